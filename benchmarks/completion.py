"""Is what the sketch left out grown as it grows? Trees that were measured branch by branch, cut back to their first two orders and
grown again.

    python -m benchmarks.completion [--skeletons DIR] [--seeds N] [--json OUT]

Orders 0 and 1 of every measured tree are the drawing, in true 3D. The template is the one that the program
chooses for their projection; Θ is measured on them. How many twigs a tree has no drawing says, so every method is told: the
density of ours, and where the baselines stop, are set to the true number of tips. Baselines: `completion_baselines`.
Bars, against the better baseline of the same run: length and angle ≤ .8 ×, height ≤ .8 ×, sky ≥ + .05, gap ≤ 120°.
"""

import argparse
import json
from pathlib import Path

import numpy as np

from benchmarks import completion_baselines
from benchmarks.cases import DATA
from benchmarks.completion_metrics import NAMES, compare
from benchmarks.drawing import Hand, draw
from benchmarks.families import measured
from sketchtree import keys
from sketchtree.axes import NULL
from sketchtree.choose import choose_template
from sketchtree.geometry.radii import PipeRadii
from sketchtree.limb_ids import stroke_limb_id
from sketchtree.propagate.drawn.implied import implied_crown
from sketchtree.propagate.generations import Propagate
from sketchtree.propagate.scale import to_scale
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.templates.estimate import estimate
from sketchtree.templates.store.database import Database
from sketchtree.traverse import is_tip, limb_chains

METHODS = ("ours", "random", "no orders")
DRAWN_ORDERS = 2
_NODE = 0.03  # H between the nodes of a drawn limb that bears no drawn one
_DENSITIES = np.geomspace(0.05, 6.0, 9)  # tried first; then halved towards the true number of tips
_HALVINGS = 5


def drawn_part(tree: TreeSkeleton) -> TreeSkeleton:
    """Orders 0 and 1 of a tree, as if each limb had been drawn by one stroke.

    A tree is digitised from lateral to lateral, so the nodes of a limb say where its laterals were. The strokes' nodes do not:
    along a limb of the last drawn order they lie every `_NODE` H."""
    kept = tree.select(tree.order < DRAWN_ORDERS)
    parent, tip, radius, order, limb = [], [], [], [], []
    row = np.zeros(len(kept), int)
    for rows in limb_chains(kept.parent, kept.limb):
        last = kept.order[rows[0]] == DRAWN_ORDERS - 1
        above = kept.parent[rows[0]]
        line = kept.tip[rows] if above == NULL else np.vstack([kept.tip[above], kept.tip[rows]])
        points = _evenly(line, _NODE * tree.height)[1:] if last and above != NULL else kept.tip[rows]
        first = len(parent)
        parent += [row[above] if above != NULL else NULL, *range(first, first + len(points) - 1)]
        row[rows] = first + np.minimum(np.arange(len(rows)), len(points) - 1)
        tip += list(points)
        radius += [float(kept.radius[rows[0]])] * len(points)
        order += [int(kept.order[rows[0]])] * len(points)
        limb += [int(kept.limb[rows[0]])] * len(points)
    stroke = np.array([stroke_limb_id(f"s{name}") for name in limb])
    return TreeSkeleton.from_columns(
        np.array(parent), np.array(tip), np.array(radius), order=np.array(order), limb=stroke, stroke=np.array(limb),
        kind=np.full(len(parent), int(Kind.DRAWN)),
    )  # fmt: skip


def _evenly(line, step: float):
    """Points every `step` or so along a polyline, its ends included."""
    along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))]
    at = np.linspace(0.0, along[-1], max(int(np.ceil(along[-1] / step)), 1) + 1)
    return np.stack([np.interp(at, along, line[:, axis]) for axis in range(3)], axis=1)


def chosen(tree: TreeSkeleton, templates: Database):
    """The exemplar that the program chooses for the projection of the drawn orders."""
    hand = Hand(azimuth=0.0, strokes=400, orders=DRAWN_ORDERS, jitter=0.0)
    graph = draw(tree, hand, name="", family="", rng=np.random.default_rng(0)).graph
    return choose_template(graph, templates, "auto")[1]


def tips(tree: TreeSkeleton) -> int:
    """Tips that were not drawn."""
    return int(np.sum(is_tip(tree.parent) & (tree.kind != Kind.DRAWN) & ~tree.is_base))


def grown(drawn: TreeSkeleton, exemplar, density: float, seed: int) -> TreeSkeleton:
    """Our growth at one density."""
    stage = Propagate(exemplar.habit, estimate(drawn), exemplar=exemplar.skeleton, density=density, thorough=1.0)
    return stage(drawn, key=keys.stage_key(keys.root_key(seed), "propagate"))


def grown_to(drawn: TreeSkeleton, exemplar, wanted: int, seed: int) -> tuple[TreeSkeleton, float]:
    """Our growth with about `wanted` tips, and its density."""
    tried = [(tips(grown(drawn, exemplar, density, seed)), density) for density in _DENSITIES]
    low = max((d for n, d in tried if n <= wanted), default=_DENSITIES[0])
    high = min((d for n, d in tried if n > wanted and d > low), default=_DENSITIES[-1])
    best = min(tried, key=lambda pair: abs(np.log(max(pair[0], 1) / wanted)))
    for _ in range(_HALVINGS):
        middle = float(np.sqrt(low * high))
        found = tips(grown(drawn, exemplar, middle, seed))
        best = min([best, (found, middle)], key=lambda pair: abs(np.log(max(pair[0], 1) / wanted)))
        low, high = (middle, high) if found <= wanted else (low, middle)
    return grown(drawn, exemplar, best[1], seed), best[1]


def figures(path: Path, templates: Database, seed: int) -> dict:
    """Every method's figures on one tree."""
    tree = measured(path)
    exemplar = chosen(tree, templates)
    tree = tree.replace(tip=tree.tip * exemplar.habit.height)
    drawn = drawn_part(tree)
    drawn = PipeRadii(exemplar.habit)(drawn)
    wanted = int(np.sum(is_tip(tree.parent) & (tree.order >= DRAWN_ORDERS)))
    ours, density = grown_to(drawn, exemplar, wanted, seed)
    envelope = implied_crown(drawn, to_scale(exemplar.habit, drawn), exemplar.skeleton)
    made = {"ours": ours}
    for name in ("random", "no orders"):
        rng = np.random.default_rng([seed, len(name)])
        made[name] = completion_baselines.replicated(drawn, envelope, wanted, random=name == "random", rng=rng)
    true_new = tree.order >= DRAWN_ORDERS
    result = {name: compare(tree, true_new, each, each.kind != Kind.DRAWN) | {"tips": tips(each)} for name, each in made.items()}
    return result | {"tree": path.stem, "template": exemplar.name, "tips": wanted, "density": density}


def main(argv=None) -> None:
    """Prints a table: every tree, then the medians and the bars."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--skeletons", type=Path, default=DATA / "measured")
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(argv)
    templates = Database.open()
    runs = [figures(path, templates, seed) for path in sorted(options.skeletons.glob("*.npz")) for seed in range(options.seeds)]
    head = f"{'tree':22s}{'method':11s}{'tips':>6s}" + "".join(f"{name:>9s}" for name in NAMES)
    print(head)
    for run in runs:
        print(f"{run['tree']:22s}{run['template']}, {run['tips']} tips, density {run['density']:.2f}")
        for name in METHODS:
            print(f"{'':22s}{name:11s}{run[name]['tips']:6d}" + "".join(f"{run[name][figure]:9.3f}" for figure in NAMES))
    print("means")
    mean = mean_of(runs)
    for name in METHODS:
        print(f"{'':22s}{name:17s}" + "".join(f"{mean[name][figure]:9.3f}" for figure in NAMES))
    print(verdict(mean))
    if options.json:
        options.json.write_text(json.dumps({"runs": runs, "mean": mean}, indent=1) + "\n")


def mean_of(runs: list[dict]) -> dict:
    """{method: {figure: mean over the runs}}."""
    return {name: {figure: float(np.mean([run[name][figure] for run in runs])) for figure in NAMES} for name in METHODS}


def verdict(mean: dict) -> str:
    """Ours against the better baseline, beside the bars."""
    lines = []
    for figure, bar in (("length", 0.8), ("angle", 0.8), ("height", 0.8)):
        better = min(mean[name][figure] for name in METHODS[1:])
        ratio = mean["ours"][figure] / better
        lines.append(f"{figure}: {ratio:.2f} x the better baseline (bar {bar}) {'met' if ratio <= bar else 'MISSED'}")
    gain = mean["ours"]["sky"] - max(mean[name]["sky"] for name in METHODS[1:])
    lines.append(f"sky: {gain:+.3f} (bar +.05) {'met' if gain >= 0.05 else 'MISSED'}")
    return "\n".join(lines)


if __name__ == "__main__":
    main()
