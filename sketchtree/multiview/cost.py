"""How unlike are the patch around a pixel and what another photo shows of the same slanted plane?

The photo-consistency cost m of Guo et al. 2018, Eq. 2, is that of their [59], the normalised correlation of a patch; its pixels count by how near and how alike
in brightness they are to the middle one (bilateral weights, Schönberger et al. 2016), so that a twig's patch is the twig and not the sky behind it:

    m = 1 − cov_w(p, q) / √(var_w(p) var_w(q))  ∈ [0, 2]        w_k = exp(−Δgrey² / 2σ_g² − Δxy² / 2σ_x²)

q is p's patch carried over by Eq. 1. A patch of even brightness says nothing: m = 1. Of several photos the mean of the `best` lowest counts, since some don't
see the place.
"""

import numpy as np

from sketchtree.multiview.compiled import compiled

GREY = 0.06  # σ_g, brightness 0-1
EVEN = 4e-5  # variance of brightness under which a patch is even
UNSEEN = 1.5  # cost where the other photo does not show the place
SIDE = 5  # samples across a patch


@compiled
def patch_of(grey, x, y, step, weight, value):
    """Fill weights and brightness of the samples around a pixel, `step` pixels apart; (sum of weights, mean, variance)."""
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
                other = grey[yy, xx]
                w = np.exp(-((other - middle) ** 2) / (2 * GREY * GREY) - (i * i + j * j) / (2.0 * half * half))
                weight[k], value[k] = w, other
                total += w
                mean += w * other
                square += w * other * other
            k += 1
    mean /= total
    return total, mean, square / total - mean * mean


@compiled
def source_cost(x, y, rho, across, down, t, other, width, height, step, weight, value, total, mean, variance):
    """m of one other photo for the plane (rho, across, down) at pixel (x, y); `t`: [A | b] of the pair."""
    half = SIDE // 2
    px, py = x + 0.5, y + 0.5
    q0 = t[0, 0] * px + t[0, 1] * py + t[0, 2] + t[0, 3] * rho
    q1 = t[1, 0] * px + t[1, 1] * py + t[1, 2] + t[1, 3] * rho
    q2 = t[2, 0] * px + t[2, 1] * py + t[2, 2] + t[2, 3] * rho
    a0, a1, a2 = t[0, 0] + t[0, 3] * across, t[1, 0] + t[1, 3] * across, t[2, 0] + t[2, 3] * across
    d0, d1, d2 = t[0, 1] + t[0, 3] * down, t[1, 1] + t[1, 3] * down, t[2, 1] + t[2, 3] * down
    s, ss, rs = 0.0, 0.0, 0.0
    k = 0
    for j in range(-half, half + 1):
        for i in range(-half, half + 1):
            w = weight[k]
            if w > 0.0:
                dx, dy = i * step, j * step
                z = q2 + dx * a2 + dy * d2
                if z <= 1e-9:
                    return UNSEEN
                u = (q0 + dx * a0 + dy * d0) / z - 0.5
                v = (q1 + dx * a1 + dy * d1) / z - 0.5
                if not (u >= 0.0 and v >= 0.0 and u < width - 1 and v < height - 1):
                    return UNSEEN
                iu, iv = int(u), int(v)
                fu, fv = u - iu, v - iv
                top = other[iv, iu] + fu * (other[iv, iu + 1] - other[iv, iu])
                low = other[iv + 1, iu] + fu * (other[iv + 1, iu + 1] - other[iv + 1, iu])
                value_there = top + fv * (low - top)
                s += w * value_there
                ss += w * value_there * value_there
                rs += w * value_there * value[k]
            k += 1
    s /= total
    spread = ss / total - s * s
    if spread < EVEN or variance < EVEN:
        return 1.0
    return 1.0 - (rs / total - s * mean) / np.sqrt(spread * variance)


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
