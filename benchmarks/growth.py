"""How fast and how evenly does a tree grow? Table 2 of the single-image growth paper beside ours, and what may never shrink or jump.

    python -m benchmarks.growth [-o FOLDER] [--repeat 3]

Trees of as many nodes as the paper's three (a drawn trunk of ours with branches grafted on, cut to that number) at as many times, without
export, in the same run by many times at once (`GrowthPlan.poses`) and, as a baseline, one time after the other (`GrowthPlan.at`).
`-o` draws what the paper's Figures 6 to 9 show, and curves of growth.
"""

import argparse
import time
from pathlib import Path

import numpy as np

from benchmarks.growth_pictures import draw_all
from sketchtree.growth.grafting import Graft
from sketchtree.growth.plan import MODES, GrowthPlan, Poses
from sketchtree.keys import root_key
from sketchtree.skeleton import Kind, TreeSkeleton

PAPER = {"a": (21_860, 28.8, 184, 24.0), "b": (13_348, 16.4, 165, 22.0), "c": (25_629, 30.7, 186, 24.0)}
"""Nodes, MB of the model, growth models, seconds of each row of Table 2 (a 2.9 GHz dual core, C++)."""

BAR_SECONDS, BAR_MEGABYTES = 2.0, 3.0
_BEND = -14.0


def trunk(seed: int = 0) -> TreeSkeleton:
    """A bare trunk that forks into nine limbs, such as one would take from a photo."""
    rng = np.random.default_rng(seed)
    rows: dict[str, list] = {"parent": [-1], "tip": [np.zeros(3)], "radius": [0.24], "limb": [0], "order": [0]}

    def grow(at: int, way, pieces: int, piece: float, thick: float, limb: int, order: int, up: float) -> list[int]:
        made = []
        for k in range(pieces):
            way = way + rng.normal(0, 0.09, 3) + [0, up, 0]
            way = way / np.linalg.norm(way)
            new = (at, rows["tip"][at] + piece * way, thick * (1 - 0.8 * (k + 1) / (pieces + 1)), limb, order)
            for name, value in zip(rows, new, strict=True):
                rows[name].append(value)
            at = len(rows["parent"]) - 1
            made.append(at)
        return made

    stem = grow(0, np.array([0.0, 1.0, 0.0]), 22, 0.3, 0.23, 0, 0, 0.03)
    for k, node in enumerate(stem[6:22:2]):
        azimuth = 2.4 * k + rng.normal(0, 0.3)
        way = np.array([np.cos(azimuth), 0.55 + 0.07 * k, np.sin(azimuth)])
        bough = grow(node, way / np.linalg.norm(way), 13 - k, 0.27, 0.55 * rows["radius"][node], k + 1, 1, 0.04)
        for j, fork in enumerate(bough[3:-2:3]):
            side = way + rng.normal(0, 0.6, 3)
            grow(fork, side / np.linalg.norm(side), 6 - j, 0.24, 0.6 * rows["radius"][fork], 100 + 10 * k + j, 2, 0.05)
    kind = np.full(len(rows["parent"]), int(Kind.OBSERVED))
    return TreeSkeleton.from_columns(rows["parent"], np.array(rows["tip"]), rows["radius"], limb=rows["limb"], order=rows["order"], kind=kind)


def of_nodes(count: int) -> TreeSkeleton:
    """A tree of exactly so many nodes: the first rows of one that has more."""
    for levels in (2, 3, 4):
        tree = Graft(levels)(trunk(), key=root_key(0))
        if len(tree) >= count:
            return tree.select(np.arange(len(tree)) < count)
    raise SystemExit(f"No tree of {count} nodes could be grown.")


def table(repeat: int) -> None:
    """Table 2: the paper's row, ours, and the baseline's."""
    print("Table 2       nodes  models  | paper: MB a model  seconds | ours: MB a model  seconds of CPU  (bent)   one by one")
    for name, (nodes, megabytes, models, seconds) in PAPER.items():
        tree, times = of_nodes(nodes), np.linspace(0, 1, models)
        plain, bent = (least(lambda b=bend: GrowthPlan.of(tree, bend=b).poses(times), repeat) for bend in (0.0, _BEND))
        single = least(lambda: [GrowthPlan.of(tree, bend=_BEND).at(now) for now in times[::10]], 1) * models / len(times[::10])
        poses = GrowthPlan.of(tree, bend=_BEND).poses(times)
        each = sum(array.nbytes for array in (poses.tip, poses.base, poses.radius, poses.grown)) / models / 1e6
        print(f"({name})        {nodes:7,} {models:7}  | {megabytes:17.1f} {seconds:8.0f} | {each:16.2f} {plain:15.2f} {bent:7.2f} {single:12.1f}")
        if each > BAR_MEGABYTES or bent > BAR_SECONDS:
            print(f"              over the bar of {BAR_SECONDS:g} s and {BAR_MEGABYTES:g} MB")


def least(work, repeat: int) -> float:
    """Seconds of processor time, the least of several runs."""
    best = np.inf
    for _ in range(repeat):
        start = time.process_time()
        work()
        best = min(best, time.process_time() - start)
    return best


def evenness(tree: TreeSkeleton, steps: int = 400) -> None:
    """What may never shrink, and how far anything goes between two times."""
    print("\nmode   bend | least step of: length of all (m)  of one (m)  radius (m)  count | farthest a tip goes in 1/1000 of the time (heights)   end")
    for mode in MODES:
        for bend in (0.0, _BEND, -25.0, 20.0):
            plan = GrowthPlan.of(tree, mode=mode, bend=bend)
            poses = plan.poses(np.linspace(0, 1, steps), dtype=np.float64)
            length = np.linalg.norm(poses.tip - poses.base, axis=2)
            shrink = np.diff(length.sum(axis=1)).min(), np.diff(length, axis=0).min(), np.diff(poses.radius, axis=0).min(), np.diff(poses.count).min()
            end = "equal" if np.array_equal(poses.tip[-1], tree.tip) and np.array_equal(poses.radius[-1], tree.radius) else "bent"
            print(f"{mode:6} {bend:5g} | {shrink[0]:31.1e} {shrink[1]:11.1e} {shrink[2]:11.1e} {shrink[3]:6} | {farthest(plan) / tree.height:50.4f}   {end}")


def farthest(plan: GrowthPlan, around: int = 60) -> float:
    """The farthest that any tip goes in a thousandth of the time, metres."""
    most = 0.0
    for now in np.linspace(0, 0.999, around):
        poses: Poses = plan.poses([now, now + 0.001], dtype=np.float64)
        most = max(most, float(np.linalg.norm(np.diff(poses.tip, axis=0)[0], axis=1).max()))
    return most


def main(arguments: list[str] | None = None) -> None:
    """Prints both tables, and draws."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.growth", description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", type=Path, help="a folder for the pictures")
    parser.add_argument("--repeat", type=int, default=3)
    asked = parser.parse_args(arguments)
    table(asked.repeat)
    evenness(Graft(2)(trunk(), key=root_key(0)))
    if asked.output:
        asked.output.mkdir(parents=True, exist_ok=True)
        draw_all(trunk(), asked.output)


if __name__ == "__main__":
    main()
