"""How much of a file is kept, and can it be opened at all?

    points kept ≤ max_points        a header ≤ HEADER bytes        what an archive unpacks to ≤ UNPACKED bytes

A file may hold any number of points: those over the limit are thinned while they are read (`gathering`), and that is said.
"""

from pathlib import Path
from typing import BinaryIO

from sketchtree.errors import OptionError, SketchError

MAX_POINTS = 2_000_000
HEADER = 1_000_000
UNPACKED = 4_000_000_000
LEAST = 1_000  # a limit below this would leave nothing of a tree


def check_limit(max_points: int) -> None:
    """Raise OptionError for a limit that would leave no tree."""
    if max_points < LEAST:
        raise OptionError(f"`max_points` is {max_points}.", remedy=f"Keep {LEAST} points or more.")


def opened(path: Path) -> BinaryIO:
    """The file. Raises SketchError for a folder and for what can't be read."""
    try:
        if path.is_dir():
            raise SketchError(f"{path} is a folder, not a point cloud.", remedy="Give the cloud inside it; a folder of photos is for `sketchtree views`.")
        return path.open("rb")
    except (FileNotFoundError, NotADirectoryError):
        raise SketchError(f"There is no file {path}.", remedy="Check the path.") from None
    except (OSError, ValueError) as error:
        raise SketchError(f"{path} can't be read ({getattr(error, 'strerror', None) or error}).", remedy="Check the file's name and its permissions.") from None
