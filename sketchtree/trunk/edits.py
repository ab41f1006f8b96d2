"""What does a person change about the contour's vertices? (Algorithm 1, lines 9-10: remove or create a vertex by selecting; §II.2: merge two segments into one.)

A file of edits is JSON; every key may be missing:

    {"vertices": m, "remove": [[x, y], ...], "add": [[x, y], ...], "merge": [[[x, y], [x, y]], ...]}

Points are pixels, x right, y down. `remove` takes the vertex nearest to each point, `merge` every vertex between two points of the contour, the shorter way round, `add` makes the point of the contour
nearest to each point a vertex, and a branch of the skeleton ends there. In that order.
"""

import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.errors import OptionError

Point = tuple[float, float]
_REACH = 0.05  # of the outline's longer side: how far from what it names a point may be
_LEAST_REACH = 8.0  # pixels
_KEYS = ("vertices", "remove", "add", "merge")
_REMEDY = 'Write {"vertices": m, "remove": [[x, y], ...], "add": [[x, y], ...], "merge": [[[x, y], [x, y]], ...]}.'


@dataclass(frozen=True)
class VertexEdits:
    """What is done by hand after the evolution."""

    vertices: int | None = None  # m
    remove: tuple[Point, ...] = ()
    add: tuple[Point, ...] = ()
    merge: tuple[tuple[Point, Point], ...] = ()
    exact: bool = True  # what finds nothing on the contour is an error; else it is passed over, and told


def read_edits(path: str | os.PathLike) -> VertexEdits:
    """The edits in a JSON file. Raises OptionError for a file that says something else."""
    path = Path(path)
    try:
        text = path.read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise OptionError(f"{path.name} can't be read.", remedy="Give a JSON file of vertex edits.") from error
    try:
        return edits_of(json.loads(text), path.name)
    except ValueError as error:
        raise OptionError(f"{path.name} is not JSON: {error}.", remedy=_REMEDY) from error


def edits_of(said: object, name: str = "The edits") -> VertexEdits:
    """The edits that a JSON object says."""
    if not isinstance(said, dict):
        raise OptionError(f"{name}: no JSON object.", remedy=_REMEDY)
    unknown = [key for key in said if key not in _KEYS]
    if unknown:
        raise OptionError(f"{name}: the key `{unknown[0]}` is none of {', '.join(_KEYS)}.", remedy=_REMEDY)
    m = said.get("vertices")
    if m is not None and (isinstance(m, bool) or not isinstance(m, int)):
        raise OptionError(f"{name}: `vertices` is {m!r}, not a whole number.", remedy=_REMEDY)
    removed, added, merged = (_listed(said.get(key, []), key, name) for key in _KEYS[1:])
    pairs = []
    for entry in merged:
        if not isinstance(entry, list) or len(entry) != 2:
            raise OptionError(f"{name}: {entry!r} in `merge` is no pair of points.", remedy=_REMEDY)
        pairs.append((_point(entry[0], "merge", name), _point(entry[1], "merge", name)))
    return VertexEdits(m, tuple(_point(p, "remove", name) for p in removed), tuple(_point(p, "add", name) for p in added), tuple(pairs))


def _listed(value: object, key: str, name: str) -> list:
    if not isinstance(value, list):
        raise OptionError(f"{name}: `{key}` is no list.", remedy=_REMEDY)
    return value


def _point(value: object, key: str, name: str) -> Point:
    numbers = isinstance(value, list) and len(value) == 2 and all(isinstance(x, int | float) and not isinstance(x, bool) and np.isfinite(x) for x in value)
    if not numbers:
        raise OptionError(f"{name}: {value!r} in `{key}` is no point [x, y].", remedy=_REMEDY)
    return float(value[0]), float(value[1])


@dataclass(frozen=True, eq=False)
class Vertices:
    """The vertices of every ring: numbers of its points, rising; which of them part the contour, and which of those a person added."""

    rows: tuple[Int[np.ndarray, " vertex"], ...]
    parting: tuple[Bool[np.ndarray, " vertex"], ...]
    added: tuple[Bool[np.ndarray, " vertex"], ...]

    @classmethod
    def of(cls, rows: Sequence[Int[np.ndarray, " vertex"]], parting: Sequence[Bool[np.ndarray, " vertex"]]) -> "Vertices":
        """Vertices of which none was added."""
        return cls(tuple(rows), tuple(parting), tuple(np.zeros(len(own), bool) for own in rows))


_PARTS, _ADDED = 1, 2  # beside 0: parts nothing


def edited(vertices: Vertices, rings: Sequence[Float[np.ndarray, "point 2"]], edits: VertexEdits) -> tuple[Vertices, tuple[str, ...]]:
    """(the vertices after the edits; those that stay part the contour as before, remarks). What does not exist raises OptionError, naming the point, or is passed over where the edits are not `exact`."""
    kept = [dict(zip(rows.tolist(), parting.astype(int).tolist(), strict=True)) for rows, parting in zip(vertices.rows, vertices.parting, strict=True)]
    reach = max(_LEAST_REACH, _REACH * float(np.ptp(np.concatenate(rings), axis=0).max()))
    told: list[str] = []
    for do, every in ((_remove, edits.remove), (_merge, edits.merge), (_add, edits.add)):
        for one in every:
            try:
                do(kept, rings, one, reach)
            except OptionError as error:
                if edits.exact:
                    raise
                told.append(f"{error.message} It was passed over.")
    rows = [np.array(sorted(own), np.int64) for own in kept]
    state = [np.array([own[row] for row in order]) for own, order in zip(kept, rows, strict=True)]
    return Vertices(tuple(rows), tuple(own >= _PARTS for own in state), tuple(own == _ADDED for own in state)), tuple(told)


def _remove(kept, rings, point: Point, reach: float) -> None:
    ring, row = _vertex_at(kept, rings, point, reach)
    _take(kept, ring, [row], f"`remove` ({point[0]:g}, {point[1]:g})")


def _add(kept, rings, point: Point, reach: float) -> None:
    ring, row = _contour_at(rings, point, reach, "add")
    kept[ring][row] = _ADDED


def _vertex_at(kept, rings, point: Point, reach: float) -> tuple[int, int]:
    """The vertex nearest to a point."""
    places = [(ring, row) for ring, own in enumerate(kept) for row in own]
    distance = np.hypot(*(np.array([rings[ring][row] for ring, row in places]) - point).T)
    best = int(np.argmin(distance))
    if distance[best] > reach:
        x, y = rings[places[best][0]][places[best][1]]
        raise OptionError(
            f"`remove` ({point[0]:g}, {point[1]:g}): no vertex is there; the nearest is ({x:.0f}, {y:.0f}), {distance[best]:.0f} pixels away.",
            remedy="Give the pixels of a vertex of the contour, y down.",
        )
    return places[best]


def _contour_at(rings, point: Point, reach: float, key: str) -> tuple[int, int]:
    """The point of the contour nearest to a point."""
    distance = [np.hypot(*(ring - point).T) for ring in rings]
    ring = int(np.argmin([d.min() for d in distance]))
    row = int(np.argmin(distance[ring]))
    if distance[ring][row] > reach:
        x, y = rings[ring][row]
        raise OptionError(
            f"`{key}` ({point[0]:g}, {point[1]:g}): the contour is not there; it is nearest at ({x:.0f}, {y:.0f}), {distance[ring][row]:.0f} pixels away.",
            remedy="Give pixels on the trunk's contour, y down.",
        )
    return ring, row


def _merge(kept, rings, pair: tuple[Point, Point], reach: float) -> None:
    """Make one segment of those that two points of the contour lie on: the vertices between go."""
    one, other = pair
    what = f"`merge` ({one[0]:g}, {one[1]:g}), ({other[0]:g}, {other[1]:g})"
    (ring, first), (ring_b, last) = (_contour_at(rings, point, reach, "merge") for point in (one, other))
    if ring != ring_b:
        raise OptionError(f"{what}: one lies on the contour of a hole, the other does not.", remedy="Give two points on one contour.")
    first, last = min(first, last), max(first, last)
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(*(np.roll(rings[ring], -1, axis=0) - rings[ring]).T))])
    inner = arc[last] - arc[first] <= arc[-1] / 2
    between = [row for row in kept[ring] if (first <= row <= last) == inner]
    if not between:
        raise OptionError(f"{what}: both lie on one segment already.", remedy="Give a point on either side of the vertices that are to go.")
    _take(kept, ring, between, what)


def _take(kept, ring: int, rows: list[int], what: str) -> None:
    if len(kept[ring]) - len(rows) < 3:
        raise OptionError(f"{what}: it would leave {len(kept[ring]) - len(rows)} vertices; a polygon has at least 3.", remedy="Keep more vertices, or ask for more.")
    for row in rows:
        del kept[ring][row]
