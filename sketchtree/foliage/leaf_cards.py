"""How do the leaves of a tree become fewer and fewer triangles, and stay as many to the eye?

By what there is to spend on a leaf, and leaves that bend the farthest get more first:

    four triangles  the picture in a diamond that lies in the full card's own faces
    two triangles   the diamond, folded or bent; a tuft's own picture on a rectangle
    one triangle    the picture in the smallest triangle round it
    less            a triangle for two, three or more leaves that follow each other on a stem and lie in a plane (`sprays`); tufts are thinned out

Short shoots have six triangles, three, one or none (`short_shoots`).

A card's place is the affine map from its picture's plane that comes nearest to where its leaves' feet, sides and tips truly are (least
squares), made larger or smaller about its middle until what is drawn on it has its leaves' area:

    min over (o, e_x, e_y)  Σ_k |o + x_k e_x + y_k e_y − p_k|²        (x, y)_k: in the picture    p_k: on the tree
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy import ndimage

from sketchtree.errors import OptionError
from sketchtree.foliage.card_shape import bends, bent, card, rim
from sketchtree.foliage.cards import mesh_name, outward, turned
from sketchtree.foliage.crown_light import crown_light
from sketchtree.foliage.leaf_materials import colours_of, leaf_factor, leaf_material, painted_material
from sketchtree.foliage.leaves import Leaves, select
from sketchtree.foliage.models import leaf_model, leaf_painting
from sketchtree.foliage.painting import Painting
from sketchtree.foliage.seasons import check_season
from sketchtree.foliage.short_shoots import STEMS, stems
from sketchtree.foliage.sprays import layouts, sprays
from sketchtree.foliage.triangles import Outlines, drawn_area, outlines, strip
from sketchtree.geometry.mesh import Material, Mesh

_MOST = 12  # leaves that one card stands for; fewer triangles thin the leaves out


class _Planes(NamedTuple):
    """The flat pictures of the leaves: where x and y of each lie in the world. A tuft has several."""

    plane: Float[np.ndarray, "picture 3 3"]  # rows: origin (the foot), e_x, e_y; metres a leaf length
    leaf: Int[np.ndarray, " picture"]
    area: Float[np.ndarray, " picture"]  # that is drawn, m²


class _Cards(NamedTuple):
    """Cards of any shape, before they are a mesh."""

    position: Float[np.ndarray, "card corner 3"]
    uv: Float[np.ndarray, "card corner 2"]
    leaf: Int[np.ndarray, "card leaf"]  # that it stands for; -1 none
    ring: Int[np.ndarray, "triangle 3"]  # corners of each of its triangles


_TRIANGLE, _QUAD = np.array([[0, 1, 2]]), np.array([[0, 1, 2], [0, 2, 3]])
_FOLDED, _WAIST = np.array([[0, 1, 2], [0, 2, 3]]), np.array([[0, 1, 3], [1, 2, 3]])  # of a diamond: foot, right, tip, left
_FACES = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])  # and its middle


def leaf_cards(leaves: Leaves, *, season: str = "summer", triangles: int, stem: int = 0) -> Mesh:
    """The leaves in at most so many triangles (≥ 1), of the same area in all: a mesh called `leaf` or `leaf_blossom`.

    Each short shoot has `stem` triangles (0, 1, 3 or 6) besides. With as many triangles as `cards.leaf_mesh` has, leaves are still made of simpler
    cards. Raises OptionError."""
    check_season(season)
    if triangles < 1:
        raise OptionError(f"The leaves were to have {triangles} triangles.", remedy="Allow at least 1, or leave the leaves out.")
    if stem not in (0, *STEMS):
        raise OptionError(f"The short shoots were to have {stem} triangles each.", remedy="Give 0, 1, 3 or 6.")
    planes = _planes(leaves)
    if len(planes.leaf) == 0:
        return _mesh(leaves, season, [], leaf_material(leaves.model, colours_of(leaves, season)), 0)
    if triangles < len(planes.leaf) and leaf_model(leaves.model).is_blade:
        cards, material = _spray_cards(leaves, planes, season, triangles)
        return _mesh(leaves, season, [cards], material, stem)
    shapes = _shapes(leaves.model)
    material = painted_material(f"leaf_{leaves.model}_simple", shapes.painting, leaves.model, colours_of(leaves, season))
    return _mesh(leaves, season, _simple(leaves, _thinned(planes, triangles), shapes, triangles), material, stem)


@lru_cache(maxsize=None)
def _shapes(name: str) -> Outlines:
    """The simple outlines of a model's picture."""
    corners, _, _ = card(name)
    return outlines(leaf_painting(name), float(corners[3, 1]) if leaf_model(name).is_blade else None)


def _simple(leaves: Leaves, planes: _Planes, shapes: Outlines, triangles: int) -> list[_Cards]:
    """Every picture on its own card: a triangle, and what is left over goes to those that it brings the most."""
    count = len(planes.leaf)
    if not leaf_model(leaves.model).is_blade:
        rich = _first(planes.area, min(triangles - count, count))
        return [_singles(_some(planes, ~rich), shapes), _boxes(_some(planes, rich), shapes)]
    fold, curl = bends(leaves.tint, leaf_model(leaves.model))
    gain = planes.area * (np.sin(fold) + curl)[planes.leaf]
    two = _first(gain, min(triangles - count, count))
    four = _first(gain, min((triangles - 2 * count) // 2, count)) if triangles > 2 * count else np.zeros(count, bool)
    sets = [_singles(_some(planes, ~two), shapes)] if not two.all() else []
    return sets + [_diamonds(leaves, planes.leaf[rows], shapes, each) for rows, each in ((two & ~four, 2), (four, 4)) if rows.any()]


def _first(value: Float[np.ndarray, " picture"], count: int) -> Bool[np.ndarray, " picture"]:
    """Which `count` are the greatest."""
    among = np.zeros(len(value), bool)
    among[np.argsort(-value, kind="stable")[: max(count, 0)]] = True
    return among


def _some(planes: _Planes, rows) -> _Planes:
    return _Planes(*(column[rows] for column in planes))


def _planes(leaves: Leaves) -> _Planes:
    model = leaf_model(leaves.model)
    count = max(model.planes, 1)
    if model.is_blade:
        outline = rim(leaves.model)
        flat = np.column_stack([np.ones(len(outline)), outline[:, :2]])
        local = np.matmul(np.linalg.pinv(flat), bent(outline, model, *bends(leaves.tint, model)))
    else:
        turn = np.pi * np.arange(count) / count
        across = np.stack([np.cos(turn), np.zeros(count), np.sin(turn)], axis=1)
        local = np.stack([np.zeros((count, 3)), across, np.tile([0.0, 1.0, 0.0], (count, 1))], axis=1).reshape(1, -1, 3)
    world = (turned(local, leaves) * leaves.size[:, None, None]).reshape(-1, 3, 3)
    world[:, 0] += np.repeat(leaves.position, count, axis=0)
    area = drawn_area(leaf_painting(leaves.model)) * np.repeat(leaves.size, count) ** 2
    return _Planes(world, np.repeat(np.arange(len(leaves)), count), area)


def _thinned(planes: _Planes, most: int) -> _Planes:
    """An even share of the pictures, grown to the area of all."""
    count = len(planes.leaf)
    if count <= most:
        return planes
    keep = (np.arange(most) * count) // most
    grown = np.sqrt(planes.area.sum() / planes.area[keep].sum())
    plane = planes.plane[keep]
    plane[:, 1:] *= grown
    return _Planes(plane, planes.leaf[keep], planes.area[keep] * grown**2)


def _diamonds(leaves: Leaves, rows: Int[np.ndarray, " card"], shapes: Outlines, triangles: int) -> _Cards:
    """Some leaves' pictures in diamonds. Of four triangles they lie in the full card's own faces; of two they are folded along the midrib or
    bent at the waist as the card is, whichever its rim asks for more: what is seen of a leaf from the side is its rim."""
    model, one = leaf_model(leaves.model), select(leaves, rows)
    corners, _, _ = card(leaves.model)
    foot, waist, tip = (float(corners[k, 1]) for k in (0, 3, 5))
    fold, curl = bends(one.tint, model)
    low, middle, high = (-curl * (y / tip) ** 2 for y in (foot, waist, tip))
    share = (waist - foot) / (tip - foot)
    off = middle - (1 - share) * low - share * high  # of the waist from the straight line
    mean, spread = _rim_reach(leaf_painting(leaves.model))
    folded = triangles == 4 or np.sin(np.radians(model.fold)) * spread > 0.3 * model.curl * share * (1 - share)
    flat_x, flat_y = shapes.corner["diamond"].T
    if triangles == 4 or not folded:
        along = [middle + (low - middle) * (flat_y[0] - waist) / (foot - waist), middle, middle + (high - middle) * (flat_y[2] - waist) / (tip - waist), middle]
    else:
        along = [low + (high - low) * (y - foot) / (tip - foot) + 0.5 * off for y in flat_y]
    lift = np.abs(flat_x) if folded else np.full(4, mean)
    x = flat_x * (np.cos(fold)[:, None] if folded else np.ones((len(fold), 1)))
    local = np.stack([x, np.broadcast_to(flat_y, x.shape), np.stack(along, axis=1) + lift * np.sin(fold)[:, None]], axis=2)
    uv, ring = shapes.uv["diamond"], _FOLDED if folded else _WAIST
    if triangles == 4:
        local = np.concatenate([local, np.stack([0 * fold, 0 * fold + waist, middle], axis=1)[:, None]], axis=1)
        uv, ring = np.vstack([uv, 0.5 * (uv[1] + uv[3])]), _FACES
    position = turned(local, one) * one.size[:, None, None] + one.position[:, None]
    return _Cards(position, np.broadcast_to(uv, (len(rows), *uv.shape)), rows[:, None], ring)


def _rim_reach(painting: Painting) -> tuple[float, float]:
    """How far from the midrib the drawing's rim is, mean and standard deviation, leaf lengths."""
    columns = painting.coverage.shape[1]
    x = np.abs(painting.left + (np.arange(columns) + 0.5) / columns * (painting.right - painting.left))
    rim = ndimage.morphological_gradient(painting.coverage, size=3).sum(axis=0)
    mean = float((rim * x).sum() / rim.sum())
    return mean, float(np.sqrt((rim * (x - mean) ** 2).sum() / rim.sum()))


def _boxes(planes: _Planes, shapes: Outlines) -> _Cards:
    """A rectangle for each picture."""
    return _flat(planes, shapes, "box", _QUAD)


def _singles(planes: _Planes, shapes: Outlines) -> _Cards:
    """A triangle for each picture."""
    return _flat(planes, shapes, "triangle", _TRIANGLE)


def _flat(planes: _Planes, shapes: Outlines, outline: str, ring) -> _Cards:
    corner, uv = shapes.corner[outline], shapes.uv[outline]
    plane = _to_area(planes.plane, corner.mean(axis=0), shapes.covered, planes.area)
    return _Cards(_on(plane, corner[None]), np.broadcast_to(uv, (len(plane), *uv.shape)), planes.leaf[:, None], ring)


def _spray_cards(leaves: Leaves, planes: _Planes, season: str, most: int) -> tuple[_Cards, Material]:
    """A triangle for each spray, of as few leaves as fit into `most` triangles."""
    table = sprays(_points(planes), most, _MOST)
    if len(table) > most:
        planes = _thinned(planes, len(planes.leaf) * most // len(table))
        table = sprays(_points(planes), most, _MOST)[:most]
    held = (table >= 0).sum(axis=1)
    foot, tip = planes.plane[:, 0], planes.plane[:, 0] + planes.plane[:, 2]
    stand, kind = [], np.zeros(len(table), np.int64)
    for n in np.unique(held):
        of = np.flatnonzero(held == n)
        found, which = layouts(foot[table[of, :n]], tip[table[of, :n]], len(of) / len(table))
        kind[of] = len(stand) + which
        stand += found
    pictures = strip(leaf_painting(leaves.model), [tuple(one) for one in stand])
    corner, uv = np.zeros((len(table), 3, 3)), np.zeros((len(table), 3, 2))
    for k, one in enumerate(stand):
        of = kind == k
        rows = table[of, : len(one.heading)]
        plane, middle = _fitted(planes.plane[rows], *one)
        corner[of] = _on(_to_area(plane, middle, pictures.covered[k], planes.area[rows].sum(axis=1)), pictures.corner[k : k + 1])
        uv[of] = pictures.uv[k]
    leaf = np.where(table >= 0, planes.leaf[table], -1)
    return _Cards(corner, uv, leaf, _TRIANGLE), painted_material(f"leaf_{leaves.model}_spray", pictures.painting, leaves.model, colours_of(leaves, season))


def _points(planes: _Planes) -> Float[np.ndarray, "picture 4 3"]:
    """Foot, tip and both sides of every leaf."""
    share = np.array([[1.0, 0, 0], [1, 0, 1], [1, 0.25, 0.5], [1, -0.25, 0.5]])
    return np.einsum("ks,psi->pki", share, planes.plane)


def _fitted(plane: Float[np.ndarray, "card leaf 3 3"], foot, heading):
    """The plane of each card that comes nearest to its leaves' planes, and the middle of the points in the picture."""
    o, ex, ey = np.moveaxis(plane, 2, 0)
    ahead = np.stack([np.sin(heading), np.cos(heading)], axis=1)
    side = np.stack([ahead[:, 1], -ahead[:, 0]], axis=1)
    share = [(0.0, 0.0), (1.0, 0.0), (0.5, 0.2), (0.5, -0.2)]
    flat = np.concatenate([foot + a * ahead + b * side for a, b in share])
    true = np.concatenate([o + a * ey + b * ex for a, b in share], axis=1)
    return np.matmul(np.linalg.pinv(np.column_stack([np.ones(len(flat)), flat])), true), flat.mean(axis=0)


def _to_area(plane, middle, covered: float, area) -> Float[np.ndarray, "card 3 3"]:
    """The planes, grown or shrunk about a point of the picture until what is drawn (`covered`, leaf lengths²) has its area (m²)."""
    own = covered * np.linalg.norm(np.cross(plane[:, 1], plane[:, 2]), axis=1)
    grown = np.clip(np.sqrt(area / np.maximum(own, 1e-12)), 0.5, 2.0)[:, None, None]
    axes = plane[:, 1:]
    moved = np.einsum("k,cki->ci", middle, axes * (1 - grown))
    return np.concatenate([(plane[:, 0] + moved)[:, None], axes * grown], axis=1)


def _on(plane, corner: Float[np.ndarray, "one corner 2"]) -> Float[np.ndarray, "card corner 3"]:
    """World places of corners of the picture."""
    return plane[:, :1] + np.matmul(corner, plane[:, 1:])


def _mesh(leaves: Leaves, season: str, sets: list[_Cards], material: Material, stem: int) -> Mesh:
    """The cards as triangles, and the short shoots of `stem` triangles each."""
    factor, blade = leaf_factor(leaves, season, crown_light(leaves)), leaf_model(leaves.model).is_blade
    position, normal, uv, triangle, color, first = [], [], [], [], [], 0
    for cards in sets:
        count, corners = cards.position.shape[:2]
        faced = _mean(leaves.normal, cards.leaf)
        faced /= np.maximum(np.linalg.norm(faced, axis=1, keepdims=True), 1e-9)
        position.append(cards.position.reshape(-1, 3))
        normal.append(outward(np.repeat(faced[:, None], corners, axis=1), cards.position, blade).reshape(-1, 3))
        uv.append(cards.uv.reshape(-1, 2))
        triangle.append((first + cards.ring[None] + corners * np.arange(count)[:, None, None]).reshape(-1, 3))
        color.append(np.repeat(_mean(factor, cards.leaf), corners, axis=0))
        first += corners * count
    if stem:
        shoots = stems(leaves, first, stem)
        for column, more in zip((position, normal, uv, triangle, color), (*shoots, np.ones((len(shoots.position), 4))), strict=True):
            column.append(more)
    if not position:
        return Mesh(mesh_name(leaves.model), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 2)), np.zeros((0, 3), np.int64), material)
    return Mesh(mesh_name(leaves.model), *(np.vstack(c) for c in (position, normal, uv, triangle)), material, np.vstack(color))


def _mean(value: Float[np.ndarray, "leaf channel"], of: Int[np.ndarray, "card leaf"]) -> Float[np.ndarray, "card channel"]:
    """The mean of each card's leaves."""
    held = of >= 0
    return np.einsum("cl,cli->ci", held / np.maximum(held.sum(axis=1, keepdims=True), 1), value[np.maximum(of, 0)])
