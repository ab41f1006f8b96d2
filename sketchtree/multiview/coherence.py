"""How likely is a plane, when other photos' depths are asked too?

Guo et al. 2018, Eq. 3:   L(p, (d_i, n_i)) = Σ_i' m(p, (d_i, n_i)) m_v(p, p', (d_i', n_i'))

    m     here how alike the patches are: 1 − the cost, 0 at least
    m_v   how well the other photo agrees: p goes over to p' by its own plane and comes back by the plane that the other photo has there, e pixels beside;
          m_v = exp(−e² / 2σ²), our reading of "similar to [60]"
    L     the sum over `ENOUGH` photos, 1 at most (ours: so many suffice, since the rest may be hidden)
"""

import numpy as np

from sketchtree.multiview.compiled import compiled
from sketchtree.multiview.cost import SIDE, patch_of, source_cost

SIGMA = 1.0  # pixels
ENOUGH = 2  # photos
AGREES = 1.5  # pixels: so far beside, the other photo still sees the same


@compiled
def back_and_forth(x, y, rho, t, back, other_plane, other_used, width, height):
    """How many pixels beside itself a pixel comes back; 1e9 where the other photo shows nothing there."""
    px, py = x + 0.5, y + 0.5
    z = t[2, 0] * px + t[2, 1] * py + t[2, 2] + t[2, 3] * rho
    if z <= 1e-9:
        return 1e9
    u = (t[0, 0] * px + t[0, 1] * py + t[0, 2] + t[0, 3] * rho) / z
    v = (t[1, 0] * px + t[1, 1] * py + t[1, 2] + t[1, 3] * rho) / z
    if not (u >= 0.0 and v >= 0.0 and u < width and v < height):
        return 1e9
    iu, iv = int(u), int(v)
    if not other_used[iv, iu]:
        return 1e9
    there = other_plane[iv, iu, 0] + other_plane[iv, iu, 1] * (u - iu - 0.5) + other_plane[iv, iu, 2] * (v - iv - 0.5)
    z = back[2, 0] * u + back[2, 1] * v + back[2, 2] + back[2, 3] * there
    if z <= 1e-9:
        return 1e9
    du = (back[0, 0] * u + back[0, 1] * v + back[0, 2] + back[0, 3] * there) / z - px
    dv = (back[1, 0] * u + back[1, 1] * v + back[1, 2] + back[1, 3] * there) / z - py
    return np.sqrt(du * du + dv * dv)


@compiled
def likelihood(grey, used, plane, transfers, backs, others, other_planes, other_used, sizes, step, likely, agreeing):
    """Fill Eq. 3 for the planes of all used pixels, and how many other photos agree with each."""
    height, width = grey.shape
    weight, value = np.empty(SIDE * SIDE, np.float32), np.empty(SIDE * SIDE, np.float32)
    for y in range(height):
        for x in range(width):
            likely[y, x], agreeing[y, x] = 0.0, 0
            if not used[y, x] or plane[y, x, 0] <= 0.0:
                continue
            total, mean, variance, middle = patch_of(grey, x, y, step, weight, value)
            rho, across, down = plane[y, x, 0], plane[y, x, 1], plane[y, x, 2]
            found = 0.0
            for k in range(len(others)):
                e = back_and_forth(x, y, rho, transfers[k], backs[k], other_planes[k], other_used[k], sizes[k, 0], sizes[k, 1])
                if e < 4.0 * SIGMA:
                    m = 1.0 - source_cost(x, y, rho, across, down, transfers[k], others[k], sizes[k, 0], sizes[k, 1], step, weight, value, total, mean, variance, middle)
                    found += max(m, 0.0) * np.exp(-e * e / (2.0 * SIGMA * SIGMA))
                if e < AGREES:
                    agreeing[y, x] += 1
            likely[y, x] = min(1.0, found / ENOUGH)
