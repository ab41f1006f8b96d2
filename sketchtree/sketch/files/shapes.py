"""What is one painted shape? Its geometry in the user units of the root, how it is painted, and what its file says of it."""

from dataclasses import dataclass
from xml.etree.ElementTree import Element

import numpy as np
from jaxtyping import Float

from sketchtree.sketch.files.areas import Area
from sketchtree.sketch.files.names import Naming
from sketchtree.sketch.files.outlines import flatten
from sketchtree.sketch.files.paint import Paint
from sketchtree.sketch.files.path_data import Subpath
from sketchtree.sketch.files.path_effects import Spine
from sketchtree.sketch.files.svg_record import StrokeRecord
from sketchtree.sketch.files.transforms import IDENTITY, Matrix
from sketchtree.sketch.files.viewport import Box


@dataclass(frozen=True, eq=False, slots=True)
class Shape:
    """One painted shape, its geometry in user units of the root (y down)."""

    element: Element
    paths: list[Subpath]
    naming: Naming
    width: float | None  # line width; None for a shape that is only filled
    filled: bool  # painted as an area, without a line
    rule: str  # how its area is told from its outline: nonzero, evenodd
    fill: Paint | None  # of the area
    line: Paint | None  # … and of the line
    clip: Area | None  # where it shows; None: everywhere
    spine: Spine | None  # of a line thickened by an effect; widths already in root units
    matrix: Matrix  # from its own coordinates to the root's
    group: str | None  # what the group around it is called
    pen: str  # its line width as the style says it
    record: StrokeRecord | None  # of a stroke that we wrote
    drawn: tuple[Float[np.ndarray, "point 2"], bool] | None  # (points, closed) of such a stroke, in root units, to the last bit; `paths` is then empty


def transformed(paths: list[Subpath], matrix: Matrix) -> list[Subpath]:
    """The same geometry after a transform. Raises ValueError if it leads beyond what numbers can hold."""
    if matrix is IDENTITY:
        return paths
    linear, shift = matrix[:2, :2].T, matrix[:2, 2]
    moved = [_moved(path, linear, shift) for path in paths]
    if not all(np.isfinite(path.start).all() and np.isfinite(path.cubics).all() for path in moved):
        raise ValueError("a coordinate is not a finite number")
    return moved


def _moved(path: Subpath, linear, shift) -> Subpath:
    """One path after a transform; what ended where it began still does, to the last bit."""
    start, cubics = path.start @ linear + shift, path.cubics @ linear + shift
    if len(cubics):
        back = (path.cubics[-1, 3] == path.start).all()
        cubics[0, 0] = start
        cubics[-1, 3] = start if back else cubics[-1, 3]
    return Subpath(start, cubics, path.closed)


def extent_of(paths: list[Subpath]) -> float:
    """The larger side of the bounding box of all control points."""
    points = np.concatenate([np.zeros((0, 2))] + [p.start[None] for p in paths] + [p.cubics.reshape(-1, 2) for p in paths])
    finite = points[np.isfinite(points).all(1)]
    return float(np.ptp(finite, axis=0).max()) if len(finite) else 0.0


def bounds(paths: list[Subpath]) -> Box:
    """The bounding box of what the paths draw; at the origin and empty for none."""
    if not paths:
        return 0.0, 0.0, 0.0, 0.0
    tolerance = 1e-3 * extent_of(paths)
    corners = np.concatenate([np.concatenate([p.start[None], flatten(p.cubics, tolerance)[0]]) for p in paths])
    low, high = corners.min(0), corners.max(0)
    return float(low[0]), float(low[1]), float(high[0] - low[0]), float(high[1] - low[1])
