"""How long does a picture take to read, and how much memory? Grown drawings as scans, photographs and pages of one bit.

    python -m benchmarks.raster_speed [--megapixels M] [--only CASE ...]

Every picture is read from its file in a process of its own: the processor's seconds for the strokes (decoding and tracing) and for
the graph, seconds by the clock, which other work on the machine lengthens, and the largest memory of the process. 12 megapixels must
take less than 10 s in all.
"""

import argparse
import multiprocessing
import resource
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from benchmarks.pictures import MEDIA, drawn, on_medium
from benchmarks.reading_speed import drawing
from sketchtree.sketch.files.svg import read_svg
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.reading import sketch_graph


@dataclass(frozen=True)
class Case:
    """One picture."""

    name: str
    strokes: int
    medium: str
    suffix: str
    pen: float = 2e-3  # width of its lines, of the picture's height


CASES = (
    Case("sparse scan", 50, "scan", ".jpg"),
    Case("dense scan", 1500, "scan", ".jpg", 1e-3),
    Case("phone", 200, "phone", ".jpg"),
    Case("pencil", 200, "pencil", ".jpg"),
    Case("1-bit TIFF", 200, "screen", ".tif"),
    Case("brush, alpha", 200, "brush", ".png"),
)


def write(case: Case, megapixels: float, folder: Path) -> Path:
    """Write the picture of a grown drawing."""
    sketch = read_svg(drawing(case.strokes), "drawing.svg")
    width, height = np.ptp(np.concatenate([s.points for s in sketch.strokes]), axis=0)
    size = int(np.sqrt(megapixels * 1e6 * max(width, height) / min(width, height)))
    data = on_medium(drawn(sketch, size, max(1.5, case.pen * size))[0], next(m for m in MEDIA if m.name == case.medium))
    path = folder / f"drawing{case.suffix}"
    path.write_bytes(data)
    if case.suffix == ".tif":
        Image.open(path).convert("L").point(lambda tone: 255 * (tone > 128)).convert("1").save(path, "TIFF", compression="group4")
    return path


def measure(path: Path) -> tuple[float, float, float, int, int, float]:
    """(seconds for the strokes, for the graph, for both by the clock, strokes, limbs, largest memory of this process in MiB)."""
    began, times = time.perf_counter(), [time.process_time()]
    sketch = read_sketch(path)
    times.append(time.process_time())
    graph = sketch_graph(sketch)
    times.append(time.process_time())
    used = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (2**20 if sys.platform == "darwin" else 2**10)
    return times[1] - times[0], times[2] - times[1], time.perf_counter() - began, len(sketch), len(graph.limb_id), used


def main() -> None:
    """Print one line a picture."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--megapixels", type=float, default=12.0)
    parser.add_argument("--only", nargs="+", default=[case.name for case in CASES], metavar="CASE")
    given = parser.parse_args()
    print(f"{'picture':>13} {'Mpx':>5} {'MB':>6} {'strokes':>11} {'limbs':>6} {'picture s':>10} {'graph s':>8} {'clock s':>8} {'MiB':>6}")
    with tempfile.TemporaryDirectory() as folder:
        for case in (case for case in CASES if case.name in given.only):
            path = write(case, given.megapixels, Path(folder))
            with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as one:
                seconds, graph, clock, strokes, limbs, used = one.submit(measure, path).result()
            size = np.prod(Image.open(path).size) / 1e6
            print(
                f"{case.name:>13} {size:5.1f} {path.stat().st_size / 1e6:6.2f} {case.strokes:5d}/{strokes:5d} {limbs:6d} "
                f"{seconds:10.2f} {graph:8.2f} {clock:8.2f} {used:6.0f}",
                flush=True,
            )


if __name__ == "__main__":
    main()
