"""Does `--theta fixed` reproduce the template's angles? W1 between the divergences of grown laterals and the exemplar's.

    python -m benchmarks.fixed_theta [NAME ...] [--sketch FILE] [--seed 0]

Of the first segments of all limbs that the sketch left out, against those of the exemplar, degrees; the bar is 3. `fit` is the same with Θ learnt
from the drawing, as by default, and `drawn` what the drawn laterals have under a fixed Θ: their page is given, so they need not agree.
"""

import argparse
from pathlib import Path
from typing import NamedTuple

import numpy as np
from jaxtyping import Float
from scipy.stats import wasserstein_distance

from benchmarks.six_templates import SKETCH
from sketchtree.keys import root_key
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.pipeline import TreeModel, sketch_to_tree
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.store.database import Database
from sketchtree.templates.estimate import parent_child_pairs

AT_MOST = 3.0  # degrees


class Apart(NamedTuple):
    """W1 to the exemplar's divergences, degrees."""

    laterals: int
    fixed: float
    fit: float
    drawn: float


def divergences(tree: TreeSkeleton) -> tuple[Float[np.ndarray, " lateral"], Float[np.ndarray, " lateral"]]:
    """(divergence of every lateral from its parent segment, degrees; id of its limb)."""
    pairs = parent_child_pairs(tree)
    lateral = tree.limb[pairs.child] != tree.limb[pairs.parent]
    return np.degrees(pairs.divergence[lateral]), tree.limb[pairs.child[lateral]]


def apart(name: str, templates: Database, *, sketch: Path = SKETCH, seed: int = 0) -> Apart:
    """One template."""
    theirs, _ = divergences(templates.exemplar(name).skeleton)
    fixed, fit = (_grown(sketch, templates, name, theta, seed) for theta in ("fixed", "fit"))
    new = [_new(tree) for tree in (fixed, fit)]
    drawn, _ = divergences(fixed.drawn.skeleton)
    return Apart(len(new[0]), *(float(wasserstein_distance(theirs, ours)) for ours in (*new, drawn)))


def _grown(sketch, templates, name, theta, seed) -> TreeModel:
    reading = ReadingOptions(template=name, theta=theta)
    return sketch_to_tree(sketch, templates, key=root_key(seed), reading=reading, tree=TreeOptions(leaf="none"))


def _new(tree: TreeModel) -> Float[np.ndarray, " lateral"]:
    """Divergences of the limbs that were not drawn."""
    angle, limb = divergences(tree.skeleton)
    return angle[~np.isin(limb, tree.drawn.skeleton.limb)]


def main(arguments: list[str] | None = None) -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.fixed_theta", description=__doc__.splitlines()[0])
    parser.add_argument("name", nargs="*", help="templates; default: all that bear limbs of order 2")
    parser.add_argument("--sketch", type=Path, default=SKETCH)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(arguments)
    templates = Database.open()
    names = options.name or [name for name in templates.names if templates.exemplar(name).habit.max_order > 1]
    print(f"{'':22s}{'laterals':>9s}{'fixed':>7s}{'fit':>7s}{'drawn':>7s}   degrees; bar {AT_MOST:g}")
    found = []
    for name in names:
        found.append(apart(name, templates, sketch=options.sketch, seed=options.seed))
        one = found[-1]
        print(f"{name:22s}{one.laterals:9d}{one.fixed:7.1f}{one.fit:7.1f}{one.drawn:7.1f}{'' if one.fixed <= AT_MOST else '   above'}", flush=True)
    kept = np.mean([one.fixed <= AT_MOST for one in found])
    print(f"median {np.median([one.fixed for one in found]):.1f}; {kept:.0%} of {len(found)} templates within the bar")


if __name__ == "__main__":
    main()
