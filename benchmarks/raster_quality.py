"""How well is a picture of a drawing read? Drawings as files, drawn as pictures in several media, against themselves.

    python -m benchmarks.raster_quality [DRAWING.svg ...] [--size PIXELS] [--pen PIXELS] [--media NAME ...]

One line a medium, means over the drawings:

    found   share of the drawn strokes' length within 1 % H of a stroke that was read
    extra   share of the length of those farther than that from any that was drawn
    whole   share of the drawn length that the one best stroke read for each drawn one covers: limbs in one piece
    pure    share of the read length that lies along the one drawn stroke it fits best: limbs not mixed up
    ways    share of the limbs whose way to the ground passes their junction and goes on along their parent
"""

import argparse
import time
from pathlib import Path

import numpy as np

from benchmarks.pictures import MEDIA, Likeness, Medium, drawn, likeness, on_medium
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.raster.reader import read_raster
from sketchtree.sketch.reading import sketch_graph

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


def compare(path: Path, medium: Medium, size: int, pen: float, *, taper: bool = False) -> Likeness:
    """Read a drawing from its file and from a picture of it."""
    sketch = read_sketch(path)
    cover, scale, corner = drawn(sketch, size, pen, taper=taper)
    read = read_raster(on_medium(cover, medium), f"{path.stem}.{medium.name}")
    return likeness((sketch, read), (sketch_graph(sketch), sketch_graph(read)), scale, corner)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("drawings", type=Path, nargs="*", default=sorted(EXAMPLES.glob("*.svg")))
    parser.add_argument("--size", type=int, default=1600, help="height or width of the pictures, pixels")
    parser.add_argument("--pen", type=float, default=5.0, help="width of the lines, pixels")
    parser.add_argument("--media", nargs="+", default=[medium.name for medium in MEDIA])
    parser.add_argument("--each", action="store_true", help="a line for every drawing")
    given = parser.parse_args()
    print(f"{'medium':>8} {'found':>7} {'extra':>7} {'whole':>7} {'pure':>7} {'ways':>7} {'limbs':>11} {'crowns':>8} {'s':>6}")
    for medium in (m for m in MEDIA if m.name in given.media):
        start = time.process_time()
        rows = [compare(path, medium, given.size, given.pen) for path in given.drawings]
        if given.each:
            for path, row in zip(given.drawings, rows, strict=True):
                print(_line(path.stem[:8], [row], 0.0))
        print(_line(medium.name, rows, (time.process_time() - start) / len(rows)))


def _line(name: str, rows: list[Likeness], seconds: float) -> str:
    found, extra, whole, pure, ways = (100 * np.mean([getattr(row, key) for row in rows]) for key in ("found", "extra", "whole", "pure", "ways"))
    limbs, crowns = (np.sum([getattr(row, key) for row in rows], axis=0) for key in ("limbs", "crowns"))
    return f"{name:>8} {found:6.1f}% {extra:6.1f}% {whole:6.1f}% {pure:6.1f}% {ways:6.1f}% {limbs[0]:5d}/{limbs[1]:5d} {crowns[0]:3d}/{crowns[1]:3d} {seconds:7.2f}"


if __name__ == "__main__":
    main()
