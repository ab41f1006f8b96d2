"""Photos that nobody took: leafy trees in summer and in autumn, two side by side, and a bare one, painted with strokes over them."""

import numpy as np
from PIL import Image, ImageDraw
from scipy import ndimage

from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import Photo

SIZE = 720  # pixels, of either side
_LIMBS = [[(0, 0.42), (-0.11, 0.55), (-0.21, 0.63)], [(0, 0.36), (0.12, 0.47), (0.23, 0.52)], [(0.01, 0.52), (0.08, 0.63), (0.15, 0.74)]]
_TRUNK = [(0, 0), (0.004, 0.3), (0.0, 0.45), (0.015, 0.6), (0.02, 0.78)]
_COLOURS = {"summer": ((52, 96, 34), (104, 150, 62)), "autumn": ((168, 74, 24), (226, 160, 52))}


def painted() -> list[tuple[str, Photo, tuple[Marked, ...]]]:
    """(name, photo, strokes of each tree)."""
    return [
        ("painted, summer", *_scene([(0.5, 0.92, 0.85, "summer")], seed=1)),
        ("painted, autumn", *_scene([(0.52, 0.93, 0.8, "autumn")], seed=2)),
        ("painted, two", *_scene([(0.28, 0.92, 0.62, "summer"), (0.73, 0.88, 0.5, "autumn")], seed=3)),
        ("painted, bare", *_scene([(0.5, 0.92, 0.85, "bare")], seed=4)),
    ]


def _scene(trees, *, seed: int) -> tuple[Photo, tuple[Marked, ...]]:
    """A sky, a meadow, and trees: (foot x, foot y, height, kind), all in parts of the picture."""
    draw = np.random.default_rng(seed)
    down = np.linspace(0, 1, SIZE)[:, None, None]
    sky = (np.array([104, 158, 222]) * (1 - down) + np.array([206, 224, 238]) * down) * np.ones((1, SIZE, 1))
    image = Image.fromarray(sky.astype(np.uint8))
    pen = ImageDraw.Draw(image)
    pen.rectangle((0, 0.86 * SIZE, SIZE, SIZE), fill=(112, 142, 66))
    marked = [_tree(pen, draw, SIZE * np.array([x, y]), height * SIZE, kind) for x, y, height, kind in trees]
    grain = ndimage.gaussian_filter(draw.normal(0, 1, (SIZE, SIZE)), 0.7)[..., None] * 8
    return Photo(np.clip(np.asarray(image) + grain, 0, 255).astype(np.uint8), name="painted"), tuple(marked)


def _tree(pen: ImageDraw.ImageDraw, draw: np.random.Generator, foot, height: float, kind: str) -> Marked:
    """Paints one tree; its strokes."""
    at = lambda line: foot + np.array(line, float) * [height, -height]  # noqa: E731
    for line, width in [(_TRUNK, 0.04), *((limb, 0.02) for limb in _LIMBS)]:
        pen.line([tuple(point) for point in at(line)], fill=(74, 58, 46), width=max(round(width * height), 2), joint="curve")
    middle, half = np.array([0.01, 0.62]), np.array([0.34, 0.36])
    if kind == "bare":
        _twigs(pen, draw, at, height)
    else:
        _leaves(pen, draw, at, height, middle, half, _COLOURS[kind])
    turn = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    crown = at(middle + 1.04 * half * np.column_stack([np.cos(turn), np.sin(turn)]))
    return Marked(crown, (at(_TRUNK), *(at(limb) for limb in _LIMBS)), ("trunk", "left", "right", "upper"))


def _leaves(pen, draw, at, height: float, middle, half, colours) -> None:
    """Clumps of leaves in an ellipse, darker below."""
    for clump in draw.normal(size=(90, 2)) * 0.5:
        clump = clump / max(np.linalg.norm(clump), 1.0) * 0.95
        for leaf in clump + draw.normal(size=(70, 2)) * 0.11:
            if np.linalg.norm(leaf) > 1.0:
                continue
            x, y = at(middle + leaf * half)
            light = np.clip(0.5 + 0.4 * leaf[1] + 0.25 * draw.normal(), 0, 1)
            colour = tuple(int(v) for v in (1 - light) * np.array(colours[0]) + light * np.array(colours[1]))
            size = 0.009 * height * draw.uniform(0.7, 1.3)
            pen.ellipse((x - size, y - 0.7 * size, x + size, y + 0.7 * size), fill=colour)


def _twigs(pen, draw, at, height: float) -> None:
    """Fine branches off every limb, and finer ones off those."""
    lines = [np.array(_TRUNK[2:], float), *(np.array(limb, float) for limb in _LIMBS)]
    for generation, width in enumerate((0.008, 0.004, 0.003)):
        grown = []
        for line in lines:
            for share in np.linspace(0.25, 1.0, 7 if generation < 2 else 5):
                k = min(int(share * (len(line) - 1)), len(line) - 2)
                start = line[k] + (share * (len(line) - 1) - k) * (line[k + 1] - line[k])
                way = np.arctan2(*(line[k + 1] - line[k])[::-1]) + draw.choice([-1, 1]) * draw.uniform(0.4, 0.9)
                long = draw.uniform(0.7, 1.3) * (0.13, 0.07, 0.035)[generation]
                new = start + long * np.array([[0, 0], [0.5 * np.cos(way), 0.5 * np.sin(way)], [np.cos(0.8 * way + 0.31), np.sin(0.8 * way + 0.31)]])
                grown.append(new)
                pen.line([tuple(point) for point in at(new)], fill=(84, 68, 56), width=max(round(width * height), 1))
        lines = grown
