"""Which smooth line does each limb follow?

Chen et al. 2008, §5.3, last lines: cubic Bezier curves interpolate the shape of the branches. Between two
knots P_i, P_i+1 the control points are P_i, P_i + h m_i / 3, P_i+1 − h m_i+1 / 3, P_i+1, with

    h     |P_i+1 − P_i|^½                                (centripetal: no loop and no overshoot between knots)
    m_i   (h_i δ_i−1 + h_i−1 δ_i) / (h_i−1 + h_i),       δ_i = (P_i+1 − P_i) / h_i

The knots are the tips of the rows and, where the limb was drawn, the drawn points between, so the line passes
through all of them. An undrawn lateral leaves its parent at a smaller angle than its chord and bends outward.
Radii fall evenly along the line from one tip to the next; a limb drawn thick up to its end runs out into a twig (`tips`).
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.geometry.chains import Chains, chains
from sketchtree.geometry.tips import run_out
from sketchtree.skeleton import Kind, TreeSkeleton

_STEPS = 6  # points evaluated on each Bezier span
_LEAN = 0.45  # share of the parent's direction in that of an undrawn lateral where it starts
_EXPONENT = 2.3  # how a parent's wood is shared among the children at a fork
_WIDEST = 0.9  # a lateral is at most this share of its parent's radius
_STEEPEST = 0.25  # radius lost in one metre along any limb, at most
_SLOPE = 0.08  # steepest taper from a lateral's foot to its first tip, metres a metre


@dataclass(frozen=True, eq=False)
class CentreLines:
    """The centre line of every limb, as a fine polyline; ragged: limb i owns the points `start[i]:start[i + 1]`.

    Requirements: `s` rises strictly within a limb; the first point of a lateral lies on its parent's line.
    """

    start: Int[np.ndarray, " limb+1"]
    point: Float[np.ndarray, "point 3"]  # metres
    s: Float[np.ndarray, " point"]  # metres along the limb, 0 at its foot
    radius: Float[np.ndarray, " point"]  # metres
    curvature: Float[np.ndarray, " point"]  # 1 / metre
    pinned: Bool[np.ndarray, " point"]  # the tip of a drawn row, the foot or the tip of the limb: a ring stands here
    is_stem: Bool[np.ndarray, " limb"]  # starts on the ground
    parent: Int[np.ndarray, " limb"]  # limb it grows from; NULL for a stem
    parent_s: Float[np.ndarray, " limb"]  # where on its parent, metres from the parent's foot
    ground: Float[np.ndarray, " limb"]  # metres along a stem where it comes out of the ground; 0 elsewhere
    limb_id: Int[np.ndarray, " limb"]  # the skeleton's 63-bit id
    first_row: Int[np.ndarray, " limb"]  # the skeleton's row that starts the limb

    def __len__(self) -> int:
        return len(self.start) - 1

    @property
    def length(self) -> Float[np.ndarray, " limb"]:
        """Metres from foot to tip."""
        return self.s[self.start[1:] - 1]

    @property
    def of_point(self) -> Int[np.ndarray, " point"]:
        """The limb of each point."""
        return np.repeat(np.arange(len(self)), np.diff(self.start))

    def at(self, limb, s) -> tuple[Float[np.ndarray, "*place 3"], Float[np.ndarray, " *place"]]:
        """Point and radius `s` metres along `limb` (arrays of one shape); clamped to the limb's ends."""
        stride = float(self.s.max(initial=0.0)) + 1.0
        place = self.of_point * stride + self.s
        limb = np.asarray(limb)
        s = np.clip(s, 0.0, self.length[limb])
        right = np.clip(np.searchsorted(place, limb * stride + s, side="right"), self.start[limb] + 1, self.start[limb + 1] - 1)
        left = right - 1
        share = np.clip((s - self.s[left]) / (self.s[right] - self.s[left]), 0.0, 1.0)
        point = self.point[left] + share[..., None] * (self.point[right] - self.point[left])
        return point, self.radius[left] + share * (self.radius[right] - self.radius[left])


@dataclass(frozen=True, eq=False)
class _Knots:
    """What the line has to pass through, ragged by limb."""

    limb: Int[np.ndarray, " knot"]
    point: Float[np.ndarray, "knot 3"]
    radius: Float[np.ndarray, " knot"]
    pinned: Bool[np.ndarray, " knot"]
    drawn: Bool[np.ndarray, " knot"]  # the span that ends here was drawn
    row: Int[np.ndarray, " knot"]  # whose tip it is; NULL for a drawn point between tips and for underground


def centre_lines(
    tree: TreeSkeleton, underground: float = 0.3, apart: Bool[np.ndarray, " segment"] | None = None, onward: bool = False
) -> CentreLines:
    """The line of every limb of the tree. Stems begin `underground` times their radius below the ground.

    Limbs of no length are left out. Lines pass through every row's tip and every drawn point. Rows that are `apart`
    make limbs of their own. `onward`: see `chains`.
    """
    cut = chains(tree, apart, onward)
    knots = _knots(tree, cut, underground)
    keep = _distinct(knots, 1e-7 * max(tree.height, 1e-6))
    used = np.flatnonzero(np.bincount(knots.limb[keep], minlength=len(cut.foot)) >= 2 + cut.is_stem)
    keep &= np.isin(knots.limb, used)
    knots = _Knots(*(getattr(knots, name)[keep] for name in _Knots.__dataclass_fields__))
    renumber = np.full(len(cut.foot) + 1, NULL)
    renumber[used] = np.arange(len(used))
    knots = _Knots(renumber[knots.limb], *(getattr(knots, name) for name in list(_Knots.__dataclass_fields__)[1:]))
    return _lines(tree, cut, used, renumber, knots)


def _lines(tree: TreeSkeleton, cut: Chains, used, renumber, knots: _Knots) -> CentreLines:
    span = np.flatnonzero(np.diff(knots.limb) == 0)  # by its first knot
    velocity, h = _velocities(tree, cut, used, knots, span)
    point, curvature, share = _evaluate(knots, span, velocity, h)
    radius = knots.radius[span, None] + share * (knots.radius[span + 1] - knots.radius[span])[:, None]
    last = np.flatnonzero(np.diff(knots.limb, append=NULL) != 0)
    order = np.argsort(np.r_[np.repeat(span, _STEPS), last], kind="stable")
    limb = np.r_[np.repeat(knots.limb[span], _STEPS), knots.limb[last]][order]
    point = np.concatenate([point.reshape(-1, 3), knots.point[last]])[order]
    start = np.r_[0, np.cumsum(np.bincount(limb, minlength=len(used)))].astype(np.int64)
    first_step = np.zeros((len(span), _STEPS), bool)
    first_step[:, 0] = knots.pinned[span]
    knot_of = np.full((len(span), _STEPS), NULL)
    knot_of[:, 0] = span
    s = _arc_length(point, start)
    rows = knots.row[np.r_[knot_of.ravel(), last][order]]
    rows = np.where(np.r_[knot_of.ravel(), last][order] == NULL, NULL, rows)
    parent, parent_s, ground = _attachment(tree, cut, used, renumber, rows, s, start)
    radius = _gentle(limb, s, np.r_[radius.ravel(), knots.radius[last]][order])
    drawn = tree.kind[cut.row[cut.start[used + 1] - 1]] == int(Kind.DRAWN)
    return CentreLines(
        start=start,
        point=point,
        s=s,
        radius=run_out(radius, s, start, parent, parent_s, drawn, float(tree.radius[~tree.is_base].min(initial=np.inf))),
        curvature=np.r_[curvature.ravel(), np.zeros(len(last))][order],
        pinned=np.r_[first_step.ravel(), np.ones(len(last), bool)][order],
        is_stem=cut.is_stem[used],
        parent=parent,
        parent_s=parent_s,
        ground=ground,
        limb_id=tree.limb[cut.row[cut.start[used]]],
        first_row=cut.row[cut.start[used]],
    )


def _attachment(tree, cut, used, renumber, rows, s, start):
    """Parent limb, place on it, and where a stem leaves the ground."""
    known = rows != NULL
    foot = _carried(tree, rows[known], cut.foot[used])
    s_of_row = np.zeros(len(tree))
    s_of_row[rows[known]] = s[known]
    stem = cut.is_stem[used]
    parent = np.where(stem, NULL, renumber[np.where(stem, NULL, cut.of_row[foot])])
    is_ground = known & np.isin(rows, np.flatnonzero(tree.is_base))
    ground = np.zeros(len(used))
    limb = np.repeat(np.arange(len(used)), np.diff(start))
    ground[limb[is_ground]] = s[is_ground]
    return parent, np.where(parent == NULL, 0.0, s_of_row[foot]), ground


def _carried(tree: TreeSkeleton, known, foot):
    """The rows at whose tips limbs start, or the nearest below that their lines have: a row of no length stands on its parent's tip."""
    has = tree.is_base.copy()
    has[known] = True
    foot = foot.copy()
    while len(foot) and not has[foot].all():
        foot = np.where(has[foot], foot, tree.parent[foot])
    return foot


def _knots(tree: TreeSkeleton, cut: Chains, underground: float) -> _Knots:
    """Foot, drawn points and tips of every limb in order; stems begin below the ground."""
    inner = np.diff(tree.curve_start)[cut.row]
    limb_of_row = np.repeat(np.arange(len(cut.foot)), np.diff(cut.start))
    point_row = np.repeat(cut.row, inner)
    within = np.arange(inner.sum()) - np.repeat(np.cumsum(inner) - inner, inner)
    between = tree.curve_points[tree.curve_start[point_row] + within]
    position = np.repeat(np.arange(len(cut.row)), inner)  # place of the row in cut.row
    start_radius = _foot_radius(tree, cut)
    is_first = cut.start[:-1][limb_of_row] == np.arange(len(cut.row))
    begin = np.where(is_first, start_radius[limb_of_row], tree.radius[tree.parent[cut.row]])
    share = (within + 1.0) / (inner[position] + 1.0)
    inner_radius = begin[position] * (1 - share) + tree.radius[point_row] * share
    drawn = np.isin(tree.kind, (int(Kind.DRAWN), int(Kind.OBSERVED), int(Kind.ROOT)))
    stem = np.flatnonzero(cut.is_stem)
    below = tree.tip[cut.foot[stem]] - np.array([0.0, 1.0, 0.0]) * (underground * start_radius[stem])[:, None]
    n_stem, n_limb = len(stem), len(cut.foot)
    limb = np.concatenate([stem, np.arange(n_limb), limb_of_row[position], limb_of_row])
    order = np.lexsort((
        np.concatenate([np.full(n_stem, NULL), np.zeros(n_limb), 1 + within, 1 + inner]),
        np.concatenate([np.full(n_stem, -2), np.full(n_limb, -1), position, np.arange(len(cut.row))]),
        limb,
    ))
    columns = (
        limb,
        np.concatenate([below, tree.tip[cut.foot], between, tree.tip[cut.row]]),
        np.concatenate([start_radius[stem], start_radius, inner_radius, tree.radius[cut.row]]),
        np.concatenate([np.ones(n_stem + n_limb, bool), np.zeros(len(position), bool), drawn[cut.row]]),
        np.concatenate([np.zeros(n_stem + n_limb, bool), drawn[point_row], drawn[cut.row]]),
        np.concatenate([np.full(n_stem, NULL), np.where(cut.is_stem, cut.foot, NULL), np.full(len(position), NULL), cut.row]),
    )
    return _Knots(*(column[order] for column in columns))


def _foot_radius(tree: TreeSkeleton, cut: Chains) -> Float[np.ndarray, " limb"]:
    """Radius where each limb starts: its share of the wood below the fork.

    What the parent has more than its children's tips need is shared by their lengths:
    r_foot^n = r_c^n + (R^n − Σ r_c^n) |v_c| / Σ |v_c|; a lateral stays inside its parent.
    """
    first = cut.row[cut.start[:-1]]
    child = np.flatnonzero(~tree.is_base)
    above = tree.parent[child]
    held = tree.radius**_EXPONENT
    wood = np.bincount(above, held[child], minlength=len(tree))
    reach = np.bincount(above, tree.length[child], minlength=len(tree))
    spare = np.maximum(held - wood, 0.0)[cut.foot] / np.maximum(reach[cut.foot], 1e-12)
    head = tree.radius[first]
    foot = (held[first] + spare * tree.length[first]) ** (1.0 / _EXPONENT)
    foot = np.minimum(foot, head + _SLOPE * tree.length[first])
    return np.where(cut.is_stem, np.maximum(head, tree.radius[cut.foot]), np.minimum(foot, _WIDEST * tree.radius[cut.foot]))


def _distinct(knots: _Knots, least: float) -> Bool[np.ndarray, " knot"]:
    """Knots that do not fall on the one before. Of two that coincide, the pinned one stays."""
    step = np.linalg.norm(np.diff(knots.point, axis=0), axis=1)
    twin = np.r_[False, (step <= least) & (np.diff(knots.limb) == 0)]
    return ~twin[: len(knots.limb)]


def _velocities(tree, cut, used, knots: _Knots, span):
    """dP/dt at both ends of every span (t in units of h) and h, the span of the parameter."""
    chord = knots.point[span + 1] - knots.point[span]
    h = np.linalg.norm(chord, axis=1) ** 0.5
    slope = chord / h[:, None]
    into = np.full(len(knots.limb), NULL)
    into[span + 1] = np.arange(len(span))
    out = np.full(len(knots.limb), NULL)
    out[span] = np.arange(len(span))
    inner = (into != NULL) & (out != NULL)
    a, b = into[inner], out[inner]
    velocity = np.zeros((len(knots.limb), 3))
    velocity[inner] = (h[b, None] * slope[a] + h[a, None] * slope[b]) / (h[a] + h[b])[:, None]
    tips = np.flatnonzero((into != NULL) & (out == NULL))
    velocity[tips] = 0.5 * (3.0 * slope[into[tips]] - velocity[tips - 1])
    single = tips[into[tips - 1] == NULL]
    velocity[single] = slope[into[single]]
    feet = np.flatnonzero((into == NULL) & (out != NULL))
    velocity[feet] = _foot_velocity(tree, cut, used, knots, feet, slope[out[feet]])
    return velocity, h


def _foot_velocity(tree, cut, used, knots: _Knots, feet, slope):
    """Drawn limbs start along their stroke; others lean towards their parent's direction. Stems start upright."""
    limb = knots.limb[feet]
    along = tree.vector[cut.foot[used[limb]]]
    length = np.linalg.norm(along, axis=1, keepdims=True)
    along = along / np.maximum(length, 1e-12)
    speed = np.linalg.norm(slope, axis=1, keepdims=True)
    lean = _LEAN * np.clip(np.einsum("ij,ij->i", along, slope / speed) + 0.35, 0.0, 1.0)
    lean = np.where(knots.drawn[feet + 1] | cut.is_stem[used[limb]], 0.0, lean)[:, None]
    blended = (1.0 - lean) * slope / speed + lean * along
    return blended / np.linalg.norm(blended, axis=1, keepdims=True) * speed


def _evaluate(knots: _Knots, span, velocity, h):
    """Points, curvatures and parameters at `_STEPS` places of every span, its end left out."""
    p0, p3 = knots.point[span], knots.point[span + 1]
    p1, p2 = p0 + h[:, None] * velocity[span] / 3.0, p3 - h[:, None] * velocity[span + 1] / 3.0
    share = np.broadcast_to(np.arange(_STEPS) / _STEPS, (len(span), _STEPS))
    t = share[..., None]
    p0, p1, p2, p3 = (p[:, None] for p in (p0, p1, p2, p3))
    point = (1 - t) ** 3 * p0 + 3 * (1 - t) ** 2 * t * p1 + 3 * (1 - t) * t**2 * p2 + t**3 * p3
    first = 3 * ((1 - t) ** 2 * (p1 - p0) + 2 * (1 - t) * t * (p2 - p1) + t**2 * (p3 - p2))
    second = 6 * ((1 - t) * (p2 - 2 * p1 + p0) + t * (p3 - 2 * p2 + p1))
    speed = np.linalg.norm(first, axis=-1)
    curvature = np.linalg.norm(np.cross(first, second), axis=-1) / np.maximum(speed, 1e-9) ** 3
    return point, curvature, share


def _arc_length(point, start):
    step = np.r_[0.0, np.linalg.norm(np.diff(point, axis=0), axis=1)]
    step = np.maximum(step, 1e-12)
    total = np.cumsum(step)
    count = np.diff(start)
    return total - np.repeat(total[start[:-1]], count)


def _gentle(limb, s, radius):
    """Radii that fall no faster than `_STEEPEST`: a drop at a fork is spread over the wood after it."""
    lifted = radius + _STEEPEST * s
    stride = float(lifted.max(initial=0.0)) + 1.0
    return np.maximum.accumulate(lifted + limb * stride) - limb * stride - _STEEPEST * s
