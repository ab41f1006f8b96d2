"""Which joints move a place on the tree, and how much?

Between two nodes of a limb a and b the joints of both, evenly by the way along it,

    w_b = (s − s_a) / (s_b − s_a)        w_a = 1 − w_b

so that a straight limb with joints of different size stays straight and runs evenly from one thickness to the other. In a collar
what is beside the vertex on the parent joins in, as in `rig.collar`.
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.animation.hosts import Hosts, Nodes, hosted
from sketchtree.geometry.limbs import CentreLines
from sketchtree.rig.boughs import Boughs
from sketchtree.rig.collar import Collar
from sketchtree.rig.place import Places
from sketchtree.rig.weights import Weights, strongest


def influences(lines: CentreLines, limbs: Boughs, nodes: Nodes, hosts: Hosts, place: Places, over: Collar | None = None) -> Weights:
    """Joints (counted from 0) and weights of the places; `over` are those that are in collars."""
    own = _along(nodes, hosts, hosted(lines, limbs, hosts, place))
    joint, weight = np.pad(own.joint, ((0, 0), (0, 2))), np.pad(own.weight, ((0, 0), (0, 2)))
    if over is not None and len(over.vertex):
        beside = _along(nodes, hosts, hosted(lines, limbs, hosts, over.place))
        share = over.share[:, None]
        joint[over.vertex, 2:] = beside.joint
        weight[over.vertex] = np.hstack([(1.0 - share) * own.weight[over.vertex], share * beside.weight])
    return strongest(joint, weight)


def _along(nodes: Nodes, hosts: Hosts, place: Places) -> Weights:
    """Two joints a place."""
    first, joints = hosts.first[place.limb], hosts.joints[place.limb]
    passed = _passed(nodes, place.limb, place.s)  # nodes at or below the place
    passed = np.minimum(passed, joints - 1)
    low, high = first + passed, first + np.minimum(passed + 1, joints - 1)
    below = np.where(passed > 0, _s(nodes, place.limb, passed - 1), 0.0)
    above = _s(nodes, place.limb, np.minimum(passed, joints - 2))
    share = np.where(high > low, np.clip((place.s - below) / np.maximum(above - below, 1e-12), 0.0, 1.0), 0.0)
    return Weights(np.column_stack([low, high]), np.column_stack([1.0 - share, share]))


def _passed(nodes: Nodes, limb: Int[np.ndarray, " place"], s: Float[np.ndarray, " place"]) -> Int[np.ndarray, " place"]:
    stride = float(max(nodes.s.max(initial=0.0), s.max(initial=0.0))) + 1.0
    of_node = np.repeat(np.arange(len(nodes.count)), nodes.count)
    return np.searchsorted(of_node * stride + nodes.s, limb * stride + s, side="right") - nodes.start[limb]


def _s(nodes: Nodes, limb, rank):
    return nodes.s[np.clip(nodes.start[limb] + rank, 0, max(len(nodes.s) - 1, 0))] if len(nodes.s) else np.zeros(len(limb))
