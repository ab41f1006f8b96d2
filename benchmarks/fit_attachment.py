"""Which curves make the reader's costs likeliest? A conditional logit over careless drawings of grown trees.

    python -m benchmarks.fit_attachment            prints the curves and how often the best arc is the true one
    python -m benchmarks.fit_attachment --write    … and writes sketchtree/sketch/joining/fitted.py

The trees are none of those that `topology` measures: the recipes grown with other seeds, and the families of
`families`. For every stroke with a known parent the arcs that the reader would consider are alternatives, of which those by
its foot on its parent are true. With u = −Σ_k c_k(x_k) of each arc, c_k piecewise linear between KNOTS, what is minimised is

    Σ_strokes [log Σ_arcs exp u − log Σ_true exp u] + ½ RIDGE |c|² + ½ STIFF Σ (second differences of c)²
"""

import argparse
import zlib
from pathlib import Path

import numpy as np
import scipy.sparse as sp
from scipy.optimize import minimize

from benchmarks.families import FAMILIES
from benchmarks.shaky import Wobbly
from benchmarks.topology import drawings
from sketchtree.axes import NULL
from sketchtree.sketch.joining import likelihood
from sketchtree.sketch.joining.bundle import Bundle
from sketchtree.sketch.joining.candidates import nearest_places
from sketchtree.sketch.joining.cleaning import clean
from sketchtree.sketch.joining.evidence import evidence, slip_of
from sketchtree.sketch.roles.sorting import sort_strokes
from sketchtree.templates.procedural import grow
from sketchtree.templates.recipe import read_recipe
from sketchtree.templates.regenerate import recipe_folder

TARGET = Path(likelihood.__file__).with_name("fitted.py")
FIRST_SEED = 1000  # of the trees grown for this
RIDGE, STIFF = 0.05, 1.5
HANDS = ((0.0, True, 0.0), (0.0, True, 0.3), (1.0, True, 1.0), (2.0, True, 1.0), (3.0, True, 1.0), (1.0, False, 1.0))  # j, moored, slips
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
    for jitter, moored, slips in hands:
        for drawn in drawings(count, jitter, moored=moored, slips=slips, first_seed=seed, source=trees):
            figures, stroke, true = alternatives(drawn)
            parts.append((figures, stroke + strokes, true))
            strokes += stroke.max(initial=-1) + 1
    return tuple(np.concatenate(column) for column in zip(*parts, strict=True))


def hats(figures) -> sp.csr_matrix:
    """The weight of every knot in every arc's curves (arc, knot)."""
    rows, columns, values, first = [], [], [], 0
    for figure, knots in zip(figures.T, (np.array(k, float) for k in KNOTS.values()), strict=True):
        x = np.clip(figure, knots[0], knots[-1])
        low = np.clip(np.searchsorted(knots, x, side="right") - 1, 0, len(knots) - 2)
        t = (x - knots[low]) / (knots[low + 1] - knots[low])
        rows += [np.arange(len(x))] * 2
        columns += [first + low, first + low + 1]
        values += [1 - t, t]
        first += len(knots)
    return sp.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(len(figures), first))


def _stiffness() -> sp.csr_matrix:
    """RIDGE and STIFF as one matrix (knot, knot)."""
    blocks = [sp.diags([1.0, -2.0, 1.0], [0, 1, 2], shape=(len(knots) - 2, len(knots))) for knots in KNOTS.values()]
    bend = sp.block_diag(blocks)
    return (RIDGE * sp.eye(bend.shape[1]) + STIFF * bend.T @ bend).tocsr()


def fit(figures, stroke, true) -> dict[str, np.ndarray]:
    """The curves: cost at every knot, 0 at the least of each."""
    hat, stiff = hats(figures), _stiffness()
    first = np.searchsorted(stroke, np.arange(stroke.max() + 1))

    def loss(utility):
        u = hat @ utility
        u -= np.maximum.reduceat(u, first)[stroke]
        e = np.exp(u)
        every, right = np.add.reduceat(e, first), np.maximum(np.add.reduceat(e * true, first), 1e-300)
        slope = hat.T @ (e / every[stroke] - e * true / right[stroke])
        return float(np.log(every / right).sum() + 0.5 * utility @ (stiff @ utility)), slope + stiff @ utility

    found = minimize(loss, np.zeros(hat.shape[1]), jac=True, method="L-BFGS-B", options={"maxiter": 300}).x
    parts = np.split(-found, np.cumsum([len(knots) for knots in KNOTS.values()])[:-1])
    return {name: part - part.min() for name, part in zip(KNOTS, parts, strict=True)}


def least(figures, stroke, true, curves) -> float:
    """What the surest attachments cost: the 1 % quantile over strokes."""
    cost = np.full(stroke.max() + 1, np.inf)
    np.minimum.at(cost, stroke[true], _cost(figures[true], curves))
    return float(np.quantile(cost, 0.01))


def _cost(figures, curves):
    return sum(np.interp(figures[:, k], KNOTS[name], curves[name]) for k, name in enumerate(KNOTS))


def hits(figures, stroke, true, curves) -> float:
    """How often the least costly arc of a stroke is a true one."""
    cost = _cost(figures, curves)
    order = np.lexsort((cost, stroke))
    return float(true[order][np.unique(stroke[order], return_index=True)[1]].mean())


def written(curves, base: float) -> str:
    """The module that holds the curves."""
    head = '"""The curves of `likelihood`: figure → (knots, cost at each). Written by `python -m benchmarks.fit_attachment --write`."""\n'
    rows = [f'    "{n}": (\n        {tuple(float(x) for x in KNOTS[n])},\n        {tuple(round(float(c), 3) for c in curves[n])},\n    ),' for n in KNOTS]
    return "\n".join([head, f"BASE = {base:.1f}  # what the surest attachments cost", "CURVES = {", *rows, "}", ""])


def main(arguments: list[str] | None = None) -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.fit_attachment", description=__doc__.splitlines()[0])
    parser.add_argument("--drawings", type=int, default=60, help="drawings by every hand (default: 60)")
    parser.add_argument("--write", action="store_true", help="make these the reader's curves")
    options = parser.parse_args(arguments)
    trees = grown(max(1, options.drawings // 15))
    table = table_of(trees, options.drawings, 0)
    curves = fit(*table)
    text = written(curves, least(*table, curves))
    print(text)
    print(f"the least costly arc is a true one: {hits(*table, curves):.4f} of {table[1].max() + 1} strokes")
    if options.write:
        TARGET.write_text(text)


if __name__ == "__main__":
    main()
