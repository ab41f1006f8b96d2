"""Which limb rides on which, and which bough does each belong to?

A *bough* is a limb that grows from a stem, with all that grows on it: it sways as one. Stems and roots belong to none.
A limb's foot lies inside its parent's wood; what is *buried* there moves with the parent, and so does what grows from there on,
as the parent's wood does where the limb comes out of it:

    b_i   the least s at which |x × t| ≥ R or x·t ≥ R + what is left of the parent,  x = x_i(s) − x_i(0)

    x_i(s)   the limb's line     t, R   direction and radius of the parent at the foot     b_i   `buried`, at most half the limb
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.geometry.limbs import CentreLines
from sketchtree.rig.place import places_on
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import generation, generations, sum_to_root


@dataclass(frozen=True, eq=False)
class Boughs:
    """One row a limb of the centre lines, parents before children."""

    depth: Int[np.ndarray, " limb"]  # limbs between it and the ground: 0 on stems and roots
    bough: Int[np.ndarray, " limb"]  # the limb on a stem that it is part of; NULL on stems and roots
    is_root: Bool[np.ndarray, " limb"]  # drawn below the ground, or growing from what is
    buried: Float[np.ndarray, " limb"]  # metres from its foot inside the parent's wood
    exit_s: Float[np.ndarray, " limb"]  # metres along the parent to where it comes out; 0 where there is none
    carried: Float[np.ndarray, " limb"]  # wood of the limb and of all that grows on it, m³

    @property
    def is_stem(self) -> Bool[np.ndarray, " limb"]:
        """Limbs that stand on the ground."""
        return (self.depth == 0) & ~self.is_root


def boughs(tree: TreeSkeleton, lines: CentreLines) -> Boughs:
    """The boughs of a tree; `lines` are its centre lines."""
    depth = generation(lines.parent)
    is_root = tree.kind[lines.first_row] == int(Kind.ROOT)
    bough = np.where((depth == 1) & ~is_root, np.arange(len(lines)), NULL)
    for limbs in generations(lines.parent)[1:]:
        is_root[limbs] |= is_root[lines.parent[limbs]]
        rest = limbs[bough[limbs] == NULL]
        bough[rest] = bough[lines.parent[rest]]
    bough[is_root] = NULL
    buried = _buried(lines)
    return Boughs(depth, bough, is_root, buried, _exits(lines, buried), sum_to_root(lines.parent, _volume(lines)))


def limb_of_row(tree: TreeSkeleton, lines: CentreLines) -> Int[np.ndarray, " segment"]:
    """The limb that each row of the skeleton is part of; NULL at a base that bears none."""
    limb = np.full(len(tree), NULL)
    limb[lines.first_row] = np.arange(len(lines))
    for rows in generations(tree.parent)[1:]:
        rest = rows[limb[rows] == NULL]
        limb[rest] = limb[tree.parent[rest]]
    bearing = np.flatnonzero(tree.is_base[tree.parent] & ~tree.is_base)[::-1]
    base = tree.parent[bearing]
    limb[base] = np.where(limb[base] == NULL, limb[bearing], limb[base])
    return limb


def _buried(lines: CentreLines) -> Float[np.ndarray, " limb"]:
    stem = lines.parent == NULL
    above, at = np.where(stem, 0, lines.parent), np.where(stem, 0.0, lines.parent_s)
    step = 0.02 * lines.length[above]
    chord = lines.at(above, at + step)[0] - lines.at(above, at - step)[0]
    chord /= np.maximum(np.linalg.norm(chord, axis=1, keepdims=True), 1e-12)
    radius = lines.at(above, at)[1]
    limb = lines.of_point
    away = lines.point - lines.point[lines.start[:-1]][limb]
    beside = np.linalg.norm(np.cross(away, chord[limb]), axis=1) - radius[limb]
    past = np.einsum("ij,ij->i", away, chord[limb]) - (lines.length[above] - at + radius)[limb]
    return np.where(stem, 0.0, np.minimum(_first_rise(lines, np.maximum(beside, past)), 0.5 * lines.length))


def _first_rise(lines: CentreLines, value: Float[np.ndarray, " point"]) -> Float[np.ndarray, " limb"]:
    """Metres along each limb to where the value first is no longer negative; its length where it always is."""
    limb, count = lines.of_point, len(lines.point)
    first = np.full(len(lines), count)
    np.minimum.at(first, limb, np.where(value >= 0, np.arange(count), count))
    here = np.minimum(first, count - 1)
    before = np.maximum(here - 1, lines.start[:-1])
    share = np.clip(-value[before] / np.maximum(value[here] - value[before], 1e-12), 0.0, 1.0)
    found = lines.s[before] + share * (lines.s[here] - lines.s[before])
    return np.where(first < count, np.where(here == before, 0.0, found), lines.length)


def _exits(lines: CentreLines, buried) -> Float[np.ndarray, " limb"]:
    child = np.flatnonzero(lines.parent != NULL)
    found = np.zeros(len(lines))
    found[child] = places_on(lines, lines.parent[child], lines.at(child, buried[child])[0]).s
    return found


def _volume(lines: CentreLines) -> Float[np.ndarray, " limb"]:
    inside = np.diff(lines.of_point) == 0
    low, high = lines.radius[:-1], lines.radius[1:]
    span = np.diff(lines.s) * np.pi / 3.0 * (low**2 + low * high + high**2)
    return np.bincount(lines.of_point[:-1][inside], span[inside], minlength=len(lines))
