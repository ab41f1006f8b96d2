"""Which depth of several suggested ones does every pixel have? The paper's refinement by geometric coherence, with a term between neighbours that is ours.

Guo et al. 2018, Eq. 4:   E₂(p, (d, n)) = ∫ (1 − u(p) L(p, (d_i, n_i))) dp

    u   whether the pixel is used (`workplace`)       L   Eq. 3 (`coherence`)

As printed it has no term between neighbours, so that a cut would have nothing to weigh; we add

    λ Σ_pq w_pq min(|Δdisparity|, τ)        w_pq = exp(−|ΔI| / σ_I),   λ = .06, τ = 2 px, disparity in pixels of the median partner

Δ is taken between the planes of the two pixels where these meet, halfway, so that a slanted limb costs nothing.

Suggested are, one after the other, what the partners' depth maps say when carried over, the planes of segments, the likeliest plane within two pixels, and a
running median; each is mixed in by a fusion move. So the energy falls from move to move.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int
from scipy.ndimage import median_filter

from sketchtree.multiview.coherence import likelihood
from sketchtree.multiview.moves import fused, truncated
from sketchtree.multiview.segments import planes_of
from sketchtree.multiview.workplace import Level, Partners, block

SMOOTH, TAU, EDGE = 0.06, 2.0, 0.08  # λ, τ (pixels), σ_I (brightness)
_SAME = 0.05  # pixels of disparity: nearer suggestions are no suggestions


def disparity_unit(level: Level, levels: list[Level]) -> float:
    """The inverse depth that moves a pixel by one in the picture of the median partner."""
    middle = np.array([0.5 * level.camera.size[0], 0.5 * level.camera.size[1]])
    rho = 0.5 * (level.sources.low + level.sources.high)
    moved = []
    for row in level.sources.rows:
        pixel = [levels[row].camera.project(level.camera.unproject(middle[None], np.array([1.0 / r])))[0][0] for r in (0.99 * rho, 1.01 * rho)]
        moved.append(np.linalg.norm(pixel[1] - pixel[0]) / (0.02 * rho))
    return 1.0 / max(float(np.median(moved)), 1e-12)


def scored(level: Level, levels: list[Level], near: Partners, plane: Float[np.ndarray, "row column 3"], step: int, used=None) -> tuple[np.ndarray, np.ndarray]:
    """(L of every pixel for those planes, how many partners agree). `used`: pixels to do it for; 0 elsewhere."""
    others = [levels[row] for row in level.sources.rows]
    likely, agreeing = np.zeros(level.shape, np.float32), np.zeros(level.shape, np.int64)
    likelihood(
        level.grey, level.used if used is None else used, plane, near.transfers, near.backs, near.others, block([other.plane for other in others]), block([other.used for other in others]),
        near.sizes, step, likely, agreeing,
    )
    return likely, agreeing


def refined(level: Level, levels: list[Level], near: Partners, label: np.ndarray, step: int) -> tuple[np.ndarray, list[float]]:
    """(planes of less energy Eq. 4, the energy before and after every move). The partners' planes are taken as they are."""
    pixel = disparity_unit(level, levels)
    plane = level.plane.copy()
    likely, _ = scored(level, levels, near, plane, step)
    links = _links(level)
    halfway = _halfway(plane, level.used, links)
    own = links.weight * truncated((halfway[0] - halfway[1]) / pixel, TAU)
    energies = [float((1.0 - likely[level.used]).sum() + SMOOTH * own.sum())]
    for suggestion in _suggestions(level, levels, plane, likely, label):
        other = suggestion(plane, likely)
        other[..., 0] = np.where(other[..., 0] > 0, other[..., 0], plane[..., 0])
        another = level.used & (other != plane).any(axis=2)
        score = np.where(another, scored(level, levels, near, other, step, another)[0], likely)
        differs = level.used & (np.abs(other[..., 0] - plane[..., 0]) > _SAME * pixel) | level.used & (score > likely + 0.02)
        takes, fall = _move(plane, likely, other, score, level.used, differs, links, pixel)
        plane[takes], likely[takes] = other[takes], score[takes]
        energies.append(energies[-1] - fall)
    return plane, energies


class _Links(NamedTuple):
    """Neighbouring used pixels."""

    pairs: Int[np.ndarray, "pair 2"]  # by their number among the used pixels
    weight: Float[np.ndarray, " pair"]  # w_pq
    step: Float[np.ndarray, "pair 2"]  # from the first halfway to the second, columns and rows


def _links(level: Level) -> _Links:
    node = np.cumsum(level.used.ravel()).reshape(level.shape) - 1
    columns = []
    for one, two, step in ((np.s_[:, :-1], np.s_[:, 1:], (0.5, 0.0)), (np.s_[:-1], np.s_[1:], (0.0, 0.5))):
        both = level.used[one] & level.used[two]
        weight = np.exp(-np.abs(level.grey[one] - level.grey[two])[both] / EDGE).astype(np.float64)
        columns.append((np.column_stack([node[one][both], node[two][both]]), weight, np.tile(step, (len(weight), 1))))
    return _Links(*(np.concatenate(column) for column in zip(*columns, strict=True)))


def _halfway(plane, used, links: _Links) -> tuple[np.ndarray, np.ndarray]:
    """The inverse depths of the planes of each pair where the two pixels meet."""
    own = plane[used].astype(np.float64)
    first, second = own[links.pairs[:, 0]], own[links.pairs[:, 1]]
    return first[:, 0] + (first[:, 1:] * links.step).sum(axis=1), second[:, 0] - (second[:, 1:] * links.step).sum(axis=1)


def _move(plane, likely, other, score, used, differs, links: _Links, pixel: float):
    """Where a fusion move takes the other plane, and by how much the energy falls. Pixels at which the two are the same stand still and pull at their neighbours."""
    if not differs.any():
        return differs, 0.0
    at = differs[used]
    row = np.cumsum(at) - 1
    unary = np.stack([1.0 - likely[differs], 1.0 - score[differs]], axis=1).astype(np.float64)
    first, second = zip(_halfway(plane, used, links), _halfway(np.where(differs[..., None], other, plane), used, links), strict=True)
    cost = np.stack([[truncated((one - two) / pixel, TAU) for two in second] for one in first]).transpose(2, 0, 1) * (SMOOTH * links.weight)[:, None, None]
    left, right = links.pairs.T
    inner = at[left] & at[right]
    for moving, still, of in ((left, right, np.s_[:, :, 0]), (right, left, np.s_[:, 0, :])):
        edge = at[moving] & ~at[still]
        np.add.at(unary, row[moving[edge]], cost[edge][of])
    takes, fall = fused(unary, np.column_stack([row[left[inner]], row[right[inner]]]), cost[inner])
    found = np.zeros(differs.shape, bool)
    found[differs] = takes
    return found, fall


def _suggestions(level: Level, levels: list[Level], plane, likely, label):
    """Each a function of the planes and their likelihoods so far."""
    for row in level.sources.rows:
        yield lambda now, _, other=levels[row]: carried_over(other, level, now)
    yield lambda now, score: planes_of(label, now, 1.0 - score, level.sources.low, level.sources.high)
    yield lambda now, score: likeliest(now, score, 2)
    yield lambda now, score: _median(now, score)


def carried_over(other: Level, level: Level, now: Float[np.ndarray, "row column 3"]) -> Float[np.ndarray, "row column 3"]:
    """What another view's depth map says at the pixels of this one: the nearest place, with the slant that is there now; 0 where it says nothing."""
    rows, columns = np.nonzero(other.used & (other.plane[..., 0] > 0))
    pixel, depth = level.camera.project(other.camera.unproject(np.column_stack([columns, rows]) + 0.5, 1.0 / other.plane[rows, columns, 0]))
    held = level.camera.holds(pixel, depth)
    x, y = pixel[held].astype(int).T
    found = now.copy()
    found[..., 0] = 0.0
    np.maximum.at(found[..., 0], (y, x), (1.0 / depth[held]).astype(np.float32))
    return found


def likeliest(plane: Float[np.ndarray, "row column 3"], likely: Float[np.ndarray, "row column"], radius: int) -> Float[np.ndarray, "row column 3"]:
    """At every pixel the plane of the likeliest pixel within so many rows and columns, carried on to it."""
    height, width = likely.shape
    best, found = likely.copy(), plane.copy()
    for dy in range(-radius, radius + 1):
        for dx in range(-radius, radius + 1):
            to = np.s_[max(dy, 0) : height + min(dy, 0), max(dx, 0) : width + min(dx, 0)]
            of = np.s_[max(-dy, 0) : height + min(-dy, 0), max(-dx, 0) : width + min(-dx, 0)]
            better = likely[of] > best[to]
            moved = plane[of].copy()
            moved[..., 0] += dx * moved[..., 1] + dy * moved[..., 2]
            found[to][better], best[to][better] = moved[better], likely[of][better]
    return found


def _median(plane, likely):
    found = plane.copy()
    found[..., 0] = median_filter(np.where(likely > 0.2, plane[..., 0], 0.0), 5)
    return found
