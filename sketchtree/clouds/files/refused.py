"""What is said of a file that is no cloud, or ends too early? Remedies and errors that several readers share."""

from sketchtree.errors import SketchError

AGAIN = "Export the cloud again."
CUT_OFF = "Copy or export it again."
CONVERT = "Convert it to LAZ or PLY (CloudCompare and PDAL do)."
GIVE = "Give PLY, LAS, LAZ, XYZ or NPZ."


def truncated(name: str, there: int, said: int) -> SketchError:
    """The error for a file that ends before its last point."""
    return SketchError(f"{name} ends after {there:,} of its {said:,} points.", remedy="The file was cut off: copy or export it again.")


def no_points(name: str) -> SketchError:
    """The error for a file without a point."""
    return SketchError(f"{name} holds no points.", remedy="Export the cloud again, with its points.")
