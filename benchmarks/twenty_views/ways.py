"""Which trees are made of a cloud? Ours, traced and grown, as `sketchtree views` makes them, and plain space colonisation on the same points, feet and stems.

Plain: points all alike, a constant influence distance of 5 or 10 internodes (Guo et al. 2018, Figures 5-6), nothing of ours; the better of the two counts.
"""

import time

from benchmarks.twenty_views.told import OURS, PLAIN
from sketchtree.cloud_tree import GENERAL, CloudOptions, cloud_to_tree
from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.growing.estimated import estimated
from sketchtree.clouds.growing.grown import grown
from sketchtree.clouds.growing.species import species
from sketchtree.clouds.growing.wanted import plain
from sketchtree.clouds.prepared.prepare import prepare
from sketchtree.clouds.standing.feet import feet
from sketchtree.clouds.standing.stems import breast_height
from sketchtree.clouds.standing.trunk import foot_radii, trunk
from sketchtree.keys import root_key
from sketchtree.multiview.thin.followed import Following
from sketchtree.options import TreeOptions
from sketchtree.skeleton import TreeSkeleton

INTERNODES = dict(zip(PLAIN, (5.0, 10.0), strict=True))
WAYS = (*OURS, *PLAIN)


def made(cloud: PointCloud, way: str, follow: Following) -> tuple[TreeSkeleton, float]:
    """(the tree of one way where the cloud is, CPU seconds). `follow`: of the pictures."""
    began = time.process_time()
    if way in OURS:
        found = cloud_to_tree(cloud, key=root_key(0), wanted=CloudOptions(up="y", method=way, pixel=follow.pixel), tree=TreeOptions(leaf="none"), follow=follow)
        tree, placement = found.skeleton, found.prepared.placement
    else:
        tree, placement = _plain(cloud, INTERNODES[way])
    return tree.replace(tip=placement.to_file(tree.tip)), time.process_time() - began


def _plain(cloud: PointCloud, internodes: float):
    prepared = prepare(cloud, up="y")
    xyz, stands = prepared.cloud.xyz, feet(prepared.cloud.xyz, prepared.above)
    trunks = [trunk(xyz[rows], breast_height(prepared.cloud.height)) for rows in stands.stems]
    kind = estimated(xyz, species(GENERAL))
    return grown(xyz, stands.rows, kind, key=root_key(0), wanted=plain(internodes), radius=foot_radii(trunks)).skeleton, prepared.placement
