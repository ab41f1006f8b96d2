"""How long does the main job take, and how much memory? `python -m benchmarks.speed [--json OUT]`

Every figure is the median of several runs in one go, on the machine named in the first line:

    build cold      `sketchtree build` of the 50-stroke example from a cold shell, compilation cached
    build first     the same with an empty compilation cache (the very first run on a machine)
    infer warm      inference alone, compilation left out, at 50 and about 500 drawn segments
    peak            peak resident memory of the cold build
"""

import argparse
import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SKETCH = ROOT / "examples" / "oak_50.svg"
BARS = {"build cold (s)": 8.0, "build first (s)": 20.0, "infer warm, 50 segments (s)": 0.6, "peak (MB)": 1500.0}


def build_once(folder: Path, environment: dict[str, str]) -> tuple[float, dict]:
    """Seconds of one whole process, and its report."""
    report = folder / "report.json"
    command = [sys.executable, "-m", "sketchtree", "build", str(SKETCH), "-o", str(folder / "tree.glb")]
    began = time.perf_counter()
    subprocess.run([*command, "--report", str(report), "--quiet"], check=True, env=environment)
    return time.perf_counter() - began, json.loads(report.read_text())


def infer_warm(segments: int, repeats: int) -> tuple[int, float]:
    """Drawn segments and the median seconds of inference without compilation."""
    from benchmarks.speed_case import tree_of_segments
    from sketchtree import Prior, factor_graph, infer, root_key, solver_named

    graph = tree_of_segments(segments)
    seconds = []
    for seed in range(repeats + 1):
        fit = infer(factor_graph(graph), Prior(), solver_named("elevation"), key=root_key(seed), throw=False)
        seconds.append(fit.seconds_warm)
    return graph.segment_count, statistics.median(seconds[1:])


def measure(repeats: int) -> dict[str, float]:
    """Every figure of the table."""
    figures: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        environment = os.environ | {
            "JAX_COMPILATION_CACHE_DIR": str(folder / "cache"),
            "JAX_PERSISTENT_CACHE_MIN_COMPILE_TIME_SECS": "0",
            "JAX_PERSISTENT_CACHE_MIN_ENTRY_SIZE_BYTES": "0",
        }
        figures["build first (s)"], _ = build_once(folder, environment)
        runs = [build_once(folder, environment) for _ in range(repeats)]
    figures["build cold (s)"] = statistics.median(seconds for seconds, _ in runs)
    figures["peak (MB)"] = statistics.median(report["peak_mb"] for _, report in runs)
    for stage in runs[0][1]["seconds"]:
        figures[f"  of which {stage} (s)"] = statistics.median(report["seconds"][stage] for _, report in runs)
    for wanted in (50, 500):
        segments, seconds = infer_warm(wanted, repeats)
        figures[f"infer warm, {wanted} segments (s)"] = seconds
        figures[f"  segments of that case, {wanted}"] = segments
    return figures


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    print(f"{platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}")
    figures = measure(arguments.repeats)
    for name, value in figures.items():
        bar = f"   bar {BARS[name]:g}" if name in BARS else ""
        print(f"{name:36s}{value:10.3f}{bar}")
    if arguments.json:
        arguments.json.write_text(json.dumps(figures, indent=1) + "\n")


if __name__ == "__main__":
    main()
