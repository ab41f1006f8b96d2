"""How many branches run through each other, before and after untangling, and what does it cost?

    python -m benchmarks.overlaps [SKETCH ...] [--seed 0] [--repeat 3] [--large]

One line an example: the undrawn segments that overlap with another undrawn one, and with any, in % of all undrawn ones, before
and after (both with final radii); segments lost, turns, and the milliseconds of the search alone and of the whole stage, the best of
`repeat` runs. `--large` does the same for an oak of 19,000 and 100,000 segments, and of more than are untangled, which is searched only.
"""

import argparse
import dataclasses
import resource
import time
from pathlib import Path

import numpy as np

from sketchtree.geometry.radii import PipeRadii
from sketchtree.keys import root_key, stage_key
from sketchtree.options import TreeOptions
from sketchtree.pipeline import draw_out, propagation
from sketchtree.propagate.after.overlaps import is_undrawn, overlapping, share_overlapping
from sketchtree.propagate.after.untangle import LARGEST, Untangle
from sketchtree.propagate.generations import Propagation
from sketchtree.propagate.scale import to_scale
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.store.database import Database

ROOT = Path(__file__).parents[1]
EXAMPLES = (*sorted((ROOT / "examples").glob("*.svg")), ROOT / "examples" / "apple.json", ROOT / "benchmarks" / "data" / "ten_strokes.svg")
LARGE = ((9.0, 200_000), (20.0, 100_000), (40.0, 1_000_000))  # (times as dense, segments at most)
_TITLE = f"{'':<18} {'undrawn':>9} {'before %':>13} {'after %':>13} {'lost %':>7} {'turned':>7} {'>12°':>6} {'most °':>7} {'search ms':>10} {'stage ms':>9}"


def grown(sketch: Path, templates: Database, seed: int, dense: float = 1.0, segments: int = 200_000):
    """(drawn tree, what grew, its final radii, drawn radii) of a sketch; twigs `dense` times as many."""
    key = root_key(seed)
    drawn = draw_out(sketch, templates, key=key)
    fine = dense**0.5
    habit = dataclasses.replace(
        drawn.habit, lateral_spacing=drawn.habit.lateral_spacing / dense**0.6, twig_length=drawn.habit.twig_length / fine,
        twig_radius=drawn.habit.twig_radius / fine, max_order=drawn.habit.max_order + 2 * (dense > 1),
    )  # fmt: skip
    drawn = dataclasses.replace(drawn, habit=habit)
    options = TreeOptions(max_segments=segments, generations=None if dense == 1 else 14)
    found = propagation(drawn, options).run(drawn.skeleton, key=stage_key(key, "propagate"))
    radius = np.full(len(found.skeleton), np.nan)
    radius[found.drawn_row] = drawn.radius
    return found, PipeRadii(habit, radius)(found.skeleton), radius, habit, to_scale(habit, drawn.skeleton, drawn.crown)


def best_ms(task, repeat: int) -> float:
    """The best of several runs, milliseconds."""
    laps = []
    for _ in range(repeat):
        began = time.perf_counter()
        task()
        laps.append(1000 * (time.perf_counter() - began))
    return min(laps)


def line(name: str, found: Propagation, tree: TreeSkeleton, radius, habit, scaled, repeat: int) -> str:
    """One tree before and after."""
    undrawn, search = int(is_undrawn(tree).sum()), best_ms(lambda: overlapping(tree), repeat)
    before = "{:6.2f} {:6.2f}".format(*(100 * share for share in share_overlapping(tree)))
    if len(tree) > LARGEST:
        return f"{name:<18} {undrawn:>9,} {before} {'':>46} {search:>10.0f}"
    stage = Untangle(scaled, found.spaces)
    freed = stage.run(tree)
    after = share_overlapping(PipeRadii(habit, radius[freed.rows])(freed.skeleton))
    lost = 100 * (1 - int(is_undrawn(freed.skeleton).sum()) / max(undrawn, 1))
    degrees = np.degrees(freed.turned)
    turns = f"{len(degrees):>7,} {int((degrees > 12.001).sum()):>6,} {degrees.max(initial=0.0):>7.1f}"
    took = best_ms(lambda: stage.run(tree), repeat)
    return f"{name:<18} {undrawn:>9,} {before} {100 * after[0]:6.2f} {100 * after[1]:6.2f} {lost:>7.2f} {turns} {search:>10.0f} {took:>9.0f}"


def main(arguments: list[str] | None = None) -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.overlaps", description=__doc__.splitlines()[0])
    parser.add_argument("sketch", type=Path, nargs="*", default=EXAMPLES)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--repeat", type=int, default=3, help="runs of which the best counts (default 3)")
    parser.add_argument("--large", action="store_true", help="an oak of up to a million segments instead")
    asked = parser.parse_args(arguments)
    templates = Database.open()
    print(_TITLE)
    if asked.large:
        for dense, segments in LARGE:
            name = f"oak, {dense:g} times"
            print(line(name, *grown(ROOT / "examples" / "oak.svg", templates, asked.seed, dense, segments), 1), flush=True)
        print(f"peak {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1000:,.0f} MB")
        return
    for sketch in asked.sketch:
        print(line(sketch.name, *grown(sketch, templates, asked.seed), max(1, asked.repeat)), flush=True)


if __name__ == "__main__":
    main()
