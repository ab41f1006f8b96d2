"""Are leaves told from wood, and does the wood gain by it? Trees of ours in leaf, scanned by eye of the program, with every point known: a table for `docs/clouds.md`.

    python -m benchmarks.cloud_leaves [NAME ...] [--points N] [--shared DIR] [-o SHEET.png]
    python -m benchmarks.cloud_leaves --fewer [NAME ...] [--points N]

A tree is seen in parallel light from six sides, level and from below, each pixel a point of what is nearest; 4 mm of noise; then thinned to N points. `labels`: precision and recall of leaf and
of wood, as leaves were told before any wood was traced. `wood`: share of the tree's length that has found wood within 1 % of the height (recall), of the found length that has the tree's (precision), S_T,
and how far the found wood's surface is from the tree's, with all points taken for wood and with leaves told apart. `leaf`: m² that were worn, of those that the tree has. Bare scans of
the same trees, and of others with `--shared`, must have none.

`--fewer` asks how many leaves are worn, where all are left, three in ten and one in ten; the stems of short shoots count as wood there, and stay.
"""

import argparse
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image
from scipy.spatial import cKDTree

from benchmarks.leaf_sheet import picture
from sketchtree.cloud_tree import CloudOptions, cloud_to_tree
from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.leafy.covering import leaf_area_of
from sketchtree.clouds.leafy.leafiness import leafiness
from sketchtree.clouds.voxels import voxel_rows, voxel_size
from sketchtree.fidelity.sampled import along, over
from sketchtree.fidelity.similarity import stava_like
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.leaves import select
from sketchtree.foliage.populate import populate
from sketchtree.geometry.wood import wood_meshes
from sketchtree.keys import root_key
from sketchtree.levels.raster import View, render
from sketchtree.options import TreeOptions
from sketchtree.templates.store.database import Database

NAMES = ("small_leaved_lime", "wild_cherry", "english_oak_young", "norway_maple", "european_ash")
SCANS = ("adtree_tree1", "adtree_tree13", "adtree_lille2", "archi_tree1", "rtwig_cloud")
SHARES = (1.0, 0.3, 0.1)  # of its leaves, that a tree is scanned with
PIXELS, SIDES, FROM_BELOW, NOISE = 700, 6, (0.0, 0.5), 0.004
KEY = root_key(5)


def scanned(wood, leaves, most: int) -> tuple[np.ndarray, np.ndarray]:
    """(points, which of them are on leaves)."""
    every = np.vstack([mesh.position for mesh in (*wood, *leaves)])
    low, high = every.min(axis=0), every.max(axis=0)
    centre, half, chance, found = (low + high) / 2, 0.52 * float(np.linalg.norm(high - low)), np.random.default_rng(0), []
    pixel = 2 * half / PIXELS
    for k, tilt in enumerate(FROM_BELOW):
        for turn in 2 * np.pi * np.arange(SIDES) / SIDES + 0.3 * k:
            level = View.round(turn, centre, half, PIXELS)
            view = View(level.right, np.cos(tilt) * level.up + np.sin(tilt) * level.towards, centre, half, PIXELS)
            of_wood = render(wood, view).depth
            of_leaf = render(leaves, view).depth if leaves else np.full_like(of_wood, -np.inf)
            depth = np.maximum(of_wood, of_leaf)
            row, column = np.nonzero(np.isfinite(depth))
            across, up = (column + 0.5) * pixel - half, half - (row + 0.5) * pixel
            place = centre + across[:, None] * view.right + up[:, None] * view.up + depth[row, column][:, None] * view.towards
            found.append(np.column_stack([place + NOISE * chance.normal(size=place.shape), of_leaf[row, column] > of_wood[row, column]]))
    both = np.concatenate(found)
    both = both[voxel_rows(both[:, :3], max(pixel, voxel_size(both[:, :3], most) if len(both) > most else 0.0))]
    return both[:, :3], both[:, 3] > 0


def near(tree, other, reach: float) -> float:
    """The share of a tree's length that has the other within reach."""
    step = 0.002 * tree.height
    return float(np.mean(cKDTree(along(other, step)[0]).query(along(tree, step)[0])[0] <= reach))


def wood_figures(known, wood, made) -> str:
    """Recall, precision, S_T, metres from the found surface to the true one."""
    reach, found = 0.01 * known.height, [mesh for mesh in made.model.meshes if mesh.name.startswith("wood")]
    away = cKDTree(over(wood, 400_000, key=KEY)).query(over(found, 100_000, key=KEY))[0].mean()
    return f"{near(known, made.skeleton, reach):.2f}, {near(made.skeleton, known, reach):.2f} | {stava_like(known, made.skeleton).total:.3f} | {away:.3f} | {made.skeleton.length.sum() / known.length.sum():.2f}"


def labels(xyz, leaf) -> str:
    """Precision and recall of leaf, and of wood, before any wood was traced."""
    found = leafiness(xyz, [np.flatnonzero(xyz[:, 1] < xyz[:, 1].min() + 0.01 * np.ptp(xyz[:, 1]))], wanted="yes").leaf
    shares = [np.mean(leaf[found]), np.mean(found[leaf]), np.mean(~leaf[~found]), np.mean(~found[~leaf])]
    return ", ".join(f"{one:.2f}" for one in shares[:2]) + " | " + ", ".join(f"{one:.2f}" for one in shares[2:])


def row(name: str, most: int, sheet: list) -> None:
    """The lines of one tree."""
    templates = Database.open()
    one = templates.exemplar(name)
    wood = list(wood_meshes(one.skeleton, bark=one.habit.bark, habit=one.habit, key=KEY))
    worn = populate(one.skeleton, one.habit, key=KEY)
    known, foot = one.skeleton, one.skeleton.tip[one.skeleton.is_base][0]
    xyz, leaf = scanned(wood, [leaf_mesh(worn)], most)
    bare, _ = scanned(wood, [], most)
    how = {"tree": TreeOptions(leaf=one.habit.leaf, wood="tubes"), "key": KEY}
    began = time.process_time()
    told = cloud_to_tree(PointCloud(xyz), templates, template=name, wanted=CloudOptions(up="y", inside=False), **how)
    took = time.process_time() - began
    without = cloud_to_tree(PointCloud(xyz), templates, template=name, wanted=CloudOptions(up="y", inside=False, in_leaf="no"), **how)
    none = cloud_to_tree(PointCloud(bare), templates, wanted=CloudOptions(up="y", inside=False), key=KEY)
    made = [_back(tree, foot) for tree in (without, told)]
    print(f"| {name.replace('_', ' ')} | {len(xyz):,} | {leaf.mean():.2f} | {told.leafy.share:.2f} ({told.leafy.ends:.2f}, {told.leafy.fills:.2f}) | {labels(xyz, leaf)} | {took:.1f} s |", flush=True)
    for title, tree in zip(("all wood", "told"), made, strict=True):
        print(f"|  {title} | {wood_figures(known, wood, tree)} | {leaf_area_of(tree.model.leaves).sum() / leaf_area_of(worn).sum():.2f} |", flush=True)
    print(f"|  bare | {len(bare):,} | | {none.leafy.share:.2f} ({none.leafy.ends:.2f}, {none.leafy.fills:.2f}) |", flush=True)
    sheet.append([[*wood, leaf_mesh(worn)], *(list(tree.model.meshes) for tree in made), wood, *([mesh for mesh in tree.model.meshes if mesh.name.startswith("wood")] for tree in made)])


def fewer(name: str, most: int) -> None:
    """A line of one tree for every share of its leaves."""
    templates = Database.open()
    one = templates.exemplar(name)
    wood, worn = list(wood_meshes(one.skeleton, bark=one.habit.bark, habit=one.habit, key=KEY)), populate(one.skeleton, one.habit, key=KEY)
    wood += _stems(worn, wood[0].material)
    rank = np.random.default_rng(1).random(len(worn))
    for share in SHARES:
        left = replace(select(worn, rank < share), shoot=worn.shoot[:0])
        xyz, leaf = scanned(wood, [leaf_mesh(left)], most)
        how = {"template": name, "tree": TreeOptions(leaf=one.habit.leaf, wood="tubes"), "key": KEY}
        found = leafiness(xyz, [np.flatnonzero(xyz[:, 1] < xyz[:, 1].min() + 0.01 * np.ptp(xyz[:, 1]))])
        made = cloud_to_tree(PointCloud(xyz), templates, wanted=CloudOptions(up="y", inside=False, in_leaf="yes"), **how)
        ratio = leaf_area_of(made.model.leaves).sum() / leaf_area_of(left).sum()
        print(f"| {name.replace('_', ' ')} | {share:g} | {len(xyz):,} | in leaf: {found.in_leaf} | {leaf.mean():.2f}, {made.leafy.share:.2f} | {ratio:.2f} |", flush=True)


def _stems(worn, material) -> list:
    """Short shoots, as wood."""
    if not len(worn.shoot):
        return []
    mesh = leaf_mesh(select(worn, np.arange(len(worn)) < 1))
    corners = len(mesh.position) - 6 * len(worn.shoot)  # of the one leaf, which come first
    return [replace(mesh, name="wood_stems", material=material, triangle=mesh.triangle[mesh.triangle.min(axis=1) >= corners])]


def _back(tree, foot):
    """The tree where it was scanned: its foot is not at the origin there."""
    shift = np.array([0.0, 0.0, 0.0]) - np.asarray(tree.prepared.placement.similarity.translate)
    moved = tuple(replace(mesh, position=mesh.position + shift) for mesh in tree.model.meshes)
    skeleton = tree.skeleton.replace(tip=tree.skeleton.tip + shift, curve_points=tree.skeleton.curve_points + shift)
    return replace(tree, model=replace(tree.model, meshes=moved, skeleton=skeleton))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", default=NAMES)
    parser.add_argument("--points", type=int, default=60_000)
    parser.add_argument("--shared", type=Path, help="the folder with `pointclouds`")
    parser.add_argument("-o", "--out", type=Path)
    parser.add_argument("--fewer", action="store_true", help="how many leaves are worn, where there are fewer and fewer")
    asked, sheet = parser.parse_args(), []
    if asked.fewer:
        for name in asked.names:
            fewer(name, asked.points)
        return
    for name in asked.names:
        row(name, asked.points, sheet)
    for name in SCANS if asked.shared else ():
        found = cloud_to_tree(asked.shared / "pointclouds" / f"{name}.ply", key=KEY).leafy
        print(f"| {name} | in leaf: {found.in_leaf} | share {found.share:.2f} | ends {found.ends:.2f} | D {found.fills:.2f} |", flush=True)
    if asked.out:
        image = Image.new("RGB", (6 * 300, 340 * len(sheet)))
        for k, pictures in enumerate(sheet):
            for j, meshes in enumerate(pictures):
                image.paste(picture(meshes, 300, 340), (300 * j, 340 * k))
        image.save(asked.out)


if __name__ == "__main__":
    main()
