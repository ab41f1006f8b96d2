"""A finished tree that grows: meshes, joints and keys, for a file that moves and for pictures of any moment.

The meshes are those of the final tree; nothing is made anew from moment to moment, so nothing flickers. At rest, and at the end if
branches don't bend, the file shows the tree as it was given, to the last vertex.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.animation.hosts import Hosts, Nodes, choose_hosts
from sketchtree.animation.influences import influences
from sketchtree.animation.keys import fewest_keys, one_sided
from sketchtree.animation.motion import Motion, motion_of
from sketchtree.animation.posing import posed
from sketchtree.animation.rims import rims
from sketchtree.animation.seams import parted
from sketchtree.animation.unfolding import cohorts
from sketchtree.animation.wanted import MOST_JOINTS, check_joints
from sketchtree.animation.young_leaves import with_shoots, young_leaves
from sketchtree.asset import Animation, Armature, Asset, Keys
from sketchtree.axes import NULL
from sketchtree.errors import OptionError
from sketchtree.geometry.limbs import CentreLines, centre_lines
from sketchtree.geometry.mesh import Mesh
from sketchtree.growth.plan import GrowthPlan, checked_times
from sketchtree.keys import root_key
from sketchtree.levels.make import Model
from sketchtree.rig.boughs import Boughs, boughs
from sketchtree.rig.islands import mesh_places
from sketchtree.rig.leaf_rows import leaf_rows
from sketchtree.rig.weights import Weights, whole
from sketchtree.rig.wind import leaf_places
from sketchtree.watch import Pulse, no_pulse

_MOMENTS = 241  # at which the motion is worked out
_NEAR, _NEAR_WOOD = 1e-4, 0.25  # how far a joint may be from its place: of the tree's height, or of the wood's radius there
_LIKE = 0.01  # how far its size may be, as a share of its last one
_TURN = 0.002  # how far a quaternion may be


@dataclass(frozen=True, eq=False)
class Growing:
    """A tree and how it grows. `plan` is one of the model's skeleton."""

    model: Model
    plan: GrowthPlan
    most_joints: int
    lines: CentreLines
    limbs: Boughs
    nodes: Nodes
    hosts: Hosts
    key: Key[Array, ""]
    pulse: Pulse = no_pulse

    @classmethod
    def of(cls, model: Model, plan: GrowthPlan, *, most_joints: int = MOST_JOINTS, key: Key[Array, ""] | None = None, pulse: Pulse = no_pulse) -> "Growing":
        """`key` is for the leaves that only young trees bear; one of its own if there is none. `pulse` is called while the animation is made, the first time that it is asked for.

        Raises `OptionError` for a number of joints that is out of range, or a tree without a limb."""
        check_joints(most_joints)
        lines = centre_lines(plan.tree)
        if not len(lines):
            raise OptionError("The tree has no branch that could grow.", remedy="Give one with a trunk of some length.")
        limbs, nodes = boughs(plan.tree, lines), Nodes.of(plan.straight, lines)
        return cls(model, plan, most_joints, lines, limbs, nodes, choose_hosts(lines, limbs, nodes, most_joints, twins=plan.bend != 0), root_key(0) if key is None else key, pulse)

    def at(self, time: float) -> tuple[Mesh, ...]:
        """The meshes at a time, 0-1, as the animated file shows them; what is not there yet has no triangles. Raises OptionError."""
        return posed(self._unit, float(checked_times([time])[0]))

    def get_ready(self) -> None:
        """Make the animation now, which takes seconds; what is asked for later takes moments."""
        self._unit  # noqa: B018 - it is kept

    def asset(self, *, seconds: float = 10.0, about: dict | None = None) -> Asset:
        """The tree as a file holds it: at rest the final tree; its animation takes so many seconds."""
        if not 0.1 <= seconds <= 3600:
            raise OptionError(f"A growth of {seconds:g} seconds can't be made.", remedy="Ask for 0.1 to 3600.")
        one = self._unit
        moving = one.animation
        stretched = {name: replace(getattr(moving, name), time=getattr(moving, name).time * seconds) for name in ("translation", "rotation", "scale")}
        morphs = tuple(replace(morph, time=morph.time * seconds) for morph in moving.morphs)
        return replace(one, animation=replace(moving, seconds=seconds, morphs=morphs, **stretched), about=about or {})

    @cached_property
    def _unit(self) -> Asset:
        """The asset whose animation takes one second."""
        time = np.linspace(0.0, 1.0, _MOMENTS)
        poses = self.plan.poses(time, pieces=True, whole=False, dtype=np.float64)
        self.pulse()
        motion = with_shoots(motion_of(self.plan, self.lines, self.limbs, self.nodes, self.hosts, poses), self.hosts)
        self.pulse()
        ground = np.unique(motion.base)
        armature = _armature(self.plan, motion, ground)
        first = 1 + len(ground)
        parts, morphs = self._parts(first)
        self.pulse()
        animation = _animation(self.plan, motion, ground, time, poses.size, self.plan.tree.height)
        young = young_leaves(
            self.plan, self.lines, self.nodes, self.hosts, self.model, armature, animation, first, len(parts), key=self.key, pulse=self.pulse
        )
        parts, morphs = (*parts, *(mesh for mesh, _ in young)), (*morphs, *(morph for _, morph in young))
        return Asset.of(parts, skeleton=self.model.skeleton, name="tree", armature=armature, animation=replace(animation, morphs=morphs))

    def _parts(self, first: int):
        parts, morphs = [], []
        for mesh in self.model.meshes:
            if not mesh.triangle_count:
                continue
            self.pulse()
            worn = self._leaves_of(mesh)
            if worn is None:
                mesh, place = parted(mesh, self.lines, self.limbs, mesh_places(self.lines, self.limbs, mesh))
                self.pulse()
                rim = rims(self.lines, self.limbs, self.hosts, place, mesh.position)
                parts.append(_bound(mesh, influences(self.lines, self.limbs, self.nodes, self.hosts, place, rim), first))
                continue
            weights = influences(self.lines, self.limbs, self.nodes, self.hosts, leaf_places(self.plan.tree, self.lines, worn))
            weights = Weights(*(column[leaf_rows(mesh, worn).leaf] for column in weights))
            for piece, morph in cohorts(_bound(mesh, weights, first), worn, self.plan.end, len(parts), 1.0):
                parts.append(piece)
                morphs.append(morph)
        return tuple(parts), tuple(morphs)

    def _leaves_of(self, mesh: Mesh):
        """The leaves, or blossoms, that a mesh shows; None: it is wood."""
        if not mesh.name.startswith("leaf"):
            return None
        return self.model.blossom if mesh.name.startswith("leaf_blossom") else self.model.leaves


def _bound(mesh: Mesh, weights: Weights, first: int) -> Mesh:
    """The mesh with its joints, those of limbs counted from `first`."""
    found = whole(weights)
    columns = {"JOINTS_0": np.where(found.weight > 0, found.joint + first, 0).astype(np.uint16), "WEIGHTS_0": found.weight.astype(np.float32)}
    return replace(mesh, extra={**mesh.extra, **columns})


def _armature(plan: GrowthPlan, motion: Motion, ground) -> Armature:
    """root ─ ground_k ─ all joints that stand on it."""
    tip = plan.straight.pieces.tip
    position = np.vstack([tip[ground].mean(axis=0), tip[ground], motion.position])
    parent = np.r_[NULL, np.zeros(len(ground), np.int64), 1 + np.searchsorted(ground, motion.base)]
    rotation = np.vstack([np.tile([0.0, 0.0, 0.0, 1.0], (1 + len(ground), 1)), motion.rest])
    name = ("root", *(f"ground_{k}" for k in range(len(ground))), *(f"limb_{k}" for k in range(len(motion.base))))
    return Armature(name, parent, position, rotation, np.full(len(parent), 0.02 * max(plan.tree.height, 1e-3)))


def _animation(plan: GrowthPlan, motion: Motion, ground, time, size: Float[np.ndarray, " time"], height: float) -> Animation:
    first = 1 + len(ground)
    joint = first + np.arange(len(motion.base))
    base = plan.straight.pieces.tip[motion.base]
    translation = fewest_keys(joint, time, motion.translation - base[:, None], motion.position - base, np.maximum(_NEAR * height, _NEAR_WOOD * motion.thickness))
    scale = fewest_keys(joint, time, motion.scale, np.ones((len(joint), 3)), _LIKE)
    rotation = _no_turns() if motion.rotation is None else _rotation_keys(joint, time, motion)
    if np.ptp(size) > 0 or size[0] != 1:
        whole_size = np.repeat(np.maximum(size, 1e-4)[None, :, None], len(ground), axis=0).repeat(3, axis=2)
        grounds = fewest_keys(1 + np.arange(len(ground)), time, whole_size, np.ones((len(ground), 3)), _LIKE / 4)
        scale = _joined(grounds, scale)
    return Animation("growth", 1.0, translation, rotation, scale)


def _rotation_keys(joint, time, motion: Motion) -> Keys:
    from scipy.spatial.transform import Rotation

    moments = motion.rotation.shape[1]
    local = Rotation.from_quat(motion.rotation.reshape(-1, 4)) * Rotation.from_quat(np.repeat(motion.rest, moments, axis=0))
    turn = local.as_quat().reshape(motion.rotation.shape)
    flip = np.where(np.sum(turn[:, 0] * motion.rest, axis=1) < 0, -1.0, 1.0)
    return fewest_keys(joint, time, one_sided(turn * flip[:, None, None]), motion.rest, _TURN)


def _no_turns() -> Keys:
    return Keys(np.zeros(0, np.int64), np.zeros(1, np.int64), np.zeros(0), np.zeros((0, 4)))


def _joined(a: Keys, b: Keys) -> Keys:
    return Keys(np.r_[a.joint, b.joint], np.r_[a.start, a.start[-1] + b.start[1:]], np.r_[a.time, b.time], np.vstack([a.value, b.value]))
