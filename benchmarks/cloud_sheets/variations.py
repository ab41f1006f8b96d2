"""As Figure 13 of Guo et al. 2018: similar trees in the same points, by other figures."""

from pathlib import Path

from benchmarks.cloud_sheets.own_clouds import own_cloud
from benchmarks.cloud_sheets.panels import around, save, shot
from sketchtree.cloud_growing import variation
from sketchtree.cloud_tree import CloudOptions, cloud_to_tree
from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.growing.figures import changes
from sketchtree.keys import root_key
from sketchtree.options import TreeOptions
from sketchtree.templates.store.database import Database

TREE, POINTS = "apple", 12_000
VARIED = ("internode=2x", "alpha=0.2x", "tropism=up", "gamma=0.75x")


def sheet(path: Path) -> None:
    """Draw it."""
    cloud = own_cloud(TREE, POINTS, noise=0.0015)
    made = cloud_to_tree(PointCloud(cloud.xyz), Database.open(), key=root_key(0), wanted=CloudOptions(up="y", method="grown"), tree=TreeOptions(wood="tubes", season="bare"), template=TREE)
    focus = around(made.prepared.cloud.xyz)
    row = [("the tree", shot(made.model.meshes, focus))]
    save(path, [row + [(said, shot(variation(made, changes(said)[0]).tree.model.meshes, focus)) for said in VARIED]])
