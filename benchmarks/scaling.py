"""How does inference grow with the drawing? `python -m benchmarks.scaling [--plot P.png] [--json OUT] [--segments N ...]`

For drawings of our own families with about N segments, the default method, no template:

    bucket      segments, limbs that the columns are padded to
    cold        seconds to compile the bucket's program, nothing kept from before
    disk        seconds until it is ready in a new process that finds it in the cache folder
    first       seconds warm until the first answer (`refine`), and until the first of the model itself
    warm        seconds of the whole inference, compiled already; median
    redraw      seconds from the last answer as the start, as after one more stroke
    peak        resident memory of the process, MB

Each size runs in processes of its own, so that nothing is warm by accident.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SIZES = (12, 25, 50, 100, 200, 500)
BARS = {50: "≤ .3 (aim .06)", 500: "≤ 3 (aim .6)"}


def one(segments: int, repeats: int) -> dict[str, float]:
    """All figures of one size, in this process; the cache folder is whatever the environment says."""
    import numpy as np

    from benchmarks.speed_case import tree_of_segments
    from sketchtree import Prior, factor_graph, infer, refine, root_key
    from sketchtree.mrf.elevation import Elevation
    from sketchtree.mrf.padding import bucket

    graph = factor_graph(tree_of_segments(segments))
    began = time.perf_counter()
    Elevation().compile(graph, Prior())
    ready = time.perf_counter() - began
    infer(graph, Prior(), Elevation(), key=root_key(99), throw=False)  # small programs, caches of the processor
    warm, first, model, redraw = [], [], [], []
    for seed in range(repeats):
        began = time.perf_counter()
        for fit in refine(graph, Prior(), Elevation(), key=root_key(seed)):
            (model if fit.steps else first).append(time.perf_counter() - began)
            if fit.steps:
                break
        fit = infer(graph, Prior(), Elevation(), key=root_key(seed), throw=False)
        warm.append(fit.seconds_warm)
        again = infer(graph, Prior(), Elevation(start=fit.depth), key=root_key(seed), throw=False)
        redraw.append(again.seconds_warm)
    figures = {"segments": float(np.sum(~graph.is_base)), "bucket": float(bucket(graph)[0]), "limbs": float(bucket(graph)[1]), "ready": ready}
    medians = {name: float(np.median(x)) for name, x in (("first", first), ("model", model), ("warm", warm), ("redraw", redraw))}
    return figures | medians | {"peak": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024}


def measure(segments: int, repeats: int) -> dict[str, float]:
    """One size: compiled cold, then found on disk by a second process."""
    with tempfile.TemporaryDirectory() as folder:
        environment = os.environ | {"JAX_COMPILATION_CACHE_DIR": folder, "JAX_PERSISTENT_CACHE_MIN_COMPILE_TIME_SECS": "0"}
        runs = []
        for count in (1, repeats):
            command = [sys.executable, "-m", "benchmarks.scaling", "--one", str(segments), "--repeats", str(count)]
            done = subprocess.run(command, env=environment, check=True, capture_output=True, text=True)
            runs.append(json.loads(done.stdout.splitlines()[-1]))
    cold, disk = runs
    return disk | {"cold": cold["ready"], "disk": disk["ready"]}


def plot(rows: list[dict[str, float]], path: Path) -> None:
    """The growth curve."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(7, 4.2), layout="constrained")
    x = [row["segments"] for row in rows]
    for name, label in (("warm", "whole inference"), ("redraw", "after one more stroke"), ("model", "first of the model"), ("first", "first answer")):
        axes.loglog(x, [row[name] for row in rows], "o-", label=label)
    axes.plot([50, 500], [0.3, 3.0], "k_", markersize=18, label="bars at 50 and 500")
    axes.set(xlabel="drawn segments", ylabel="seconds, warm, 2 cores")
    axes.grid(alpha=0.3, which="both")
    axes.legend()
    figure.savefig(path, dpi=110)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--segments", type=int, nargs="+", default=list(SIZES))
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--plot", type=Path)
    parser.add_argument("--json", type=Path)
    parser.add_argument("--one", type=int, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.one:
        print(json.dumps(one(arguments.one, arguments.repeats)))
        return
    print(f"{'segments':>9s}{'bucket':>12s}{'cold':>8s}{'disk':>8s}{'first':>8s}{'model':>8s}{'warm':>8s}{'redraw':>8s}{'peak MB':>9s}")
    rows = []
    for segments in arguments.segments:
        row = measure(segments, arguments.repeats)
        rows.append(row)
        size = f"{row['bucket']:.0f}, {row['limbs']:.0f}"
        figures = "".join(f"{row[name]:8.3f}" for name in ("cold", "disk", "first", "model", "warm", "redraw"))
        print(f"{row['segments']:9.0f}{size:>12s}{figures}{row['peak']:9.0f}   {BARS.get(segments, '')}", flush=True)
    if arguments.plot:
        plot(rows, arguments.plot)
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=1) + "\n")


if __name__ == "__main__":
    main()
