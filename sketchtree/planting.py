"""Where does each tree of a forest stand, and how does it differ from the others of its kind?

Trees stand in a row along x, in the order given, the first with its foot at the origin; each keeps facing the viewer, so that it still shows
what was drawn. From foot to foot it is `spacing` metres, or without one

    x_{k+1} − x_k = max(r_k, `LEAST` h_k) + max(l_{k+1}, `LEAST` h_{k+1})

    l, r   how far the drawing (limbs and crown) goes to the left and the right of the foot, metres       h   its height

so that neighbouring drawings just touch. What grows beyond the drawing, and out of the page, then meets.

The same drawing given again is another tree: it grows by the key of its stage `copy 1`, `copy 2`, … The first grows as it would alone.
Drawings are the same if what was read of them is, to the last bit.
"""

import hashlib
from collections.abc import Sequence

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.errors import OptionError
from sketchtree.keys import stage_key
from sketchtree.sketch.graph import SketchGraph

MOST_TREES = 1000
LEAST = 0.08  # of a tree's height


def check_stand(count: int, spacing: float | None) -> None:
    """Raises OptionError for no tree, for too many, and for a spacing (metres) that is none."""
    if count < 1:
        raise OptionError("There is no sketch to make a forest of.", remedy="Name one or several sketch files.")
    if count > MOST_TREES:
        raise OptionError(f"{count} trees are more than a forest may have.", remedy=f"Give {MOST_TREES} at most; instance them in your 3D program.")
    if spacing is not None and not (np.isfinite(spacing) and spacing > 0):
        raise OptionError(f"`--spacing {spacing:g}` is no distance between trees.", remedy="Give metres above 0, from trunk to trunk.")


def digest(graph: SketchGraph) -> str:
    """What drawings that are the same have in common: a hash of strokes, branches, widths and outlines."""
    columns = (graph.parent, graph.stroke, graph.xy, graph.curve_points, graph.curve_start, graph.width, *graph.crown, *graph.obstacles)
    made = hashlib.blake2b("\n".join(graph.stroke_ids).encode(), digest_size=8)
    for column in columns:
        made.update(np.ascontiguousarray(column).tobytes())
    return made.hexdigest()


def copy_numbers(digests: Sequence[str]) -> list[int]:
    """How many of the same drawing stand before each."""
    seen: dict[str, int] = {}
    found = []
    for one in digests:
        found.append(seen.get(one, 0))
        seen[one] = found[-1] + 1
    return found


def tree_key(key: Key[Array, ""], copy: int) -> Key[Array, ""]:
    """The key of one tree: the run's own for the first of its kind."""
    return key if copy == 0 else stage_key(key, f"copy {copy}")


def sides(drawn) -> tuple[float, float]:
    """How far a drawn tree needs room to the left and to the right of its foot, metres (at least `LEAST` of its height)."""
    tree = drawn.skeleton
    outlines = [drawn.similarity.to_world(outline)[:, 0] for outline in drawn.graph.crown]
    x = np.concatenate([tree.tip[:, 0], tree.curve_points[:, 0], *outlines])
    least = LEAST * tree.height
    return max(float(-x.min()), least), max(float(x.max()), least)


def places(drawn: Sequence, spacing: float | None) -> Float[np.ndarray, "tree 3"]:
    """Where each tree's foot stands, metres."""
    room = np.array([sides(one) for one in drawn])
    apart = np.full(len(drawn) - 1, spacing) if spacing is not None else room[:-1, 1] + room[1:, 0]
    return np.column_stack([np.r_[0.0, np.cumsum(apart)], np.zeros((len(drawn), 2))])


def crowded(names: Sequence[str], place: Float[np.ndarray, "tree 3"], radius: Float[np.ndarray, " tree"]) -> tuple[str, ...]:
    """A warning for every two neighbours whose trunks stand in each other."""
    apart = np.diff(place[:, 0])
    met = np.flatnonzero(apart < radius[:-1] + radius[1:])
    return tuple(
        f"The trunks of {names[k]} and {names[k + 1]} stand {apart[k]:.2f} m apart, nearer than they are thick "
        f"({radius[k] + radius[k + 1]:.2f} m), so they run into each other. Raise --spacing."
        for k in met
    )
