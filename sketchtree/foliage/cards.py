"""How do leaves become triangles?

A blade is one card of six triangles, folded along the midrib and bent down at the tip; its outline is the
smallest hexagon round the drawing, so that little of it is empty. A needle tuft is a few quads crossed on
its axis. Short shoots are three-sided tubes. Shading normals lean from the card's own towards "out of the crown":

    n ∝ (1 − b) n_card + b (p − c)/|p − c|        c: centre of the crown, b: 0.35 for blades, 0.6 for tufts
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int

from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.models import LeafModel, leaf_model, leaf_painting
from sketchtree.foliage.painting import Painting, albedo, normal_map
from sketchtree.foliage.seasons import check_season, linear
from sketchtree.foliage.twigs import level_side
from sketchtree.geometry.mesh import Material, Mesh

_OUTWARD = {True: 0.35, False: 0.6}  # blade, tuft
_STEM = 0.018  # radius of a short shoot at its foot, leaf sizes
_BLADE = np.array([[0, 1, 3], [0, 3, 2], [1, 4, 3], [3, 4, 6], [3, 6, 5], [3, 5, 2]])


def leaf_mesh(leaves: Leaves, *, season: str = "summer") -> Mesh:
    """All leaves as one mesh called `leaf`, its material `leaf_<model>`. Raises OptionError."""
    check_season(season)
    model = leaf_model(leaves.model)
    card, uv, triangle = _card(leaves.model)
    right = np.cross(leaves.direction, leaves.normal)
    frame = np.stack([right, leaves.direction, leaves.normal], axis=1)
    bent = _bent(card, leaves, model)
    position = leaves.position[:, None] + np.einsum("lvi,lij->lvj", bent, frame) * leaves.size[:, None, None]
    local = _card_normals(card, triangle, model)
    normal = _outward(np.einsum("vi,lij->lvj", local, frame), position, _OUTWARD[model.is_blade])
    tint = _palette(model, season).factor(leaves.tint)
    vertices = len(card)
    stem = _stems(leaves, vertices * len(leaves))
    cards = (triangle[None] + vertices * np.arange(len(leaves))[:, None, None]).reshape(-1, 3)
    color = np.repeat(np.column_stack([tint, np.ones(len(leaves))]), vertices, axis=0)
    return Mesh(
        name="leaf",
        position=np.vstack([position.reshape(-1, 3), stem.position]),
        normal=np.vstack([normal.reshape(-1, 3), stem.normal]),
        uv=np.vstack([np.tile(uv, (len(leaves), 1)), stem.uv]),
        triangle=np.vstack([cards, stem.triangle]),
        material=leaf_material(leaves.model, season),
        color=np.vstack([color, np.ones((len(stem.position), 4))]),
    )


class _Stems(NamedTuple):
    """The short shoots as three-sided tapering tubes, in the texture's petiole."""

    position: Float[np.ndarray, "vertex 3"]
    normal: Float[np.ndarray, "vertex 3"]
    uv: Float[np.ndarray, "vertex 2"]
    triangle: Int[np.ndarray, "triangle 3"]


def _stems(leaves: Leaves, first: int) -> _Stems:
    """`first` is the number of their first vertex."""
    count = len(leaves.shoot)
    start, end = leaves.shoot[:, 0], leaves.shoot[:, 1]
    along = (end - start) / np.maximum(np.linalg.norm(end - start, axis=1, keepdims=True), 1e-12)
    side = level_side(along)
    turn = 2 * np.pi * np.arange(3) / 3
    ring = np.cos(turn)[:, None] * side[:, None] + np.sin(turn)[:, None] * np.cross(along, side)[:, None]
    radius = _STEM * (float(np.median(leaves.size)) if len(leaves) else 0.0)
    position = np.stack([start[:, None] + radius * ring, end[:, None] + 0.4 * radius * ring], axis=1)
    j = np.arange(3)
    k = (j + 1) % 3
    sides = np.vstack([np.stack([j, k, k + 3], axis=1), np.stack([j, k + 3, j + 3], axis=1)])
    painting = leaf_painting(leaves.model)
    u = -painting.left / (painting.right - painting.left) + 0.002 * (np.tile(j, 2) - 1)
    foot = (painting.top - _foot(painting)) / (painting.top - painting.bottom)
    v = foot - np.repeat([0.012, 0.024], 3)
    return _Stems(
        position.reshape(-1, 3),
        np.repeat(ring[:, None], 2, axis=1).reshape(-1, 3),
        np.tile(np.stack([u, v], axis=1), (count, 1)),
        (first + sides[None] + 6 * np.arange(count)[:, None, None]).reshape(-1, 3),
    )


@lru_cache(maxsize=32)
def leaf_material(name: str, season: str = "summer") -> Material:
    """The textures of a leaf model in a season."""
    model, painting = leaf_model(name), leaf_painting(name)
    palette = _palette(model, season)
    return Material(
        name=f"leaf_{name}",
        base_color_texture=albedo(painting, palette.texture_blade, linear(palette.vein), linear(palette.stem)),
        normal_texture=normal_map(painting),
        roughness=model.roughness,
        alpha_cutoff=0.5,
        double_sided=True,
    )


def _palette(model: LeafModel, season: str):
    return model.palettes[{"bare": "autumn"}.get(season, season)]


@lru_cache(maxsize=None)
def _card(name: str) -> tuple[Float[np.ndarray, "vertex 3"], Float[np.ndarray, "vertex 2"], Int[np.ndarray, "triangle 3"]]:
    """The flat card in blade lengths, petiole's end at the origin, with its texture places."""
    model, painting = leaf_model(name), leaf_painting(name)
    if model.is_blade:
        flat, triangle = hexagon(painting), _BLADE
        card = np.column_stack([flat, np.zeros(len(flat))])
    else:
        card, flat, triangle = _crossed(painting, model.planes)
    uv = (flat - [painting.left, painting.top]) / [painting.right - painting.left, painting.bottom - painting.top]
    foot = _foot(painting)
    return card - [0, foot, 0], uv, triangle


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


def _foot(painting: Painting) -> float:
    """Where the petiole (or the twig of a tuft) starts, blade lengths."""
    used = np.flatnonzero((painting.coverage > 0.5).any(axis=1))
    rows = len(painting.coverage)
    return float(painting.top + (used[-1] + 1) / rows * (painting.bottom - painting.top))


def _crossed(painting: Painting, planes: int):
    """`planes` upright quads turned evenly about the axis."""
    flat = np.array([[painting.left, painting.bottom], [painting.right, painting.bottom], [painting.right, painting.top], [painting.left, painting.top]])
    turn = np.pi * np.arange(planes) / planes
    x, y = flat[None, :, :1], np.broadcast_to(flat[None, :, 1:], (planes, 4, 1))
    card = np.concatenate([x * np.cos(turn)[:, None, None], y, x * np.sin(turn)[:, None, None]], axis=2)
    triangle = (np.array([[0, 1, 2], [0, 2, 3]])[None] + 4 * np.arange(planes)[:, None, None]).reshape(-1, 3)
    return card.reshape(-1, 3), np.tile(flat, (planes, 1)), triangle


def _bent(card, leaves: Leaves, model: LeafModel) -> Float[np.ndarray, "leaf vertex 3"]:
    """Every leaf's card, folded along the midrib and bent down, each a little differently."""
    if not model.is_blade:
        return np.broadcast_to(card, (len(leaves), *card.shape))
    fold = np.radians(model.fold) * (0.6 + 0.8 * (leaves.tint * 7.31 % 1.0))[:, None]
    curl = model.curl * (0.4 + 1.2 * (leaves.tint * 13.7 % 1.0))[:, None]
    x, y = card[None, :, 0], card[None, :, 1]
    z = np.abs(x) * np.sin(fold) - curl * (y / y.max()) ** 2
    return np.stack([x * np.cos(fold), y * np.ones_like(fold), z], axis=2)


def _card_normals(card, triangle, model: LeafModel) -> Float[np.ndarray, "vertex 3"]:
    if not model.is_blade:
        faces = np.cross(card[triangle[:, 1]] - card[triangle[:, 0]], card[triangle[:, 2]] - card[triangle[:, 0]])
        normal = np.zeros_like(card)
        np.add.at(normal, triangle.ravel(), np.repeat(faces, 3, axis=0))
    else:
        tilt = np.radians(model.fold) * np.sign(card[:, 0])
        bend = 2 * model.curl * card[:, 1] / card[:, 1].max() ** 2
        normal = np.stack([-np.sin(tilt), bend, np.cos(tilt)], axis=1)
    return normal / np.linalg.norm(normal, axis=1, keepdims=True)


def _outward(normal, position, share) -> Float[np.ndarray, "leaf vertex 3"]:
    """Card normals leaning out of the crown by `share`."""
    if len(position) == 0:
        return normal
    out = position - position.reshape(-1, 3).mean(axis=0)
    out /= np.maximum(np.linalg.norm(out, axis=2, keepdims=True), 1e-9)
    lean = (1 - share) * normal + share * out
    return lean / np.maximum(np.linalg.norm(lean, axis=2, keepdims=True), 1e-9)
