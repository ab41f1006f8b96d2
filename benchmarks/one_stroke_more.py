"""Does one stroke more leave the rest of the tree as it was? `python -m benchmarks.one_stroke_more [SKETCH ...]`

Of every drawing (default: the examples) each of a few limbs is left out in turn, in 3D, so that depths are the same with and without it.
Both trees are grown with the same key. Of the undrawn limbs that do not grow from that limb:

    same      end where they did, to a thousandth of the tree's height
    near      end within 2 % of it
    gone      are not there any more, or were not there before: mostly around the stroke, where there is less or more room

"""

import argparse
from pathlib import Path

import numpy as np

from sketchtree import keys
from sketchtree.options import TreeOptions
from sketchtree.pipeline import draw_out, propagation
from sketchtree.propagate.after.cutting import borne
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.templates.store.database import Database
from sketchtree.traverse import is_tip

ROOT = Path(__file__).resolve().parents[1]
LEFT_OUT = 4  # limbs of each drawing, one at a time


def ends(tree: TreeSkeleton) -> dict[int, np.ndarray]:
    """{limb: its tip} of what was not drawn."""
    rows = np.flatnonzero((tree.kind == Kind.PROPAGATED) & ~tree.is_base)
    return {int(tree.limb[row]): tree.tip[row] for row in rows}  # a limb's last row stands last


def without(tree: TreeSkeleton, limb: int) -> TreeSkeleton:
    """The drawing without one limb and all it bears."""
    mine = tree.limb == limb
    return tree.select(~(mine | borne(tree.parent, mine)))


def shares(drawn, limb: int, key) -> tuple[float, float, float]:
    """(same, near, gone)."""
    stage = propagation(drawn, TreeOptions())
    whole, less = stage(drawn.skeleton, key=key), stage(without(drawn.skeleton, limb), key=key)
    on = whole.limb == limb
    on |= borne(whole.parent, on)
    theirs = set(whole.limb[on].tolist())
    before, after = ends(less), {limb: tip for limb, tip in ends(whole).items() if limb not in theirs}
    both = before.keys() & after.keys()
    apart = np.array([np.linalg.norm(before[limb] - after[limb]) for limb in both]) / whole.height
    total = len(before.keys() | after.keys())
    return float(np.sum(apart < 1e-3) / total), float(np.sum(apart < 0.02) / total), 1.0 - len(both) / total


def main(argv=None) -> None:
    """Prints one line a drawing."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sketches", nargs="*", type=Path)
    sketches = parser.parse_args(argv).sketches or sorted((ROOT / "examples").glob("*.svg"))
    templates, key = Database.open(), keys.root_key(0)
    print(f"{'drawing':20s}{'same':>8s}{'near':>8s}{'gone':>8s}")
    for sketch in sketches:
        drawn = draw_out(sketch, templates, key=key)
        tree = drawn.skeleton
        limbs = np.unique(tree.limb[(tree.order == 1) & is_tip(tree.parent)])
        limbs = limbs[np.linspace(0, len(limbs) - 1, min(LEFT_OUT, len(limbs))).astype(int)]
        found = np.mean([shares(drawn, int(limb), keys.stage_key(key, "propagate")) for limb in limbs], axis=0)
        print(f"{sketch.stem:20s}" + "".join(f"{share:8.0%}" for share in found))


if __name__ == "__main__":
    main()
