"""Which slanted plane does every pixel show? PatchMatch stereo (Bleyer et al. 2011) over several photos, with the paper's energy.

Guo et al. 2018, Eq. 2:   E₁(d, n) = τ ∫ m(p, (d, n)) dp + λ ∫ |d_Ω(p) − d(p)| dp

    m      photo-consistency (`cost`), the mean of the two best photos        τ = 1
    d_Ω    depth of the plane of p's segment (`segments`), in inverse depth, as a share of the range sought, 1 % of it or more counting alike (ours)
    λ      `PRIOR`; where a segment has no plane there is no second term

A pixel tries the planes of eight neighbours at odd distances, that of its segment, its own with a little changed, and new ones. Pixels of one colour of a
chessboard only look at the other colour's, so that all of them may be worked on at once. Numbers by chance follow from the seed, the pixel and the round alone.
"""

import numpy as np

from sketchtree.multiview.compiled import compiled
from sketchtree.multiview.cost import SIDE, mean_of_best, patch_of, source_cost

PRIOR = 0.15  # λ
REACH = 0.01  # of the range: as far off the segment's plane as counts
SAME = 2e-6  # of the range: a neighbour's plane that is no other, handed on before
IMPOSSIBLE = 4.0  # energy of a plane outside the range, or too steep
STEEPEST = 2.5  # tangent of a plane's slant
NEIGHBOURS = np.array([(1, 0), (-1, 0), (0, 1), (0, -1), (5, 0), (-5, 0), (0, 5), (0, -5)])


@compiled
def chance(seed, x, y, draw):
    """A number in [0, 1) for a pixel and a draw (splitmix64)."""
    z = np.uint64(seed) + np.uint64(x) * np.uint64(0x9E3779B97F4A7C15) + np.uint64(y) * np.uint64(0xC2B2AE3D27D4EB4F) + np.uint64(draw) * np.uint64(0x165667B19E3779F9)
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    z = z ^ (z >> np.uint64(31))
    return float(z >> np.uint64(11)) * 2.0**-53


@compiled
def energy_of(x, y, rho, across, down, low, high, focal, prior, transfers, others, sizes, step, best, weight, value, total, mean, variance, middle, costs, bound):
    """The integrand of Eq. 2 for one plane at one pixel; where it can't be less than `bound`, anything that is not less."""
    limit = STEEPEST * rho / focal
    if rho < low or rho > high or across * across + down * down > limit * limit:
        return IMPOSSIBLE
    second = PRIOR * min(abs(prior - rho) / (REACH * (high - low)), 1.0) if prior > 0.0 else 0.0
    last, least = len(costs) - 1, 2.0
    for k in range(len(costs)):
        if second + (0.0 if k < last or best < 2 else least / best) >= bound:
            return IMPOSSIBLE
        costs[k] = source_cost(x, y, rho, across, down, transfers[k], others[k], sizes[k, 0], sizes[k, 1], step, weight, value, total, mean, variance, middle)
        least = min(least, costs[k])
    return second + mean_of_best(costs, best)


@compiled
def sweep(colour, first, last, grey, used, plane, energy, prior, low, high, focal, transfers, others, sizes, step, best, spread, fresh, seed):
    """Improve the planes of the used pixels of one colour of the chessboard in rows `first` to `last`.

    `spread`: how much of the range is tried round what is there; `fresh`: how many new planes are tried.
    """
    height, width = grey.shape
    weight, value, costs = np.empty(SIDE * SIDE, np.float32), np.empty(SIDE * SIDE, np.float32), np.empty(len(others))
    for y in range(first, last):
        for x in range((y + colour) % 2, width, 2):
            if not used[y, x]:
                continue
            total, mean, variance, middle = patch_of(grey, x, y, step, weight, value)
            own = prior[y, x, 0]
            r0, a0, d0 = plane[y, x, 0], plane[y, x, 1], plane[y, x, 2]
            same = SAME * (high - low)
            e0 = energy_of(x, y, r0, a0, d0, low, high, focal, own, transfers, others, sizes, step, best, weight, value, total, mean, variance, middle, costs, np.inf)
            for k in range(8 + 1 + 2 + fresh):
                if k < 8:
                    nx, ny = x + NEIGHBOURS[k, 0], y + NEIGHBOURS[k, 1]
                    if nx < 0 or ny < 0 or nx >= width or ny >= height or not used[ny, nx]:
                        continue
                    a, d = plane[ny, nx, 1], plane[ny, nx, 2]
                    r = plane[ny, nx, 0] + a * (x - nx) + d * (y - ny)
                    if abs(r - r0) < same and abs(a - a0) < 0.2 * same and abs(d - d0) < 0.2 * same:
                        continue
                elif k == 8:
                    if own <= 0.0:
                        continue
                    r, a, d = own, prior[y, x, 1], prior[y, x, 2]
                else:
                    one, two, three = chance(seed, x, y, 3 * k), chance(seed, x, y, 3 * k + 1), chance(seed, x, y, 3 * k + 2)
                    tilt = 2.0 * r0 / focal
                    if k == 9:
                        r, a, d = r0 + spread * (2 * one - 1) * (high - low), a0, d0
                    elif k == 10:
                        r, a, d = r0 + 0.1 * spread * (2 * one - 1) * (high - low), a0 + 0.5 * tilt * (two - 0.5), d0 + 0.5 * tilt * (three - 0.5)
                    else:
                        r, a, d = low + one * (high - low), tilt * (two - 0.5), tilt * (three - 0.5)
                e = energy_of(x, y, r, a, d, low, high, focal, own, transfers, others, sizes, step, best, weight, value, total, mean, variance, middle, costs, e0)
                if e < e0:
                    e0, r0, a0, d0 = e, r, a, d
            energy[y, x] = e0
            plane[y, x, 0], plane[y, x, 1], plane[y, x, 2] = r0, a0, d0


def starting(shape: tuple[int, int], low: float, high: float, generator: np.random.Generator) -> np.ndarray:
    """A plane by chance for every pixel, facing the camera."""
    plane = np.zeros((*shape, 3), np.float32)
    plane[..., 0] = generator.uniform(low, high, shape)
    return plane


def finer(plane: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """The planes of a coarser picture for a finer one: each pixel has that of the pixel it lies in."""
    rows, columns = ((np.arange(fine) + 0.5) * coarse / fine for fine, coarse in zip(shape, plane.shape, strict=False))
    y, x = np.minimum(rows.astype(int), plane.shape[0] - 1), np.minimum(columns.astype(int), plane.shape[1] - 1)
    found = plane[y[:, None], x[None]].copy()
    found[..., 0] += found[..., 1] * (columns - x - 0.5)[None] + found[..., 2] * (rows - y - 0.5)[:, None]
    found[..., 1] *= plane.shape[1] / shape[1]
    found[..., 2] *= plane.shape[0] / shape[0]
    return found
