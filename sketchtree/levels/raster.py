"""Which triangle is seen at each pixel of a parallel view?

Triangles are cut into spans, one a pixel row: where the row's middle line y crosses the triangle,

    x ∈ [ max over falling edges of x_e(y),  min over rising edges of x_e(y) ]

and every pixel whose middle lies in a span is a fragment. Fragments whose texture has less alpha than the material's cutoff are
dropped; of the others the nearest to the viewer stays. Textures are read as graphics cards read them: from the level
of a pyramid of averages that has about one texel a pixel. It needs no graphics card, and gives the same picture everywhere.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.geometry.mesh import Mesh
from sketchtree.levels.texels import Pyramid

_AT_ONCE = 60_000  # triangles looked at together, which bounds the memory


@dataclass(frozen=True, eq=False)
class View:
    """A parallel view of a square of the world."""

    right: Float[np.ndarray, " 3"]  # unit, in the world
    up: Float[np.ndarray, " 3"]  # unit, ⟂ right
    centre: Float[np.ndarray, " 3"]  # metres, in the middle of the picture
    half: float  # metres from the middle to each edge
    pixels: int  # along each edge

    @classmethod
    def round(cls, azimuth: float, centre, half: float, pixels: int) -> "View":
        """From the side, `azimuth` radians round y from +z (the drawing's view) towards +x."""
        right = np.array([np.cos(azimuth), 0.0, -np.sin(azimuth)])
        return cls(right, np.array([0.0, 1.0, 0.0]), np.asarray(centre, float), half, pixels)

    @property
    def towards(self) -> Float[np.ndarray, " 3"]:
        """Unit, from the tree to the viewer."""
        return np.cross(self.right, self.up)

    def place(self, point: Float[np.ndarray, "point 3"]) -> Float[np.ndarray, "point 3"]:
        """Column, row (both in pixels, from the top left corner) and depth (metres, greater is nearer)."""
        away = point - self.centre
        scale = self.pixels / (2.0 * self.half)
        column, row = (away @ self.right + self.half) * scale, (self.half - away @ self.up) * scale
        return np.stack([column, row, away @ self.towards], axis=1)


@dataclass(frozen=True, eq=False)
class Fragments:
    """Pixels covered by triangles of one mesh; one row a pixel and triangle."""

    pixel: Int[np.ndarray, " fragment"]  # row · pixels + column
    depth: Float[np.ndarray, " fragment"]  # metres, greater is nearer
    triangle: Int[np.ndarray, " fragment"]
    weight: Float[np.ndarray, "fragment 3"]  # of the triangle's corners


@dataclass(frozen=True, eq=False)
class Seen:
    """What is seen at each pixel; a pixel of nothing has depth −∞."""

    depth: Float[np.ndarray, "row column"]
    color: Float[np.ndarray, "row column 3"]  # linear, 0-1, of the surface itself, without light
    normal: Float[np.ndarray, "row column 3"]  # world, unit, of the side that is seen
    facing: Bool[np.ndarray, "row column"]  # the front of its triangle is seen


def silhouette(meshes: Sequence[Mesh], view: View) -> Bool[np.ndarray, "row column"]:
    """Where anything is seen at the middles of the pixels, textures read at their finest: what is true of the surfaces, however small they are."""
    found = np.zeros(view.pixels**2, bool)
    for mesh in meshes:
        texels = Pyramid.of(mesh.material)
        for fragments in _fragments(mesh, view, texels, sharp=True):
            found[fragments.pixel] = True
    return found.reshape(view.pixels, view.pixels)


def render(meshes: Sequence[Mesh], view: View) -> Seen:
    """The nearest surface at each pixel: its own colour and which way it looks."""
    return _seen(meshes, view, (1.0,))[0]


def render_both(meshes: Sequence[Mesh], view: View) -> tuple[Seen, Seen]:
    """The same from this side and from the opposite one: what covers a pixel from one covers its mirror image from the other."""
    front, back = _seen(meshes, view, (1.0, -1.0))
    return front, Seen(*(getattr(back, name)[:, ::-1] for name in Seen.__dataclass_fields__))


def _seen(meshes: Sequence[Mesh], view: View, sides: Sequence[float]) -> list[Seen]:
    size = view.pixels**2
    found = [Seen(np.full(size, -np.inf), np.zeros((size, 3)), np.zeros((size, 3)), np.zeros(size, bool)) for _ in sides]
    for mesh in meshes:
        texels = Pyramid.of(mesh.material)
        for fragments in _fragments(mesh, view, texels):
            for side, seen in zip(sides, found, strict=True):
                near = _nearest(fragments, seen.depth, side)
                seen.depth[near.pixel] = side * near.depth
                seen.color[near.pixel] = _colors(mesh, near, texels, view)
                seen.normal[near.pixel], seen.facing[near.pixel] = _normals(mesh, near, side * view.towards)
    shape = view.pixels, view.pixels
    return [Seen(seen.depth.reshape(shape), seen.color.reshape(*shape, 3), seen.normal.reshape(*shape, 3), seen.facing.reshape(shape)) for seen in found]


def _fragments(mesh: Mesh, view: View, texels: Pyramid, *, sharp: bool = False) -> Iterator[Fragments]:
    """All fragments of a mesh that pass the test of alpha (if `sharp`, that of the texture itself), some triangles at a time."""
    place = view.place(mesh.position)
    for begin in range(0, len(mesh.triangle), _AT_ONCE):
        triangle = np.arange(begin, min(begin + _AT_ONCE, len(mesh.triangle)))
        found = _covered(place, mesh.triangle[triangle], view.pixels)
        found = Fragments(found.pixel, found.depth, triangle[found.triangle], found.weight)
        if mesh.material.alpha_cutoff is not None and texels.has_alpha:
            alpha = texels.alpha_at(_uv(mesh, found)) if sharp else texels.at(*_texture_places(mesh, found, view))[:, 3]
            found = _rows(found, alpha >= mesh.material.alpha_cutoff)
        yield found


def _covered(place, corner, pixels: int) -> Fragments:
    """The pixels whose middles lie in each triangle."""
    a, b, c = (place[corner[:, k]] for k in range(3))
    double = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    some = np.flatnonzero(np.abs(double) > 1e-12)
    a, b, c, double = a[some], b[some], c[some], double[some]
    low = np.minimum(np.minimum(a[:, 1], b[:, 1]), c[:, 1])
    high = np.maximum(np.maximum(a[:, 1], b[:, 1]), c[:, 1])
    first = np.clip(np.ceil(low - 0.5), 0, pixels).astype(np.int64)
    count = np.clip(np.floor(high - 0.5).astype(np.int64) + 1, 0, pixels) - first
    which, row = _ragged(first, np.maximum(count, 0))
    left, right = _span(a[which], b[which], c[which], double[which] > 0, row + 0.5)
    first = np.clip(np.ceil(left - 0.5), 0, pixels).astype(np.int64)
    count = np.clip(np.ceil(right - 0.5), 0, pixels).astype(np.int64) - first
    span, column = _ragged(first, np.maximum(count, 0))
    which, row = which[span], row[span]
    x, y = column + 0.5, row + 0.5
    a, b, c, double = a[which], b[which], c[which], double[which]
    to_b = ((x - a[:, 0]) * (c[:, 1] - a[:, 1]) - (y - a[:, 1]) * (c[:, 0] - a[:, 0])) / double
    to_c = ((b[:, 0] - a[:, 0]) * (y - a[:, 1]) - (b[:, 1] - a[:, 1]) * (x - a[:, 0])) / double
    weight = np.stack([1.0 - to_b - to_c, to_b, to_c], axis=1)
    depth = weight[:, 0] * a[:, 2] + weight[:, 1] * b[:, 2] + weight[:, 2] * c[:, 2]
    return Fragments(row * pixels + column, depth, some[which], weight)


def _span(a, b, c, counter, y):
    """From where to where the line at y lies in each triangle."""
    left, right = np.full(len(y), -np.inf), np.full(len(y), np.inf)
    for start, end in ((a, b), (b, c), (c, a)):
        rise = end[:, 1] - start[:, 1]
        level = np.abs(rise) < 1e-300
        x = start[:, 0] + (y - start[:, 1]) * (end[:, 0] - start[:, 0]) / np.where(level, 1.0, rise)
        is_right = (rise > 0) == counter
        right = np.where(~level & is_right, np.minimum(right, x), right)
        left = np.where(~level & ~is_right, np.maximum(left, x), left)
    return left, np.maximum(right, left)


def _ragged(first, count):
    """For each row `count` numbers from `first` on: the row of each, and the number."""
    which = np.repeat(np.arange(len(count)), count)
    return which, np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count) + first[which]


def _nearest(found: Fragments, depth: Float[np.ndarray, " pixel"], side: float) -> Fragments:
    """Of each pixel's fragments the nearest as seen from in front (1) or behind (−1), where it is nearer than `depth`; the later one
    where two are equally near."""
    near = side * found.depth
    rows = np.flatnonzero(near > depth[found.pixel])
    rows = rows[np.argsort(near[rows], kind="stable")]
    winner = np.full(len(depth), -1)
    winner[found.pixel[rows]] = rows  # the last one written stays
    return _rows(found, winner[winner >= 0])


def _rows(found: Fragments, rows) -> Fragments:
    return Fragments(*(getattr(found, name)[rows] for name in Fragments.__dataclass_fields__))


def _uv(mesh: Mesh, found: Fragments):
    return np.einsum("fk,fkc->fc", found.weight, mesh.uv[mesh.triangle[found.triangle]])


def _texture_places(mesh: Mesh, found: Fragments, view: View):
    """Texture place of each fragment, and how many textures a pixel is wide there."""
    uv = _uv(mesh, found)
    used, back = np.unique(found.triangle, return_inverse=True)
    tri = mesh.triangle[used]
    first, second = mesh.uv[tri[:, 1]] - mesh.uv[tri[:, 0]], mesh.uv[tri[:, 2]] - mesh.uv[tri[:, 0]]
    there = np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])
    place = view.place(mesh.position[tri.ravel()]).reshape(-1, 3, 3)
    one, two = place[:, 1] - place[:, 0], place[:, 2] - place[:, 0]
    here = np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])
    return uv, np.sqrt(there / np.maximum(here, 1e-12))[back.ravel()]


def _colors(mesh: Mesh, found: Fragments, texels: Pyramid, view: View):
    color = np.broadcast_to(np.asarray(mesh.material.base_color[:3]), (len(found.pixel), 3))
    if texels.any:
        color = color * texels.at(*_texture_places(mesh, found, view))[:, :3]
    if mesh.color is not None:
        color = color * np.einsum("fk,fkc->fc", found.weight, mesh.color[mesh.triangle[found.triangle]][..., :3])
    return color


def _normals(mesh: Mesh, found: Fragments, towards):
    corner = mesh.triangle[found.triangle]
    normal = np.einsum("fk,fkc->fc", found.weight, mesh.normal[corner])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    a, b, c = (mesh.position[corner[:, k]] for k in range(3))
    front = np.cross(b - a, c - a) @ towards > 0
    return np.where(front[:, None] | (not mesh.material.double_sided), normal, -normal), front
