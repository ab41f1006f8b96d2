"""How long does a picture take to read, and how much memory? A grown drawing, photographed, at several sizes.

    python -m benchmarks.raster_speed [--megapixels M ...] [--strokes N] [--medium NAME] [--pen PIXELS]

Processor seconds for the strokes and for the graph, and the largest memory of the process, which only ever grows: larger pictures come later.
"""

import argparse
import resource
import sys
import time

import numpy as np

from benchmarks.pictures import MEDIA, drawn, on_medium
from benchmarks.reading_speed import drawing
from sketchtree.sketch.files.svg import read_svg
from sketchtree.sketch.raster.reader import read_raster
from sketchtree.sketch.reading import sketch_graph


def picture(megapixels: float, strokes: int, medium: str, pen: float) -> bytes:
    """The file of a picture of a grown drawing."""
    sketch = read_svg(drawing(strokes), "drawing.svg")
    size = int(np.sqrt(megapixels * 1e6 / _aspect(sketch)))
    return on_medium(drawn(sketch, size, pen)[0], next(m for m in MEDIA if m.name == medium))


def _aspect(sketch) -> float:
    width, height = np.ptp(np.concatenate([s.points for s in sketch.strokes]), axis=0)
    return float(min(width, height) / max(width, height))


def measure(data: bytes, name: str) -> tuple[float, float, int, int]:
    """(seconds for the strokes, seconds for the graph, strokes, limbs)."""
    times = [time.process_time()]
    sketch = read_raster(data, name)
    times.append(time.process_time())
    graph = sketch_graph(sketch)
    times.append(time.process_time())
    return times[1] - times[0], times[2] - times[1], len(sketch), len(graph.limb_id)


def _memory() -> float:
    """Largest memory of this process so far, MiB."""
    used = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return used / (2**20 if sys.platform == "darwin" else 2**10)


def main() -> None:
    """Print one line a picture."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--megapixels", type=float, nargs="+", default=[1.0, 4.0, 12.0])
    parser.add_argument("--strokes", type=int, default=200)
    parser.add_argument("--medium", default="phone", choices=[medium.name for medium in MEDIA])
    parser.add_argument("--pen", type=float, default=None, help="width of the lines, pixels (default: 0.2 %% of the picture's height)")
    given = parser.parse_args()
    measure(picture(0.3, 20, given.medium, 3.0), "first")
    print(f"{'Mpx':>6} {'pen px':>7} {'strokes':>8} {'limbs':>7} {'picture s':>10} {'graph s':>8} {'MiB':>7}")
    for megapixels in given.megapixels:
        pen = given.pen or max(1.5, 2e-3 * np.sqrt(megapixels * 1e6))
        data = picture(megapixels, given.strokes, given.medium, pen)
        seconds, graph, strokes, limbs = measure(data, "drawing")
        print(f"{megapixels:6.1f} {pen:7.1f} {strokes:8d} {limbs:7d} {seconds:10.2f} {graph:8.2f} {_memory():7.0f}")


if __name__ == "__main__":
    main()
