"""Is it told on how many stems a plant stands? Trees of ours, bare and in leaf, scanned as in `cloud_leaves`, bare from one side with noise as in `cloud_recall`, and scans of single trees.

    python -m benchmarks.cloud_stems [NAME ...] [--points N] [--shared DIR]

A line for each cloud: stems that it has, stems that were counted, stems that were found where their number was told, trees that it was taken for. Without a name all exemplars.
"""

import argparse
from pathlib import Path

import numpy as np

from benchmarks.cloud_recall import scanned as from_one_side
from benchmarks.cloud_up import clouds
from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.prepared.prepare import prepare
from sketchtree.clouds.standing.feet import feet
from sketchtree.templates.store.database import Database

NOISE = 0.003  # of the height, where a tree was scanned from one side


def every(names, most: int, shared: Path | None):
    """(name, points with y up, stems) of every cloud."""
    templates = Database.open()
    stems = {name: int(templates.exemplar(name).skeleton.is_base.sum()) for name in names}
    for name, xyz in clouds(names, most, shared):
        yield name, xyz, stems.get(name.split(",")[0], 1)
    for name in names:
        yield f"{name}, from one side", from_one_side(templates.exemplar(name).skeleton, NOISE, most), stems[name]


def main() -> None:
    """Print the lines."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--points", type=int, default=30_000)
    parser.add_argument("--shared", type=Path, help="the folder with `pointclouds`")
    asked, right = parser.parse_args(), []
    for name, xyz, stems in every(asked.names or Database.open().names, asked.points, asked.shared):
        found = prepare(PointCloud(xyz), up="y", tree=1)
        counted, told = (len(feet(found.cloud.xyz, found.above, count=count).rows) for count in ("auto", stems))
        right.append(counted == stems)
        print(f"| {name.replace('_', ' ')} | {stems} | {counted} | {told} | {found.trees} |", flush=True)
    print(f"| all | {np.sum(right)} of {len(right)} |")


if __name__ == "__main__":
    main()
