"""How do flowers stand together? In umbels, plates, panicles, catkins and clusters, each in three finenesses. The whole blossom is one long."""

import numpy as np

from sketchtree.foliage.flowers.atlas import STEM, petal_uv
from sketchtree.foliage.flowers.pieces import BOWL, FINE, PLAIN, bud, flower
from sketchtree.foliage.flowers.recipe import Recipe
from sketchtree.foliage.flowers.shape import Shape, axes_along, grid, joined, stalk

_GOLDEN = np.radians(137.508)
_SHARE = {FINE: 1.0, PLAIN: 0.6, BOWL: 0.3}  # of the flowers of a blossom of many, which grow by as much
_MANY = 12  # flowers


def blossom_shape(recipe: Recipe, level: str) -> Shape:
    """The blossom; `level`: fine, plain or bowl (`pieces`)."""
    return {"umbel": _umbel, "cluster": _umbel, "plate": _plate, "panicle": _panicle, "catkin": _catkin}[recipe.form](recipe, level)


def _sides(level: str) -> int:
    return 3 if level == FINE else 2


def _umbel(recipe: Recipe, level: str) -> Shape:
    """Stalks from the end of one, or from the wood; flowers look out along them, buds stand in the middle."""
    count = recipe.flowers + recipe.buds
    share = _SHARE[level] if count > _MANY else 1.0
    count, open_ = max(int(round(share * count)), 1), max(int(round(share * recipe.flowers)), 1)
    size = recipe.radius / np.sqrt(share)
    foot = np.array([0.0, 0.0 if recipe.form == "cluster" else max(1.0 - recipe.stalk - 1.1 * recipe.radius, 0.04), 0.0])
    parts = [stalk([0, 0, 0], foot, 0.018, STEM, _sides(level))] if foot[1] > 0 else []
    for k in range(count):
        rank = count - 1 - k  # the outer ones are open
        lean = np.radians(recipe.spread) * np.sqrt((rank + 0.5) / count)
        way = np.array([np.sin(lean) * np.cos(rank * _GOLDEN), np.cos(lean), np.sin(lean) * np.sin(rank * _GOLDEN)])
        long = recipe.stalk * (0.86 + 0.28 * ((rank * 0.618) % 1.0))
        end = foot + long * way
        parts.append(stalk(foot, end, 0.011, STEM, _sides(level)))
        one = flower(recipe, level, k) if k < open_ else bud(recipe, level)
        parts.append(one.placed(end, axes_along(way + [0, 0.25, 0]), size))
    return joined(parts)


def _plate(recipe: Recipe, level: str) -> Shape:
    """Flowers of one height, on branching stalks."""
    count, size = max(int(recipe.flowers * _SHARE[level]), 1), recipe.radius / np.sqrt(_SHARE[level])
    parts, arms = [], 5
    for k in range(arms):
        turn = 2 * np.pi * k / arms
        parts.append(stalk([0, 0, 0], [0.30 * np.cos(turn), 0.52, 0.30 * np.sin(turn)], 0.012, STEM, _sides(level)))
    for k in range(count):
        out, turn = recipe.wide * np.sqrt((k + 0.5) / count), k * _GOLDEN
        place = np.array([out * np.cos(turn), 0.72 + 0.16 * (1 - (out / recipe.wide) ** 2) + 0.03 * np.sin(5.3 * k), out * np.sin(turn)])
        way = np.array([0.5 * place[0], 1.0, 0.5 * place[2]])
        if level == FINE:
            parts.append(stalk([0.5 * place[0], 0.56, 0.5 * place[2]], place, 0.005, STEM, 2))
        parts.append(flower(recipe, BOWL).placed(place, axes_along(way), size))
    return joined(parts)


def _panicle(recipe: Recipe, level: str) -> Shape:
    """Flowers round an axis, closer to it towards its end; the last ones are buds."""
    count, size = max(int(recipe.flowers * _SHARE[level]), 1), recipe.radius / np.sqrt(_SHARE[level])
    parts = [stalk([0, 0, 0], [0, 0.98, 0], 0.016, STEM, _sides(level))]
    for k in range(count):
        up, turn = ((k + 0.5) / count) ** 0.9, k * _GOLDEN
        out = recipe.wide * (1 - up) ** 0.6 * min(1.0, (up + 0.10) / 0.22) + 0.01
        way = np.array([np.cos(turn), 0.45, np.sin(turn)])
        foot, end = np.array([0, 0.06 + 0.88 * up, 0.0]), np.array([out * np.cos(turn), 0.10 + 0.88 * up, out * np.sin(turn)])
        if level == FINE:
            parts.append(stalk(foot, end, 0.005, STEM, 2))
        kind = BOWL if level == BOWL or recipe.flowers > 60 else PLAIN
        parts.append((flower(recipe, kind, k) if up < 0.9 else bud(recipe, kind)).placed(end, axes_along(way), size * (1.0 - 0.25 * up)))
    return joined(parts)


def _catkin(recipe: Recipe, level: str) -> Shape:
    """A body of bracts in rows, thick in its middle."""
    sides, rows = {FINE: (8, 29), PLAIN: (6, 11), BOWL: (4, 4)}[level]
    along, turn = np.linspace(0, 1, rows), 2 * np.pi * np.arange(sides + 1) / sides
    body = recipe.wide * np.sqrt(np.clip(1 - np.abs(2 * along - 0.9) ** 3 / 1.35, 0.05, 1))
    body *= 1.0 + (0.16 * (np.arange(rows) % 2) if level != BOWL else 0.0)
    bow = 0.05 * np.sin(np.pi * along)
    point = np.stack([body[:, None] * np.cos(turn) + bow[:, None], np.broadcast_to(0.1 + 0.9 * along[:, None], (rows, sides + 1)), body[:, None] * np.sin(turn)], axis=2)
    uv = petal_uv(np.broadcast_to(2 * np.arange(sides + 1) / sides - 1, (rows, sides + 1)), np.broadcast_to(along[:, None], (rows, sides + 1)))
    return joined([stalk([0, 0, 0], [0, 0.12, 0], 0.02, STEM, _sides(level)), grid(point, uv)])
