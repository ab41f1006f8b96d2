"""Which matte parts tree from the rest for the least of its own volume? Normalised matting, the paper's (Eq. 3 and 4).

    min  f(α) = αᵀLα / αᵀDα     s.t.  α_i = s_i (i ∈ S),  0 ≤ α ≤ 1        D_ii   windows that hold pixel i

With w = D^½ α / q and q = (αᵀDα)^½ this is the paper's quadratic form wᵀ D^-½ L D^-½ w under bounds that hang on q. It is no convex problem; the paper hands it to sequential
quadratic programming (fmincon). Here: a ratio falls exactly where the quadratic αᵀ(L − μD)α does, μ = f(α) (Dinkelbach), whose gradient is that of f but for a factor. Each step
minimises that quadratic over the pixels that no bound holds, by conjugate gradients that end where it curves down (then that direction is taken: it falls without end), and goes as
far along it as lowers f, cut off at the bounds (projected Newton, Bertsekas 1982). The factors of closed-form matting precondition it, and its matte, on the scribbles exact, is the
start. f never rises: `course` is Figure 2, middle.
"""

import numpy as np
from jaxtyping import Array, Bool, Float, Key

from sketchtree.matting.alpha import Matte
from sketchtree.matting.closed_form import factored, solved
from sketchtree.matting.laplacian import laplacian, volume
from sketchtree.matting.scribbles import Scribbles
from sketchtree.photo.photo import Photo
from sketchtree.watch import Pulse, no_pulse

STEPS = 10
_INNER = 4  # conjugate gradients of a step
_ENOUGH = 1e-5  # relative fall of f below which it has converged
_SHORTEST = 2.0**-12  # of a step


def normalised(photo: Photo, scribbles: Scribbles, *, key: Key[Array, ""], pulse: Pulse = no_pulse) -> Matte:
    """The normalised matte; `key` is not used. Its course is f(α) after each step, from the start on."""
    fore, back = scribbles.masks(photo)
    matrix, known = laplacian(photo.rgb / 255.0), fore | back
    pulse()
    factor = factored(matrix, known)
    start = solved(factor, fore)
    start[fore], start[back] = 1.0, 0.0
    alpha, course = least_ratio(matrix, volume(known.shape), start.ravel(), ~known.ravel(), factor.solve, pulse=pulse)
    return Matte(alpha.reshape(known.shape), "normalised", course)


def least_ratio(matrix, weight, alpha, free: Bool[np.ndarray, " pixel"], precondition, *, pulse: Pulse = no_pulse) -> tuple[Float[np.ndarray, " pixel"], tuple[float, ...]]:
    """(α, f after each step) from a start within 0 to 1; only free pixels move."""
    ratio, slope = _ratio(matrix, weight, alpha)
    course = [ratio]
    for _ in range(STEPS):
        pulse()
        moving = free & ~((alpha <= 0) & (slope >= 0)) & ~((alpha >= 1) & (slope <= 0))
        step = _newton(matrix, weight, ratio, slope, moving, precondition)
        alpha, found = _line(matrix, weight, alpha, step, ratio)
        fallen = (ratio - found) / max(ratio, 1e-30)
        ratio, slope = _ratio(matrix, weight, alpha)
        course.append(found)
        if fallen < _ENOUGH:
            break
    return alpha, tuple(course)


def _ratio(matrix, weight, alpha) -> tuple[float, Float[np.ndarray, " pixel"]]:
    """(f, (L − f D) α): the second is f's gradient times half its denominator."""
    product, heavy = matrix @ alpha, weight * alpha
    ratio = float(alpha @ product) / max(float(alpha @ heavy), 1e-30)
    return ratio, product - ratio * heavy


def _newton(matrix, weight, ratio: float, slope, moving, precondition) -> Float[np.ndarray, " pixel"]:
    """About the minimiser of ½ xᵀ(L − f D)x + slopeᵀx over the moving pixels, or a direction that falls where there is none."""
    residual = np.where(moving, -slope, 0.0)
    found = np.zeros_like(residual)
    ready = np.where(moving, precondition(residual), 0.0)
    if float(residual @ ready) <= 0:  # the factors of a nearly singular system may be too inexact to precondition with
        scale = np.maximum(matrix.diagonal(), 1e-6)

        def precondition(right):
            return right / scale

        ready = np.where(moving, residual / scale, 0.0)
    search, size = ready, float(residual @ ready)
    least = 1e-6 * size
    for k in range(_INNER):
        if size <= least or size <= 0:
            break
        product = np.where(moving, matrix @ search - ratio * weight * search, 0.0)
        curve = float(search @ product)
        if curve <= 0:
            return search if k == 0 else found
        found = found + size / curve * search
        residual = residual - size / curve * product
        ready = np.where(moving, precondition(residual), 0.0)
        size, before = float(residual @ ready), size
        search = ready + size / before * search
    return found


def _line(matrix, weight, alpha, step, ratio: float) -> tuple[Float[np.ndarray, " pixel"], float]:
    """The first point along the step, cut off at the bounds, where f is lower; the start if there is none."""
    reach = 1.0
    while reach >= _SHORTEST:
        there = np.clip(alpha + reach * step, 0.0, 1.0)
        found = _ratio(matrix, weight, there)[0]
        if found < ratio:
            return there, found
        reach /= 2
    return alpha, ratio
