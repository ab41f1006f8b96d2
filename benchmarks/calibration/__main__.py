"""May the posterior be believed?

    python -m benchmarks.calibration sbc --replicates 2000        both variants of the core model
    python -m benchmarks.calibration budget                       40 drawings; about half an hour
    python -m benchmarks.calibration coverage                     grown and measured trees
"""

import argparse
import json
from pathlib import Path

import numpy as np

from benchmarks import cases as case_sets
from benchmarks.calibration import budget, coverage, sbc
from benchmarks.calibration.core_model import VARIANTS

LEAST_P = 0.01
NEAR = 0.03  # of 50 and 90 %


def main(arguments: list[str] | None = None) -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.calibration", description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(required=True)
    ranks = commands.add_parser("sbc", help="ranks of the truth under the core model")
    ranks.add_argument("--replicates", type=int, default=2000)
    ranks.add_argument("--variant", nargs="+", choices=VARIANTS, default=list(VARIANTS))
    ranks.add_argument("--ranks", type=Path, help="write every rank here (.npz)")
    ranks.set_defaults(run=run_sbc)
    rivals = commands.add_parser("budget", help="everyday samples against fifty times the budget")
    rivals.add_argument("--drawings", type=int, default=40)
    rivals.add_argument("--json", type=Path, help="write every drawing's figures here")
    rivals.set_defaults(run=run_budget)
    inside = commands.add_parser("coverage", help="intervals on trees of known depth")
    inside.add_argument("--set", nargs="+", choices=("synthetic", "real"), default=["synthetic", "real"])
    inside.add_argument("--skeletons", type=Path, help="a folder of measured trees for the set `real`")
    inside.add_argument("--cases", type=int, help="only so many of each set")
    inside.set_defaults(run=run_coverage)
    for command in (ranks, rivals, inside):
        command.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(arguments)
    options.run(options)


def run_sbc(options) -> None:
    """χ² and coverage of every scalar."""
    sampling, found = sbc.Sampling(), {}
    for variant in options.variant:
        ranks = sbc.ranks(variant, options.replicates, seed=options.seed, sampling=sampling)
        found |= {f"{variant}: {name}": rank for name, rank in ranks.items()}
        rows = {name: sbc.verdict(rank, sampling.kept) for name, rank in ranks.items()}
        print(f"\n{variant}: {options.replicates} replicates\n{'':26s}{'p':>8s}{'50 %':>8s}{'90 %':>8s}{'mean':>8s}")
        for name, row in rows.items():
            print(f"{name:26s}{row.p:8.4f}{row.cover[50]:8.3f}{row.cover[90]:8.3f}{row.mean:8.3f}")
        least = sbc.holm(np.array([row.p for row in rows.values()]))
        worst = max(abs(cover - level / 100) for row in rows.values() for level, cover in row.cover.items())
        print(f"smallest p after Holm {least:.4f} (bar > {LEAST_P}): {_word(least > LEAST_P)}")
        print(f"worst coverage off by {worst:.3f} (bar {NEAR}): {_word(worst <= NEAR)}", flush=True)
    if options.ranks:
        np.savez_compressed(options.ranks, **found)


def run_budget(options) -> None:
    """Both figures of every drawing, their means, the worst drawing."""
    rows = []
    print(f"{'':26s}{'segments':>9s}{'steepness':>10s}{'odds':>8s}{'restart':>9s}{'odds':>8s}")
    for row in budget.differences(budget.drawings(options.drawings), seed=options.seed):
        rows.append(row)
        print(f"{row.name:26s}{row.segments:9d}{row.steepness:10.4f}{row.odds:8.4f}{row.restart_steepness:9.4f}{row.restart_odds:8.4f}", flush=True)
    for figure, bar in budget.AT_MOST.items():
        mean = float(np.mean([getattr(row, figure) for row in rows]))
        worst = max(rows, key=lambda row: getattr(row, figure))
        print(f"{figure}: mean {mean:.4f} (bar {bar}): {_word(mean <= bar)}; worst {worst.name} {getattr(worst, figure):.4f}")
    if options.json:
        options.json.write_text(json.dumps([row._asdict() for row in rows], indent=1) + "\n")


def run_coverage(options) -> None:
    """Every share and order of each set."""
    sets = {"synthetic": case_sets.synthetic, "real": lambda: case_sets.real(options.skeletons)}
    for name in options.set:
        found = [coverage.measured(case, seed=options.seed) for case in sets[name]()[: options.cases]]
        print(f"\n{name}: {len(found)} cases\n{'share':>6s}{'order':>6s}{'segments':>9s}{'cover':>8s}{'below':>8s}{'width':>8s}{'score':>8s}")
        for k, share in enumerate(coverage.SHARES):
            for order in (None, 0, 1, 2):
                row = coverage.held(found, k, order)
                label = "all" if order is None else f"{order}" + "+" * (order == 2)
                bars = _word(coverage.COVER[0] <= row.cover <= coverage.COVER[1] and row.score <= coverage.SCORE) if order is None else ""
                print(f"{share:6.2f}{label:>6s}{row.segments:9d}{row.cover:8.3f}{row.below:8.3f}{row.width:8.3f}{row.score:8.3f}  {bars}")


def _word(holds: bool) -> str:
    return "holds" if holds else "FAILS"


if __name__ == "__main__":
    main()
