"""Does any file break a reader? `python -m benchmarks.fuzz --minutes N [--reader R]... [--seed S] [--keep DIR]`

Mutants of drawings are read by `read_sketch`, written, read again, and made a graph: each must give a sound sketch, the same once written,
and a sound graph, or a SketchTreeError. Mutants of point clouds are read, prepared and traced: each must give sound points and a sound skeleton, or a SketchTreeError. Anything else (another exception, a warning of numpy, more than SLOW seconds or MEMORY) is
a failure: it is counted, kept in DIR, and the command ends with status 1.
"""

import argparse
import collections
import dataclasses
import resource
import signal
import sys
import tempfile
import time
import traceback
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from benchmarks import cloud_mutants, mutants
from benchmarks.cloud_mutants import CLOUDS
from benchmarks.mutants import READERS
from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.files.read_cloud import read_placed
from sketchtree.clouds.prepared.prepare import prepare
from sketchtree.clouds.standing.feet import feet
from sketchtree.clouds.standing.stems import breast_height
from sketchtree.clouds.standing.trunk import trunk
from sketchtree.clouds.tracing.traced import traced
from sketchtree.errors import SketchTreeError
from sketchtree.sketch.files.sketch_json import read_sketch_json, sketch_json
from sketchtree.sketch.files.svg import read_svg
from sketchtree.sketch.files.svg_writer import sketch_svg
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.strokes import Sketch, StrokeKind

SLOW = 20  # seconds that one file may take
MEMORY = 6 * 2**30  # bytes of address space
STROKES = 2_000  # at most in one file
POINTS = 3_000  # of a cloud that are kept


@dataclass
class Tally:
    """What became of the files of one reader."""

    tried: int = 0
    read: int = 0  # a sketch and a graph
    refused: int = 0  # by the reader
    no_tree: int = 0  # a sketch, but no graph
    failed: int = 0
    reasons: collections.Counter = field(default_factory=collections.Counter)
    slowest: float = 0.0  # seconds


def outcome(path: Path) -> str:
    """"read", or the reader's or the graph's refusal in brackets. Raises whatever else comes out."""
    try:
        sketch = read_sketch(path, max_strokes=STROKES, max_mb=20, max_megapixels=2)
    except SketchTreeError as error:
        return f"refused: {_kind(error)}"
    check_sketch(sketch)
    check_written(sketch)
    try:
        graph = sketch_graph(sketch)
    except SketchTreeError as error:
        return f"no tree: {_kind(error)}"
    check_graph(graph, sketch)
    return "read"


def outcome_of_cloud(path: Path) -> str:
    """The same of a point cloud: "read", or how its reader refused it, or why no tree stands in it."""
    try:
        placed = read_placed(path, max_points=POINTS)
    except SketchTreeError as error:
        return f"refused: {_kind(error)}"
    check_cloud(placed.cloud)
    assert len(placed.cloud) <= POINTS and all(len(remark) < 500 for remark in placed.remarks), "limits"
    try:
        found = prepare(placed, tree=1)
        stands = feet(found.cloud.xyz, found.above)
        [trunk(found.cloud.xyz[rows], breast_height(found.cloud.height)) for rows in stands.stems]
        tree = traced(found.cloud.xyz, stands.rows).skeleton
    except SketchTreeError as error:
        return f"no tree: {_kind(error)}"
    check_cloud(found.cloud)
    assert len(tree) > 1 and np.isfinite(tree.tip).all() and (tree.radius > 0).all(), "a skeleton"
    return "read"


def check_cloud(cloud: PointCloud) -> None:
    """A cloud that came out of a reader is sound."""
    assert len(cloud) and np.isfinite(cloud.xyz).all(), "points"
    assert cloud.colour is None or ((cloud.colour >= 0) & (cloud.colour <= 1)).all(), "colours"
    assert cloud.normal is None or np.allclose(np.linalg.norm(cloud.normal, axis=1), 1.0, atol=1e-6), "normals"


def check_sketch(sketch: Sketch) -> None:
    """A sketch that came out of a reader is sound."""
    ids = [stroke.id for stroke in sketch.strokes]
    assert len(set(ids)) == len(ids), "two strokes of one id"
    assert any(stroke.kind == StrokeKind.BRANCH for stroke in sketch.strokes), "no branch stroke"
    for stroke in sketch.strokes:
        assert np.isfinite(stroke.points).all() and len(stroke.points), "points"
        assert stroke.width is None or (np.isfinite(stroke.width) and stroke.width >= 0), f"width {stroke.width}"
        for column in (stroke.pressure, stroke.time):
            assert column is None or (np.shape(column) == (len(stroke.points),) and np.isfinite(column).all()), "pressure or time"
        stroke.id.encode("utf-8")
    assert all(isinstance(warning, str) and len(warning) < 500 for warning in sketch.warnings), "a long warning"
    assert len(sketch.warnings) < 30, "too many warnings"


def check_written(sketch: Sketch) -> None:
    """What is written as sketch JSON or SVG reads back as the same sketch."""
    for write, read in ((sketch_json, read_sketch_json), (sketch_svg, read_svg)):
        again = read(write(sketch).encode(), sketch.name)
        assert (again.units, again.view_deg, again.page) == (sketch.units, sketch.view_deg, sketch.page), f"{write.__name__}: the page"
        assert len(again) == len(sketch), f"{write.__name__}: {len(again)} strokes of {len(sketch)}"
        for old, new in zip(sketch.strokes, again.strokes, strict=True):
            for column in dataclasses.fields(old):
                a, b = getattr(old, column.name), getattr(new, column.name)
                assert (a is None) == (b is None) and (a is None or np.array_equal(a, b)), f"{write.__name__}: {column.name}"


def check_graph(graph: SketchGraph, sketch: Sketch) -> None:
    """A graph that came out of the reading is sound."""
    assert len(graph) and graph.segment_count, "an empty graph"
    assert np.isfinite(graph.xy).all() and np.isfinite(graph.curve_points).all(), "points"
    assert ((graph.stroke >= 0) & (graph.stroke < len(sketch))).all(), "rows of strokes"
    assert graph.height > 0, "no height"
    assert len(set(graph.limb_id.tolist())) == len(graph.limb_id), "two limbs of one id"


def _kind(error: SketchTreeError) -> str:
    """The message without what differs from file to file."""
    words = [word for word in error.message.split() if not any(c.isdigit() or c in "'\"<>&#{}[]\\" for c in word)]
    return " ".join(words)[:70]


def _alarm(*_):
    raise TimeoutError(f"more than {SLOW} seconds")


def run(readers: tuple[str, ...], minutes: float, seed: int, keep: Path | None) -> dict[str, Tally]:
    """Fuzz the readers in turn until the time is over."""
    tallies = {reader: Tally() for reader in readers}
    end, turn = time.monotonic() + 60 * minutes, 0
    signal.signal(signal.SIGALRM, _alarm)
    with tempfile.TemporaryDirectory() as folder:
        while time.monotonic() < end:
            reader = readers[turn % len(readers)]
            data = (cloud_mutants if reader in CLOUDS else mutants).mutant(reader, np.random.default_rng((seed, turn)))
            path = Path(folder) / f"mutant.{'png' if reader == 'picture' else reader}"
            path.write_bytes(data)
            _one(path, outcome_of_cloud if reader in CLOUDS else outcome, tallies[reader], keep and keep / f"{reader}-{seed}-{turn}{path.suffix}")
            turn += 1
    return tallies


def _one(path: Path, outcome: Callable[[Path], str], tally: Tally, kept: Path | None) -> None:
    began = time.perf_counter()
    signal.alarm(SLOW)
    try:
        found = outcome(path)
    except Exception as error:  # noqa: BLE001  (anything at all is what is looked for)
        where = traceback.extract_tb(error.__traceback__)[-1]
        found = f"failed: {type(error).__name__} in {Path(where.filename).name}:{where.lineno} ({str(error)[:80]})"
        if kept is not None:
            kept.parent.mkdir(parents=True, exist_ok=True)
            kept.write_bytes(path.read_bytes())
    finally:
        signal.alarm(0)
    tally.tried += 1
    tally.slowest = max(tally.slowest, time.perf_counter() - began)
    way = found.partition(":")[0].replace(" ", "_")
    setattr(tally, way, getattr(tally, way) + 1)
    tally.reasons[found] += 1


def main() -> int:
    """Run and print the counts."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--minutes", type=float, default=1.0)
    parser.add_argument("--reader", action="append", choices=(*READERS, *CLOUDS))
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--keep", type=Path, help="folder for the files that failed")
    parser.add_argument("--reasons", type=int, default=0, help="print the N most frequent refusals of each reader")
    options = parser.parse_args()
    warnings.simplefilter("error")
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    tallies = run(tuple(options.reader or (*READERS, *CLOUDS)), options.minutes, options.seed, options.keep)
    print(f"{'reader':<12}{'tried':>8}{'read':>8}{'refused':>9}{'no tree':>9}{'failed':>8}{'slowest':>10}")
    for reader, tally in tallies.items():
        print(f"{reader:<12}{tally.tried:>8}{tally.read:>8}{tally.refused:>9}{tally.no_tree:>9}{tally.failed:>8}{tally.slowest:>9.2f}s")
    for reader, tally in tallies.items():
        lines = [(found, count) for found, count in tally.reasons.most_common() if found.startswith("failed")]
        lines += [line for line in tally.reasons.most_common(options.reasons) if line not in lines and line[0] != "read"]
        for found, count in lines:
            print(f"{reader:<12}{count:>8}  {found}")
    return int(any(tally.failed for tally in tallies.values()))


if __name__ == "__main__":
    sys.exit(main())
