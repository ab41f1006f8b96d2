"""As Figure 12 of Guo et al. 2018: one tree after some cycles of its growth toward the points, and the points."""

from pathlib import Path

from benchmarks.cloud_sheets.own_clouds import own_cloud
from benchmarks.cloud_sheets.panels import around, points_mesh, save, shot
from sketchtree.cloud_growing import after, cycles
from sketchtree.cloud_tree import CloudOptions, cloud_to_tree
from sketchtree.clouds.cloud import PointCloud
from sketchtree.keys import root_key
from sketchtree.options import TreeOptions
from sketchtree.templates.store.database import Database

TREE, POINTS = "wild_cherry", 24_000
TREES = 6  # of a series, the first of which is hardly more than a seedling and not shown


def sheet(path: Path) -> None:
    """Draw it."""
    cloud = own_cloud(TREE, POINTS, noise=0.0015)
    made = cloud_to_tree(PointCloud(cloud.xyz), Database.open(), key=root_key(0), wanted=CloudOptions(up="y", method="grown"), tree=TreeOptions(wood="tubes"), template=TREE)
    xyz = made.prepared.cloud.xyz
    focus = around(xyz)
    row = [("cloud", shot([points_mesh(xyz, 0.010 * cloud.tree.height, (0.45, 0.47, 0.44))], focus))]
    save(path, [row + [(f"cycle {cycle}", shot(after(made, cycle).meshes, focus)) for cycle in map(int, cycles(made, TREES)[1:])]])
