"""What is a piece of a flower? Triangles with places in its texture; pieces are turned, brought to their place and joined."""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int


class Shape(NamedTuple):
    """Triangles; the foot is the origin and y leads away from it."""

    position: Float[np.ndarray, "vertex 3"]
    uv: Float[np.ndarray, "vertex 2"]
    triangle: Int[np.ndarray, "triangle 3"]

    def normals(self) -> Float[np.ndarray, "vertex 3"]:
        """Unit, by the areas of the triangles about each vertex."""
        corner = self.position[self.triangle]
        face = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        total = np.zeros_like(self.position)
        np.add.at(total, self.triangle.ravel(), np.repeat(face, 3, axis=0))
        length = np.linalg.norm(total, axis=1, keepdims=True)
        return np.where(length > 1e-12, total / np.maximum(length, 1e-12), [0.0, 1.0, 0.0])

    def placed(self, foot, axes, size: float) -> "Shape":
        """At its place. `axes`: rows, what x, y and z become."""
        return Shape(np.asarray(foot) + size * self.position @ np.asarray(axes), self.uv, self.triangle)


def joined(parts: list[Shape]) -> Shape:
    """All of them as one."""
    first = np.cumsum([0, *(len(part.position) for part in parts)])
    triangle = [part.triangle + start for part, start in zip(parts, first, strict=False)]
    return Shape(np.concatenate([part.position for part in parts]), np.concatenate([part.uv for part in parts]), np.concatenate(triangle))


def grid(point: Float[np.ndarray, "row column 3"], uv: Float[np.ndarray, "row column 2"]) -> Shape:
    """A sheet of places, two triangles between any four."""
    rows, columns = point.shape[:2]
    at = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = at[:-1, :-1].ravel(), at[:-1, 1:].ravel(), at[1:, 1:].ravel(), at[1:, :-1].ravel()
    return Shape(point.reshape(-1, 3), uv.reshape(-1, 2), np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]))


def axes_along(way) -> Float[np.ndarray, "3 3"]:
    """Rows: a frame whose y is the unit vector `way`, its z as much upward as can be."""
    way = np.asarray(way, float) / np.linalg.norm(way)
    up = np.array([0.0, 1.0, 0.0]) if abs(way[1]) < 0.95 else np.array([0.0, 0.0, 1.0])
    z = up - (up @ way) * way
    z /= np.linalg.norm(z)
    return np.stack([np.cross(way, z), way, z])


def stalk(start, end, radius: float, uv, sides: int = 3) -> Shape:
    """A thin tapering tube; of two sides, one flat strip."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    x, _, z = axes_along(end - start)
    turn = 2 * np.pi * np.arange(sides) / sides
    ring = np.cos(turn)[:, None] * x + np.sin(turn)[:, None] * z
    if sides == 2:
        point = np.stack([start + radius * ring, end + 0.8 * radius * ring])
        return grid(point, np.broadcast_to(np.asarray(uv, float), (2, 2, 2)))
    ring = np.concatenate([ring, ring[:1]])
    point = np.stack([start + radius * ring, end + 0.8 * radius * ring])
    return grid(point, np.broadcast_to(np.asarray(uv, float), (2, sides + 1, 2)))
