"""How to carry a frame along a curve without twisting it.

Double reflection, Wang, Jüttler, Zheng & Liu 2008, "Computation of rotation minimizing frames" (ACM
Transactions on Graphics 27 (1), Table I): from point i to i+1,

    v1 = x_i+1 − x_i          rᴸ = r_i − 2 (v1·r_i) v1 / v1·v1        tᴸ likewise from t_i
    v2 = t_i+1 − tᴸ           r_i+1 = rᴸ − 2 (v2·rᴸ) v2 / v2·v2

    x   points of the curve     t   unit tangents     r   unit reference vectors, perpendicular to t

The error per step is of fourth order. All curves advance together, one point a pass.
"""

import numpy as np
from jaxtyping import Float, Int


def rotation_minimising(
    point: Float[np.ndarray, "ring 3"],
    tangent: Float[np.ndarray, "ring 3"],
    start: Int[np.ndarray, " limb+1"],
    first: Float[np.ndarray, "limb 3"],
) -> Float[np.ndarray, "ring 3"]:
    """Reference vectors r of ragged curves; `first` is projected to be perpendicular to the first tangent."""
    reference = np.zeros_like(point)
    count = np.diff(start)
    order = np.argsort(-count, kind="stable")
    head, count = start[:-1][order], count[order]
    alive = np.searchsorted(-count, -np.arange(1, (count[0] if len(count) else 0) + 1), side="right")
    if len(count) and alive[0]:
        begin = head[: alive[0]]
        reference[begin] = perpendicular(first[order[: alive[0]]], tangent[begin])
    for step, living in enumerate(alive[1:].tolist()):
        here = head[:living] + step
        reference[here + 1] = _double_reflection(
            point[here], point[here + 1], tangent[here], tangent[here + 1], reference[here]
        )
    return reference


def perpendicular(vector: Float[np.ndarray, "ring 3"], tangent: Float[np.ndarray, "ring 3"]) -> Float[np.ndarray, "ring 3"]:
    """The unit part of `vector` perpendicular to the unit `tangent`; any perpendicular where they are parallel."""
    least = np.argmin(np.abs(tangent), axis=-1)
    part = _reject(vector, tangent)
    size = np.linalg.norm(part, axis=-1, keepdims=True)
    parallel = size <= 0.05 * np.linalg.norm(vector, axis=-1, keepdims=True)
    part = np.where(parallel, _reject(np.eye(3)[least], tangent), part)
    return part / np.linalg.norm(part, axis=-1, keepdims=True)


def _reject(vector, tangent):
    return vector - np.sum(vector * tangent, axis=-1, keepdims=True) * tangent


def _double_reflection(x, x_next, t, t_next, r):
    v1 = x_next - x
    r_left = _reflect(r, v1)
    v2 = t_next - _reflect(t, v1)
    r_next = _reflect(r_left, v2)
    r_next -= np.sum(r_next * t_next, axis=-1, keepdims=True) * t_next  # rounding only
    return r_next / np.linalg.norm(r_next, axis=-1, keepdims=True)


def _reflect(u, v):
    """u mirrored in the plane perpendicular to v; u itself where v vanishes."""
    squared = np.sum(v * v, axis=-1, keepdims=True)
    share = np.sum(v * u, axis=-1, keepdims=True) / np.where(squared > 1e-30, squared, np.inf)
    return u - 2.0 * share * v
