"""As Figure 9 of Guo et al. 2018: a plant of several stems, as its cloud, the density of its points on the ground with the roots, what grew from each root, and that in leaf."""

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont
from scipy.spatial import cKDTree

from benchmarks.cloud_sheets.grown_here import here
from benchmarks.cloud_sheets.own_clouds import own_cloud
from benchmarks.cloud_sheets.panels import HIGH, WIDE, around, points_mesh, ramp, save, shot, tinted, wood_of
from sketchtree.cloud_tree import Finish
from sketchtree.clouds.standing.density import Density, density
from sketchtree.keys import root_key
from sketchtree.options import TreeOptions
from sketchtree.templates.store.database import Database

STEM, POINTS = "silver_birch", 8_000  # of each stem
APART, LEAN, HIGH_AS = 0.45, 9.0, (1.0, 0.86, 0.93, 0.78)  # metres from the middle, degrees, of the first stem
HEAT = ("#f4f1e6", "#f0d693", "#e79a55", "#c94b3d", "#7a1d43", "#2b0f33")
OF_ROOT = ((0.84, 0.37, 0.00), (0.00, 0.45, 0.70), (0.00, 0.62, 0.45), (0.80, 0.47, 0.65), (0.90, 0.62, 0.00), (0.34, 0.71, 0.91))


def sheet(path: Path) -> None:
    """Draw it."""
    xyz = clump()
    height = float(np.ptp(xyz[:, 1]))
    stands, size = here(xyz, len(HIGH_AS)), 0.010 * height
    grows, focus = stands.grows(), around(xyz)
    place = grows.box.to_world(grows.roots.place)[:, [0, 2]]
    tree = grows.skeleton
    in_leaf = Finish(root_key(0), TreeOptions(wood="tubes"), Database.open(), STEM)(tree)[0].meshes
    low = xyz[xyz[:, 1] < 0.12 * height]
    save(path, [[
        ("cloud", shot([points_mesh(xyz, size, (0.45, 0.47, 0.44))], focus)),
        (f"density on the ground, {len(place)} roots", plan(density(low, height), place)),
        ("what grew from each root", shot(_by_root(tree), focus)),
        ("in leaf", shot(in_leaf, focus)),
    ]])  # fmt: skip


def clump() -> np.ndarray:
    """Points of several birches out of one stool, each leaning its own way."""
    found, lean = [], np.radians(LEAN)
    for k, size in enumerate(HIGH_AS):
        one = size * own_cloud(STEM, POINTS, noise=0.0015, seed=k).xyz * 0.5
        turn = 2 * np.pi * (k / len(HIGH_AS) + 0.03 * (-1) ** k)
        one = one @ np.array([[np.cos(turn), 0, np.sin(turn)], [0, 1, 0], [-np.sin(turn), 0, np.cos(turn)]])
        out = np.array([np.cos(turn), 0.0, np.sin(turn)])
        along = one @ out
        one = one + np.outer(one[:, 1] * np.sin(lean) + along * (np.cos(lean) - 1), out) + np.outer(one[:, 1] * (np.cos(lean) - 1) - along * np.sin(lean), [0, 1, 0])
        found.append(one + APART * out)
    return np.concatenate(found)


def _by_root(tree):
    """The wood of each stem in a colour."""
    whole = wood_of(tree)
    middle = 0.5 * (tree.start + tree.tip)
    row = cKDTree(middle).query(whole.position)[1]
    return [tinted(whole, np.asarray(OF_ROOT)[tree.tree[row] % len(OF_ROOT)])]


def plan(found: Density, roots) -> Image.Image:
    """The ground from above, with a ring round each root."""
    high = found.value > 0.02 * found.value.max()
    rows, columns = np.flatnonzero(high.any(axis=1)), np.flatnonzero(high.any(axis=0))
    across = max(np.ptp(rows), np.ptp(columns) * WIDE / HIGH) + 8
    middle = found.corner + found.size * np.array([rows.mean(), columns.mean()])
    scale = WIDE / (across * found.size)  # pixels a metre
    x, z = np.meshgrid((np.arange(WIDE) - WIDE / 2) / scale + middle[0], (np.arange(HIGH) - HIGH / 2) / scale + middle[1])
    cell = [np.clip(((axis - low) / found.size).astype(int), 0, size - 1) for axis, low, size in zip((x, z), found.corner, found.value.shape, strict=True)]
    share = np.sqrt(found.value[cell[0], cell[1]] / found.value.max())
    picture = Image.fromarray(np.round(255 * ramp(share.ravel(), HEAT).reshape(HIGH, WIDE, 3)).astype(np.uint8))
    pen = ImageDraw.Draw(picture)
    for k, at in enumerate(roots):
        u, v = (at - middle) * scale + (WIDE / 2, HIGH / 2)
        ink = tuple(round(255 * one) for one in OF_ROOT[k % len(OF_ROOT)])
        pen.ellipse([u - 9, v - 9, u + 9, v + 9], outline="white", width=5)
        pen.ellipse([u - 8, v - 8, u + 8, v + 8], outline=ink, width=3)
    metre = 0.2
    pen.line([14, HIGH - 16, 14 + metre * scale, HIGH - 16], fill=(40, 40, 36), width=3)
    pen.text((14, HIGH - 22), "20 cm", fill=(40, 40, 36), font=ImageFont.load_default(14), anchor="ls")
    return picture
