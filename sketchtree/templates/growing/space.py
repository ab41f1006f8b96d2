"""Is there room for a limb? The wood that stands already, kept in cubes so that a question costs the same in a large tree.

Competition for space, and for the light that comes with it: who came first keeps the place. A limb that comes nearer than its
`clearance` to other wood bends away from the nearest of it or stops; see `shoot`.
"""

from math import floor

from sketchtree.templates.growing.headings import Vector


class Space:
    """Points of wood in cubes of `cell` metres; `cell` is at least the widest clearance asked for."""

    def __init__(self, cell: float):
        self._cell = max(cell, 1e-3)
        self._cubes: dict[tuple[int, int, int], list[tuple[Vector, int]]] = {}

    def add(self, at: Vector, limb: int) -> None:
        """Wood of `limb` stands at `at`."""
        self._cubes.setdefault(self._cube(at), []).append((at, limb))

    def nearest(self, at: Vector, within: float, but: tuple[int, ...]) -> Vector | None:
        """The nearest wood within so many metres that belongs to no limb of `but`; None where there is room."""
        i, j, k = self._cube(at)
        best, found = within * within, None
        for cube in ((i + a, j + b, k + c) for a in (-1, 0, 1) for b in (-1, 0, 1) for c in (-1, 0, 1)):
            for point, limb in self._cubes.get(cube, ()):
                square = (point[0] - at[0]) ** 2 + (point[1] - at[1]) ** 2 + (point[2] - at[2]) ** 2
                if square < best and limb not in but:
                    best, found = square, point
        return found

    def _cube(self, at: Vector) -> tuple[int, int, int]:
        return floor(at[0] / self._cell), floor(at[1] / self._cell), floor(at[2] / self._cell)
