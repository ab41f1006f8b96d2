"""How long does it take to give a skeleton its radii, its wood and its file? `python -m benchmarks.mesh`

Prints one line a size and way to make the wood: segments, limbs, triangles, and warm seconds (the best of `--repeats`) for the pipe
model, the wood and the GLB on disk; then whether the wood, welded, is closed: parts, open and non-manifold edges. One piece is made up to
`--joined` segments. The tree is an oak-like one that branches until it has the number of segments.
"""

import argparse
import platform
import sys
import tempfile
import time
from pathlib import Path

import jax
import numpy as np

from sketchtree.export.gltf import write_glb
from sketchtree.geometry.bark import bark_material
from sketchtree.geometry.radii import PipeRadii
from sketchtree.geometry.wood import wood_mesh
from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton


def branching_tree(segments: int, seed: int = 0, nodes: int = 5) -> TreeSkeleton:
    """A tree of limbs of `nodes` segments, each limb's laterals half as long, until there are `segments` rows."""
    rng = np.random.default_rng(seed)
    parent, tip, order, limb = [-1], [np.zeros(3)], [0], [0]
    waiting = [(0, np.array([0.0, 1.0, 0.0]), 7.0, 0)]  # row, direction, length, order
    while waiting and len(parent) <= segments:
        row, direction, length, level = waiting.pop(0)
        name = len(parent)
        for _ in range(nodes):
            direction = direction + rng.normal(0.0, 0.1, 3) + [0.0, 0.04, 0.0]
            direction = direction / np.linalg.norm(direction)
            parent.append(row)
            tip.append(tip[row] + direction * length / nodes)
            order.append(level)
            limb.append(name)
            row = len(parent) - 1
            side = np.cross(direction, rng.normal(size=3))
            angle = np.radians(rng.uniform(35, 65))
            turned = direction * np.cos(angle) + side / np.linalg.norm(side) * np.sin(angle)
            waiting.append((row, turned, length * rng.uniform(0.45, 0.65), level + 1))
    return TreeSkeleton.from_columns(
        np.array(parent), np.array(tip), np.full(len(parent), 0.01), order=np.array(order), limb=np.array(limb)
    )


def fastest(repeats: int, work):
    """Least seconds over the repeats, and the last result."""
    best = np.inf
    for _ in range(repeats):
        begin = time.perf_counter()
        result = work()
        best = min(best, time.perf_counter() - begin)
    return best, result


def main(arguments: list[str]) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--segments", type=int, nargs="+", default=[500, 5_000, 50_000])
    parser.add_argument("--joined", type=int, default=10_000, help="segments up to which wood is made in one piece too")
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args(arguments)
    from benchmarks.wood_audit import audit  # which takes its largest tree from here

    key = jax.random.key(0)
    bark, _ = fastest(1, lambda: bark_material("oak"))
    print(f"{platform.machine()} {platform.system()}, Python {platform.python_version()}; bark drawn in {bark:.2f} s")
    print(f"{'segments':>9} {'limbs':>7} {'wood':>10} {'triangles':>10} {'radii s':>8} {'wood s':>8} {'glb s':>8} {'MB':>7} {'parts':>7} {'open':>5} {'nonman':>6}")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "tree.glb"
        for segments in options.segments:
            bare = branching_tree(segments)
            radii, tree = fastest(options.repeats, lambda bare=bare: PipeRadii(Habit())(bare))
            for way in ("tubes", "one-piece") if segments <= options.joined else ("tubes",):
                wood, mesh = fastest(options.repeats, lambda tree=tree, way=way: wood_mesh(tree, bark="oak", key=key, wood=way))
                glb, _ = fastest(options.repeats, lambda mesh=mesh: write_glb(path, [mesh]))
                found = audit(mesh.position, mesh.triangle)
                print(
                    f"{tree.segment_count:>9} {len(np.unique(tree.limb)):>7} {way:>10} {len(mesh.triangle):>10} {radii:>8.3f} {wood:>8.3f} {glb:>8.3f} "
                    f"{path.stat().st_size / 1e6:>7.1f} {found['parts']:>7} {found['open']:>5} {found['nonmanifold']:>6}",
                    flush=True,
                )


if __name__ == "__main__":
    main(sys.argv[1:])
