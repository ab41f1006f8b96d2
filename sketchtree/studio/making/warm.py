"""What is slow only the first time? Compiling the programs of inference; it is done before the first stroke.

Columns of drawings are padded to a few sizes (`mrf.padding`), and each size has a program, which is kept on disk. One little drawing of every size that is met every day is
inferred with all but one limb held, as after a stroke; the sizes met first come first. Points behind a drawing are a factor more, and so have programs of their own.
"""

import dataclasses
import numpy as np

from sketchtree.editing.seen import FACTOR
from sketchtree.editing.settle import QUICK
from sketchtree.keys import root_key
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.factors.seen_depths import SeenPoints
from sketchtree.mrf.infer import infer
from sketchtree.mrf.methods import solver_named
from sketchtree.mrf.prior import Prior
from sketchtree.parameters import GENERIC
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.strokes import Sketch, Stroke

LIMBS = (4, 10, 20, 15, 40, 30)  # of drawings padded to 32 rows and 8 limbs, 32 and 16, 64 and 32, 64 and 16, 128 and 64, 128 and 32
FOR_POINTS = (4, 10)  # of them, over points: a drawing over a scan begins small


def warm_up(quick: bool, limbs: int, *, seen: bool = False) -> None:
    """Compile, or read what was compiled before: the program of hurried answers, or of full ones, to a drawing with so many limbs; `seen`: with points behind it."""
    factors = factor_graph(sketch_graph(_little(limbs)))
    last = factors.limb_count - 1
    locked = {int(row): 0.0 for row in np.flatnonzero((factors.limb != last) & ~factors.is_base)}
    solver = dataclasses.replace(solver_named("elevation"), start=np.zeros(len(factors)), locked=locked, **(QUICK if quick else {}))
    if seen:
        solver = dataclasses.replace(solver, factors={FACTOR: SeenPoints(np.zeros((1, 3)), needed=False)})
    infer(factors, Prior(GENERIC), solver, key=root_key(0), max_steps=None if quick else 1, throw=False)


def _little(count: int) -> Sketch:
    """A trunk and so many limbs, to the left and to the right."""
    strokes = [Stroke("trunk", np.array([[0.0, 0.0], [0.0, 100.0]]))]
    for k in range(count):
        y, side = 20.0 + 75.0 * k / count, 1.0 if k % 2 else -1.0
        strokes.append(Stroke(f"limb {k}", np.array([[0.0, y], [20.0 * side, y + 15.0], [30.0 * side, y + 30.0 + k % 3]])))
    return Sketch(tuple(strokes))
