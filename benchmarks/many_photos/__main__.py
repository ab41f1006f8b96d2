"""How good are clouds made of photos of a known tree? `python -m benchmarks.many_photos [TREE.glb ...]`: ours, plain PatchMatch and COLMAP's sparse points, as in
Guo et al. 2018, Figure 10.

Without trees, of the oak of the examples, bare, over ground with a print. Plain: without segments, coherence and guided filter; fat: ours without outlines; sparse*:
COLMAP's points of the true cameras. CPU seconds are of all cores together.
"""

import argparse
import subprocess
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks.many_photos.measures import LOWEST, measured
from benchmarks.many_photos.renders import Rendered, rendered
from benchmarks.many_photos.sheet import Shown, save, sheet
from benchmarks.many_photos.sparse import sparse_points, triangulated
from benchmarks.many_photos.thickness import axes_of, thickness
from sketchtree.keys import root_key
from sketchtree.multiview.depths import FULL, PREVIEW, Quality, depth_maps
from sketchtree.multiview.fuse import gathered, thinned
from sketchtree.multiview.sky_and_ground import ground
from sketchtree.multiview.sources import sources_of
from sketchtree.multiview.workplace import Level
from sketchtree.watch import Watch

ROOT = Path(__file__).parents[2]


def main() -> None:
    """Measure, print a line a way, and draw."""
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("trees", nargs="*", type=Path)
    options.add_argument("--views", type=int, default=24)
    options.add_argument("--arc", type=float, default=360.0, help="degrees over which the views are spread")
    options.add_argument("--pixels", type=int, default=450, help="a side of the photos that depth is found in")
    options.add_argument("--taken", type=int, default=900, help="a side of the photos that cameras are found in")
    options.add_argument("--quality", choices=("preview", "full"), default="preview")
    options.add_argument("--even", action="store_true", help="no print on the ground: structure from motion has little to hold on to")
    options.add_argument("--no-sparse", action="store_true", help="leave COLMAP out")
    options.add_argument("-o", "--out", type=Path, help="folder for pictures")
    wanted = options.parse_args()
    with tempfile.TemporaryDirectory() as place:
        place = Path(place)
        for tree in wanted.trees or [_oak(place)]:
            large = rendered(tree, place / tree.stem, count=wanted.views, pixels=wanted.taken, arc=wanted.arc, printed=not wanted.even)
            print(f"{tree.stem}: {large.height:.2f} m, {wanted.views} views of {wanted.pixels} px over {wanted.arc:g}°")
            _compare(tree, large, wanted, place)


def _compare(tree: Path, large: Rendered, wanted, place: Path) -> None:
    truth = large.smaller(wanted.pixels)
    quality = replace(FULL if wanted.quality == "full" else PREVIEW, longest=wanted.pixels)
    columns = [] if wanted.no_sparse else _sparse(large, place / "photos")
    plain = _depths(truth, replace(quality, segments=False, coherence=False, guided=0), "plain")
    ours = _depths(truth, quality, "ours")
    for way, words, levels, outlines in (("plain", "plain PatchMatch", plain, False), ("fat", None, ours, False), ("ours", "ours", ours, True)):
        points = gathered(levels, outlines=outlines)
        cloud = thinned(points, points.size)
        cloud = cloud.select(~ground(cloud, key=root_key(0)))
        _tell(way, measured(cloud.xyz, truth))
        wide = thickness(cloud.xyz, axes_of(tree, 0.5 * points.size), points.size, LOWEST * truth.height)
        print(f"  {way:8} thickness over the true one, median and 90 %: {'  '.join(f'{name} {half:.2f} {most:.2f}' for name, (_, half, most) in wide.items())}", flush=True)
        columns += [Shown(words, cloud.xyz, cloud.colour)] if words else []
    if wanted.out:
        save(sheet(np.round(255 * large.views[0].rgb).astype(np.uint8), large.cameras[0], columns), wanted.out / "many_photos.png")


def _sparse(large: Rendered, place: Path) -> list[Shown]:
    """COLMAP's points, twice."""
    photos, columns = large.save(place), []
    began = time.process_time()
    points, off, placed, told = sparse_points(large, photos)
    print(f"  sparse   {placed} of {len(large.views)} photos placed, cameras off by {off:.2%} of the ring, {told}; CPU {time.process_time() - began:.0f} s")
    for way, words, xyz in (("sparse", "COLMAP, its cameras", points), ("sparse*", "COLMAP, true cameras", triangulated(large, photos))):
        if len(xyz):
            _tell(way, measured(xyz, large))
        columns.append(Shown(words, xyz, np.full((len(xyz), 3), 0.2), 2))
    return columns


def _depths(truth: Rendered, quality: Quality, way: str) -> list[Level]:
    watch, began = Watch(), time.process_time()
    none = [np.zeros(0, np.int64)] * len(truth.views)
    levels = depth_maps(truth.views, sources_of(truth.cameras, quality.sources, np.zeros((0, 3)), none), quality, key=root_key(0), watch=watch)
    print(f"  {way:8} {'  '.join(f'{stage} {seconds:.0f} s' for stage, seconds in watch.seconds.items())}; CPU {time.process_time() - began:.0f} s", flush=True)
    return levels


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
