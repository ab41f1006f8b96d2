"""Which limbs get bones, and where are the joints?

The limbs that carry most wood, the limb that each grows from before it, as long as there are joints to give. Joints stand along a limb
at even steps of

    m(s) = s / L + |bend up to s| / 180°       the fewer the straighter and the shorter it is: n = 1 + m(L) L / 0.3 H, from 2 to 5

    L   length of the limb      H   height of the tree

A joint's +y runs along its bone, to the next joint or the limb's tip, by the shortest turn from upright. Names come from the limbs' ids, so that
a limb's bones keep theirs whatever else is drawn: `bone_trunk_0`, `bone_1f0a93c2_0`, …; several stems hang from `bone_root`.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.asset import Armature
from sketchtree.axes import NULL
from sketchtree.geometry.limbs import CentreLines
from sketchtree.rig.boughs import Boughs
from sketchtree.rig.place import Places, along

_FEW, _MANY = 2, 5  # joints of a limb
_STEP = 0.3  # heights of the tree, of a straight bone
_STUB = 0.02  # heights of the tree: a shorter limb needs no bone


@dataclass(frozen=True, eq=False)
class Bones:
    """An armature, and where on the tree its joints stand."""

    armature: Armature
    limb: Int[np.ndarray, " joint"]  # NULL: `bone_root`
    s: Float[np.ndarray, " joint"]  # metres along the limb, where its bone begins
    first: Int[np.ndarray, " limb"]  # first joint of each limb; NULL where it has none
    count: Int[np.ndarray, " limb"]  # how many it has


def bones(lines: CentreLines, limbs: Boughs, *, most: int = 64) -> Bones:
    """Bones for the main limbs, `most` joints (≥ 3) at most. There is at least one limb."""
    height = float(np.ptp(lines.point[:, 1])) or 1.0
    stems = np.flatnonzero(limbs.is_stem)
    measure = _measure(lines)
    count = _joints_given(lines, limbs, _joints_wanted(lines, measure, height), height, most - (len(stems) > 1))
    chosen = np.flatnonzero(count)
    chosen = chosen[np.lexsort((-limbs.carried[chosen], limbs.depth[chosen]))]
    root = int((limbs.is_stem[chosen]).sum() > 1)
    first = np.full(len(lines), NULL)
    first[chosen] = root + np.r_[0, np.cumsum(count[chosen])][:-1]
    limb = np.repeat(chosen, count[chosen])
    rank = np.arange(len(limb)) - (first[limb] - root)
    s = _at_measure(lines, measure, limb, rank / count[limb])
    armature = _armature(lines, limbs, limb, rank, s, first, count, root)
    return Bones(armature, np.r_[np.full(root, NULL), limb], np.r_[np.zeros(root), s], first, count)


def _measure(lines: CentreLines) -> Float[np.ndarray, " point"]:
    """m at every point of the lines."""
    inside = np.r_[False, np.diff(lines.of_point) == 0]
    chord = np.diff(lines.point, axis=0, prepend=lines.point[:1])
    chord /= np.maximum(np.linalg.norm(chord, axis=1, keepdims=True), 1e-12)
    cosine = np.clip(np.einsum("ij,ij->i", chord, np.roll(chord, 1, axis=0)), -1.0, 1.0)
    turn = np.where(inside & np.r_[False, inside[:-1]], np.arccos(cosine), 0.0)
    total = np.cumsum(turn)
    return lines.s / lines.length[lines.of_point] + (total - total[lines.start[:-1]][lines.of_point]) / np.pi


def _joints_wanted(lines: CentreLines, measure, height: float) -> Int[np.ndarray, " limb"]:
    whole = measure[lines.start[1:] - 1] * lines.length / (_STEP * height)
    return np.clip(np.round(1.0 + whole), _FEW, _MANY).astype(np.int64)


def _joints_given(lines: CentreLines, limbs: Boughs, wanted, height: float, most: int) -> Int[np.ndarray, " limb"]:
    """How many joints each limb gets: those that carry most wood first, none before what it grows from; the first stem in any case."""
    given, left = np.zeros(len(lines), np.int64), most
    order = np.lexsort((np.arange(len(lines)), -limbs.carried, ~limbs.is_stem))
    for limb in order.tolist():
        if limbs.is_root[limb] or (not limbs.is_stem[limb] and (not given[lines.parent[limb]] or lines.length[limb] < _STUB * height)):
            continue
        if wanted[limb] > left and left < most:
            break
        given[limb] = min(wanted[limb], left)
        left -= int(given[limb])
    return given


def _at_measure(lines: CentreLines, measure, limb, share) -> Float[np.ndarray, " joint"]:
    """Metres along each limb to where `share` of its measure is reached."""
    stride = float(measure.max(initial=0.0)) + 1.0
    place = lines.of_point * stride + measure
    target = limb * stride + share * measure[lines.start[limb + 1] - 1]
    return np.interp(target, place, lines.s)


def _armature(lines: CentreLines, limbs: Boughs, limb, rank, s, first, count, root: int) -> Armature:
    place = Places(limb, s)
    head = along(lines, lines.point, place)
    is_last = rank == count[limb] - 1
    tip = lines.point[lines.start[limb + 1] - 1]
    tail = np.where(is_last[:, None], tip, np.roll(head, -1, axis=0))
    vector = tail - head
    above = np.where(lines.parent[limb] == NULL, np.where(root, 0, NULL), _bone_at(lines, limbs, first, count, limb, s, root))
    parent = np.where(rank > 0, root + np.arange(len(limb)) - 1, above)
    name = [f"bone_{word}_{k}" for word, k in zip(_words(lines, limbs, limb), rank.tolist(), strict=True)]
    length = np.linalg.norm(vector, axis=1)
    if root:
        ground = head[(rank == 0) & (lines.parent[limb] == NULL)].mean(axis=0)
        name, parent, head = ["bone_root", *name], np.r_[NULL, parent], np.vstack([ground, head])
        vector, length = np.vstack([[0.0, 1.0, 0.0], vector]), np.r_[length.max(), length]
    return Armature(tuple(name), parent.astype(np.int64), head, upright_to(vector), length)


def _bone_at(lines: CentreLines, limbs: Boughs, first, count, limb, s, root: int) -> Int[np.ndarray, " joint"]:
    """The joint of its parent limb that each limb's foot lies on."""
    above = np.maximum(lines.parent[limb], 0)
    k = np.arange(_MANY)
    joint = np.minimum(first[above][:, None] + k - root, len(s) - 1)
    passed = (k < count[above][:, None]) & (s[joint] <= limbs.exit_s[limb][:, None] + 1e-9)
    return first[above] + np.maximum(passed.sum(axis=1) - 1, 0)


def _words(lines: CentreLines, limbs: Boughs, limb) -> list[str]:
    """A short name for each joint's limb: eight hexadecimal digits of its id, all sixteen if two have the same eight."""
    ids = {int(i): f"{int(lines.limb_id[i]) >> 31:08x}" for i in np.unique(limb)}
    short = list(ids.values())
    names = {i: word if short.count(word) == 1 else f"{int(lines.limb_id[i]):016x}" for i, word in ids.items()}
    if limbs.is_stem[np.unique(limb)].sum() == 1:
        names[int(limb[limbs.is_stem[limb]][0])] = "trunk"
    return [names[int(i)] for i in limb]


def upright_to(vector: Float[np.ndarray, "joint 3"]) -> Float[np.ndarray, "joint 4"]:
    """Unit quaternions x y z w of the shortest turns from +y to the vectors."""
    y = vector / np.maximum(np.linalg.norm(vector, axis=1, keepdims=True), 1e-12)
    turn = np.column_stack([y[:, 2], np.zeros(len(y)), -y[:, 0], 1.0 + y[:, 1]])
    down = turn[:, 3] < 1e-6
    turn[down] = [1.0, 0.0, 0.0, 0.0]
    return turn / np.linalg.norm(turn, axis=1, keepdims=True)
