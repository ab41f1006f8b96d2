"""Where do two straight pieces of wood come nearest to each other?

Ericson, *Real-Time Collision Detection* (2005), §5.1.9. Of the pieces p + s d and q + t e, 0 ≤ s, t ≤ 1, with r = p − q,

    s = (b f − c h) / (a h − b²)     a = d·d,  b = d·e,  c = d·r,  f = e·r,  h = e·e;   cut to 0-1; 0 where they are parallel
    t = (b s + f) / h                cut to 0-1; where that cuts it, s = (b t − c) / a, cut to 0-1
"""

import numpy as np
from jaxtyping import Float

_PARALLEL = 1e-12  # of a h: below that the two count as parallel, where every s is as good as another
_POINT = 1e-300  # m²: a shorter piece is a point


def nearest(
    p: Float[np.ndarray, "pair 3"], d: Float[np.ndarray, "pair 3"], q: Float[np.ndarray, "pair 3"], e: Float[np.ndarray, "pair 3"]
) -> tuple[Float[np.ndarray, " pair"], Float[np.ndarray, " pair"]]:
    """(s, t), 0-1: how far along p + s d and q + t e their nearest points lie. Where there are several, one of them."""
    r = p - q
    a, h = np.maximum(_dot(d, d), _POINT), np.maximum(_dot(e, e), _POINT)
    b, c, f = _dot(d, e), _dot(d, r), _dot(e, r)
    across = a * h - b * b
    crossing = across > _PARALLEL * a * h
    s = np.where(crossing, np.clip((b * f - c * h) / np.where(crossing, across, 1.0), 0.0, 1.0), 0.0)
    free = (b * s + f) / h
    t = np.clip(free, 0.0, 1.0)
    return np.where(free == t, s, np.clip((b * t - c) / a, 0.0, 1.0)), t


def _dot(one, other):
    return np.einsum("bi,bi->b", one, other)
