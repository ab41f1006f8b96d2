"""As Figure 7 of Guo et al. 2018: three species, each as its cloud, its weights, what grows in it, and that in leaf."""

from pathlib import Path

from benchmarks.cloud_sheets.grown_here import here
from benchmarks.cloud_sheets.own_clouds import own_cloud
from benchmarks.cloud_sheets.panels import around, points_mesh, ramp, save, shot, wood_of
from benchmarks.cloud_sheets.weights import WARM
from sketchtree.cloud_tree import Finish
from sketchtree.clouds.growing.box import boxed
from sketchtree.clouds.growing.weights import point_weights
from sketchtree.keys import root_key
from sketchtree.options import TreeOptions
from sketchtree.templates.store.database import Database

SPECIES = (("wild_cherry", "wild cherry"), ("silver_birch", "silver birch"), ("norway_maple", "Norway maple"))
POINTS, LEAFY = 24_000, 0.35
SIZE = (196, 222)  # pixels of a panel


def sheet(path: Path) -> None:
    """Draw it."""
    save(path, [row(name, title) for name, title in SPECIES])


def row(name: str, title: str):
    """One species."""
    cloud = own_cloud(name, POINTS, leafy=LEAFY, noise=0.0015)
    stands, size = here(cloud.xyz), 0.010 * cloud.tree.height
    weight = point_weights(boxed(cloud.xyz).to_sketch(cloud.xyz))
    order, focus = weight.argsort().argsort() / (len(weight) - 1), around(cloud.xyz)
    tree = stands.grows().skeleton
    in_leaf = Finish(root_key(0), TreeOptions(wood="tubes"), Database.open(), name)(tree)[0].meshes
    seen = (("cloud", [points_mesh(cloud.xyz, size, (0.45, 0.47, 0.44))]), ("weights", [points_mesh(cloud.xyz, size, ramp(order, WARM))]), ("skeleton", [wood_of(tree)]), ("in leaf", in_leaf))
    return [(f"{title}, {what}", shot(meshes, focus, size=SIZE)) for what, meshes in seen]
