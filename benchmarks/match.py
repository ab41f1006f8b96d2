"""Is the species that was sketched recognised? Sketches of trees that are no exemplars, ranked by both scores.

    python -m benchmarks.match                                 six new trees of every recipe, from a random side each
    python -m benchmarks.match --confusion matrix.png          … and which recipe was taken for which (or .csv)
    python -m benchmarks.match --trees 2 --robust 0

`tree_sketch` draws them: two or three orders, 1 % jitter, with and without a crown's outline. `chen` is the paper's sum; `calibrated` ours.
A species counts as found if an exemplar of it (young or old) comes first, or is among the first three exemplars; a growth habit if the
first exemplar has it. Then the same trees with more or less jitter, and with a third or two thirds of their limbs left out.
"""

import argparse
import csv
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from benchmarks.tree_sketch import Pencil, grown, main_limbs, random_pencil, recipes, sketch_of
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.store.database import Database
from sketchtree.templates.matching.match import SCORES, match
from sketchtree.templates.growing.recipe import Recipe

FIRST_SEED = 700_000  # of the trees grown for this; `fit_match` learns from others, and no choice was made by these
BARS = {True: (0.75, 0.85), False: (0.60, 0.70)}  # with a crown, without: species among three, habit first
PLAIN = "as the bars say"
HANDS = {
    PLAIN: {},
    "no jitter": {"jitter": 0.0},
    "2 % jitter": {"jitter": 0.02},
    "3 % jitter": {"jitter": 0.03},
    "a third left out": {"left_out": 1 / 3},
    "two thirds left out": {"left_out": 2 / 3},
}


@dataclass(frozen=True)
class Ranked:
    """One sketch and what it was taken for."""

    recipe: str
    hand: str
    crown: bool
    score: str
    first: tuple[str, ...]  # names of the first three exemplars


def sketch_and_rank(db: Database, wanted: list[Recipe], seeds, hands: dict[str, dict]) -> list[Ranked]:
    """Every recipe grown from every seed, drawn by every hand, ranked with and without its crown by both scores."""
    found = []
    for recipe, seed, tree in grown(wanted, seeds):
        rng = np.random.default_rng([seed, db.index(recipe.name)])
        pencil = random_pencil(rng)
        drawn = main_limbs(tree, pencil)
        for number, (hand, how) in enumerate(hands.items()):
            found += _rank(db, recipe, tree, hand, replace(pencil, **how), drawn, np.random.default_rng([seed, db.index(recipe.name), number]))
    return found


def _rank(db: Database, recipe: Recipe, tree: TreeSkeleton, hand: str, pencil: Pencil, drawn, rng) -> list[Ranked]:
    graph = sketch_of(tree, pencil, rng, drawn=drawn)
    return [
        Ranked(recipe.name, hand, crown, score, tuple(m.name for m in match(seen, db, score=score, count=3)))
        for crown, seen in ((True, graph), (False, graph.replace(crown=())))
        for score in SCORES
    ]


def shares(found: list[Ranked], kinds: dict[str, Recipe]) -> tuple[float, float, float]:
    """(species first, species among three, habit first)."""
    rows = []
    for sketch in found:
        true, seen = kinds[sketch.recipe], [kinds[name] for name in sketch.first]
        right = [recipe.species == true.species for recipe in seen]
        rows.append((right[0], any(right), seen[0].growth_habit == true.growth_habit))
    return tuple(np.mean(rows, axis=0).tolist())


def confusion(found: list[Ranked], names: list[str]) -> np.ndarray:
    """How often the sketch of a recipe's tree (row) was taken for an exemplar (column)."""
    table = np.zeros((len(names), len(names)), int)
    for sketch in found:
        table[names.index(sketch.recipe), names.index(sketch.first[0])] += 1
    return table


def write_confusion(path: Path, tables: dict[str, np.ndarray], names: list[str]) -> None:
    """The tables as a picture (.png) or as comma-separated counts (.csv)."""
    if path.suffix == ".csv":
        with open(path, "w", newline="", encoding="utf-8") as file:
            rows = csv.writer(file)
            for title, table in tables.items():
                rows.writerow([title, *names])
                rows.writerows([name, *counts] for name, counts in zip(names, table.tolist(), strict=True))
        return
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11 * len(tables), 11), layout="constrained")
    for axis, (title, table) in zip(figure.subplots(1, len(tables), squeeze=False)[0], tables.items(), strict=True):
        axis.imshow(table / np.maximum(table.sum(axis=1, keepdims=True), 1), cmap="Greys", vmin=0, vmax=1)
        for row, column in np.argwhere(table):
            dark = table[row, column] > 0.5 * table[row].sum()
            axis.text(column, row, table[row, column], ha="center", va="center", fontsize=7, color="white" if dark else "tab:red")
        axis.set_xticks(range(len(names)), names, rotation=90, fontsize=7)
        axis.set_yticks(range(len(names)), names, fontsize=7)
        axis.set(title=title, xlabel="taken for", ylabel="sketch of")
    figure.savefig(path, dpi=110, bbox_inches="tight")


def print_bars(found: list[Ranked], kinds: dict[str, Recipe]) -> None:
    """Both scores beside the bars."""
    print(f"{'':28}{'species first':>15}{'first three':>13}{'habit first':>13}   bars: three, habit")
    for crown in (True, False):
        chen, ours = (shares([f for f in found if f.crown == crown and f.score == s], kinds) for s in ("chen", "calibrated"))
        bar = BARS[crown]
        met = ours[1] >= bar[0] and ours[2] >= bar[1] and all(a > b for a, b in zip(ours, chen, strict=True))
        for score, row in (("calibrated", ours), ("chen", chen)):
            verdict = f"   {bar[0]:.0%}, {bar[1]:.0%}, above chen: {'met' if met else 'missed'}" if score == "calibrated" else ""
            print(f"{score:11}{'with a crown' if crown else 'without a crown':17}{row[0]:15.1%}{row[1]:13.1%}{row[2]:13.1%}{verdict}")


def main(arguments: list[str] | None = None) -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.match", description=__doc__.splitlines()[0])
    parser.add_argument("--trees", type=int, default=6, help="new trees of every recipe (default 6)")
    parser.add_argument("--robust", type=int, default=6, help="of them drawn with other jitter and with limbs left out (default 6)")
    parser.add_argument("--confusion", type=Path, help="a .png or .csv of what was taken for what, with and without a crown")
    wanted = parser.parse_args(arguments)
    db = Database.open()
    kinds = {recipe.name: recipe for recipe in recipes()}
    split = FIRST_SEED + min(wanted.robust, wanted.trees)
    found = sketch_and_rank(db, list(kinds.values()), range(FIRST_SEED, split), HANDS)
    found += sketch_and_rank(db, list(kinds.values()), range(split, FIRST_SEED + wanted.trees), {PLAIN: {}})
    plain = [f for f in found if f.hand == PLAIN]
    print(f"{len(plain) // 4} sketches of new trees of {len(kinds)} recipes ({len({k.species for k in kinds.values()})} species)")
    print_bars(plain, kinds)
    for hand in HANDS if wanted.robust else ():
        if hand != PLAIN:
            of_hand = [f for f in found if f.hand == hand]
            print(f"{hand}:")
            print_bars(of_hand, kinds)
    if wanted.confusion:
        tables = {
            "with a crown" if crown else "without a crown": confusion(
                [f for f in plain if f.crown == crown and f.score == "calibrated"], list(kinds)
            )
            for crown in (True, False)
        }
        write_confusion(wanted.confusion, tables, list(kinds))


if __name__ == "__main__":
    main()
