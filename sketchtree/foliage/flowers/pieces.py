"""How is one flower built? Its stalk comes from below; y leads out of its face, and petals are one long.

    fine    petals of twelve triangles, cupped and curved; a stamen and its anther a triangle each; a calyx
    plain   petals of two triangles; the heart a small pyramid
    bowl    the whole flower from above (`atlas`) on a bowl of as many triangles as it has petals
"""

import numpy as np

from sketchtree.foliage.flowers.atlas import HEART, STEM, face_uv, half_width, petal_uv
from sketchtree.foliage.flowers.recipe import Recipe
from sketchtree.foliage.flowers.shape import Shape, axes_along, grid, joined

FINE, PLAIN, BOWL = "fine", "plain", "bowl"
_CLOSED = 0.42  # length of a bud's petals, of an open flower's


def flower(recipe: Recipe, level: str, shade: int = 0) -> Shape:
    """An open flower. `shade`: which of several that differ a little."""
    if recipe.flower == "pea":
        return _pea(recipe, level)
    if level == BOWL:
        return bowl(recipe)
    cup = recipe.cup + 9.0 * ((shade * 0.618) % 1.0 - 0.5)
    parts = [petal(recipe, level, 2 * np.pi * k / recipe.petals, cup, cup - 18.0, bend=0.10 * np.sin(2.4 * k + shade)) for k in range(recipe.petals)]
    return joined([*parts, *_middle(recipe, level), *([_calyx()] if level == FINE else [])])


def bud(recipe: Recipe, level: str) -> Shape:
    """A closed flower."""
    if level == BOWL:
        return bowl(recipe, rise=1.6).placed([0, 0, 0], np.eye(3), 0.35)
    parts = [petal(recipe, level, 2 * np.pi * k / recipe.petals, 25.0, 150.0) for k in range(recipe.petals)]
    return joined([*parts, *([_calyx()] if level == FINE else [])]).placed([0, 0, 0], np.eye(3), _CLOSED)


def petal(recipe: Recipe, level: str, turn: float, low: float, high: float, bend: float = 0.0) -> Shape:
    """One petal, which rises by `low` degrees at its foot and `high` at its tip; `bend` lifts one side."""
    along = np.array([0.0, 0.3, 0.62, 0.88, 1.0])[:, None] if level == FINE else np.array([0.0, 0.62, 1.0])[:, None]
    across = np.array([[-1.0, 0.0, 1.0]]) if level == FINE else np.array([[-1.0, 1.0]])
    fine = np.linspace(0, 1, 41)
    rise = np.radians(low + (high - low) * fine)
    out, up = (np.interp(along, fine, np.r_[0.0, np.cumsum((f(rise[1:]) + f(rise[:-1])) / 2) / 40]) for f in (np.cos, np.sin))
    width = half_width(along, recipe.width)
    notched = 1.0 - recipe.notch * (along > 0.99) * (1 - np.abs(across))
    beside = width * across
    up = up + 0.16 * across**2 * width + bend * across * along
    radial, sideways = np.array([np.sin(turn), 0.0, np.cos(turn)]), np.array([np.cos(turn), 0.0, -np.sin(turn)])
    point = (0.05 + out * notched)[..., None] * radial + beside[..., None] * sideways + (up + 0 * across)[..., None] * [0.0, 1.0, 0.0]
    return grid(point, petal_uv(np.broadcast_to(across, point.shape[:2]), np.broadcast_to(along, point.shape[:2])))


def bowl(recipe: Recipe, rise: float | None = None) -> Shape:
    """The flower from above, on a bowl whose sides stand over its petals."""
    count = recipe.petals
    up = np.sin(np.radians(max(recipe.cup - 9.0, 4.0))) if rise is None else rise
    turn, reach = 2 * np.pi * (np.arange(count) + 0.5) / count, 1.0 / np.cos(np.pi / count)
    reach = min(reach, 1.24)
    x, z = reach * np.sin(turn), reach * np.cos(turn)
    position = np.concatenate([[[0.0, 0.0, 0.0]], np.stack([x, np.full(count, up), z], axis=1)])
    k = np.arange(count)
    return Shape(position, face_uv(np.r_[0.0, x], np.r_[0.0, z]), np.stack([np.zeros(count, int), 1 + k, 1 + (k + 1) % count], axis=1))


def _middle(recipe: Recipe, level: str) -> list[Shape]:
    """The heart, and stamens about it."""
    turn = 2 * np.pi * np.arange(5) / 5
    ring = np.stack([recipe.heart * np.cos(turn), np.full(5, 0.06), recipe.heart * np.sin(turn)], axis=1)
    k = np.arange(5)
    top = Shape(np.concatenate([[[0.0, 0.06 + 0.8 * recipe.heart, 0.0]], ring]), np.tile(HEART, (6, 1)), np.stack([np.zeros(5, int), 1 + (k + 1) % 5, 1 + k], axis=1))
    return [top, *(_stamen(recipe, j) for j in range(recipe.stamens if level == FINE else 0))]


def _stamen(recipe: Recipe, number: int) -> Shape:
    """A filament as pale as the petals, and its anther."""
    turn, lean = 2.39996 * number, np.radians(16.0 + 26.0 * ((number * 0.38) % 1.0))
    way = np.array([np.sin(lean) * np.cos(turn), np.cos(lean), np.sin(lean) * np.sin(turn)])
    side, long = np.cross(way, [0.3, 0.1, 0.9]), recipe.stamen * (0.8 + 0.4 * ((number * 0.73) % 1.0))
    side = side / np.linalg.norm(side)
    foot, end = 0.5 * recipe.heart * way + [0, 0.05, 0], long * way + [0, 0.05, 0]
    filament = Shape(np.stack([foot - 0.012 * side, foot + 0.012 * side, end]), petal_uv(np.zeros(3), np.full(3, 0.9)), np.array([[0, 1, 2]]))
    anther = Shape(np.stack([end - 0.045 * side, end + 0.045 * side, end + 0.07 * way]), np.tile(HEART, (3, 1)), np.array([[0, 1, 2]]))
    return joined([filament, anther])


def _calyx() -> Shape:
    """Sepals under the petals, and the cup that they stand on."""
    turn = 2 * np.pi * (np.arange(10)) / 10
    out = np.where(np.arange(10) % 2, 0.12, 0.42)
    rim = np.stack([out * np.sin(turn), np.where(np.arange(10) % 2, 0.0, 0.03), out * np.cos(turn)], axis=1)
    k = np.arange(10)
    return Shape(np.concatenate([[[0.0, -0.20, 0.0]], rim - [0, 0.015, 0]]), np.tile(STEM, (11, 1)), np.stack([np.zeros(10, int), 1 + (k + 1) % 10, 1 + k], axis=1))


def _pea(recipe: Recipe, level: str) -> Shape:
    """A standard that stands up, two wings before it, a keel below."""
    standard = petal(recipe, FINE if level == FINE else PLAIN, 0.0, 60.0, 95.0).placed([0, 0, 0], np.eye(3), 0.75)
    wings = [petal(recipe, FINE if level == FINE else PLAIN, side * 0.9, 62.0, 72.0).placed([0, 0.05, 0], np.eye(3), 0.8) for side in (1, -1)]
    if level == BOWL:
        return joined([standard, petal(recipe, PLAIN, np.pi, 58.0, 78.0)])
    keel = [petal(recipe, PLAIN, np.pi + side * 0.45, 48.0, 84.0, bend=0.18 * side) for side in (1, -1)]
    cup = _calyx().placed([0, 0.14, 0], axes_along([0.0, 1.0, 0.0]), 0.6)
    return joined([standard, *wings, *keel, cup])
