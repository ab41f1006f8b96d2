"""Which bones move each vertex, and how much?

Along a limb with bones, bone k takes over from bone k − 1 across the joint between them, within half of the shorter bone; at its foot the
first bone takes over from what moves the parent where the limb comes out:

    share of bones ≥ k    smoothstep((s − s_k + h_k) / 2 h_k),   h_k = ½ min(l_k−1, l_k)
    share of the parent   1 − smoothstep((s − b) / h_0),         h_0 = ½ l_0, at most 8 radii

    s_k, l_k   where bone k begins, its length     b   what of the limb is buried in its parent

A limb without bones, and each leaf, is moved as one by what moves the place it grows from. Vertices of a collar blend into their parent
(`collar.py`). The four strongest bones are kept; weights are whole 255ths and sum to 1.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.geometry.limbs import CentreLines
from sketchtree.rig.bones import Bones
from sketchtree.rig.boughs import Boughs
from sketchtree.rig.collar import Collar, smoothstep
from sketchtree.rig.place import Places
from sketchtree.traverse import generations

_KEPT = 4  # bones that move a vertex
_HINGE = 8.0  # radii: a limb's first bone is its own from here on


class Weights(NamedTuple):
    """One row a vertex; a bone of no weight is bone 0."""

    joint: Int[np.ndarray, "vertex 4"]
    weight: Float[np.ndarray, "vertex 4"]


def place_weights(lines: CentreLines, limbs: Boughs, bones: Bones, place: Places, over: Collar | None = None) -> Weights:
    """Bones and weights of places on the tree; `over` are those that are in collars."""
    feet = _feet(lines, limbs, bones)
    found = _weights(lines, limbs, bones, feet, place)
    if over is not None and len(over.vertex):
        beside = _weights(lines, limbs, bones, feet, over.place)
        own = Weights(*(column[over.vertex] for column in found))
        share = over.share[:, None]
        mixed = strongest(np.hstack([own.joint, beside.joint]), np.hstack([(1.0 - share) * own.weight, share * beside.weight]))
        found.joint[over.vertex], found.weight[over.vertex] = mixed
    return whole(found)


def strongest(joint: Int[np.ndarray, "vertex many"], weight: Float[np.ndarray, "vertex many"]) -> Weights:
    """The four strongest bones of each vertex, those named twice added up; their weights sum to 1."""
    order = np.argsort(joint, axis=1, kind="stable")
    joint, weight = np.take_along_axis(joint, order, axis=1), np.take_along_axis(weight, order, axis=1)
    for k in range(joint.shape[1] - 1):
        twin = joint[:, k] == joint[:, k + 1]
        weight[:, k + 1] += np.where(twin, weight[:, k], 0.0)
        weight[:, k] = np.where(twin, 0.0, weight[:, k])
    order = np.argsort(-weight, axis=1, kind="stable")[:, :_KEPT]
    joint, weight = np.take_along_axis(joint, order, axis=1), np.take_along_axis(weight, order, axis=1)
    return Weights(np.where(weight > 0, joint, 0), weight / np.maximum(weight.sum(axis=1, keepdims=True), 1e-12))


def whole(found: Weights) -> Weights:
    """The same in whole 255ths; what rounding leaves goes to the strongest."""
    part = np.round(255.0 * found.weight)
    part[np.arange(len(part)), found.weight.argmax(axis=1)] += 255.0 - part.sum(axis=1)
    return Weights(np.where(part > 0, found.joint, 0), part / 255.0)


def _feet(lines: CentreLines, limbs: Boughs, bones: Bones) -> Weights:
    """What moves each limb where it comes out of its parent: for a limb without bones, what moves all of it."""
    feet = Weights(np.zeros((len(lines), _KEPT), np.int64), np.zeros((len(lines), _KEPT)))
    feet.weight[:, 0] = 1.0
    for among in generations(lines.parent)[1:]:
        found = _weights(lines, limbs, bones, feet, Places(lines.parent[among], limbs.exit_s[among]))
        feet.joint[among], feet.weight[among] = found
    return feet


def _weights(lines: CentreLines, limbs: Boughs, bones: Bones, feet: Weights, place: Places) -> Weights:
    """Weights by limb and place alone."""
    joint, weight = feet.joint[place.limb].copy(), feet.weight[place.limb].copy()
    own = np.flatnonzero(bones.count[place.limb] > 0)
    if len(own):
        limb, s = place.limb[own], place.s[own]
        parent = _share_of_parent(lines, limbs, bones, limb, s)[:, None]
        chain, share = _along_chain(bones, limb, s)
        mixed = strongest(np.hstack([joint[own], chain]), np.hstack([parent * weight[own], (1.0 - parent) * share]))
        joint[own], weight[own] = mixed
    return Weights(joint, weight)


def _share_of_parent(lines: CentreLines, limbs: Boughs, bones: Bones, limb, s):
    hinge = np.minimum(0.5 * bones.armature.length[bones.first[limb]], _HINGE * lines.radius[lines.start[limb]])
    share = 1.0 - smoothstep((s - limbs.buried[limb]) / np.maximum(hinge, 1e-12))
    return np.where(lines.parent[limb] == NULL, 0.0, share)


def _along_chain(bones: Bones, limb, s):
    """The two bones of the limb's own that share each place (the second may be the first), and their shares."""
    first, count = bones.first[limb], bones.count[limb]
    length = bones.armature.length
    k = np.arange(1, int(bones.count.max()))
    joint = np.minimum(first[:, None] + k, len(length) - 1)
    half = 0.5 * np.minimum(length[joint - 1], length[joint])
    beyond = np.where(k < count[:, None], smoothstep((s[:, None] - bones.s[joint] + half) / (2.0 * half)), 0.0)
    rank = (beyond > 0).sum(axis=1)  # the windows follow each other: only the last may be less than 1
    share = np.where(rank > 0, np.take_along_axis(beyond, np.maximum(rank - 1, 0)[:, None], axis=1)[:, 0], 1.0)
    here = first + rank
    return np.column_stack([here, np.maximum(here - 1, first)]), np.column_stack([share, 1.0 - share])
