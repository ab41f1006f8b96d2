"""Which curves make the reader's costs likeliest? A conditional logit over careless drawings of grown trees.

    python -m benchmarks.fit_attachment            prints the curves and how often the best arc is the true one
    python -m benchmarks.fit_attachment --write    … and writes sketchtree/sketch/joining/fitted.py

The trees are none of those that `topology` measures: the recipes grown with other seeds, and the families of
`families`. For every stroke with a known parent the arcs that the reader would consider are alternatives, of which those by
its foot on its parent are true; `conditional_logit` finds the curves.
"""

import argparse
import zlib
from pathlib import Path

import numpy as np

from benchmarks.conditional_logit import fit, hits, least
from benchmarks.families import FAMILIES
from benchmarks.shaky import Wobbly
from benchmarks.topology import drawings
from sketchtree.axes import NULL
from sketchtree.sketch.joining import fitted
from sketchtree.sketch.joining.bundle import Bundle
from sketchtree.sketch.joining.candidates import nearest_places
from sketchtree.sketch.joining.cleaning import clean
from sketchtree.sketch.joining.evidence import evidence, slip_of
from sketchtree.sketch.roles.sorting import sort_strokes
from sketchtree.templates.growing.procedural import grow
from sketchtree.templates.growing.recipe import read_recipe
from sketchtree.templates.making.regenerate import recipe_folder

TARGET = Path(fitted.__file__)
FIRST_SEED = 1000  # of the trees grown for this
ORDERS = (2, 3, 4)
HANDS: tuple[dict, ...] = (
    {"jitter": 0.0, "slips": 0.0},
    {"jitter": 0.2, "slips": 0.3},
    {"jitter": 0.0, "slips": 0.3},
    {"jitter": 0.0},
    {"jitter": 1.0},
    {"jitter": 2.0},
    {"jitter": 3.0},
    {"jitter": 1.0, "short": False},
    {"jitter": 2.0, "short": False},
    {"jitter": 1.0, "moored": False},
    {"jitter": 2.0, "moored": False},
)
_TURNS = tuple(np.radians([0, 20, 40, 60, 80, 100, 120, 150, 180]).round(4).tolist())
KNOTS = {
    "gap": (0, 0.002, 0.005, 0.01, 0.015, 0.02, 0.03, 0.045, 0.07, 0.12, 0.25),
    "slip": (0, 0.25, 0.5, 1, 2, 3, 5, 8, 15, 40),
    "over": (0, 0.005, 0.01, 0.015, 0.025),
    "rise": (-1, -0.5, 0, 0.5, 1),
    "outward": (-1, -0.6, -0.2, 0.2, 0.6, 1),
    "longer": (-3, -2, -1, -0.5, 0, 0.5, 1, 2),
    "size": (-3, -2, -1.4, -0.8, -0.3, 0.3),
    "carries": (0, 1, 2, 4, 8, 16),
    "aim": (0, 0.004, 0.008, 0.012, 0.016, 0.02, 0.03, 0.04, 0.0799, 0.08),
    "aimed": (0, 0.004, 0.008, 0.012, 0.016, 0.02, 0.03, 0.06, 0.1199, 0.12),
    "beside": (0, 0.05, 0.15, 0.3, 0.5, 0.75, 1, 1.6, 3),
    "turn": _TURNS,
    "sweep": _TURNS,
    "at_tip": _TURNS[::2],
    "foot": (0, 0.005, 0.01, 0.015, 0.02, 0.03, 0.045, 0.07, 0.1, 0.2, 0.5),
    "tip": (0, 0.005, 0.01, 0.02, 0.03, 0.05, 0.1, 0.3),
    "place": (0, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.95, 1),
}


def grown(turns: int) -> list[tuple[str, object]]:
    """(name, skeleton) of `turns` trees of every recipe and every family, none of them an exemplar."""
    made = []
    for turn in range(FIRST_SEED, FIRST_SEED + turns):
        made += [(path.stem, grow(read_recipe(path), turn)) for path in sorted(recipe_folder().glob("*.toml"))]
        made += [(name, grown_by(np.random.default_rng([turn, zlib.crc32(name.encode())]))) for name, grown_by in FAMILIES.items()]
    return made


def alternatives(drawn: Wobbly):
    """(figures (arc, k), stroke of each arc, whether it is true) of one drawing; strokes without a true arc are left out."""
    lines = clean(sort_strokes(drawn.sketch).lines).lines
    owner = {name: k for k, names in enumerate(drawn.ids) for name in names}
    who = np.array([owner[line.id] for line in lines])
    foot = np.array([drawn.line[k][0] for k in who])
    gaps = [np.hypot(*(np.array([line.points[end] for line in lines]) - foot).T) for end in (0, -1)]
    end = (gaps[0] > gaps[1]).astype(int)
    bundle = Bundle.of(lines)
    arcs = nearest_places(bundle)
    table = evidence(bundle, arcs, drawn.line[0][0])
    side = end[arcs.parent]
    true = (arcs.end == end[arcs.child]) & (who[arcs.parent] == drawn.parent[who[arcs.child]])
    table["slip"] = table["miss"] / slip_of(arcs.gap[true] / bundle.height)
    figures = np.stack([table[name][np.arange(len(side)), side if table[name].shape[1] > 1 else 0] for name in KNOTS], 1)
    whole = (np.bincount(who, minlength=len(drawn.line))[who] == 1) & (drawn.parent[who] != NULL)
    answered = np.zeros(len(lines), bool)
    answered[arcs.child[true]] = True
    used = (whole & answered)[arcs.child]
    return figures[used], np.unique(arcs.child[used], return_inverse=True)[1], true[used]


def table_of(trees, count: int, seed: int, hands=HANDS):
    """The alternatives of `count` drawings by every hand, strokes numbered on."""
    parts, strokes = [], 0
    for hand in hands:
        for drawn in drawings(count, first_seed=seed, source=trees, orders=ORDERS, **hand):
            figures, stroke, true = alternatives(drawn)
            parts.append((figures, stroke + strokes, true))
            strokes += stroke.max(initial=-1) + 1
    return tuple(np.concatenate(column) for column in zip(*parts, strict=True))


def written(curves, base: float) -> str:
    """The module that holds the curves."""
    head = '"""The curves of `likelihood`: figure → (knots, cost at each). Written by `python -m benchmarks.fit_attachment --write`."""\n'
    rows = [f'    "{n}": (\n        {tuple(map(float, KNOTS[n]))},\n        {tuple(round(float(c), 3) for c in curves[n])},\n    ),' for n in KNOTS]
    return "\n".join([head, f"BASE = {base:.1f}  # what the surest attachments cost", "CURVES = {", *rows, "}", ""])


def main(arguments: list[str] | None = None) -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.fit_attachment", description=__doc__.splitlines()[0])
    parser.add_argument("--drawings", type=int, default=90, help="drawings by every hand (default: 90)")
    parser.add_argument("--write", action="store_true", help="make these the reader's curves")
    options = parser.parse_args(arguments)
    trees = grown(max(1, options.drawings // 15))
    table = table_of(trees, options.drawings, 0)
    curves = fit(KNOTS, *table)
    text = written(curves, least(KNOTS, *table, curves))
    print(text)
    print(f"the least costly arc is a true one: {hits(KNOTS, *table, curves):.4f} of {table[1].max() + 1} strokes")
    if options.write:
        TARGET.write_text(text)


if __name__ == "__main__":
    main()
