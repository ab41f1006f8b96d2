"""How fast is a search of 100,000 exemplars, and in how much memory? And of the shipped ones?

    python -m benchmarks.match_speed                         100,000 exemplars, 36 views each
    python -m benchmarks.match_speed --count 20000 --folder /var/tmp
    python -m benchmarks.match_speed --gzip                  the file packed as `templates build` packs it

The large database is the shipped views over and over with noise, written slab by slab to a temporary file (1.3 GB unpacked), which is deleted
at the end. Each database is measured in a fresh process: loading (every checksum compared), the first search, and later ones.
"""

import argparse
import json
import resource
import subprocess
import sys
import tempfile
import time
from itertools import chain
from pathlib import Path

import h5py
import numpy as np

from sketchtree.templates.store.columns import COLUMNS, SCHEMA
from sketchtree.templates.store.database import FORMAT, Database
from sketchtree.templates.store.digest import Digest, root_digest
from sketchtree.templates.matching.match import match

SLAB = 1000  # exemplars written at a time
NOISE = 0.02
SHIPPED_BARS = {"load": 0.050, "warm": 0.005}  # seconds
LARGE_BARS = {"warm": 0.5, "rss": 2.0}  # seconds, GB


def write_large(path: Path, count: int, *, gzip: bool = False, seed: int = 1) -> None:
    """A database of `count` exemplars, never held in memory."""
    source, digests = Database.open(), {}
    packed = {"compression": "gzip", "compression_opts": 6, "shuffle": True, "fletcher32": True} if gzip else {}
    with h5py.File(path, "w", libver=("v110", "v110")) as file:
        for name, (kind, unit, meaning) in COLUMNS.items():
            slabs = _slabs(name, source, count, np.random.default_rng(seed))
            first = next(slabs)
            rows = {"skeleton/start": count + 1, "views/azimuth": len(first)}.get(name, count * (2 if name.startswith("skeleton/") else 1))
            shape = (rows, *first.shape[1:])
            chunks = {"chunks": (max(1, min(rows, 2**18 // max(1, first[:1].nbytes))), *shape[1:])} if packed else {}
            dataset, digest, row = file.create_dataset(name, shape, first.dtype, **chunks, **packed), Digest(name, first.dtype, schema=SCHEMA), 0
            for slab in chain((first,), slabs):
                dataset[row : row + len(slab)] = slab
                digest.update(slab)
                row += len(slab)
            digests[name] = digest.result(shape)
            dataset.attrs["unit"], dataset.attrs["meaning"], dataset.attrs["sha256"] = unit, meaning, digests[name]
        file.attrs["format"], file.attrs["schema"], file.attrs["sha256"] = FORMAT, SCHEMA, root_digest(digests)


def _slabs(name: str, source: Database, count: int, rng):
    """A column, slab by slab: views with noise, names of their own, a stick for a skeleton, the rest of the first exemplar."""
    whole = source.column(name)
    if name == "views/azimuth":
        yield whole
        return
    if name == "skeleton/start":
        yield 2 * np.arange(count + 1, dtype=whole.dtype)
        return
    stick = {"parent": [-1, 0], "tip": [[0, 0, 0], [0, 1, 0]], "radius": [0.1, 0.1], "order": [0, 0], "limb": [0, 0]}
    for first in range(0, count, SLAB):
        place = np.arange(first, min(first + SLAB, count))
        if name == "exemplar/name":
            yield np.array([f"exemplar_{i:08d}".encode() for i in place])
        elif name.startswith("skeleton/"):
            one = np.array(stick[name.partition("/")[2]], whole.dtype)
            yield np.tile(one, (len(place), *[1] * (one.ndim - 1)))
        elif name == "exemplar/thumbnail":
            yield np.full((len(place), 1, 1), 255, whole.dtype)
        elif name.startswith("views/"):
            values = whole[place % len(whole)]
            values += (NOISE * rng.standard_normal(values.shape, dtype=np.float32)).astype(values.dtype)
            yield np.abs(values) if name in ("views/branching_sd", "views/branching_count") else values
        else:
            yield np.repeat(whole[:1], len(place), axis=0)


def measure(path: str | None) -> dict[str, float]:
    """Seconds and GB, in this process, of the database at `path`; None: the one in use."""
    from benchmarks.tree_sketch import Pencil, sketch_of

    graph = sketch_of(Database.open().exemplar("english_oak").skeleton, Pencil(azimuth=33.0), np.random.default_rng(1))
    begin = time.perf_counter()
    db = Database.open(path)
    _ = db.views, db.azimuths
    took = {"exemplars": len(db), "load": time.perf_counter() - begin}
    for name, seen, score in (("", graph, "calibrated"), (" bare", graph.replace(crown=()), "calibrated"), (" chen", graph, "chen")):
        times = []
        for _ in range(8):
            begin = time.perf_counter()
            match(seen, db, score=score, count=20)
            times.append(time.perf_counter() - begin)
        took |= {f"first{name}": times[0], f"warm{name}": float(np.median(times[1:])), f"best{name}": min(times)}
    took["rss"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e9
    return took


def in_fresh_process(path: str | None) -> dict[str, float]:
    """`measure` of a process that has done nothing else."""
    command = [sys.executable, "-m", "benchmarks.match_speed", "--measure", path or ""]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def print_table(took: dict[str, float], bars: dict[str, float]) -> None:
    """One line a figure, beside its bar."""
    print(f"{took['exemplars']:,} exemplars × 36 views")
    for name, value in took.items():
        if name == "exemplars":
            continue
        shown = f"{value:.2f} GB" if name == "rss" else f"{1000 * value:.1f} ms"
        bar = bars.get("warm" if name.startswith("warm") else name)
        unit = "GB" if name == "rss" else "s"
        print(f"  {name:12}{shown:>12}" + (f"   at most {bar} {unit}: {'met' if value <= bar else 'missed'}" if bar is not None else ""))


def main(arguments: list[str] | None = None) -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.match_speed", description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=100_000, help="exemplars of the large database (default 100000)")
    parser.add_argument("--folder", type=Path, help="where the temporary file is written")
    parser.add_argument("--gzip", action="store_true", help="pack the large database")
    parser.add_argument("--measure", metavar="FILE", help=argparse.SUPPRESS)
    wanted = parser.parse_args(arguments)
    if wanted.measure is not None:
        print(json.dumps(measure(wanted.measure or None)))
        return
    print_table(in_fresh_process(None), SHIPPED_BARS)
    with tempfile.TemporaryDirectory(dir=wanted.folder) as folder:
        path = Path(folder) / "large.h5"
        begin = time.perf_counter()
        write_large(path, wanted.count, gzip=wanted.gzip)
        print(f"written in {time.perf_counter() - begin:.0f} s, {path.stat().st_size / 1e9:.2f} GB{', packed' if wanted.gzip else ''}")
        print_table(in_fresh_process(str(path)), LARGE_BARS)


if __name__ == "__main__":
    main()
