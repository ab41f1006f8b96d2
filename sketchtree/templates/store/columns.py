"""Which columns does the database file have? Exemplars to arrays and back.

One dataset a column, all exemplars after one another; ragged columns (skeletons) are cut by
`skeleton/start`. `COLUMNS` is the whole schema: name, stored type, unit, meaning; `template_db/README.md` shows it.
Schema 2 added `exemplar/species` and `exemplar/growth_habit`.
"""

import dataclasses
import json
from collections.abc import Iterator, Sequence

import numpy as np

from sketchtree.parameters import Habit, LimbStatistics, TreeParameters
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.exemplar import Exemplar, Views
from sketchtree.templates.seen.footprint import view_azimuths

SCHEMA = 2

THETA = tuple(f.name for f in dataclasses.fields(TreeParameters))
LIMBS = {
    "divergence_count": "1", "divergence_mean": "rad", "divergence_variance": "rad2",
    "length_count": "1", "length_mean": "1", "length_variance": "1", "bend_count": "1", "bend_square": "rad2",
}  # fmt: skip

COLUMNS: dict[str, tuple[str, str, str]] = {
    "exemplar/name": ("S", "", "name, unique"),
    "exemplar/title": ("S", "", "name for people, UTF-8"),
    "exemplar/species": ("S", "", "botanical name, UTF-8; empty: not said"),
    "exemplar/growth_habit": ("S", "", "one of recipe.GROWTH_HABITS; empty: not said"),
    "exemplar/recipe": ("S", "", "text of the recipe, UTF-8; empty: a digitised tree"),
    "exemplar/source": ("S", "", "where the recipe's figures come from, or the tree itself"),
    "exemplar/habit": ("S", "", "parameters.Habit as JSON; angles in degrees, lengths in metres"),
    "exemplar/version": ("S", "", "version of the program that grew or imported it"),
    "exemplar/seed": ("i8", "1", "seed it was grown with; 0: a digitised tree"),
    "exemplar/thumbnail": ("u1", "1", "grey picture, 255 paper, 0 wood: (exemplar, row, column)"),
    "theta/tree": ("f8", "rad", "Θ in the order of TreeParameters' fields, scale without unit: (exemplar, 8)"),
    "theta/order": ("f8", "rad", "the same of pairs whose parent has order 0, 1, 2+: (exemplar, 3, 8)"),
    **{f"limbs/{k}": ("i8" if "count" in k else "f8", unit, f"LimbStatistics.{k}: (exemplar, order)") for k, unit in LIMBS.items()},
    "skeleton/start": ("i8", "1", "rows of exemplar i are start[i] to start[i + 1]: (exemplar + 1)"),
    "skeleton/parent": ("i4", "1", "row of the parent within the exemplar; -1 at a base: (row)"),
    "skeleton/tip": ("f4", "m", "end point, y up: (row, 3)"),
    "skeleton/radius": ("f4", "m", "at the tip: (row)"),
    "skeleton/order": ("i1", "1", "branching order, 0 a trunk: (row)"),
    "skeleton/limb": ("i4", "1", "number of the limb within the exemplar: (row)"),
    "views/azimuth": ("f8", "deg", "azimuth of every view, elevation 0: (view)"),
    "views/footprint": ("f4", "1", "f of the silhouette without the root branch: (exemplar, view, direction)"),
    "views/branching_mean": ("f4", "1, rad, rad", "μ of s, α, β in 2D; NaN none: (exemplar, view, 3)"),
    "views/branching_sd": ("f4", "1, rad, rad", "σ of s, α, β in 2D: (exemplar, view, 3)"),
    "views/branching_count": ("f4", "1", "pairs behind them: (exemplar, view, 3)"),
    "views/posture": ("f4", "1", "features of templates.posture: (exemplar, view, feature)"),
}

TEXTS = tuple(name for name, (dtype, _, _) in COLUMNS.items() if dtype == "S")
START = "skeleton/start"
ROWS = tuple(name for name in COLUMNS if name.startswith("skeleton/") and name != START)
ONCE = ("views/azimuth",)  # the same for every exemplar


def texts(*, name, title, species, growth_habit, recipe, source, habit: Habit, version) -> dict[str, bytes]:
    """The text columns of one exemplar."""
    values = (name, title, species, growth_habit, recipe, source, json.dumps(dataclasses.asdict(habit), sort_keys=True), version)
    return {column: text.encode("utf-8") for column, text in zip(TEXTS, values, strict=True)}


def to_columns(exemplars: Sequence[Exemplar], views: Sequence[Views]) -> dict[str, np.ndarray]:
    """All columns of a database of these exemplars."""
    trees = [e.skeleton for e in exemplars]
    words = [texts(**{k.partition("/")[2]: getattr(e, k.partition("/")[2]) for k in TEXTS}) for e in exemplars]
    raw = {
        **{column: [row[column] for row in words] for column in TEXTS},
        "exemplar/seed": [e.seed for e in exemplars],
        "exemplar/thumbnail": np.stack([e.thumbnail for e in exemplars]),
        "theta/tree": [dataclasses.astuple(e.theta) for e in exemplars],
        "theta/order": [[dataclasses.astuple(t) for t in e.theta_order] for e in exemplars],
        **{f"limbs/{k}": [getattr(e.limbs, k) for e in exemplars] for k in LIMBS},
        "skeleton/start": np.r_[0, np.cumsum([len(t) for t in trees])],
        **{f"skeleton/{k}": np.concatenate([getattr(t, k) for t in trees]) for k in ("parent", "tip", "radius", "order", "limb")},
        "views/azimuth": view_azimuths(),
        "views/footprint": [v.footprint for v in views],
        "views/branching_mean": [v.branching.mean for v in views],
        "views/branching_sd": [v.branching.sd for v in views],
        "views/branching_count": [v.branching.count for v in views],
        "views/posture": [v.posture for v in views],
    }
    return {name: _stored(raw[name], COLUMNS[name][0]) for name in COLUMNS}


def _stored(values, dtype: str) -> np.ndarray:
    if dtype == "S":
        return np.array(values)
    return np.ascontiguousarray(np.asarray(values), dtype=np.dtype("<" + dtype))


def split(columns: dict[str, np.ndarray]) -> Iterator[dict[str, np.ndarray]]:
    """The columns of one exemplar after another."""
    for i in range(len(columns["exemplar/name"])):
        yield block_at(lambda name, first, last: columns[name][first:last], i)


def block_at(column, index: int) -> dict[str, np.ndarray]:
    """The columns of exemplar `index` alone; `column(name, first, last)` gives a part of a column."""
    start = column(START, index, index + 2)
    block = {name: column(name, index, index + 1) for name in COLUMNS if name not in (START, *ROWS, *ONCE)}
    block |= {name: column(name, int(start[0]), int(start[1])) for name in ROWS}
    block |= {name: column(name, 0, None) for name in ONCE}
    return block | {START: start - start[0]}


def exemplar_at(column, index: int) -> Exemplar:
    """Exemplar `index`; `column(name, first, last)` gives a part of a column."""

    def one(name):
        return column(name, index, index + 1)[0]

    def text(name):
        return one(name).decode("utf-8")

    first, last = (int(x) for x in column("skeleton/start", index, index + 2))
    rows = {k: column(f"skeleton/{k}", first, last) for k in ("parent", "tip", "radius", "order", "limb")}
    return Exemplar(
        name=text("exemplar/name"),
        title=text("exemplar/title"),
        species=text("exemplar/species"),
        growth_habit=text("exemplar/growth_habit"),
        theta=TreeParameters(*one("theta/tree").tolist()),
        theta_order=tuple(TreeParameters(*row) for row in one("theta/order").tolist()),
        limbs=LimbStatistics(**{k: one(f"limbs/{k}") for k in LIMBS}),
        habit=Habit(**json.loads(text("exemplar/habit"))),
        skeleton=TreeSkeleton.from_columns(**rows),
        thumbnail=one("exemplar/thumbnail"),
        recipe=text("exemplar/recipe"),
        source=text("exemplar/source"),
        seed=int(one("exemplar/seed")),
        version=text("exemplar/version"),
    )
