"""What does a project file keep beside the strokes? What was done by hand, and what the depths have come to.

    edits      JSON, as `editing.kept` writes it
    settled    JSON, likewise; projects of the first versions have none, and nothing by hand either
    cloud      points behind the drawing, as `editing.laid_cloud` has them; attributes coloured, x, y, unit, trunk, and remarks as JSON
"""

import json
from pathlib import Path

import numpy as np

from sketchtree.editing import kept
from sketchtree.editing.edits import Edits
from sketchtree.editing.laid_cloud import LaidCloud
from sketchtree.editing.settled import Settled
from sketchtree.errors import SketchError, SketchTreeError
from sketchtree.sketch.files.project import column, holds_cloud

_SIGNATURE = b"\x89HDF\r\n\x1a\n"


def hand_work(path: str | Path) -> tuple[Edits, Settled] | None:
    """(the edits, what is settled) of a project; None for any other file. Raises SketchError where they are damaged."""
    try:
        with open(path, "rb") as file:
            if file.read(8) != _SIGNATURE:
                return None
    except OSError:
        return None  # whoever reads the strokes says so
    import h5py

    try:
        with h5py.File(path, "r") as file:
            if "edits" not in file:
                return None
            edits = json.loads(column(file, "edits").tobytes())
            settled = json.loads(column(file, "settled").tobytes()) if "settled" in file else {}
        return kept.reading(kept.edits_from_json, edits), kept.reading(kept.settled_from_json, settled)
    except (OSError, RuntimeError, ValueError, RecursionError, AttributeError, KeyError, TypeError) as error:
        raise SketchError(
            f"What was done by hand in {Path(path).name} can't be read ({error}).", remedy="Open an older copy, or save its drawing as JSON and begin from that."
        ) from error


def laid_cloud(path: str | Path) -> LaidCloud | None:
    """The points behind the drawing of a project; None for any other file. Raises SketchError where they are damaged."""
    if not holds_cloud(path):
        return None
    import h5py

    try:
        with h5py.File(path, "r") as file:
            said = file["cloud"].attrs
            place = (float(said[name]) for name in ("x", "y", "unit", "trunk"))
            return LaidCloud(column(file, "cloud").astype(np.uint8).tobytes(), bool(said["coloured"]), *place, tuple(map(str, json.loads(said["remarks"]))))
    except (SketchTreeError, OSError, RuntimeError, ValueError, RecursionError, AttributeError, KeyError, TypeError) as error:
        raise SketchError(f"The points behind the drawing of {Path(path).name} can't be read ({error}).", remedy="Open an older copy of it.") from error
