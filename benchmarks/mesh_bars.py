"""Do meshes and files keep their bars of time and size? `python -m benchmarks.mesh_bars [--repeats N] [--cold]`

Prints one line a bar. Seconds are warm, the best of `--repeats`; a machine that does other work at the time makes them longer. The trees are those of
`benchmarks.mesh`, oak-like, with oak leaves:

    default      200 segments and as many leaves as make 20,000 triangles with the tubes: wood and leaves meshed; its GLB on disk
    5,000        segments and 30,000 leaves: from the skeleton, with its leaves placed, to the GLB on disk
    100,000      segments: pipe model, leaves, wood, GLB on disk; with the most memory that the whole run held
    cold         `sketchtree build examples/oak.svg` in a process of its own, compiled before (with `--cold`)
"""

import argparse
import os
import platform
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import jax
import numpy as np

from benchmarks.mesh import branching_tree, fastest
from sketchtree.asset import Asset
from sketchtree.export.write import write_asset
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.instanced import leaf_instances
from sketchtree.foliage.leaves import Leaves, select
from sketchtree.foliage.populate import populate
from sketchtree.geometry.radii import PipeRadii
from sketchtree.geometry.wood import wood_of
from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton

ROOT = Path(__file__).resolve().parents[1]
KEY = jax.random.key(0)
DEFAULT, DEFAULT_TRIANGLES = 200, 20_000


def leafy_tree(segments: int, leaves: int) -> tuple[TreeSkeleton, Leaves]:
    """A tree with its radii, and so many leaves on it, or as many as find room."""
    tree = PipeRadii(Habit())(branching_tree(segments))
    return tree, populate(tree, Habit(), key=KEY, model="oak", density=4.0, max_leaves=leaves)


def wooden(tree: TreeSkeleton, way: str | None):
    """The wood of the tree, as meshes."""
    return wood_of(tree, bark="oak", habit=Habit(), key=KEY, wood=way).meshes


def written(path: Path, tree: TreeSkeleton, parts) -> float:
    """MB of the file."""
    write_asset(path, Asset.of(parts, skeleton=tree))
    return path.stat().st_size / 1e6


def told(name: str, value: float, bar: float, unit: str) -> None:
    """One line of the table."""
    print(f"{name:56s} {value:9.3f} {unit:3s} bar {bar:6g}   {'kept' if value <= bar else f'OVER, x {value / bar:.2f}'}", flush=True)


def default_tree(folder: Path, repeats: int) -> None:
    """The bars of a tree of 20,000 triangles."""
    tree, leaves = leafy_tree(DEFAULT, 5_000)
    tubes = sum(mesh.triangle_count for mesh in wooden(tree, "tubes"))
    each = leaf_mesh(leaves).triangle_count / len(leaves)
    leaves = select(leaves, np.arange(len(leaves)) < (DEFAULT_TRIANGLES - tubes) / each)
    for way, bar in (("tubes", 0.1), ("one-piece", 0.6)):
        seconds, parts = fastest(repeats, lambda way=way: (*wooden(tree, way), leaf_mesh(leaves)))
        told(f"default, {sum(part.triangle_count for part in parts):,} triangles, {way}: meshed", seconds, bar, "s")
        told(f"default, {way}: GLB", written(folder / "default.glb", tree, parts), 2.0, "MB")


def large_tree(folder: Path, repeats: int) -> None:
    """The bars of 5,000 segments and 30,000 leaves."""
    tree, leaves = leafy_tree(5_000, 30_000)
    name = f"{tree.segment_count:,} segments, {len(leaves):,} leaves"
    for way, bar in (("tubes", 1.0), ("one-piece", 4.0)):
        seconds, size = fastest(repeats, lambda way=way: written(folder / "large.glb", tree, (*wooden(tree, way), leaf_mesh(leaves))))
        told(f"{name}, {way}: to disk", seconds, bar, "s")
        told(f"{name}, {way}: merged", size, 40.0, "MB")
        told(f"{name}, {way}: instanced", written(folder / "large.glb", tree, (*wooden(tree, way), *leaf_instances(leaves))), 8.0, "MB")


def huge_tree(folder: Path) -> None:
    """The bars of 100,000 segments, made once."""
    bare = branching_tree(100_000)
    began = time.perf_counter()
    tree = PipeRadii(Habit())(bare)
    leaves = populate(tree, Habit(), key=KEY, model="oak")
    parts = (*wooden(tree, None), leaf_mesh(leaves))
    size = written(folder / "huge.glb", tree, parts)
    name = f"{tree.segment_count:,} segments, {len(leaves):,} leaves"
    told(f"{name}, {size:.0f} MB: to disk", time.perf_counter() - began, 10.0, "s")
    told(f"{name}: most memory", resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (1e6 if sys.platform == "darwin" else 1e3) / 1e3, 3.0, "GB")


def cold_build(folder: Path) -> None:
    """The bar of a whole process, compiled before."""
    call = [sys.executable, "-m", "sketchtree", "build", str(ROOT / "examples" / "oak.svg"), "-o", str(folder / "x.glb"), "--quiet"]
    seconds, _ = fastest(3, lambda: subprocess.run(call, check=True, cwd=ROOT))
    told("build examples/oak.svg, cold, compiled before", seconds, 6.0, "s")


def main(arguments: list[str]) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--cold", action="store_true", help="time a whole build too")
    options = parser.parse_args(arguments)
    print(f"{platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        default_tree(folder, options.repeats)
        large_tree(folder, options.repeats)
        huge_tree(folder)
        if options.cold:
            cold_build(folder)


if __name__ == "__main__":
    main(sys.argv[1:])
