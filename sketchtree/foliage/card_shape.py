"""What flat shape carries a leaf's picture, and how is it bent?

A blade is one card of six triangles, folded along the midrib and bent down at the tip; its outline is the
smallest hexagon round the drawing, so that little of it is empty. A tuft is a few quads crossed on its axis.

    x' = x cos φ,   z' = |x| sin φ − c (y / y_tip)²        φ: fold    c: curl, blade lengths
"""

from functools import lru_cache

import numpy as np
from jaxtyping import Float, Int

from sketchtree.foliage.leaf_model import LeafModel
from sketchtree.foliage.models import leaf_model, leaf_painting
from sketchtree.foliage.painting import Painting

_BLADE = np.array([[0, 1, 3], [0, 3, 2], [1, 4, 3], [3, 4, 6], [3, 6, 5], [3, 5, 2]])

_RIM = 24  # heights at which the rim is looked at


@lru_cache(maxsize=None)
def card(name: str) -> tuple[Float[np.ndarray, "vertex 3"], Float[np.ndarray, "vertex 2"], Int[np.ndarray, "triangle 3"]]:
    """The flat card in blade lengths, petiole's end at the origin, with its texture places."""
    model, painting = leaf_model(name), leaf_painting(name)
    if model.is_blade:
        flat, triangle = hexagon(painting), _BLADE
        corners = np.column_stack([flat, np.zeros(len(flat))])
    else:
        corners, flat, triangle = _crossed(painting, model.planes)
    uv = (flat - [painting.left, painting.top]) / [painting.right - painting.left, painting.bottom - painting.top]
    return corners - [0, foot_of(painting), 0], uv, triangle


def hexagon(painting: Painting) -> Float[np.ndarray, "7 2"]:
    """The smallest hexagon, level at foot, waist and tip, that holds the drawing and stays on its texture: foot
    (left, right), waist (left, middle, right), tip (left, right), in blade lengths."""
    y, half = _half_widths(painting)
    waist = np.linspace(y[-1], y[0], 42)[3:-3]
    width = np.linspace(half.max(), max(half.max(), min(painting.right, -painting.left)), 6)
    best = (np.inf,)
    for at in waist:
        below, above = y < at - 1e-9, y > at + 1e-9
        reach = lambda part, end: (width + np.max((half[part] - width[:, None]) * (end - at) / (y[part] - at), axis=1)).clip(0.004)  # noqa: E731
        foot, tip = reach(below, y[-1]), reach(above, y[0])
        area = (foot + width) * (at - y[-1]) + (width + tip) * (y[0] - at)
        pick = int(np.argmin(area))
        if area[pick] < best[0]:
            best = (area[pick], at, foot[pick], width[pick], tip[pick])
    _, at, foot, wide, tip = best
    return np.array([[-foot, y[-1]], [foot, y[-1]], [-wide, at], [0, at], [wide, at], [-tip, y[0]], [tip, y[0]]])


def foot_of(painting: Painting) -> float:
    """Where the petiole (or the twig of a tuft) starts, blade lengths."""
    used = np.flatnonzero((painting.coverage > 0.5).any(axis=1))
    rows = len(painting.coverage)
    return float(painting.top + (used[-1] + 1) / rows * (painting.bottom - painting.top))


@lru_cache(maxsize=None)
def rim(name: str) -> Float[np.ndarray, "point 3"]:
    """Places on the rim of a blade's drawing, right and left at even heights, and its tip; on the flat card, in blade lengths."""
    painting = leaf_painting(name)
    y, half = _half_widths(painting)
    some = np.linspace(0, len(y) - 1, _RIM).astype(int)
    top = card(name)[0][:, 1].max()  # where `bent` has the tip
    flat = np.concatenate([np.stack([side * half[some], y[some] - foot_of(painting)], axis=1) for side in (1, -1)] + [[[0.0, top]]])
    return np.column_stack([flat, np.zeros(len(flat))])


def bends(tint: Float[np.ndarray, " leaf"], model: LeafModel) -> tuple[Float[np.ndarray, " leaf"], Float[np.ndarray, " leaf"]]:
    """Fold (radians) and curl (blade lengths) of each leaf: about the model's, drawn from the digits of its tint."""
    return np.radians(model.fold) * (0.6 + 0.8 * (tint * 7.31 % 1.0)), model.curl * (0.4 + 1.2 * (tint * 13.7 % 1.0))


def bent(corners: Float[np.ndarray, "vertex 3"], model: LeafModel, fold, curl) -> Float[np.ndarray, "leaf vertex 3"]:
    """The card of every leaf, folded along the midrib and bent down; a tuft stays as it is."""
    fold, curl = np.asarray(fold, float)[:, None], np.asarray(curl, float)[:, None]
    if not model.is_blade:
        return np.broadcast_to(corners, (len(fold), *corners.shape))
    x, y = corners[None, :, 0], corners[None, :, 1]
    z = np.abs(x) * np.sin(fold) - curl * (y / y.max()) ** 2
    return np.stack([x * np.cos(fold), y * np.ones_like(fold), z], axis=2)


def card_normals(corners, triangle, model: LeafModel) -> Float[np.ndarray, "vertex 3"]:
    """Unit normals of the model's card as it is bent on average."""
    if not model.is_blade:
        faces = np.cross(corners[triangle[:, 1]] - corners[triangle[:, 0]], corners[triangle[:, 2]] - corners[triangle[:, 0]])
        normal = np.zeros_like(corners)
        np.add.at(normal, triangle.ravel(), np.repeat(faces, 3, axis=0))
    else:
        tilt = np.radians(model.fold) * np.sign(corners[:, 0])
        bend = 2 * model.curl * corners[:, 1] / corners[:, 1].max() ** 2
        normal = np.stack([-np.sin(tilt), bend, np.cos(tilt)], axis=1)
    return normal / np.linalg.norm(normal, axis=1, keepdims=True)


def _half_widths(painting: Painting):
    """Height of every texture row, top first, and how far from the midrib its drawing reaches."""
    rows, columns = painting.coverage.shape
    x = painting.left + (np.arange(columns) + 0.5) / columns * (painting.right - painting.left)
    y = painting.top + (np.arange(rows) + 0.5) / rows * (painting.bottom - painting.top)
    seen = painting.coverage > 0.02
    reach = np.max(np.where(seen, np.abs(x)[None], 0.0), axis=1) + 1.5 / rows
    used = np.flatnonzero(seen.any(axis=1))
    rim = np.arange(max(used[0] - 1, 0), min(used[-1] + 2, rows))
    return y[rim], reach[rim]


def _crossed(painting: Painting, planes: int):
    """`planes` upright quads turned evenly about the axis."""
    flat = np.array([[painting.left, painting.bottom], [painting.right, painting.bottom], [painting.right, painting.top], [painting.left, painting.top]])
    turn = np.pi * np.arange(planes) / planes
    x, y = flat[None, :, :1], np.broadcast_to(flat[None, :, 1:], (planes, 4, 1))
    corners = np.concatenate([x * np.cos(turn)[:, None, None], y, x * np.sin(turn)[:, None, None]], axis=2)
    triangle = (np.array([[0, 1, 2], [0, 2, 3]])[None] + 4 * np.arange(planes)[:, None, None]).reshape(-1, 3)
    return corners.reshape(-1, 3), np.tile(flat, (planes, 1)), triangle
