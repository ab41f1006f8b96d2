"""As Figure 6 of Guo et al. 2018: a cloud, its weights, and what grows without and with them. Wood farther than 1.5 % of the height from the true wood is red."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from benchmarks.cloud_sheets.grown_here import here
from benchmarks.cloud_sheets.own_clouds import own_cloud
from benchmarks.cloud_sheets.panels import around, points_mesh, ramp, save, shot, tinted, wood_of
from sketchtree.clouds.growing.box import boxed
from sketchtree.clouds.growing.wanted import Growing, plain
from sketchtree.clouds.growing.weights import point_weights

TREE, POINTS = "apple", 24_000
WARM = ("#2c4a7c", "#3f8f9b", "#8fc07a", "#f2cf5b", "#e8743b", "#b3202a")  # cold: hardly any weight
TRUE, STRAY, OFF = (0.42, 0.36, 0.30), (0.84, 0.16, 0.10), 0.015


def sheet(path: Path) -> None:
    """Draw it."""
    cloud = own_cloud(TREE, POINTS, leafy=0.5, noise=0.003, uneven=True)
    stands, size = here(cloud.xyz), 0.012 * cloud.tree.height
    weight = point_weights(boxed(cloud.xyz).to_sketch(cloud.xyz))
    order = weight.argsort().argsort() / (len(weight) - 1)
    focus = around(cloud.xyz)
    row = [("cloud", shot([points_mesh(cloud.xyz, size, (0.45, 0.47, 0.44))], focus)), ("weights (Eq. 8), warm: much", shot([points_mesh(cloud.xyz, size, ramp(order, WARM))], focus))]
    printed = replace(plain(5.0), influence=None, persists=True)
    for name, way in (("as printed, all points alike", printed), ("as printed, with weights", replace(printed, weighted=True)), ("ours", Growing())):
        tree = stands.grows(way).skeleton
        row.append((name, shot([_stray(tree, cloud.tree)], focus)))
    save(path, [row])


def _stray(tree, known):
    """The wood, red where nothing true is near."""
    mesh, true = wood_of(tree), wood_of(known)
    far = cKDTree(true.position).query(mesh.position)[0]
    return tinted(mesh, np.where(far[:, None] > OFF * known.height, STRAY, TRUE))
