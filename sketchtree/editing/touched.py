"""What has to be solved again? Only what was touched: new limbs, those whose course changed, those that are held elsewhere than they are.

    a limb is touched if nothing is known of it · it runs elsewhere on the page · it grows on another limb · it is held off the depth it has

Where a limb was pulled in depth, what grows on it and the limbs beside it, with all they bear, are open too: they make room.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.editing.edits import Edits
from sketchtree.editing.limbs import LimbLine, LimbLines
from sketchtree.editing.settled import Depths, Settled

SAME_COURSE = 0.004  # of the drawing's height: nearer than that a limb runs where it ran
SAME_DEPTH = 1e-9  # of the drawing's height


def carried(lines: LimbLines, settled: Settled) -> Float[np.ndarray, " segment"]:
    """Depths of all rows as far as they are settled, sketch units: each limb rises from its foot as it did. NaN where nothing is known."""
    depth = np.where(lines.graph.is_base, 0.0, np.nan)
    for line in lines.lines:
        known = settled.limbs.get(line.limb)
        if known is None or len(known.share) < 2:
            continue
        foot = depth[line.foot]
        at = np.interp(line.share, known.share, known.depth)
        moved = 0.0 if np.isnan(foot) else foot - known.depth[0]
        depth[line.rows] = at if abs(moved) <= SAME_DEPTH * lines.graph.height else at + moved
    return depth


def touched(lines: LimbLines, settled: Settled, edits: Edits) -> frozenset[int]:
    """Ids of the limbs whose depths are to be found."""
    height = max(lines.graph.height, 1e-300)
    fresh = {line.limb for line in lines.lines if _is_new(line, lines, settled.limbs.get(line.limb), height)}
    pulled = {line.limb for line in lines.lines if line.limb not in fresh and _is_pulled(line.limb, settled, edits, height)}
    beside = {line.limb for line in lines.lines for one in pulled if line.parent is not None and line.parent == settled.limbs[one].parent}
    return frozenset(fresh | _with_borne(lines, pulled | beside))


def depth_at(depths: Depths, share) -> Float[np.ndarray, " place"]:
    """Depth at places along a limb, sketch units."""
    return np.interp(share, depths.share, depths.depth)


def _is_new(line: LimbLine, lines: LimbLines, known: Depths | None, height: float) -> bool:
    if known is None or known.rough or known.parent != line.parent:
        return True
    return bool(np.abs(line.course(lines.graph) - known.course).max() > SAME_COURSE * height)


def _is_pulled(limb: int, settled: Settled, edits: Edits, height: float) -> bool:
    held = edits.held.get(limb)
    if held is None or held.whole:
        return False
    return bool(np.abs(depth_at(settled.limbs[limb], held.share) - held.depth).max() > 1e-6 * height)


def _with_borne(lines: LimbLines, limbs: set[int]) -> set[int]:
    """These and all that grows on them."""
    found = set(limbs)
    for line in lines.lines:  # parents first
        if line.parent in found:
            found.add(line.limb)
    return found
