"""How much of a tree that is known does a scan of it give back? Six exemplars, scanned by rule, traced, and held against themselves.

    python -m benchmarks.cloud_recall [--noise SHARE ...] [--points N] [--only NAME ...]

A scanner stands at three places round one side of the tree and sees the nearest spot in each of its directions, so that wood hides wood, and the far side isn't seen. Points are moved by
chance: `noise` is one standard deviation, as a share of the height. Thickness is compared where a found axis has the known one within 1 % of the height.
"""

import argparse
import time
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy.spatial import cKDTree

from sketchtree.clouds.cloud import PointCloud
from sketchtree.cloud_tree import CloudOptions, CloudTree, cloud_to_tree
from sketchtree.fidelity.recall import NEAR, recall
from sketchtree.fidelity.sampled import along, over
from sketchtree.fidelity.scan_distance import mesh_to_scan, scan_to_mesh
from sketchtree.fidelity.similarity import stava_like
from sketchtree.geometry.wood import wood_mesh
from sketchtree.keys import root_key
from sketchtree.options import TreeOptions
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.store.database import Database

SIX = ("english_oak", "silver_birch", "small_leaved_lime", "wild_cherry", "apple", "norway_spruce")
NOISES = (0.001, 0.002, 0.003)
POINTS = 25_000
CLASSES = (0.0, 0.005, 0.01, 0.02, 0.05, 10.0)  # metres: known radii between which thickness is compared
_SPOTS = 1_500_000  # of the surface, that may be seen
_STANDS, _ARC, _FAR, _HIGH = 3, 2.4, 1.4, 0.1  # places of the scanner, radians over which they are spread, distance and height of each in tree heights
_RAY = 8e-4  # radians between two directions


def scanned(tree: TreeSkeleton, noise: float, count: int = POINTS, seed: int = 0) -> Float[np.ndarray, "point 3"]:
    """What a scanner sees of a tree from three places on one side, metres."""
    spots = over([wood_mesh(tree, bark="oak", key=root_key(0), wood="tubes")], _SPOTS, key=root_key(seed))
    spots = spots[spots[:, 1] >= tree.start[:, 1].min()]
    chance, seen = np.random.default_rng(seed), []
    for turn in np.linspace(-_ARC / 2, _ARC / 2, _STANDS):
        eye = tree.height * np.array([_FAR * np.cos(turn), _HIGH, _FAR * np.sin(turn)])
        seen.append(_nearest(spots - eye))
    rows = np.unique(np.concatenate(seen))
    rows = np.sort(chance.choice(rows, min(count, len(rows)), replace=False))
    return spots[rows] + chance.normal(0.0, noise * tree.height, (len(rows), 3))


def _nearest(away):
    """Rows that are nearest in their direction."""
    far = np.linalg.norm(away, axis=1)
    turn, rise = np.arctan2(away[:, 2], away[:, 0]) % (2 * np.pi), np.arcsin(away[:, 1] / far)
    ray = np.floor(turn / _RAY).astype(np.int64) * 100_000 + np.floor((rise + np.pi) / _RAY).astype(np.int64)
    order = np.lexsort((far, ray))
    return order[np.r_[True, np.diff(ray[order]) > 0]]


@dataclass(frozen=True)
class Found:
    """What is measured of one scan."""

    figures: dict[str, float]
    thickness: tuple[float, ...]  # found over known, by class of the known; NaN where there is none


def compared(known: TreeSkeleton, points: Float[np.ndarray, "point 3"]) -> Found:
    """The tree that is traced in the points, held against the one that they are of."""
    began = time.process_time()
    made = cloud_to_tree(PointCloud(points), key=root_key(0), wanted=CloudOptions(up="y"), tree=TreeOptions(leaf="none"))
    took = time.process_time() - began
    found = in_place(made)
    share, alike = recall(known, found), stava_like(known, found)
    trunk = made.trunks[0]
    wood = [mesh for mesh in made.model.meshes if mesh.name.startswith("wood")]
    xyz = made.prepared.cloud.xyz
    figures = {
        "length recall": share.length_recall, "precision": share.length_precision, "tip recall": share.tip_recall, "tip precision": share.tip_precision,
        "Chamfer %": 100 * share.chamfer, "length": found.length.sum() / known.length.sum(), "breast": (trunk.breast if trunk else np.nan) / breast(known), "S_T": alike.total,
        "scan → mesh %": 100 * scan_to_mesh(xyz, wood).share, "mesh → scan %": 100 * mesh_to_scan(wood, xyz, key=root_key(1)).share, "triangles": sum(mesh.triangle_count for mesh in wood), "CPU": took,
    }  # fmt: skip
    return Found(figures, thickness(known, found))


def in_place(made: CloudTree) -> TreeSkeleton:
    """The found tree where the points are: it stands with its foot at the origin."""
    tree = made.skeleton
    tip = made.prepared.placement.to_file(tree.tip)
    return TreeSkeleton.from_columns(tree.parent, tip, tree.radius, limb=tree.limb, order=tree.order, tree=tree.tree, kind=tree.kind)


def breast(tree: TreeSkeleton) -> float:
    """Diameter of the stem 1.3 m above the ground, or at an eighth of a small tree's height."""
    level = tree.start[:, 1].min() + min(1.3, 0.12 * tree.height)
    across = (tree.start[:, 1] <= level) & (tree.tip[:, 1] > level)
    return 2 * float(tree.radius[across].max())


def thickness(known: TreeSkeleton, found: TreeSkeleton) -> tuple[float, ...]:
    """Found over known radius: the median over places of found axes, by class of the known."""
    fine = 0.002 * known.height
    (place, row), (mine, own) = along(known, fine), along(found, fine)
    off, near = cKDTree(place).query(mine)
    true, ratio = known.radius[row[near]], found.radius[own] / known.radius[row[near]]
    good = off <= NEAR * known.height
    return tuple(float(np.median(ratio[some])) if (some := good & (true >= low) & (true < high)).sum() > 20 else float("nan") for low, high in zip(CLASSES, CLASSES[1:], strict=False))


def main() -> None:
    """Print a line a scan, and the means."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--noise", type=float, nargs="+", default=NOISES)
    parser.add_argument("--points", type=int, default=POINTS)
    parser.add_argument("--only", nargs="+", choices=SIX, default=SIX)
    asked = parser.parse_args()
    database, found = Database.open(), {}
    for name in asked.only:
        known = database.exemplar(name).skeleton
        for noise in asked.noise:
            found[name, noise] = compared(known, scanned(known, noise, asked.points))
            if len(found) == 1:
                print("tree, noise".ljust(26) + "  ".join(found[name, noise].figures) + "  thickness, known over " + ", ".join(f"{1000 * low:g}" for low in CLASSES[:-1]) + " mm")
            _tell(f"{name} {noise:.1%}", found[name, noise])
    for noise in asked.noise:
        rows = [value for (_, at), value in found.items() if at == noise]
        _tell(f"mean {noise:.1%}", Found({key: float(np.nanmean([row.figures[key] for row in rows])) for key in rows[0].figures}, tuple(np.nanmean([row.thickness for row in rows], axis=0))))


def _tell(name: str, found: Found) -> None:
    figures = "  ".join(f"{value:{max(len(key), 5)}.{0 if value > 99 else 2}f}" for key, value in found.figures.items())
    print(f"{name:26}{figures}  " + " ".join(f"{ratio:5.2f}" for ratio in found.thickness), flush=True)


if __name__ == "__main__":
    main()
