"""Which leaves does a young tree bear on wood that is bare when it is old?

The final tree has leaves on its last twigs only. At `TIMES` the young tree of that time is given leaves as any tree is; those on wood that bears none
at the end, and that moves by nodes, are kept: they unfold at that time and are shed as the next ones unfold. Leaves are about as large
as grown ones, which on a small tree is large: by √M of their size.

In a file they are drawn back to their feet at rest, so that the tree at rest is the final one; the one morph target of each mesh unfolds them. They must not
swell as their wood does, so they go with joints that only move: that of the ground where nothing bends, else with *shoots*, twins of the nodes'
joints without their size. Each leaf is put where its joint takes it to its place at its time. Where the tree is one of a coarser level of detail, they
have as few triangles a leaf as its own have.
"""

from dataclasses import replace

import numpy as np
from jaxtyping import Array, Int, Key

from sketchtree.animation.hosts import Hosts, Nodes
from sketchtree.animation.motion import Motion
from sketchtree.animation.posing import joint_frames
from sketchtree.asset import Animation, Armature, Morph
from sketchtree.axes import NULL
from sketchtree.dressing import Dress
from sketchtree.foliage.card_shape import card
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.leaf_cards import leaf_cards
from sketchtree.foliage.leaves import Leaves, select
from sketchtree.foliage.populate import populate
from sketchtree.geometry.limbs import CentreLines
from sketchtree.geometry.mesh import Mesh
from sketchtree.growth.age import WHOLE
from sketchtree.growth.plan import GrowthPlan
from sketchtree.keys import numpy_generator, stage_key
from sketchtree.levels.make import Model
from sketchtree.rig.boughs import limb_of_row
from sketchtree.rig.leaf_rows import leaf_rows
from sketchtree.watch import Pulse, no_pulse

TIMES = tuple(WHOLE * share for share in (0.04, 0.09, 0.16, 0.24, 0.33, 0.43, 0.54, 0.66, 0.79, 0.92))
_UNFOLDS, _FALLS = 0.035, 0.05  # of the tree's time: they are whole so long after the moment they belong to, and shed so long after that of the next
_MOST = 20_000  # leaves of one time


def with_shoots(motion: Motion, hosts: Hosts) -> Motion:
    """The motion with a shoot for every joint of a limb by nodes, after all others; itself where nothing bends."""
    if motion.rotation is None:
        return motion
    twin = shoot_of(hosts)
    node = np.flatnonzero(twin != NULL)
    more = {name: getattr(motion, name)[node] for name in ("position", "rest", "thickness", "base", "translation", "rotation", "scale")}
    more["scale"] = np.ones_like(more["scale"])
    return Motion(**{name: np.concatenate([getattr(motion, name), column]) for name, column in more.items()})


def shoot_of(hosts: Hosts) -> Int[np.ndarray, " joint"]:
    """The shoot of every joint; NULL for those of limbs as one."""
    inner = np.zeros(hosts.count, bool)
    for first, count in zip(hosts.first[hosts.by_nodes].tolist(), hosts.joints[hosts.by_nodes].tolist(), strict=True):
        inner[first : first + count] = True
    return np.where(inner, hosts.count + np.cumsum(inner) - 1, NULL)


def young_leaves(
    plan: GrowthPlan, lines: CentreLines, nodes: Nodes, hosts: Hosts, model: Model, bones: Armature, animation: Animation, first: int, part: int, *, key: Key[Array, ""], pulse: Pulse = no_pulse
) -> list[tuple[Mesh, Morph]]:
    """Meshes `leaf_young_1` …, and how each unfolds and is shed. Joints of limbs are counted from `first`, parts from `part`; the animation takes one second."""
    dress, final = model.dress, model.leaves
    if dress.leaf is None or not len(final) or plan.mode == "scale":  # there the final tree only becomes larger
        return []
    triangles = sum(mesh.triangle_count for mesh in model.meshes if mesh.name == "leaf") / len(final)  # of one leaf
    joint = _joint_of_row(plan, lines, nodes, hosts, first, bones)
    joint[final.segment] = NULL
    found: list[tuple[Mesh, Morph]] = []
    for number, time in enumerate(TIMES):
        pulse()
        young, rows = plan.with_rows_at(time)
        size = max(float(np.sqrt(plan.size_at(time))), 0.05)
        leaves = populate(young, dress.habit, key=stage_key(key, f"young leaves {number}"), model=dress.leaf, season=dress.season, scale=size, max_leaves=_MOST)
        own = joint[rows[leaves.segment]]
        kept = np.flatnonzero(own != NULL)
        if not len(kept):
            continue
        leaves, own = replace(select(leaves, kept), shoot=np.zeros((0, 2, 3))), own[kept]
        if final.seen is not None:  # in a photo, whose colours the young tree has too
            chosen = numpy_generator(stage_key(key, f"young colours {number}")).integers(len(final), size=len(leaves))
            leaves = replace(leaves, seen=final.seen[chosen])
        frame, rest = joint_frames(bones, animation, time)
        carries = np.unique(own)
        back = np.tile(np.eye(4), (len(frame), 1, 1))
        back[carries] = rest[carries] @ np.linalg.inv(frame[carries])
        mesh, offset = _drawn_back(_mesh(leaves, dress.season, triangles), leaves, own, back)
        later = TIMES[number + 1] if number + 1 < len(TIMES) else WHOLE
        found.append((replace(mesh, name=f"leaf_young_{len(found) + 1}"), Morph(part + len(found), offset, *_course(time, later))))
    return found


def _mesh(leaves: Leaves, season: str, triangles: float) -> Mesh:
    """The leaves, of so many triangles each if that is less than the full card has."""
    full = len(card(leaves.model)[2])
    return leaf_mesh(leaves, season=season) if triangles >= full else leaf_cards(leaves, season=season, triangles=max(int(triangles * len(leaves)), 1))


def _joint_of_row(plan: GrowthPlan, lines: CentreLines, nodes: Nodes, hosts: Hosts, first: int, bones: Armature):
    """The joint that carries leaves on each row: the ground's, or the shoot where the row begins (where its limb does, the one at its tip); NULL where its limb does not move by nodes."""
    limb = np.repeat(np.arange(len(lines)), nodes.count)
    rank = np.arange(len(limb)) - nodes.start[limb]
    of_piece = np.full(len(plan.straight.row), NULL)
    of_piece[nodes.piece] = np.where(hosts.by_nodes[limb], hosts.first[limb] + np.maximum(rank, 1), NULL)
    joint = of_piece[plan.straight.last]
    joint[limb_of_row(plan.tree, lines) == NULL] = NULL
    moved = first + (joint if plan.bend == 0 else shoot_of(hosts)[joint])
    return np.where(joint == NULL, NULL, bones.parent[moved] if plan.bend == 0 else moved)


def _drawn_back(mesh: Mesh, leaves: Leaves, own, back):
    """The mesh with every leaf in its foot, bound to its own joint, and how far each vertex is from there."""
    leaf = leaf_rows(mesh, leaves).leaf
    move = back[own]
    foot = np.einsum("lij,lj->li", move[:, :3, :3], leaves.position) + move[:, :3, 3]
    place = np.einsum("vij,vj->vi", move[leaf][:, :3, :3], mesh.position) + move[leaf][:, :3, 3]
    turn = move[leaf][:, :3, :3]
    normal = np.einsum("vij,vj->vi", turn, mesh.normal)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    columns = {"JOINTS_0": np.zeros((len(leaf), 4), np.uint16), "WEIGHTS_0": np.tile(np.float32([1, 0, 0, 0]), (len(leaf), 1))}
    columns["JOINTS_0"][:, 0] = own[leaf]
    return replace(mesh, position=foot[leaf], normal=normal, extra={**mesh.extra, **columns}), (place - foot[leaf]).astype(np.float32)


def _course(time: float, later: float):
    """(moments, weights): unfolding, whole, shed as the next unfold."""
    return np.array([0.0, time, time + _UNFOLDS, later + 0.01, min(later + _FALLS, 1.0)]), np.array([0.0, 0.0, 1.0, 1.0, 0.0])
