"""How do drawn roots join the graph? They branch downward as limbs do upward, from the bases of the stems.

Turned upside down, roots are read as any other lines; their rows are turned back and stand after all rows of the tree. What
stood on the ground there hangs on the nearest base here; a gap between the two is bridged, the drawn point kept.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.axes import NULL

Table = dict[str, np.ndarray]  # the columns of a SketchGraph, one row a segment, and its curves


def with_roots(table: Table, roots: Table, limb_count: int) -> Table:
    """The columns of a tree and of its roots, which were read upside down (y negated). `limb_count`: of the tree."""
    bases = np.flatnonzero(table["parent"] == NULL)
    turned = roots["xy"] * (1.0, -1.0)
    base = roots["parent"] == NULL
    near = np.hypot(*np.moveaxis(turned[base][:, None] - table["xy"][bases][None], -1, 0)).argmin(1)
    count, kept = len(table["parent"]), np.flatnonzero(~base)
    row = np.empty(len(base), np.int64)  # where every row of the roots stands in the whole
    row[kept] = count + np.arange(len(kept))
    row[base] = bases[near]
    parent = row[roots["parent"][kept]]
    tree = table["tree"][_base_of(parent, table["parent"], count)]
    curves = [_curve(k, roots, turned, table["xy"], row) for k in kept]
    return {
        "parent": np.r_[table["parent"], parent],
        "xy": np.vstack([table["xy"], turned[kept]]),
        "limb": np.r_[table["limb"], roots["limb"][kept] + limb_count],
        "stroke": np.r_[table["stroke"], roots["stroke"][kept]],
        "tree": np.r_[table["tree"], tree],
        "width": np.r_[table["width"], roots["width"][kept]],
        "joined": np.r_[table["joined"], roots["joined"][kept]],
        "root": np.r_[np.zeros(count, bool), np.ones(len(kept), bool)],
        "curve_points": np.vstack([table["curve_points"], *curves]),
        "curve_start": np.r_[table["curve_start"], table["curve_start"][-1] + np.cumsum([len(curve) for curve in curves])].astype(np.int64),
    }


def _base_of(parent, above, count: int) -> np.ndarray:
    """The row of the tree that every row of the roots goes back to."""
    whole = np.r_[above, parent]
    top = parent.copy()
    while (top >= count).any():
        top = np.where(top >= count, whole[top], top)
    return top


def _curve(k: int, roots: Table, turned: Float[np.ndarray, "row 2"], xy: Float[np.ndarray, "row 2"], row) -> Float[np.ndarray, "point 2"]:
    """The drawn points inside one row of the roots; with its first point where that is not where the row starts now."""
    inner = roots["curve_points"][roots["curve_start"][k] : roots["curve_start"][k + 1]] * (1.0, -1.0)
    above = roots["parent"][k]
    if roots["parent"][above] == NULL and (turned[above] != xy[row[above]]).any():
        return np.vstack([turned[above], inner])
    return inner
