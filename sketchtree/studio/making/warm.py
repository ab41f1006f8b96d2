"""What is slow only the first time? Compiling the programs of inference; it is done before the first stroke.

A little drawing of every size up to the largest that is met every day is inferred once, plainly and with all but one limb held, as after a stroke.
"""

import numpy as np

from sketchtree.editing.edits import Edits
from sketchtree.editing.settle import settle
from sketchtree.editing.settled import Settled
from sketchtree.keys import root_key
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.methods import solver_named
from sketchtree.mrf.prior import Prior
from sketchtree.parameters import GENERIC
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.strokes import Sketch, Stroke

_LIMBS = (4, 20, 45)  # of drawings whose columns are padded to 32, 64 and 128 rows


def warm_up(limbs: tuple[int, ...] = _LIMBS) -> None:
    """Compile, or read what was compiled before."""
    for count in limbs:
        graph = sketch_graph(_little(count))
        factors, prior, key = factor_graph(graph), Prior(GENERIC), root_key(0)
        solver = solver_named("elevation")
        settle(graph, factors, prior, solver, edits=Edits(), settled=Settled(), key=key, quick=True)


def _little(count: int) -> Sketch:
    """A trunk and so many limbs, to the left and to the right."""
    strokes = [Stroke("trunk", np.array([[0.0, 0.0], [0.0, 100.0]]))]
    for k in range(count):
        y, side = 20.0 + 75.0 * k / count, 1.0 if k % 2 else -1.0
        strokes.append(Stroke(f"limb {k}", np.array([[0.0, y], [20.0 * side, y + 15.0], [30.0 * side, y + 30.0 + k % 3]])))
    return Sketch(tuple(strokes))
