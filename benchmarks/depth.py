"""How deep, how right, how fast? Every method on trees whose depth is known, in one table.

    python -m benchmarks.depth                                  synthetic and measured trees of our own
    python -m benchmarks.depth --set synthetic --methods okabe elevation
    python -m benchmarks.depth --set quality --record           the fixed set; its medians become the tests' record
    python -m benchmarks.depth --cases DIR                      CASE.json + CASE.svg pairs: from the exact
                                                                graph, and through the reader
Medians over cases, elev of every case, and how often a method's elev is below `okabe`'s in the same run. No template is
given: the prior is the generic one. `s` is the time of one warm solution.
"""

import argparse
import json
import sys
from pathlib import Path

import numpy as np

from benchmarks import cases as case_sets
from benchmarks import metrics
from benchmarks.drawing import Case
from benchmarks.reading import matched_depth, read_graph
from sketchtree.keys import root_key
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.infer import infer
from sketchtree.mrf.methods import METHODS, solver_named
from sketchtree.mrf.prior import Prior
from sketchtree.sketch.graph import SketchGraph

ORDER = ("flat", "random-sign", "okabe", "chen-fixed", "chen", "elevation")
RIVAL = "okabe"
SEEDS = (0, 1, 2)
DRAWING = ("random-sign", "elevation")  # methods whose answer depends on the seed
RECORD = case_sets.DATA / "depth_record.json"
Scores = dict[str, dict[str, float]]  # case → figure → value


def solve(graph: SketchGraph, method: str, *, seed: int = 0):
    """The `Fit` of one method with the generic prior; a run that stops early counts as it stands."""
    return infer(factor_graph(graph), Prior(), solver_named(method), key=root_key(seed), throw=False)


def score(case: Case, method: str, *, graph: SketchGraph | None = None, seed: int = 0) -> dict[str, float]:
    """Figures of one method on one case: from its exact graph, or from `graph` as it was read."""
    fit = solve(case.graph if graph is None else graph, method, seed=seed)
    depth, seen = (fit.depth, 1.0) if graph is None else matched_depth(case, graph, fit.depth)
    return metrics.evaluate(case, depth) | {"matched": seen, "s": fit.seconds_warm, "steps": float(fit.steps)}


def compare(cases: list[Case], methods: list[str], *, read: bool = False, seed: int = 0) -> dict[str, Scores]:
    """method → case → figures. A method whose module is not installed is left out."""
    graphs = {case.name: read_graph(case) if read else None for case in cases}
    result = {}
    for method in methods:
        try:
            result[method] = {c.name: score(c, method, graph=graphs[c.name], seed=seed) for c in cases}
        except ModuleNotFoundError as missing:
            if not str(missing.name).startswith("sketchtree.mrf."):
                raise
            print(f"{method}: there is no module {missing.name}; left out", file=sys.stderr)
    return result


def summary(result: dict[str, Scores]) -> dict[str, dict[str, float]]:
    """method → median of every figure, and `wins`: the share of cases with elev below the rival's."""
    table = {}
    for method, scores in result.items():
        table[method] = metrics.medians(list(scores.values()))
        if RIVAL in result and method != RIVAL:
            pairs = [(row["elev"], result[RIVAL][name]["elev"]) for name, row in scores.items()]
            table[method]["wins"] = metrics.win_rate(*map(list, zip(*pairs, strict=True)))
    return table


def table(result: dict[str, Scores]) -> str:
    """The medians as text, one method a line."""
    columns = (*metrics.NAMES, "wins", "matched", "s")
    lines = [f"{'':12s}" + "".join(f"{name:>10s}" for name in columns)]
    for method, row in summary(result).items():
        lines.append(f"{method:12s}" + "".join(f"{row.get(name, np.nan):10.3f}" for name in columns))
    return "\n".join(lines)


def per_case(result: dict[str, Scores], figure: str = "elev") -> str:
    """One figure of every case, one case a line."""
    lines = [f"{figure:26s}" + "".join(f"{method:>12s}" for method in result)]
    for name in next(iter(result.values()), {}):
        lines.append(f"{name:26s}" + "".join(f"{scores[name][figure]:12.3f}" for scores in result.values()))
    return "\n".join(lines)


def over_seeds(cases: list[Case], methods: list[str], seeds: tuple[int, ...] = SEEDS) -> dict[str, dict[str, float]]:
    """As `summary`, each figure the mean of its medians over several seeds for methods that draw numbers:
    another processor's last bits lead the chains elsewhere, much as another seed does."""
    tables = [summary(compare(cases, methods, seed=seeds[0]))]
    drawing = [method for method in methods if method in (RIVAL, *DRAWING)]
    tables += [summary(compare(cases, drawing, seed=seed)) for seed in seeds[1:]]
    return {
        method: {name: float(np.mean([table[method][name] for table in tables if method in table])) for name in row}
        for method, row in tables[0].items()
    }


def write_record(cases: list[Case], methods: list[str]) -> None:
    """The figures that `tests/mrf/test_depth_quality.py` holds every later version to."""
    rows = {m: {name: round(row[name], 4) for name in metrics.NAMES} for m, row in over_seeds(cases, methods).items()}
    RECORD.write_text(json.dumps(rows, indent=1) + "\n")


def main(arguments: list[str] | None = None) -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.depth", description=__doc__.splitlines()[0])
    parser.add_argument("--set", choices=("synthetic", "real", "quality", "all"), help="default: all, unless --cases")
    parser.add_argument("--cases", type=Path, help="a folder of CASE.json + CASE.svg pairs")
    parser.add_argument("--skeletons", type=Path, help="a folder of measured trees for the set `real`")
    parser.add_argument("--methods", nargs="+", choices=METHODS, default=list(ORDER))
    parser.add_argument("--json", type=Path, help="write every figure here")
    parser.add_argument("--record", action="store_true", help="make the medians of `quality` the tests' record")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--brief", action="store_true", help="medians only")
    options = parser.parse_args(arguments)
    report = {}
    for name, cases, read in _runs(options):
        result = compare(cases, options.methods, read=read, seed=options.seed)
        report[name] = {m: {"median": summary(result)[m], "cases": scores} for m, scores in result.items()}
        print(f"\n{name}: {len(cases)} cases\n{table(result)}", flush=True)
        if options.record and name == "quality":
            write_record(cases, options.methods)
        if not options.brief:
            print(f"\n{per_case(result)}", flush=True)
    if options.json:
        options.json.write_text(json.dumps(report, indent=1) + "\n")


def _runs(options):
    """(title, cases, through the reader?) of everything asked for."""
    chosen = options.set or (None if options.cases else "all")
    if chosen in ("synthetic", "all"):
        yield "synthetic", case_sets.synthetic(), False
    if chosen in ("real", "all"):
        yield "real", case_sets.real(options.skeletons), False
    if chosen == "quality":
        yield "quality", case_sets.quality(), False
    if options.cases:
        cases = case_sets.shared(options.cases)
        if not cases:
            raise SystemExit(f"There is no case (*.json) in {options.cases}.")
        yield f"{options.cases.name}, exact graph", cases, False
        drawn = [case for case in cases if case.svg]
        if drawn:
            yield f"{options.cases.name}, as read", drawn, True


if __name__ == "__main__":
    main()
