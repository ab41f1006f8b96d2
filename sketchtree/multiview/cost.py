"""How unlike are the patch around a pixel and what another photo shows of the same slanted plane?

The photo-consistency cost m of Guo et al. 2018, Eq. 2, is that of their [59], the normalised correlation of a patch; its pixels count by how near and how alike
in brightness they are to the middle one (bilateral weights, Schönberger et al. 2016), so that a twig's patch is the twig and not the sky behind it:

    m = 1 − cov_w(p, q) / √(var_w(p) var_w(q))  ∈ [0, 2]        w_k = exp(−Δgrey² / 2σ_g² − Δxy² / 2σ_x²)

q is p's patch carried over by Eq. 1. A patch of even brightness says nothing: m = 1; nor is one known that another photo doesn't show whole. Of several photos the mean of the `best`
lowest counts, since some don't see the place. So that single precision loses little, brightness is counted from that of the middle pixel (m does not change with it), and places in the
other photo from where the middle pixel goes, u_0:

    u − u_0 = (Δx a_0 + Δy d_0 − u_0 (Δx a_2 + Δy d_2)) / z
"""

import numpy as np

from sketchtree.multiview.compiled import compiled

GREY = 0.06  # σ_g, brightness 0-1
EVEN = 4e-5  # variance of brightness under which a patch is even
UNSEEN = 1.5  # cost where the other photo does not show the place
SIDE = 5  # samples across a patch
DOWN, ACROSS = (np.ascontiguousarray(side.ravel()) for side in np.mgrid[-(SIDE // 2) : SIDE // 2 + 1, -(SIDE // 2) : SIDE // 2 + 1].astype(np.float32))

_single = np.float32


@compiled
def patch_of(grey, x, y, step, weight, value):
    """Fill weights and brightness over that of the middle of the samples around a pixel, `step` pixels apart; (sum of weights, mean, variance, brightness of the middle)."""
    height, width = grey.shape
    half = SIDE // 2
    middle = grey[y, x]
    total, mean, square = 0.0, 0.0, 0.0
    k = 0
    for j in range(-half, half + 1):
        for i in range(-half, half + 1):
            yy, xx = y + j * step, x + i * step
            if yy < 0 or xx < 0 or yy >= height or xx >= width:
                weight[k], value[k] = 0.0, 0.0
            else:
                over = grey[yy, xx] - middle
                w = np.exp(-(over**2) / (2 * GREY * GREY) - (i * i + j * j) / (2.0 * half * half))
                weight[k], value[k] = w, over
                total += w
                mean += w * over
                square += w * over * over
            k += 1
    mean /= total
    return total, mean, square / total - mean * mean, middle


@compiled
def source_cost(x, y, rho, across, down, t, other, width, height, step, weight, value, total, mean, variance, middle):
    """m of one other photo for the plane (rho, across, down) at pixel (x, y); `t`: [A | b] of the pair."""
    px, py = x + 0.5, y + 0.5
    q0 = t[0, 0] * px + t[0, 1] * py + t[0, 2] + t[0, 3] * rho
    q1 = t[1, 0] * px + t[1, 1] * py + t[1, 2] + t[1, 3] * rho
    q2 = t[2, 0] * px + t[2, 1] * py + t[2, 2] + t[2, 3] * rho
    a0, a1, a2 = step * (t[0, 0] + t[0, 3] * across), step * (t[1, 0] + t[1, 3] * across), step * (t[2, 0] + t[2, 3] * across)
    d0, d1, d2 = step * (t[0, 1] + t[0, 3] * down), step * (t[1, 1] + t[1, 3] * down), step * (t[2, 1] + t[2, 3] * down)
    if q2 - _reach(a2, d2) <= 1e-9 or not (_inside(q0, q2, a0, a2, d0, d2, width) and _inside(q1, q2, a1, a2, d1, d2, height)):
        return UNSEEN
    u0, v0 = q0 / q2, q1 / q2
    ua, ud, va, vd = _single((a0 - u0 * a2) / q2), _single((d0 - u0 * d2) / q2), _single((a1 - v0 * a2) / q2), _single((d1 - v0 * d2) / q2)
    za, zd, left, upper = _single(a2 / q2), _single(d2 / q2), _single(u0 - 0.5), _single(v0 - 0.5)
    texels, one, row = other.reshape(-1), np.uint32(1), np.uint32(other.shape[1])
    s, ss, rs = _single(0.0), _single(0.0), _single(0.0)
    for k in range(SIDE * SIDE):  # without a branch and in single precision, so that several samples are taken at once
        i, j = ACROSS[k], DOWN[k]
        over = _single(1.0) / (_single(1.0) + i * za + j * zd)
        u, v = left + (i * ua + j * ud) * over, upper + (i * va + j * vd) * over
        iu, iv = np.int32(u), np.int32(v)
        fu, fv = u - _single(iu), v - _single(iv)
        at = np.uint32(iv) * row + np.uint32(iu)
        top = texels[at] + fu * (texels[at + one] - texels[at])
        low = texels[at + row] + fu * (texels[at + row + one] - texels[at + row])
        there = top + fv * (low - top) - middle
        weighted = weight[k] * there
        s += weighted
        ss += weighted * there
        rs += weighted * value[k]
    s /= total
    spread = ss / total - s * s
    if spread < EVEN or variance < EVEN:
        return 1.0
    return 1.0 - (rs / total - s * mean) / np.sqrt(spread * variance)


@compiled
def _reach(across, down):
    """How far a number that changes by so much from sample to sample gets from the middle of a patch."""
    return (SIDE // 2) * (abs(across) + abs(down))


@compiled
def _inside(q, q2, a, a2, d, d2, size):
    """Whether a patch lies between the first and the last texel along one side: 0 ≤ q / q2 − ½ < size − 1 at its corners, so everywhere."""
    far = size - 0.5
    return q - 0.5 * q2 - _reach(a - 0.5 * a2, d - 0.5 * d2) >= 0.0 and q - far * q2 + _reach(a - far * a2, d - far * d2) < 0.0


@compiled
def mean_of_best(costs, best):
    """The mean of the lowest few; the costs are sorted."""
    count = len(costs)
    for i in range(1, count):
        held = costs[i]
        j = i - 1
        while j >= 0 and costs[j] > held:
            costs[j + 1] = costs[j]
            j -= 1
        costs[j + 1] = held
    best = min(best, count)
    found = 0.0
    for i in range(best):
        found += costs[i]
    return found / best
