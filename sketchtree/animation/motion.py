"""Where is each joint at each time of growth?

With x the rest place of a vertex, p, Q that of a joint (place and turn), and T, R, S its motion, a vertex of that joint alone is at

    x' = T + R Q S Qᵀ (x − p)

    at a node            T the node's tip in the plan, S its radius against its last one (all three axes), Q = 1
    at a foot            p where the limb comes out of what bears it, T there on what bears it; S as at the limb's first node
    a limb as one        the same, with Q's y along it and S = (ρ, g, ρ): ρ its first piece's radius, g the share of its length that has grown
    R                    where branches bend, the shortest turn from a piece's way at the end to its way now; else 1

Wood that has not begun has S = 0. The growth of the whole (M) is a joint on the ground below all others, and not in these.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial.transform import Rotation

from sketchtree.animation.hosts import Hosts, Nodes
from sketchtree.animation.influences import influences
from sketchtree.axes import NULL
from sketchtree.geometry.limbs import CentreLines
from sketchtree.growth.plan import GrowthPlan, Poses
from sketchtree.rig.bones import upright_to
from sketchtree.rig.boughs import Boughs
from sketchtree.rig.place import Places
from sketchtree.traverse import generations


@dataclass(frozen=True, eq=False)
class Motion:
    """Joints of limbs, before the growth of the whole. World axes."""

    position: Float[np.ndarray, "joint 3"]  # p, metres
    rest: Float[np.ndarray, "joint 4"]  # Q, x y z w
    thickness: Float[np.ndarray, " joint"]  # radius of the wood there at the end, metres
    base: Int[np.ndarray, " joint"]  # the piece that is the ground it stands on
    translation: Float[np.ndarray, "joint time 3"]  # T, metres
    rotation: Float[np.ndarray, "joint time 4"] | None  # R, x y z w; None: nothing turns
    scale: Float[np.ndarray, "joint time 3"]  # S


def motion_of(plan: GrowthPlan, lines: CentreLines, limbs: Boughs, nodes: Nodes, hosts: Hosts, poses: Poses) -> Motion:
    """The motion of all joints; `poses` are those of the plan's straight pieces, not of the whole."""
    moving = _Moving(plan, lines, limbs, nodes, hosts, poses)
    for generation in generations(lines.parent):
        moving.add(generation[hosts.first[generation] != NULL])
    return moving.done()


class _Moving:
    """The motion while it is worked out, limbs after those that bear them."""

    def __init__(self, plan: GrowthPlan, lines: CentreLines, limbs: Boughs, nodes: Nodes, hosts: Hosts, poses: Poses):
        self.plan, self.lines, self.limbs, self.nodes, self.hosts, self.poses = plan, lines, limbs, nodes, hosts, poses
        pieces, times = plan.straight.pieces, len(poses.time)
        self.begun = poses.grown > 0
        final = np.where(pieces.radius > 0, pieces.radius, 1.0)
        self.thick = np.where(self.begun, poses.radius / final, 0.0)
        self.turn = _turns(poses, pieces) if plan.bend != 0 else None
        self.position, self.rest = np.zeros((hosts.count, 3)), np.tile([0.0, 0.0, 0.0, 1.0], (hosts.count, 1))
        self.base, self.thickness = np.zeros(hosts.count, np.int64), np.zeros(hosts.count)
        self.translation, self.scale = np.zeros((2, hosts.count, times, 3))
        self.rotation = None if self.turn is None else np.zeros((hosts.count, times, 4))
        ground = np.arange(len(pieces))
        for rows in generations(pieces.parent)[1:]:
            ground[rows] = ground[pieces.parent[rows]]
        self.ground = ground

    def add(self, limb: Int[np.ndarray, " some"]) -> None:
        """Limbs of one generation that have joints."""
        if not len(limb):
            return
        first, lead = self.hosts.first[limb], self.nodes.piece[self.nodes.start[limb]]
        self.base[first], self.thickness[first] = self.ground[lead], self.plan.straight.pieces.radius[lead]
        self._feet(limb, first, lead)
        alone = ~self.hosts.by_nodes[limb]
        self.scale[first] = self.thick[:, lead].T[:, :, None]
        if alone.any():
            self._as_one(limb[alone], first[alone])
        count = self.nodes.count[limb[~alone]]
        which = np.repeat(limb[~alone], count)
        rank = np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
        joint, piece = self.hosts.first[which] + 1 + rank, self.nodes.piece[self.nodes.start[which] + rank]
        self.position[joint], self.base[joint] = self.plan.straight.pieces.tip[piece], self.ground[piece]
        self.thickness[joint] = self.plan.straight.pieces.radius[piece]
        self.translation[joint] = np.swapaxes(self.poses.tip[:, piece], 0, 1)
        self.scale[joint] = self.thick[:, piece].T[:, :, None]
        if self.turn is not None:
            self.rotation[joint], self.rotation[first] = self.turn[piece], self.turn[lead]

    def done(self) -> Motion:
        """All of it."""
        return Motion(self.position, self.rest, self.thickness, self.base, self.translation, self.rotation, self.scale)

    def _feet(self, limb, first, lead) -> None:
        """Stems stand on their bases; others ride where they come out of what bears them."""
        stem = self.lines.parent[limb] == NULL
        base = self.ground[lead[stem]]
        self.position[first[stem]] = self.plan.straight.pieces.tip[base]
        self.translation[first[stem]] = np.swapaxes(self.poses.tip[:, base], 0, 1)
        rest = limb[~stem]
        if not len(rest):
            return
        place = Places(self.lines.parent[rest], self.limbs.exit_s[rest])
        held = influences(self.lines, self.limbs, self.nodes, self.hosts, place)
        foot = self.lines.at(rest, self.limbs.buried[rest])[0]
        self.position[first[~stem]] = foot
        self.translation[first[~stem]] = sum(held.weight[:, k, None, None] * self._moved(held.joint[:, k], foot) for k in range(2))

    def _moved(self, joint, point):
        """Where the joints take the points, at all times."""
        away = (point - self.position[joint])[:, None]
        rest = Rotation.from_quat(self.rest[joint])
        local = rest.inv().as_matrix()[:, None] @ away[..., None]
        turned = (rest.as_matrix()[:, None] @ (self.scale[joint][..., None] * local))[..., 0]
        if self.rotation is not None:
            turned = Rotation.from_quat(self.rotation[joint].reshape(-1, 4)).apply(turned.reshape(-1, 3)).reshape(turned.shape)
        return self.translation[joint] + turned

    def _as_one(self, limb, first) -> None:
        chord = self.lines.point[self.lines.start[limb + 1] - 1] - self.position[first]
        self.rest[first] = upright_to(chord)
        self.scale[first, :, 1] = self._grown(limb)

    def _grown(self, limb) -> Float[np.ndarray, "limb time"]:
        """The share of their length that limbs have."""
        count = self.nodes.count[limb]
        start = np.cumsum(count) - count
        which = np.repeat(np.arange(len(limb)), count)
        piece = self.nodes.piece[self.nodes.start[limb[which]] + np.arange(len(which)) - start[which]]
        length = self.plan.straight.pieces.length[piece]
        whole = np.maximum(np.bincount(which, length, minlength=len(limb)), 1e-12)
        return np.add.reduceat(self.poses.grown[:, piece] * length, start, axis=1).T / whole[:, None]


def _turns(poses: Poses, pieces) -> Float[np.ndarray, "piece time 4"]:
    """The shortest turn of each piece from its way at rest; before it begins, that of its beginning."""
    way = poses.tip - poses.base
    long = np.linalg.norm(way, axis=2)
    sure = (poses.grown > 0) & (long > 1e-9)
    begins = np.where(sure.any(axis=0), sure.argmax(axis=0), 0)
    now = np.where(sure, np.arange(len(way))[:, None], begins)
    way = np.take_along_axis(way, now[..., None], axis=0)
    way = np.swapaxes(way / np.maximum(np.linalg.norm(way, axis=2, keepdims=True), 1e-12), 0, 1)
    rest = pieces.vector / np.maximum(pieces.length, 1e-12)[:, None]
    rest = np.broadcast_to(rest[:, None], way.shape)
    turn = np.concatenate([np.cross(rest, way), 1.0 + np.sum(rest * way, axis=2, keepdims=True)], axis=2)
    turn[np.linalg.norm(turn, axis=2) < 1e-6] = [1.0, 0.0, 0.0, 0.0]
    turn[(pieces.is_base | ~sure.any(axis=0))] = [0.0, 0.0, 0.0, 1.0]
    return turn / np.linalg.norm(turn, axis=2, keepdims=True)
