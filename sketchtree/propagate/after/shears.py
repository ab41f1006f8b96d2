"""What does a pair of shears leave? One side of a plane, the inside of a mesh, or what is outside one.

    plane     n · x ≤ d        written `y<4.5`, `x>-1`, `1,1,0<3` (metres, world: x to the right, y up, z towards the viewer)
    mesh      inside it        written as the name of its file: hedge shears, topiary
    hole      outside it       written `outside:FILE`

A branch from p to q is cut at f p q: for a plane f = (d − n·p) / (n·q − n·p); at a mesh, f is found by bisection between an
end that stays and one that goes (what dips in and out again within one piece is not seen).
"""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.errors import OptionError
from sketchtree.propagate.after.solids import Solid

HOLE = "outside:"
_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
_BISECTIONS = 24
_FIX = "Write a plane like `y<4.5`, `x>-1` or `1,1,0<3` (metres), a mesh file's name, or `outside:` and a mesh file's name."


class Shears(Protocol):
    """What is left of space."""

    cuts_roots: bool

    def inside(self, point: Float[np.ndarray, "point 3"]) -> Bool[np.ndarray, " point"]:
        """Which points stay."""
        ...

    def exit_fraction(self, start: Float[np.ndarray, "piece 3"], end: Float[np.ndarray, "piece 3"]) -> Float[np.ndarray, " piece"]:
        """The share of each piece up to where it first leaves; 1 if it stays, 0 if it starts outside."""
        ...


@dataclass(frozen=True)
class Plane:
    """Keeps the side n · x ≤ d."""

    normal: tuple[float, float, float]
    distance: float  # metres, if the normal has unit length
    cuts_roots: bool = True

    def inside(self, point):
        """Which points stay."""
        return point @ np.array(self.normal) <= self.distance

    def exit_fraction(self, start, end):
        """The share of each piece up to the plane."""
        here, there = (self.distance - point @ np.array(self.normal) for point in (start, end))
        crosses = (here >= 0) & (there < 0)
        return np.where(crosses, here / np.where(crosses, here - there, 1.0), (here >= 0).astype(float))


@dataclass(frozen=True, eq=False)
class Hedge:
    """Keeps what is inside a closed mesh, or (`hole`) what is outside it. Shears work above the ground: roots are left alone."""

    solid: Solid
    hole: bool = False
    cuts_roots: bool = False

    @classmethod
    def from_mesh(cls, mesh, *, hole: bool = False) -> "Hedge":
        """The shears of a trimesh; raises OptionError if it is not closed."""
        if not mesh.is_watertight:
            name = mesh.metadata.get("name", "The mesh")
            raise OptionError(f"{name} is not closed, so that it has no inside to prune by.", remedy="Close its holes, or prune by planes such as `y<4.5`.")
        return cls(Solid.from_triangles(mesh.triangles), hole)

    def inside(self, point):
        """Which points stay."""
        return self.solid.inside(point) != self.hole

    def exit_fraction(self, start, end):
        """The share of each piece up to the surface."""
        share = self.inside(start).astype(float)
        rows = np.flatnonzero(share > 0)
        rows = rows[~self.inside(end[rows])]
        low, high = np.zeros(len(rows)), np.ones(len(rows))
        for _ in range(_BISECTIONS if len(rows) else 0):
            middle = 0.5 * (low + high)
            stays = self.inside(start[rows] + middle[:, None] * (end - start)[rows])
            low, high = np.where(stays, middle, low), np.where(stays, high, middle)
        share[rows] = low
        return share


def plane(text: str) -> Plane | None:
    """The plane that is written so; None if this is no plane. Raises OptionError for a misspelt one."""
    if "<" not in text and ">" not in text:
        return None
    found = re.fullmatch(r"\s*([^<>=]+?)\s*([<>])=?\s*([^<>=]+?)\s*", text)
    normal = found and _normal(found[1])
    distance = found and _number(found[3])
    if normal is None or distance is None:
        raise OptionError(f"`--prune {text}` is no plane.", remedy=_FIX)
    sign = 1.0 if found[2] == "<" else -1.0
    return Plane(tuple(sign * part for part in normal), sign * distance)


def shears(text: str) -> Shears:
    """The shears that are written so. Raises OptionError for a misspelt plane or a mesh that can't be used."""
    found = plane(text)
    if found is not None:
        return found
    from sketchtree.propagate.space.mesh_files import read_mesh

    hole = text.startswith(HOLE)
    path = text.removeprefix(HOLE).strip()
    if not path:
        raise OptionError(f"`--prune {text}` names nothing to prune by.", remedy=_FIX)
    if not Path(path).is_file():
        raise OptionError(f"`--prune {text}`: there is no mesh file {path}.", remedy=_FIX)
    return Hedge.from_mesh(read_mesh(path), hole=hole)


def _normal(text: str):
    if text in _AXES:
        return _AXES[text]
    parts = [_number(part) for part in text.split(",")]
    return None if len(parts) != 3 or None in parts or not any(parts) else tuple(parts)


def _number(text: str) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if np.isfinite(value) else None
