"""What do trees look like beside their model? A row a model: model, cloud, ways; wood as thick as it is."""

from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection

from sketchtree.skeleton import TreeSkeleton

_INK, _PAPER, _THINNEST = "#2b2622", "#ffffff", 0.0009  # of the height: half the width that a line has at least


def sheet(rows: list[tuple[str, TreeSkeleton, np.ndarray, np.ndarray, dict[str, tuple[TreeSkeleton, str]]]], path: Path, across: tuple[int, ...] = (0, 2)) -> None:
    """`rows`: name, model, places and colours of the cloud, trees by way with a line about each. Each from the front and from the side."""
    ways = list(rows[0][4])
    figure, axes = plt.subplots(len(rows) * len(across), len(ways) + 2, figsize=(3.4 * (len(ways) + 2), 3.7 * len(rows) * len(across)), squeeze=False)
    for k, (name, model, xyz, colour, trees) in enumerate(rows):
        for j, side in enumerate(across):
            line = axes[k * len(across) + j]
            draw_tree(line[0], model, model.height, side)
            order = np.argsort(xyz[:, 2 - side])
            line[1].scatter(xyz[order, side], xyz[order, 1], s=0.25, c=colour[order], lw=0, rasterized=True)
            for place, way in zip(line[2:], ways, strict=True):
                draw_tree(place, trees[way][0], model.height, side)
            for place in line:
                _framed(place, model, side)
            if not j:
                for place, title in zip(line, [f"{name}, model", f"cloud, {len(xyz):,} points", *(f"{way}  {trees[way][1]}" for way in ways)], strict=True):
                    place.set_title(title, fontsize=9, color=_INK)
    figure.subplots_adjust(0.01, 0.01, 0.99, 0.97, 0.02, 0.06)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=100, facecolor=_PAPER)
    plt.close(figure)


def draw_tree(place, tree: TreeSkeleton, height: float, side: int = 0, ink: str = _INK) -> None:
    """The wood's outline, seen along z (side 0) or x (2)."""
    rows = np.flatnonzero(tree.length > 0)
    a, b = tree.start[rows][:, [side, 1]], tree.tip[rows][:, [side, 1]]
    thick = np.maximum(tree.radius, _THINNEST * height)
    foot = np.where(tree.limb[tree.parent[rows]] == tree.limb[rows], thick[tree.parent[rows]], thick[rows])
    way = b - a
    out = np.stack([-way[:, 1], way[:, 0]], axis=1) / np.maximum(np.linalg.norm(way, axis=1), 1e-9)[:, None]
    corner = np.stack([a - foot[:, None] * out, a + foot[:, None] * out, b + thick[rows][:, None] * out, b - thick[rows][:, None] * out], axis=1)
    place.add_collection(PolyCollection(corner, facecolors=ink, edgecolors=ink, linewidths=0.15))


def _framed(place, model: TreeSkeleton, side: int) -> None:
    low, high = model.tip.min(axis=0), model.tip.max(axis=0)
    reach = 0.54 * max(high[1] - low[1], high[0] - low[0], high[2] - low[2])
    middle, up = 0.5 * (low[side] + high[side]), 0.5 * (low[1] + high[1])
    place.set(xlim=(middle - reach, middle + reach), ylim=(up - reach, up + reach), aspect="equal")
    place.axis("off")
