"""How good are clouds made of photos of a known tree? `python -m benchmarks.many_photos [TREE.glb ...]`: ours, plain PatchMatch and COLMAP's sparse points, as in
Guo et al. 2018, Figure 10.

Without trees, of the oak of the examples, bare. Plain: without segments, coherence and guided filter. CPU seconds are of all cores together.
"""

import argparse
import subprocess
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks.many_photos.measures import measured
from benchmarks.many_photos.renders import Rendered, rendered
from benchmarks.many_photos.sheet import depth_picture, points_picture, save
from benchmarks.many_photos.sparse import sparse_points
from sketchtree.keys import root_key
from sketchtree.multiview.depths import FULL, PREVIEW, Quality, depth_maps
from sketchtree.multiview.fuse import gathered, thinned
from sketchtree.multiview.sky_and_ground import ground
from sketchtree.multiview.sources import sources_of
from sketchtree.watch import Watch

ROOT = Path(__file__).parents[2]


def main() -> None:
    """Measure, print a line a way, and draw."""
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("trees", nargs="*", type=Path)
    options.add_argument("--views", type=int, default=24)
    options.add_argument("--arc", type=float, default=360.0, help="degrees over which the views are spread")
    options.add_argument("--pixels", type=int, default=480)
    options.add_argument("--quality", choices=("preview", "full"), default="preview")
    options.add_argument("--no-sparse", action="store_true", help="leave COLMAP out")
    options.add_argument("-o", "--out", type=Path, help="folder for pictures")
    wanted = options.parse_args()
    with tempfile.TemporaryDirectory() as place:
        place = Path(place)
        for tree in wanted.trees or [_oak(place)]:
            truth = rendered(tree, place / tree.stem, count=wanted.views, pixels=wanted.pixels, arc=wanted.arc)
            print(f"{tree.stem}: {truth.height:.2f} m, {wanted.views} views of {wanted.pixels} px over {wanted.arc:g}°")
            _compare(tree.stem, truth, replace(FULL if wanted.quality == "full" else PREVIEW, longest=wanted.pixels), wanted, place)


def _compare(name: str, truth: Rendered, quality: Quality, wanted, place: Path) -> None:
    shown, middle = [np.round(255 * truth.views[0].rgb).astype(np.uint8)], truth.views[0].camera
    if not wanted.no_sparse:
        began = time.process_time()
        points, off, placed = sparse_points(truth, place / "photos")
        where = f", cameras off by {off:.2%} of the ring" if placed else ""
        print(f"  sparse   {placed} of {wanted.views} photos placed{where}; CPU {time.process_time() - began:.0f} s")
        if len(points):
            _tell("sparse", measured(points, truth))
        shown.append(points_picture(points, np.full((len(points), 3), 0.2), middle))
    for way, one in (("plain", replace(quality, segments=False, coherence=False, guided=0)), ("ours", quality)):
        cloud, levels = _cloud(truth, one, way)
        _tell(way, measured(cloud.xyz, truth))
        shown += [depth_picture(levels[0]), points_picture(cloud.xyz, cloud.colour, middle)]
    if wanted.out:
        save(shown, wanted.out / f"{name}_many_photos.png")


def _cloud(truth: Rendered, quality: Quality, way: str):
    watch, began = Watch(), time.process_time()
    none = [np.zeros(0, np.int64)] * len(truth.views)
    levels = depth_maps(truth.views, sources_of(truth.cameras, quality.sources, np.zeros((0, 3)), none), quality, key=root_key(0), watch=watch)
    with watch("fuse"):
        points = gathered(levels)
        cloud = thinned(points, points.size)
        cloud = cloud.select(~ground(cloud, key=root_key(0)))
    print(f"  {way:8} {'  '.join(f'{stage} {seconds:.0f} s' for stage, seconds in watch.seconds.items())}; CPU {time.process_time() - began:.0f} s")
    return cloud, levels


def _tell(way: str, found: dict[str, float]) -> None:
    both = [2 * found[f"on {share}"] * found[f"found {share}"] / max(found[f"on {share}"] + found[f"found {share}"], 1e-9) for share in (".5 %", "1.5 %")]
    shares = "  ".join(f"{name} {value:.3f}" for name, value in found.items() if name not in ("points", "median off"))
    print(f"  {way:8} {found['points']:7,} points  {1000 * found['median off']:5.1f} mm off  {shares}  F {both[0]:.3f} {both[1]:.3f}")


def _oak(place: Path) -> Path:
    tree = place / "oak.glb"
    subprocess.run([sys.executable, "-m", "sketchtree", "build", ROOT / "examples" / "oak.svg", "-o", tree, "--leaf", "none", "--height", "6", "--quiet"], check=True)
    return tree


if __name__ == "__main__":
    main()
