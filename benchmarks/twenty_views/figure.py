"""From photos to a tree, as in Guo et al. 2018, Figure 2: `python -m benchmarks.twenty_views.figure -o PICTURE.png --folder FOLDER [--model NAME]`: pictures, depth maps, cloud, skeleton, tree in leaf.

The folder is that of `python -m benchmarks.twenty_views`, which keeps what takes long.
"""

import argparse
import tempfile
from pathlib import Path

import matplotlib
import numpy as np
from PIL import Image

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import LineCollection

from benchmarks.twenty_views.models import RECIPES, model
from benchmarks.twenty_views.seen import SHOWN, following, pictures, seen
from sketchtree.cloud_tree import CloudOptions, CloudTree, cloud_to_tree
from sketchtree.keys import root_key
from sketchtree.multiview.cameras import Camera
from sketchtree.templates.store.database import Database
from sketchtree.view.picture import preview

_INK, _QUIET, _PAPER = "#22262b", "#6b727b", "#ffffff"
_ORDERS = ("#3b2a1e", "#9a4f1f", "#d98a2b", "#5b8f3a")  # trunk, limbs, branches, twigs
_VIEW = 0  # the view that cloud, skeleton and tree are shown from


def figure(name: str, folder: Path, path: Path, pixels: int) -> None:
    """Five panels in a row."""
    one = model(name)
    cloud = seen(one, folder / "clouds", pixels)
    views = pictures(one, folder / "clouds" / f"{name}_{pixels}.png", pixels)
    depths = np.asarray(Image.open(folder / "clouds" / f"{name}_{pixels}_depths.png").convert("RGB"))
    made = cloud_to_tree(cloud, Database.open(), key=root_key(0), wanted=CloudOptions(up="y"), template=name, follow=following(one, folder / "clouds", pixels))
    camera, box = views[_VIEW].camera, _box(views[_VIEW].camera, one.mesh.position, pixels)
    panels = plt.figure(figsize=(15.0, 4.6), facecolor=_PAPER)
    titles = ["20 pictures", "depth maps", f"cloud, {len(cloud):,} points", f"skeleton, {made.skeleton.segment_count:,} segments", "tree in leaf"]
    places = [panels.add_axes((0.004 + 0.2 * k, 0.02, 0.192, 0.87)) for k in range(5)]
    for k, (place, title) in enumerate(zip(places, titles, strict=True)):
        place.axis("off")
        panels.text(0.1 + 0.2 * k, 0.925, title, ha="center", color=_INK, fontsize=12.5)
        if k:
            panels.text(0.2 * k, 0.45, "→", ha="center", va="center", color=_QUIET, fontsize=20)
    places[0].imshow(_grid([_cut(np.round(255 * view.rgb).astype(np.uint8), _box(view.camera, one.mesh.position, pixels)) for view in views[:6]], 3))
    places[1].imshow(np.concatenate([_cut(depths[:, pixels * k : pixels * (k + 1)], _box(views[row].camera, one.mesh.position, pixels)) for k, row in enumerate(SHOWN)], axis=1))
    _cloud(places[2], cloud, camera, box)
    _skeleton(places[3], made, camera, box)
    places[4].imshow(_leafy(made))
    path.parent.mkdir(parents=True, exist_ok=True)
    panels.savefig(path, dpi=100, facecolor=_PAPER)
    plt.close(panels)


def _box(camera: Camera, position, pixels: int) -> tuple[int, int, int, int]:
    """Left, top, right, bottom of a model in a picture, with a margin: portrait, three to four."""
    xy, _ = camera.project(np.asarray(position, float))
    low, high = xy.min(axis=0), xy.max(axis=0)
    middle, half = 0.5 * (low + high), 0.54 * max(high[1] - low[1], (high[0] - low[0]) * 4 / 3)
    wide = 0.75 * half
    left, top, right, bottom = middle[0] - wide, middle[1] - half, middle[0] + wide, middle[1] + half
    return max(int(left), 0), max(int(top), 0), min(int(right), pixels), min(int(bottom), pixels)


def _cut(picture: np.ndarray, box) -> np.ndarray:
    """What lies in the box, three to four, so that all are the same size."""
    left, top, right, bottom = box
    return np.asarray(Image.fromarray(picture[top:bottom, left:right]).resize((360, 480), Image.Resampling.LANCZOS))


def _grid(cells: list[np.ndarray], columns: int) -> np.ndarray:
    gap = [np.pad(cell, ((4, 4), (4, 4), (0, 0)), constant_values=255) for cell in cells]
    return np.concatenate([np.concatenate(gap[k : k + columns], axis=1) for k in range(0, len(gap), columns)], axis=0)


def _cloud(place, cloud, camera: Camera, box) -> None:
    pixel, depth = camera.project(cloud.xyz)
    order = np.argsort(-depth)
    place.scatter(*pixel[order].T, s=0.35, c=cloud.colour[order], lw=0, rasterized=True)
    _framed(place, box)


def _skeleton(place, made: CloudTree, camera: Camera, box) -> None:
    tree, to_file = made.skeleton, made.prepared.placement.to_file
    rows = np.flatnonzero((tree.length > 0) & (np.arange(len(tree)) < made.seen))
    rows = rows[np.argsort(-tree.order[rows], kind="stable")]
    a, b = (camera.project(to_file(end[rows]))[0] for end in (tree.start, tree.tip))
    wide = np.array([2.2, 1.5, 1.0, 0.7])
    order = np.clip(tree.order[rows], 0, 3)
    place.add_collection(LineCollection(np.stack([a, b], axis=1), colors=np.array(_ORDERS)[order], linewidths=wide[order], capstyle="round"))
    _framed(place, box)


def _framed(place, box) -> None:
    left, top, right, bottom = box
    place.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")


def _leafy(made: CloudTree) -> np.ndarray:
    with tempfile.TemporaryDirectory() as folder:
        shot = Path(folder) / "leafy.png"
        drawn, why = preview(made.model.meshes, shot, size=(720, 960), azimuth=0.0, elevation=4.0, ground=True, timeout=1500.0)
        if not drawn:
            raise SystemExit(why)
        return np.asarray(Image.open(shot).convert("RGB"))


def main() -> None:
    """Draw."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--out", type=Path, required=True)
    parser.add_argument("--folder", type=Path, required=True)
    parser.add_argument("--model", choices=tuple(RECIPES), default="wild_cherry")
    parser.add_argument("--pixels", type=int, default=480)
    asked = parser.parse_args()
    figure(asked.model, asked.folder, asked.out, asked.pixels)


if __name__ == "__main__":
    main()
