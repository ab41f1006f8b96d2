"""How does a drawn limb go on into a crown that it does not fill?

The commonest drawing is a crown over a trunk that ends at or below it. A crown outline with little drawn wood in it
is *unled*: the limbs whose tips are nearest to it go on into it as leaders, same limb and order (the apical
continuation of Chen et al. 2008, §6); their laterals then fill it by blocks as everywhere. From tip p towards p',
with c = |p' − p|, a leader follows Hermite's curve and wanders about it by its limb's own random numbers:

    q(t) = h00 p + h10 c d + h01 p' + h11 c d'  +  A c sin(πt) Σ_k sin(2π (k t + ε_k)) e_k / k        0 ≤ t ≤ 1

    d, d'   direction of the drawn tip, half turned to p'; of the end, half turned upwards
    p'      on the crown's own axis: near its top if the habit is excurrent, lower if it dissolves into limbs
            (`apical_control`); several leaders spread out as their tips do
    A       less for a habit that keeps its axis;  ε_k in [0, 1), e_k two horizontal axes

An outline whose nearest tip already leads another gets a fork of the nearest drawn wood; one that is farther away than
the tree is high, and than itself is large, belongs to no limb.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Array, Bool, Float, Int, Key

from sketchtree import keys, limb_ids
from sketchtree.axes import NULL
from sketchtree.parameters import Habit
from sketchtree.propagate.blocks.attach_block import Nodes
from sketchtree.propagate.space.envelope import Envelope, Lobe
from sketchtree.propagate.space.obstacles import Obstacles
from sketchtree.propagate.space.space import Space
from sketchtree.propagate.blocks.open_branch import OpenBranches, frames, limb_arcs, polar, turn
from sketchtree.skeleton import TreeSkeleton

_NEARS = (0.6, 1.05)  # of its way to the crown's surface: a leader's lateral is at least as long as between these
_LED = 0.6  # of its height: with more drawn wood inside, a crown outline needs no leader
_NEAR = 0.35  # of an outline's size: tips this much farther than the nearest one lead too
_MOST = 5  # leaders of one outline
_END = (0.62, 0.34)  # height of a leader's end in the crown, 0-1: at apical control 0, and what 1 adds
_ASIDE = 0.5  # of the crown's half width: how far from its axis the outermost of several leaders ends
_LOWER = 0.2  # of the height it would have on the axis: how much lower such a leader ends
_WANDER = (0.05, 0.042)  # of the chord: at apical control 0, and what 1 takes away
_RANK = 2_000_000  # ranks of forks into an outline: above those of all nodes and of the limbs that close gaps
_FEWEST, _FINEST = 3, 96  # nodes of a leader
_CLOSEST = 1 / 14  # of an outline's height: its leader's nodes are at least this close
_SAMPLES = 5  # of a drawn row, to measure what of it lies inside


@dataclass(frozen=True, eq=False)
class Leaders:
    """The limbs that lead into the crown, grown: `nodes` from `first_row` on, and each one's parent row."""

    nodes: Nodes
    parent: Int[np.ndarray, " node"]

    def __len__(self) -> int:
        return len(self.nodes)

    @property
    def grown(self) -> dict[int, float]:
        """Length of the whole limb, metres, by limb id."""
        return dict(zip(self.nodes.limb.tolist(), self.nodes.whole.tolist(), strict=True))


@dataclass(frozen=True)
class _Course:
    """One leader to be: from the tip of a drawn row to a point in the crown."""

    row: int
    limb: int
    order: int
    end: Float[np.ndarray, " 3"]
    lobe: Lobe
    forks: bool


def leaders(
    tree: TreeSkeleton,
    envelope: Envelope | None,
    habit: Habit,
    spacing: Float[np.ndarray, " segment"],
    key: Key[Array, ""] | np.uint64,
    *,
    most: int,
    obstacles: Obstacles | None = None,
) -> Leaders | None:
    """The leaders into every drawn outline that is unled, `most` nodes at most in all; None where there are none.

    Each crosses the gap between its tip and the crown, and once inside stays inside. Obstacles it is led round, or ends there."""
    if envelope is None or not envelope.binding:
        return None
    frame = frames(tree)
    parts = [_grown(tree, course, frame, spacing, habit, obstacles, key) for course in _courses(tree, envelope, habit)]
    parts = [part for part in parts if part is not None]
    if not parts:
        return None
    nodes, first = parts[0], len(tree)
    for part in parts[1:]:
        nodes = nodes.join(part)
    starts = np.r_[True, nodes.limb[1:] != nodes.limb[:-1]]
    parent = np.where(starts, nodes.row, first + np.arange(len(nodes)) - 1)
    nodes = Nodes(**{name: getattr(nodes, name) for name in nodes.__dataclass_fields__} | {"row": first + np.arange(len(nodes))})
    return Leaders(nodes.select(slice(0, most)), parent[:most]) if most > 0 else None


def to_surface(
    opened: OpenBranches, led: Bool[np.ndarray, " branch"], envelope: Envelope, space: Space, key: Key[Array, ""] | np.uint64
) -> OpenBranches:
    """The same, those on `led` limbs as long as it takes to come near the crown's surface, half the crown at most."""
    widest = 0.5 * max(lobe.reach for lobe in envelope.lobes)
    way = space.exit_fraction(opened.origin, opened.origin + widest * opened.frame[:, :, 1], bisections=7) * widest
    way = way * (_NEARS[0] + (_NEARS[1] - _NEARS[0]) * keys.uniform(key, opened.limb, 15))
    return replace(opened, length=np.where(led, np.maximum(opened.length, way), opened.length))


def unled(tree: TreeSkeleton, lobe: Lobe) -> bool:
    """Whether the drawn wood inside an outline is shorter than `_LED` of its height."""
    t = (np.arange(_SAMPLES) + 0.5) / _SAMPLES
    point = tree.start[:, None] + t[None, :, None] * tree.vector[:, None]
    within = (lobe.margin(point.reshape(-1, 3)) >= 0).reshape(len(tree), _SAMPLES).mean(axis=1)
    return bool(np.sum(within * tree.length) < _LED * np.ptp(lobe.height))


def _courses(tree, envelope, habit) -> list[_Course]:
    """Which drawn rows lead where; the outlines nearest to a tip choose first."""
    tips = np.flatnonzero(_limb_ends(tree) & ~tree.is_base & (tree.order < max(habit.max_order, 1)))
    lobes = [lobe for lobe in envelope.lobes if unled(tree, lobe)]
    if len(tips) == 0 or not lobes:
        return []
    distance = np.array([_distance(lobe, tree.tip[tips]) for lobe in lobes])
    taken: set[int] = set()
    found = []
    for rank, which in enumerate(np.argsort(distance.min(axis=1), kind="stable")):
        lobe, away = lobes[which], distance[which]
        size = min(np.ptp(lobe.height), lobe.reach)
        if away.min() > max(tree.height, size):
            continue
        near = tips[np.argsort(away, kind="stable")][:_MOST]
        near = np.array([row for row in near[np.sort(away)[:_MOST] <= away.min() + _NEAR * size] if row not in taken], np.int64)
        if len(near):
            taken |= set(near.tolist())
            ends = _ends(lobe, tree.tip[near], habit)
            found += [_Course(int(row), int(tree.limb[row]), int(tree.order[row]), end, lobe, False) for row, end in zip(near, ends, strict=True)]
            continue
        wood = np.flatnonzero(~tree.is_base & (tree.order < habit.max_order))
        if len(wood):
            row = wood[np.argmin(_distance(lobe, tree.tip[wood]))]
            limb = limb_ids.child_limb_id(tree.limb[row : row + 1], np.array([_RANK + rank]))[0]
            end = _ends(lobe, tree.tip[row : row + 1], habit)[0]
            found.append(_Course(int(row), int(limb), int(tree.order[row]) + 1, end, lobe, True))
    return found


def _limb_ends(tree) -> Bool[np.ndarray, " segment"]:
    """Rows where their limb ends, whether or not another limb starts there."""
    above = np.where(tree.parent == NULL, 0, tree.parent)
    goes_on = (tree.parent != NULL) & (tree.limb == tree.limb[above])
    ends = np.ones(len(tree), bool)
    ends[tree.parent[goes_on]] = False
    return ends


def _distance(lobe: Lobe, point) -> Float[np.ndarray, " point"]:
    """From each point to the nearest of a few places on the outline's own axis, metres."""
    axis = lobe.axis_at(lobe.height[0] + np.linspace(0.05, 0.95, 9) * np.ptp(lobe.height))
    return np.linalg.norm(point[:, None] - axis[None], axis=2).min(axis=1)


def _ends(lobe: Lobe, tip, habit: Habit) -> Float[np.ndarray, "leader 3"]:
    """Where the leaders from these tips end: on the axis, or spread about it as the tips are."""
    aside = (tip - tip.mean(axis=0)) * [1.0, 0.0, 1.0]
    far = np.linalg.norm(aside, axis=1)
    share = aside / max(far.max(), 1e-12) if far.max() > 1e-3 * np.ptp(lobe.height) else 0.0 * aside
    out = np.linalg.norm(share, axis=1)
    height = _END[0] + _END[1] * np.clip(habit.apical_control, 0.0, 1.0)
    y = lobe.height[0] + height * (1.0 - _LOWER * out) * np.ptp(lobe.height)
    return lobe.axis_at(y) + _ASIDE * lobe.half_width_at(y)[:, None] * share


def _grown(tree, course: _Course, frame, spacing, habit, obstacles, key) -> Nodes | None:
    """The nodes of one leader (`row` still that of the drawn tip); None where it would not enter the outline."""
    arcs, _ = limb_arcs(tree)
    arc = 0.0 if course.forks else float(arcs[course.row])
    step = min(float(spacing[course.row]), _CLOSEST * float(np.ptp(course.lobe.height)))
    point = _curve(tree.tip[course.row], frame[course.row][:, 1], course, habit, step, key)
    point = obstacles.clear(point) if obstacles else point
    run = np.cumsum(np.linalg.norm(np.diff(point, axis=0), axis=1))
    point, kept = _until_outside(point[1:], course.lobe)
    if kept is None:
        return None
    run, count = run[: len(point)], len(point)
    whole = arc + run[-1]
    begins = run[kept] if kept else 0.0
    axes = _transported(frame[course.row], np.vstack([tree.tip[course.row], point]), course.forks)
    first = 0 if course.forks else int(np.rint(arc / step)) + 1
    return Nodes(
        row=np.full(count, course.row),
        tip=point,
        frame=axes,
        limb=np.full(count, course.limb),
        order=np.full(count, course.order),
        tree=np.full(count, tree.tree[course.row]),
        number=first + np.arange(count),
        position=(arc + run) / whole,
        zone=np.where(run >= begins, (run - begins) / max(run[-1] - begins, 1e-12), -1.0),
        whole=np.full(count, whole),
        radius=tree.radius[course.row] * (1.0 - 0.9 * run / run[-1]),
    )


def _curve(start, heading, course: _Course, habit, step, key) -> Float[np.ndarray, "point 3"]:
    """Hermite's curve with the leader's wander, a node every `step` metres or so; the start included."""
    chord = course.end - start
    length = np.linalg.norm(chord)
    count = int(np.clip(np.ceil(length / step), _FEWEST, _FINEST))
    t = np.linspace(0.0, 1.0, count + 1)[:, None]
    leave = _unit(heading + chord / length)
    arrive = _unit(chord / length + [0.0, 1.0, 0.0])
    path = (2 * t**3 - 3 * t**2 + 1) * start + (t**3 - 2 * t**2 + t) * length * leave
    path = path + (3 * t**2 - 2 * t**3) * course.end + (t**3 - t**2) * length * arrive
    id_ = np.array([course.limb])
    wander = np.zeros((count + 1, 3))
    for axis in (0, 2):
        for k in (1, 2):
            phase = keys.uniform(key, id_, 16 + axis + k)[0]
            wander[:, axis] += (np.sin(2 * np.pi * (k * t + phase)) / k)[:, 0]
    amplitude = _WANDER[0] - _WANDER[1] * np.clip(habit.apical_control, 0.0, 1.0)
    return path + amplitude * length * np.sin(np.pi * t) * wander


def _until_outside(point, lobe: Lobe):
    """(the points up to where the leader, once inside, would leave; the index of the first one inside, or None)."""
    within = lobe.margin(point) >= 0
    if not within.any():
        return point, None
    enters = int(np.argmax(within))
    leaves = np.flatnonzero(~within[enters:])
    return point[: enters + leaves[0]] if len(leaves) else point, enters


def _transported(frame, point, forks) -> Float[np.ndarray, "node 3 3"]:
    """The frame at every point but the first, carried along the polyline from `frame`."""
    found = np.empty((len(point) - 1, 3, 3))
    for k, way in enumerate(np.diff(point, axis=0)):
        apical: Bool[np.ndarray, " 1"] = np.array([k > 0 or not forks])
        frame = turn(frame[None], *polar((frame.T @ way)[None]), apical)[0]
        found[k] = frame
    return found


def _unit(vector):
    return vector / max(np.linalg.norm(vector), 1e-12)
