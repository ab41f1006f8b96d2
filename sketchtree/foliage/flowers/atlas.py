"""What is painted on a flower? One picture for all its pieces: left a whole flower from above, with holes between its petals; right one petal, and below it a patch of stem and one of heart.

Whole flowers from above are worn by simpler ones (`pieces.bowl`), the petal by those whose outline is cut by their triangles.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.foliage.flowers.recipe import Recipe
from sketchtree.foliage.painting import Painting

_ROWS, _FINER = 256, 3
_REACH = 1.25  # petal lengths that the flower from above shows to every side
PETAL = (0.52, 0.02, 0.98, 0.76)  # left, top, right, bottom in the texture
STEM, HEART = (0.64, 0.90), (0.88, 0.90)  # middles of their patches


def face_uv(x, y) -> Float[np.ndarray, "point 2"]:
    """Where a place of the flower from above is, petal lengths from its middle."""
    return np.stack([0.25 + 0.25 * np.asarray(x) / _REACH, 0.5 - 0.5 * np.asarray(y) / _REACH], axis=-1)


def petal_uv(across, along) -> Float[np.ndarray, "point 2"]:
    """Where a place of a petal is: −1 to 1 across, 0 at its foot, 1 at its tip."""
    left, top, right, bottom = PETAL
    return np.stack([left + (right - left) * (np.asarray(across) + 1) / 2, bottom + (top - bottom) * np.asarray(along)], axis=-1)


def half_width(along, width: float) -> Float[np.ndarray, " place"]:
    """Of a petal, petal lengths."""
    return width * np.interp(along, [0.0, 0.12, 0.35, 0.6, 0.82, 0.94, 1.0], [0.16, 0.34, 0.80, 1.0, 0.86, 0.55, 0.20])


def atlas(recipe: Recipe) -> Painting:
    """The picture."""
    rows = _FINER * _ROWS
    y, x = np.meshgrid((np.arange(rows) + 0.5) / rows, (np.arange(2 * rows) + 0.5) / rows / 2, indexing="ij")
    mask = {name: np.zeros_like(x) for name in ("coverage", "vein", "stem", "height")} | {"shade": np.ones_like(x)}
    _face(mask, x, y, recipe)
    _petal(mask, x, y, recipe)
    low = (x > 0.5) & (y > 0.8)
    mask["stem"][low & (x < 0.76)] = 1.0
    mask["vein"][low & (x >= 0.76)] = 1.0
    small = {name: one.reshape(_ROWS, _FINER, 2 * _ROWS, _FINER).mean(axis=(1, 3)).astype(np.float32) for name, one in mask.items()}
    return Painting(*(small[name] for name in ("coverage", "vein", "stem", "shade", "height")), -1.0, 1.0, 0.0, 1.0)


def _face(mask, x, y, recipe: Recipe) -> None:
    here = x < 0.5
    across, up = (x - 0.25) / 0.25 * _REACH, (0.5 - y) / 0.5 * _REACH
    out, turn = np.hypot(across, up), np.arctan2(across, up)
    step = 2 * np.pi / recipe.petals
    off = (turn + step / 2) % step - step / 2
    along, beside = out * np.cos(off), out * np.sin(off)
    edge = half_width(np.clip(along, 0, 1), recipe.width) - np.abs(beside)
    within = here & (((edge > 0) & (along < 1 - recipe.notch * np.exp(-((beside / 0.12) ** 2)))) | (out < 0.16))
    mask["coverage"][within] = 1.0
    mask["shade"][within] = (0.84 + 0.16 * np.clip(edge / 0.10, 0, 1) - 0.06 * np.exp(-((beside / 0.03) ** 2)) * (along > 0.2))[within]
    dots = (np.cos(recipe.stamens * turn) > 0.35) & (np.abs(out - recipe.heart * (1.5 + 0.35 * np.cos(7 * turn))) < 0.045)
    mask["vein"][within & ((out < recipe.heart) | dots)] = 1.0
    throat = np.clip(1.6 - out / max(recipe.throat, 1e-6), 0, 1) if recipe.throat else 0.0
    mask["vein"][within] = np.maximum(mask["vein"], 0.6 * throat)[within]


def _petal(mask, x, y, recipe: Recipe) -> None:
    left, top, right, bottom = PETAL
    here = x >= 0.5
    across, along = 2 * (x - left) / (right - left) - 1, np.clip((y - bottom) / (top - bottom), 0, 1)
    mask["coverage"][here] = 1.0
    if recipe.form == "catkin":
        _scales(mask, here & (y < 0.8), across, along)
        return
    streak = 0.5 + 0.5 * np.cos(9 * np.pi * across * (1.2 - 0.4 * along))
    mask["shade"][here] = (0.90 + 0.10 * along - 0.05 * streak * (1 - 0.5 * along) - 0.10 * np.clip((np.abs(across) - 0.8) / 0.2, 0, 1))[here]
    throat = np.clip(1.6 - along / max(recipe.throat, 1e-6), 0, 1) if recipe.throat else np.zeros_like(along)
    mask["vein"][here] = (0.6 * throat)[here]


def _scales(mask, here, across, along) -> None:
    """Rows of bracts round a catkin, anthers between them."""
    row = np.floor(14 * along)
    in_row, turn = 14 * along - row, (3 * (across + 1) + 0.5 * (row % 2)) % 1.0 - 0.5
    bract = in_row > 0.25 + 2.4 * turn**2
    mask["shade"][here] = np.where(bract, 0.78 + 0.22 * in_row, 0.62)[here]
    mask["vein"][here] = np.where(bract, 0.0, 0.85)[here]
