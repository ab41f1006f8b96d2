"""Which joints move a place on the tree, and how much?

Between two nodes of a limb a and b the joints of both, evenly by the way along it,

    w_b = (s − s_a) / (s_b − s_a)        w_a = 1 − w_b

so that a straight limb with joints of different size stays straight and runs evenly from one thickness to the other; what of a limb is
buried in what bears it, its foot alone. Bark round the foot of a branch goes with that foot too (`rims`).
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.animation.hosts import Hosts, Nodes, hosted
from sketchtree.animation.rims import Rim
from sketchtree.geometry.limbs import CentreLines
from sketchtree.rig.boughs import Boughs
from sketchtree.rig.place import Places
from sketchtree.rig.weights import Weights, strongest


def influences(lines: CentreLines, limbs: Boughs, nodes: Nodes, hosts: Hosts, place: Places, rim: Rim | None = None) -> Weights:
    """Joints (counted from 0) and weights of the places."""
    own = _along(limbs, nodes, hosts, hosted(lines, limbs, hosts, place))
    joint, weight = np.pad(own.joint, ((0, 0), (0, 2))), np.pad(own.weight, ((0, 0), (0, 2)))
    if rim is not None and len(rim.vertex):
        joint[rim.vertex, 2] = hosts.first[rim.limb]
        weight[rim.vertex, :2] *= 1.0 - rim.share[:, None]
        weight[rim.vertex, 2] = rim.share
    return strongest(joint, weight)


def _along(limbs: Boughs, nodes: Nodes, hosts: Hosts, place: Places) -> Weights:
    """Two joints a place."""
    first, joints = hosts.first[place.limb], hosts.joints[place.limb]
    passed = np.minimum(_passed(nodes, place.limb, place.s), joints - 1)  # nodes at or below the place
    low, high = first + passed, first + np.minimum(passed + 1, joints - 1)
    below = np.where(passed > 0, _s(nodes, place.limb, passed - 1), limbs.buried[place.limb])
    above = _s(nodes, place.limb, np.minimum(passed, joints - 2))
    share = np.where(high > low, np.clip((place.s - below) / np.maximum(above - below, 1e-12), 0.0, 1.0), 0.0)
    return Weights(np.column_stack([low, high]), np.column_stack([1.0 - share, share]))


def _passed(nodes: Nodes, limb: Int[np.ndarray, " place"], s: Float[np.ndarray, " place"]) -> Int[np.ndarray, " place"]:
    stride = float(max(nodes.s.max(initial=0.0), s.max(initial=0.0))) + 1.0
    of_node = np.repeat(np.arange(len(nodes.count)), nodes.count)
    return np.searchsorted(of_node * stride + nodes.s, limb * stride + s, side="right") - nodes.start[limb]


def _s(nodes: Nodes, limb, rank):
    return nodes.s[np.clip(nodes.start[limb] + rank, 0, max(len(nodes.s) - 1, 0))] if len(nodes.s) else np.zeros(len(limb))
