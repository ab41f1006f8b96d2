"""Is it told which axis of a cloud is up? Trees of ours, bare and in leaf, scanned as in `cloud_leaves`, and scans: each turned about its trunk, with y up and with z up.

    python -m benchmarks.cloud_up [NAME ...] [--points N] [--shared DIR]

A line for each cloud: right of asked, how many were said to be unsure, and how many were wrong without a word; then the sums.
"""

import argparse
from pathlib import Path

import numpy as np

from benchmarks.cloud_leaves import KEY, SCANS, scanned
from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.files.read_cloud import read_placed
from sketchtree.clouds.prepared.up_axis import upright
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.populate import populate
from sketchtree.geometry.wood import wood_meshes
from sketchtree.templates.store.database import Database

NAMES = ("apple", "lilac", "english_oak", "windswept_hawthorn", "olive", "norway_spruce", "weeping_willow", "hazel", "umbrella_thorn", "staghorn_sumac")
TURNS = (0.0, 0.9, 2.0)


def clouds(names, most: int, shared: Path | None):
    """(name, points with y up) of every cloud."""
    templates = Database.open()
    for name in names:
        one = templates.exemplar(name)
        wood = list(wood_meshes(one.skeleton, bark=one.habit.bark, habit=one.habit, key=KEY))
        yield f"{name}, bare", scanned(wood, [], most)[0]
        yield f"{name}, in leaf", scanned(wood, [leaf_mesh(populate(one.skeleton, one.habit, key=KEY))], most)[0]
    for name in SCANS if shared else ():
        yield name, read_placed(shared / "pointclouds" / f"{name}.ply").cloud.xyz


def told(xyz) -> np.ndarray:
    """(asked, right, unsure, wrong and sure) over turns and both axes."""
    count = np.zeros(4, int)
    for angle in TURNS:
        c, s = np.cos(angle), np.sin(angle)
        x, y, z = c * xyz[:, 0] + s * xyz[:, 2], xyz[:, 1], c * xyz[:, 2] - s * xyz[:, 0]
        for axis, points in (("y", np.c_[x, y, z]), ("z", np.c_[x, -z, y])):
            found = upright(PointCloud(points))
            right, unsure = found.axis == axis, found.remark is not None
            count += [1, right, unsure, not right and not unsure]
    return count


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", default=NAMES)
    parser.add_argument("--points", type=int, default=30_000)
    parser.add_argument("--shared", type=Path, help="the folder with `pointclouds`")
    asked, total = parser.parse_args(), np.zeros(4, int)
    for name, xyz in clouds(asked.names, asked.points, asked.shared):
        count = told(xyz)
        total += count
        print(f"| {name.replace('_', ' ')} | {count[1]} of {count[0]} | {count[2]} | {count[3]} |", flush=True)
    print(f"| all | {total[1]} of {total[0]} | {total[2]} | {total[3]} |")


if __name__ == "__main__":
    main()
