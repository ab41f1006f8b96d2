"""Which trees have a depth we know? Three families grown by rules of other people, and measured trees.

None is drawn from the prior that inference uses: there is no Θ here, only growth.

    weber_penn     levels of curved stems, down angle, rotation, length by crown shape
                   (after Weber & Penn 1995, "Creation and rendering of realistic trees")
    colonised      stems that compete for points scattered in a crown envelope
                   (after Runions, Lane & Prusinkiewicz 2007, "Modeling trees with a space colonization algorithm")
    conifer        a straight trunk with whorls of near-horizontal limbs, sprays in their planes
    measured       digitised trees: nodes, parents and radii from a file

Each is called with a `numpy.random.Generator` that also draws the species' own parameters, and
returns a `TreeSkeleton` about one unit high, its base at the origin, limbs and orders filled in.
"""

from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import children, generations, is_tip, sum_to_root

UP = np.array([0.0, 1.0, 0.0])
_THIN = 1e-3  # smallest radius, tree heights


class _Rows:
    """Rows of a skeleton while it grows."""

    def __init__(self):
        self.parent, self.tip, self.radius, self.limb, self.order = [NULL], [np.zeros(3)], [0.02], [0], [0]

    def stem(self, at: int, points, radius, limb: int, order: int) -> np.ndarray:
        """Appends a chain of points that grows from row `at`; returns its rows."""
        first = len(self.parent)
        rows = np.arange(first, first + len(points))
        self.parent += [at, *rows[:-1].tolist()]
        self.tip += list(points)
        self.radius += list(np.maximum(radius, _THIN))
        self.limb += [limb] * len(points)
        self.order += [order] * len(points)
        return rows

    def skeleton(self) -> TreeSkeleton:
        return TreeSkeleton.from_columns(self.parent, np.array(self.tip), self.radius, limb=self.limb, order=self.order)


def _perpendicular(direction, azimuth):
    """A unit vector square to `direction`, turned by `azimuth` about it."""
    side = np.cross(direction, [0.0, 0.0, 1.0] if abs(direction[2]) < 0.9 else [1.0, 0.0, 0.0])
    side /= np.linalg.norm(side)
    return np.cos(azimuth) * side + np.sin(azimuth) * np.cross(direction, side)


def _stem_points(rng, start, direction, length, steps, wander, rise):
    """A curved stem: each step turns by a random `wander` and leans up (`rise` > 0) or down."""
    points, d = [], np.array(direction)
    for _ in range(steps):
        d = d + wander / np.sqrt(steps) * rng.normal(size=3) + rise / steps * UP
        d /= np.linalg.norm(d)
        start = start + d * length / steps
        points.append(start)
    return np.array(points)


# ------------------------------------------------------------------ Weber-Penn-like

_SHAPES = {  # length of a first-order limb by its relative height in the crown (0 base, 1 top)
    "conical": lambda t: 0.2 + 0.8 * (1 - t),
    "spherical": lambda t: 0.2 + 0.8 * np.sin(np.pi * (0.12 + 0.85 * t)),
    "hemispherical": lambda t: 0.2 + 0.8 * np.sin(0.5 * np.pi * (1 - 0.92 * t)),
    "cylindrical": lambda t: 0.8 + 0.2 * (1 - t),
    "flame": lambda t: 0.3 + 0.7 * np.where(t < 0.3, t / 0.3, (1 - t) / 0.7),
}


def weber_penn(rng: np.random.Generator) -> TreeSkeleton:
    """Three levels of stems with down angles, rotations and lengths of a random species."""
    rows = _Rows()
    shape = _SHAPES[rng.choice(sorted(_SHAPES))]
    bare, count = rng.uniform(0.1, 0.35), int(rng.integers(12, 30))
    down = np.radians(rng.uniform([38, 32], [78, 62]))  # per level 1, 2
    down_spread = np.radians(rng.uniform(4, 12, 2))
    turn = np.radians(rng.choice([137.5, 140.0, 90.0, 180.0], p=[0.5, 0.2, 0.15, 0.15]))
    reach = rng.uniform([0.3, 0.25], [0.55, 0.5])  # longest child / parent
    rise = rng.uniform(-0.35, 0.7)
    girth = rng.uniform(0.014, 0.03)
    trunk = _stem_points(rng, np.zeros(3), UP, 1.0, 24, rng.uniform(0.02, 0.18), 0.15)
    trunk_rows = rows.stem(0, trunk, girth * (1 - 0.93 * np.arange(1, 25) / 24), 0, 0)
    azimuth, limb = rng.uniform(0, 2 * np.pi), 0
    at_trunk = np.unique(np.clip(np.sort(np.round(24 * np.linspace(bare, 0.97, count))).astype(int), 1, 23))
    for host in at_trunk:
        t = (host / 24 - bare) / (1 - bare)
        azimuth += turn + rng.normal(0, 0.25)
        limb += 1
        length = reach[0] * shape(np.clip(t, 0, 1)) * rng.uniform(0.8, 1.15)
        tilt = down[0] * (1.15 - 0.4 * t) + down_spread[0] * rng.normal()
        parts = (trunk_rows, host, azimuth, tilt, length)
        first = _side_stem(rng, rows, *parts, limb=limb, order=1, rise=rise, steps=10, wander=rng.uniform(0.08, 0.3))
        limb = _second_level(rng, rows, first, limb, length, reach[1], down[1], down_spread[1], rise)
    return rows.skeleton()


def _side_stem(rng, rows, host_rows, host, azimuth, tilt, length, *, limb, order, rise, steps, wander):
    row = int(host_rows[host])
    along = rows.tip[row] - rows.tip[rows.parent[row]]
    along = along / np.linalg.norm(along)
    out = np.cos(tilt) * along + np.sin(tilt) * _perpendicular(along, azimuth)
    points = _stem_points(rng, rows.tip[row], out, length, steps, wander, rise)
    thick = min(0.7 * rows.radius[row], 0.03 * length)
    return rows.stem(row, points, thick * (1 - 0.9 * np.arange(1, steps + 1) / steps), limb, order)


def _second_level(rng, rows, host_rows, limb, length, reach, down, spread, rise):
    azimuth = rng.uniform(0, 2 * np.pi)
    for host in np.unique(np.round(np.linspace(2, len(host_rows) - 2, rng.integers(3, 8))).astype(int)):
        azimuth += np.radians(140) + rng.normal(0, 0.4)
        limb += 1
        own = length * reach * (1.1 - 0.7 * host / len(host_rows)) * rng.uniform(0.7, 1.2)
        parts = (host_rows, host, azimuth, down + spread * rng.normal(), own)
        _side_stem(rng, rows, *parts, limb=limb, order=2, rise=rise, steps=6, wander=0.2)
    return limb


# ------------------------------------------------------------------ whorled conifer


def conifer(rng: np.random.Generator) -> TreeSkeleton:
    """Whorls of 3-6 limbs on a straight trunk; twigs left and right in each limb's plane."""
    rows = _Rows()
    steps = int(rng.integers(14, 26))
    trunk = _stem_points(rng, np.zeros(3), UP, 1.0, steps, rng.uniform(0.005, 0.04), 0.3)
    girth = rng.uniform(0.012, 0.025)
    trunk_rows = rows.stem(0, trunk, girth * (1 - 0.95 * np.arange(1, steps + 1) / steps), 0, 0)
    per_whorl, width, taper = int(rng.integers(3, 7)), rng.uniform(0.2, 0.42), rng.uniform(0.6, 1.1)
    top, bottom = np.radians(rng.uniform([40, 72], [65, 100]))  # divergence from the trunk
    sag, limb, phase = rng.uniform(-0.45, 0.35), 0, rng.uniform(0, 2 * np.pi)
    twig_tilt, twig_reach = np.radians(rng.uniform(40, 62)), rng.uniform(0.3, 0.5)
    for host in range(int(steps * rng.uniform(0.08, 0.25)), steps - 1):
        t = host / steps
        phase += np.pi / per_whorl + rng.normal(0, 0.25)
        for k in range(per_whorl):
            limb += 1
            length = width * (1 - t) ** taper * rng.uniform(0.75, 1.15) + 0.02
            tilt = bottom + (top - bottom) * t + rng.normal(0, 0.08)
            parts = (trunk_rows, host, phase + 2 * np.pi * k / per_whorl + rng.normal(0, 0.12), tilt, length)
            own = _side_stem(rng, rows, *parts, limb=limb, order=1, rise=sag, steps=8, wander=0.08)
            limb = _spray(rng, rows, own, limb, length * twig_reach, twig_tilt)
    return rows.skeleton()


def _spray(rng, rows, host_rows, limb, reach, tilt):
    """Twigs of a limb, alternately left and right in the plane it spans with the horizontal."""
    for host in range(2, len(host_rows) - 1):
        row = int(host_rows[host])
        along = rows.tip[row] - rows.tip[rows.parent[row]]
        along = along / np.linalg.norm(along)
        side = np.cross(along, UP)
        side /= np.linalg.norm(side) + 1e-12
        limb += 1
        own = tilt + rng.normal(0, 0.1)
        out = np.cos(own) * along + np.sin(own) * (1 if host % 2 else -1) * side + rng.normal(0, 0.06, 3)
        length = reach * (1.1 - host / len(host_rows)) * rng.uniform(0.7, 1.2)
        points = _stem_points(rng, rows.tip[row], out / np.linalg.norm(out), length, 4, 0.06, 0.0)
        rows.stem(row, points, 0.3 * rows.radius[row] * np.linspace(1, 0.2, 4), limb, 2)
    return limb


# ------------------------------------------------------------------ space colonisation


def colonised(rng: np.random.Generator) -> TreeSkeleton:
    """A tree that grew towards the points of a random crown envelope."""
    points = _envelope(rng, 900)
    step = rng.uniform(0.022, 0.032)
    bare = points[:, 1].min()
    lean = rng.normal(0, 0.06, 3) * [1, 0, 1]
    count = max(2, int(np.ceil((bare + 0.05) / step)))
    tip = [np.zeros(3)] + [(k + 1) * step * (UP + lean) for k in range(count)]
    parent = [NULL] + list(range(count))
    grown, origin = _colonise(rng, np.array(tip), np.array(parent), points, step)
    return _tidy(grown, origin, shortest=2.5 * step)


def _envelope(rng, count):
    """Points spread in a crown: an ellipsoid, a cone or a dome of random proportions."""
    low, width = rng.uniform(0.15, 0.35), rng.uniform([0.18, 0.8], [0.42, 1.25])
    kind = rng.choice(["ellipsoid", "cone", "dome"])
    t, radius = rng.uniform(0, 1, 6 * count), np.sqrt(rng.uniform(0.02, 1, 6 * count))
    half = {"ellipsoid": 2 * np.sqrt(t * (1 - t)), "cone": 1 - t, "dome": np.sqrt(1 - t**2)}[kind]
    keep = np.flatnonzero(rng.uniform(0, 1, 6 * count) < half**2)[:count]
    t, radius, half = t[keep], (radius * half)[keep], half[keep]
    turn = rng.uniform(0, 2 * np.pi, len(t))
    x, z = width[0] * radius * np.cos(turn), width[0] * width[1] * radius * np.sin(turn)
    return np.c_[x, low + (1 - low) * t, z]


def _colonise(rng, tip, parent, points, step, kill=2.0, influence=12.0):
    for _ in range(120):
        distance, nearest = cKDTree(tip).query(points)
        alive = distance > kill * step
        points, distance, nearest = points[alive], distance[alive], nearest[alive]
        pull = distance < influence * step
        if not pull.any():
            break
        toward = (points[pull] - tip[nearest[pull]]) / distance[pull, None]
        summed = np.zeros_like(tip)
        np.add.at(summed, nearest[pull], toward)
        active = np.unique(nearest[pull])
        d = summed[active] + 0.1 * rng.normal(size=(len(active), 3)) + 0.15 * UP
        new = tip[active] + step * d / np.linalg.norm(d, axis=1, keepdims=True)
        fresh = cKDTree(tip).query(new)[0] > 0.3 * step
        if not fresh.any():
            break
        tip, parent = np.concatenate([tip, new[fresh]]), np.concatenate([parent, active[fresh]])
    return tip, parent


def _tidy(tip, parent, shortest):
    """Limbs by the strongest continuation, twigs shorter than `shortest` dropped, pipe-model radii."""
    tree = with_limbs(parent, tip, np.ones(len(tip)))
    length = np.bincount(tree.limb, tree.length)
    lost = (length < shortest)[tree.limb] & (tree.order > 0)
    for rows in generations(tree.parent)[1:]:
        lost[rows] |= lost[tree.parent[rows]]
    tree = tree.select(~lost)
    leaves = sum_to_root(tree.parent, is_tip(tree.parent).astype(float))
    return with_limbs(tree.parent, tree.tip, np.maximum(0.022 * (leaves / leaves[0]) ** 0.45, _THIN))


# ------------------------------------------------------------------ measured trees


def measured(path: str | Path) -> TreeSkeleton:
    """A digitised tree: an .npz with `parent`, `pos` (y up) and `radius` (NaN where unknown), scaled to height 1."""
    with np.load(path) as file:
        parent, tip, radius = file["parent"].astype(int), file["pos"].astype(float), file["radius"].astype(float)
    scale = 1 / np.ptp(tip[:, 1])
    radius = np.where(np.isfinite(radius), radius, np.nanmedian(radius))
    return with_limbs(parent, (tip - tip[0]) * scale, np.maximum(radius * scale, 1e-5))


def with_limbs(parent, tip, radius) -> TreeSkeleton:
    """A skeleton whose limbs follow, at every fork, the child with the longest and straightest way on."""
    start = np.where(parent[:, None] == NULL, tip, tip[parent])
    vector = tip - start
    length = np.linalg.norm(vector, axis=1)
    reach = length.copy()
    for rows in reversed(generations(parent)[1:]):
        np.maximum.at(reach, parent[rows], length[parent[rows]] + reach[rows])
    unit = vector / np.maximum(length, 1e-12)[:, None]
    straight = np.einsum("sa,sa->s", unit, unit[parent])
    score = reach * (1.2 + np.where(length[parent] > 0, straight, 0.0))
    child, begin = children(parent)
    limb, order, count = np.zeros(len(parent), int), np.zeros(len(parent), int), 1
    for row in range(len(parent)):
        own = child[begin[row] : begin[row + 1]]
        if len(own) == 0:
            continue
        apical = own[np.argmax(score[own])]
        for c in own:
            limb[c], order[c] = (limb[row], order[row]) if c == apical else (count, order[row] + 1)
            count += c != apical
    return TreeSkeleton.from_columns(parent, tip, radius, limb=limb, order=order)


FAMILIES = {"weber_penn": weber_penn, "colonised": colonised, "conifer": conifer}
