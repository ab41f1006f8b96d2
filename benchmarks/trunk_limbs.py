"""Is a trunk from a photo that of the tree? Limbs against those traced by hand, and how round the crown is seen from above.

    python -m benchmarks.trunk_limbs --shared DIR [--only WORD] [--mattes FOLDER]

Four trees: sugar maple, tulip tree, English elm (Levison 1914) and the birch before several backgrounds. Limbs by hand: `data/limbs_by_hand`, and `photo_cases` of the folder given.

    found      length of the limbs by hand that has a traced line near it (1.2 % of the photo's height, or half the limb's width)
    spurious   length of the traced lines that has no limb near it, twigs marked as optional among those that count
    radius     |traced − true| / true over what lies on a limb, median; and the trunk's below its first limb, signed
    bends      turning of the traced limbs in degrees a hundred pixels, over that of the limbs by hand
    depth      spread in depth over spread in width of the tips (standard deviations); of the trunk alone, then with three levels grafted on
    round      least over greatest of the spreads over all horizontal directions
    gap        the largest angle, degrees, seen from the trunk, in which no limb's tip stands

--mattes keeps the mattes in a folder, and takes them from it where it has them.
"""

import argparse
import json
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from benchmarks.matting_cases import SCRIBBLES, Case, birch_cases, given_cases, real_cases
from benchmarks.photo_truth import NEAR, walked
from sketchtree.growth.grafting import Graft
from sketchtree.keys import root_key, stage_key
from sketchtree.matting.matte import find_matte
from sketchtree.skeleton import TreeSkeleton
from sketchtree.sketch.graph import SketchGraph
from sketchtree.trunk.as_tree import as_tree
from sketchtree.trunk.limbs import trunk_drawing
from sketchtree.trunk.skeletonise import GAP, trunk_skeleton

HAND = SCRIBBLES.parent / "limbs_by_hand"
BIRCH = ("sky, usual", "grass, usual", "meadow, usual", "house, usual", "leafy, usual", "birch_photo")
SEEDS = 3
_LEVELS = 3
_TWIG = 0.003  # metres


def cases(shared: Path) -> list[tuple[Case, dict]]:
    """Photos with scribbles, and the limbs of their trees."""
    birch = json.loads((shared / "photo_cases" / "tuxpaint_birch_sky.json").read_text())
    found = []
    for case in real_cases(shared):
        own = HAND / f"{case.name}.json"
        found.append((case, json.loads((own if own.exists() else shared / "photo_cases" / f"{case.name}.json").read_text())))
    every = {case.name: case for case in (*birch_cases(shared), *given_cases(shared))}
    return found + [(every[name], birch) for name in BIRCH]


def against_hand(graph: SketchGraph, hand: dict) -> dict[str, float]:
    """Traced limbs against those drawn by hand."""
    lines = [(walked(limb["points"], limb["widths"]), limb.get("optional", False)) for limb in hand["limbs"]]
    must, may = np.concatenate([line for line, optional in lines if not optional]), np.concatenate([line for line, _ in lines])
    rows = np.flatnonzero(~graph.is_base)
    ours = np.concatenate([_traced(graph, row) for row in rows])
    reach = NEAR * hand["height"]
    away, which = cKDTree(may[:, :2]).query(ours[:, :2])
    on = away <= np.maximum(reach, 0.5 * may[which, 2])
    back, _ = cKDTree(ours[:, :2]).query(must[:, :2])
    trunk = ours[on & (which < len(lines[0][0]) // 2)]
    beside = must[cKDTree(must[:, :2]).query(trunk[:, :2])[1], 2]
    return {
        "found": float((back <= np.maximum(reach, 0.5 * must[:, 2])).mean()),
        "spurious": float(1.0 - on.mean()),
        "radius": float(np.median(np.abs(ours[on, 2] - may[which[on], 2]) / may[which[on], 2])),
        "trunk": float(np.median(trunk[:, 2] / beside) - 1.0) if len(trunk) else float("nan"),
        "bends": _turning([graph.curve(row)[:, :2] for row in rows]) / _turning([np.array(limb["points"], float) for limb in hand["limbs"]]),
    }


def _traced(graph: SketchGraph, row: int) -> np.ndarray:
    line = graph.curve(row) * [1.0, -1.0]
    up = graph.parent[row]
    first = graph.width[up] if graph.limb[up] == graph.limb[row] else graph.width[row]
    run = np.r_[0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T))]
    return walked(line, first + (graph.width[row] - first) * run / max(run[-1], 1e-9))


def _turning(lines) -> float:
    """Degrees that lines turn a hundred pixels, seen over steps of six."""
    turned = length = 0.0
    for line in lines:
        run = np.r_[0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T))]
        at = np.arange(0.0, run[-1], 6.0)
        if len(at) > 2:
            heading = np.unwrap(np.arctan2(*np.diff(np.column_stack([np.interp(at, run, line[:, k]) for k in (0, 1)]), axis=0).T))
            turned += np.degrees(np.abs(np.diff(heading)).sum())
        length += run[-1]
    return 100.0 * turned / max(length, 1e-9)


def roundness(tree: TreeSkeleton) -> dict[str, float]:
    """How a crown spreads seen from above: by the tips of its branches, each as heavy as its last piece is high above the lowest fork."""
    ends = np.ones(len(tree), bool)
    ends[tree.parent[tree.parent >= 0]] = False
    plan = tree.tip[ends][:, [0, 2]]
    spread = np.cov(plan.T, bias=True)
    least, most = np.sqrt(np.maximum(np.linalg.eigvalsh(spread), 0.0))
    middle = plan - plan.mean(axis=0)
    far = middle[np.hypot(*middle.T) >= 0.5 * np.quantile(np.hypot(*middle.T), 0.9)]
    angle = np.sort(np.degrees(np.arctan2(*far.T)))
    return {"depth": float(np.sqrt(spread[1, 1] / spread[0, 0])), "round": float(least / most), "gap": float(np.diff(np.r_[angle, angle[0] + 360.0]).max())}


def measured(case: Case, hand: dict, mattes: Path | None) -> dict:
    """A row of the table."""
    skeleton = trunk_skeleton(_alpha(case, mattes), gap=GAP)
    row = {"case": case.name, "limbs": against_hand(trunk_drawing(skeleton)[1], hand), "bare": [], "crown": []}
    for seed in range(SEEDS):
        tree = as_tree(skeleton, key=stage_key(root_key(seed), "trunk"))
        row["bare"].append(roundness(tree))
        row["crown"].append(roundness(Graft(_LEVELS, min(_TWIG, float(tree.radius.min())))(tree, key=root_key(seed))))
    return row


def _alpha(case: Case, mattes: Path | None):
    kept = None if mattes is None else mattes / f"{case.name.replace(', ', '_')}.npy"
    if kept is not None and kept.exists():
        return np.load(kept)
    alpha = find_matte(case.photo, case.scribbles, key=stage_key(root_key(0), "matte")).alpha
    if kept is not None:
        mattes.mkdir(parents=True, exist_ok=True)
        np.save(kept, alpha)
    return alpha


def told(row: dict) -> str:
    """One line of the table."""
    limbs = row["limbs"]
    seen = [
        "{} depth {:.2f} round {:.2f} gap {:3.0f}".format(name, *(np.median([one[what] for one in row[name]]) for what in ("depth", "round", "gap"))) for name in ("bare", "crown")
    ]
    return "{:18} found {found:.2f} spurious {spurious:.2f} radius {radius:.0%} trunk {trunk:+.0%} bends {bends:.1f} | ".format(row["case"], **limbs) + " | ".join(seen)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--shared", type=Path, required=True)
    parser.add_argument("--only", default="")
    parser.add_argument("--mattes", type=Path)
    options = parser.parse_args()
    for case, hand in cases(options.shared):
        if options.only in case.name:
            print(told(measured(case, hand, options.mattes)), flush=True)


if __name__ == "__main__":
    main()
