"""Make `cloud/ash.ply`: points on the wood of a tree of ours, strewn as a scanner strews them.

    python examples/scan.py examples/cloud/ash.ply
"""

import sys

import numpy as np
from scipy.spatial import cKDTree

import sketchtree as st
from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.files.write_cloud import write_cloud
from sketchtree.dressing import Dress, wood_worn
from sketchtree.templates.store.database import Database

TREE, POINTS, NOISE = "european_ash", 18_500, 0.004  # metres
LEAST = 0.006  # metres: thinner wood is not hit
SUN = np.array([-0.5, 0.7, 0.5]) / np.linalg.norm([-0.5, 0.7, 0.5])


def main(path: str) -> None:
    """Write it."""
    key, chance = st.root_key(0), np.random.default_rng(0)
    tree = Database.open().exemplar(TREE).skeleton
    wood = wood_worn(tree, Dress("ash", None), key=key).meshes
    corners = np.concatenate([mesh.position[mesh.triangle] for mesh in wood]).astype(float)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(normal, axis=1) / 2
    rows = np.flatnonzero(~tree.is_base)
    radius = tree.radius[rows][cKDTree((tree.tip[rows] + tree.start[rows]) / 2).query(corners.mean(axis=1))[1]]
    seen = np.where(radius >= LEAST, area / np.sqrt(radius), 0.0)  # stout wood hides much of itself
    hit = chance.choice(len(area), POINTS, p=seen / seen.sum())
    u, v = np.sqrt(chance.random(len(hit))), chance.random(len(hit))
    xyz = ((1 - u)[:, None] * corners[hit, 0] + (u * (1 - v))[:, None] * corners[hit, 1] + (u * v)[:, None] * corners[hit, 2]) + chance.normal(0, NOISE, (len(hit), 3))
    facing = normal[hit] @ SUN / (2 * np.maximum(area[hit], 1e-12))
    bark = np.array([0.50, 0.46, 0.39]) * (0.78 + 0.28 * facing[:, None]) + chance.normal(0, 0.025, (len(hit), 3))
    write_cloud(PointCloud(xyz, np.clip(bark, 0, 1)), path, comments=[f"{TREE}, a tree of SketchTree's templates; CC0"])


main(sys.argv[1])
