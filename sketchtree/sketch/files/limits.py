"""How large a file may be? Every reader's bounds on bytes and strokes, each with the option that lifts it.

    packed or unpacked bytes ≤ max_mb · 10⁶        strokes ≤ max_strokes        points ≤ MAX_POINTS

The last has no option: elements name one another, and a small file could show a large one without end.
"""

import gzip
import io
import zlib
from pathlib import Path

from sketchtree.errors import SketchError

MAX_STROKES = 20_000
MAX_MB = 100.0  # 10⁶ bytes, after unpacking
MAX_MEGAPIXELS = 200.0  # 10⁶ pixels of a picture
MAX_POINTS = 5_000_000  # of all strokes together
MAX_OUTLINE = 20_000_000  # characters of one shape's path data, list of points or trace


def read_bytes(path: Path, *, max_mb: float = MAX_MB) -> bytes:
    """The bytes of a file. Raises SketchError for a folder, for what can't be read, and for more than `max_mb`."""
    try:
        if path.is_dir():
            raise SketchError(f"{path} is a folder, not a drawing.", remedy="Give the drawing inside it.")
        with path.open("rb") as file:
            data = file.read(int(max_mb * 1e6) + 1)
            size = max(path.stat().st_size, len(data))
    except (FileNotFoundError, NotADirectoryError):
        raise SketchError(f"There is no file {path}.", remedy="Check the path.") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise SketchError(f"{path} can't be read ({reason}).", remedy="Check the file's name and its permissions.") from None
    if len(data) > max_mb * 1e6:
        raise too_large(path.name, f"holds {size / 1e6:.3g} MB", max_mb)
    return data


def inflate(data: bytes, name: str, *, max_mb: float = MAX_MB) -> bytes:
    """The bytes of a file, unpacked if they are gzipped (`.svgz`), and no more than we are willing to hold."""
    if data[:2] != b"\x1f\x8b":
        return data
    try:
        with gzip.open(io.BytesIO(data)) as packed:
            data = packed.read(int(max_mb * 1e6) + 1)
    except (OSError, EOFError, zlib.error) as error:
        raise SketchError(f"{name} is a damaged gzip file ({error}).", remedy="Export the drawing again.") from None
    if len(data) > max_mb * 1e6:
        raise too_large(name, f"unpacks to more than {max_mb:g} MB", max_mb)
    return data


def too_large(name: str, says: str, max_mb: float) -> SketchError:
    """The error for a file over the limit; `says` is its verb and size."""
    return SketchError(
        f"{name} {says}; the limit is {max_mb:g} MB.",
        remedy="Simplify the drawing, split it into several files, or raise the limit with --max-mb.",
    )


def check_strokes(count: int, name: str, max_strokes: int) -> None:
    """Raise SketchError when a file holds more strokes than `max_strokes`."""
    if count > max_strokes:
        raise SketchError(
            f"{name} holds {count} strokes, more than {max_strokes}.",
            remedy="Draw fewer strokes, or raise the limit with --max-strokes.",
        )


def check_points(count: int, name: str) -> None:
    """Raise SketchError when the strokes of a file have more than MAX_POINTS points together."""
    if count > MAX_POINTS:
        raise SketchError(
            f"{name} draws more than {MAX_POINTS // 10**6} million points.",
            remedy="Simplify its lines, unlink its clones, or split it into several files.",
        )


def check_number(number: int, count: int, name: str) -> int:
    """`number`, if a file of `count` drawings has one of it (they count from 1). Raises SketchError."""
    if not 1 <= number <= count:
        raise SketchError(f"{name} has no drawing #{number}; it holds {count}.", remedy=f"Say #1 to #{count}." if count else "Give another file.")
    return number
