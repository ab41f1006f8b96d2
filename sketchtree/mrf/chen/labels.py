"""Which child is apical, and where round the parent does each lateral belong?

Chen et al. 2008, §4 (the label cases) and §5.2.1. Children of one parent carry different labels, so the best of the
K! hypotheses is a linear assignment of children to labels, solved exactly:

    L* = argmax Σ_c log P(v_c, v_p, l_c | Θ)       over permutations l

Eq. 2, one child and one label:   log P(s | Θ) + log P(φ | θ_l) + log P(ϕ | θ_l), each a Gaussian.

A family is the children of one node. Limbs that leave a stem at the ground have no parent segment: they count as
siblings of the stem's first segment, in its frame, and share the labels 2 … K.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int
from scipy.optimize import linear_sum_assignment

from sketchtree.axes import NULL
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.frames import wrap
from sketchtree.parameters import TreeParameters
from sketchtree.traverse import generation


class Family(NamedTuple):
    """The children that one segment shares out its labels among."""

    above: int  # row of the parent segment
    child: Int[np.ndarray, " child"]  # rows
    first_label: int  # 1, or 2 where the apical child is given
    label_count: int  # K


class Families(NamedTuple):
    """Every family of a drawing, parents' first, by generation."""

    generations: tuple[tuple[Family, ...], ...]
    above: Int[np.ndarray, " segment"]  # row of the segment each row diverges from; NULL at bases and stem starts
    child_count: Int[np.ndarray, " segment"]  # K of the family that the row belongs to; 0 at bases and stem starts


class LabelParameters(NamedTuple):
    """θ_l of every label of a family of K, as columns."""

    mu_divergence: Float[np.ndarray, " label"]
    sigma_divergence: Float[np.ndarray, " label"]
    mu_orientation: Float[np.ndarray, " label"]
    sigma_orientation: Float[np.ndarray, " label"]


def families(graph: FactorGraph) -> Families:
    """Who shares labels with whom."""
    above = np.where(graph.parent == NULL, NULL, graph.parent)
    at_ground = (graph.parent != NULL) & graph.is_base[np.maximum(graph.parent, 0)]
    starts = np.flatnonzero(at_ground & (graph.limb_parent[graph.limb] == NULL))
    stem_start = {int(graph.parent[row]): int(row) for row in starts[::-1]}
    for row in np.flatnonzero(at_ground):
        start = stem_start[int(graph.parent[row])]
        above[row] = NULL if row == start else start
    count = np.zeros(len(graph), np.int64)
    by_generation: dict[int, list[Family]] = {}
    level = generation(graph.parent)
    for at, rows in _grouped(above, at_ground):
        given = bool(at_ground[rows[0]])
        labels = len(rows) + given
        count[rows] = labels
        by_generation.setdefault(int(level[rows[0]]), []).append(Family(at, rows, 1 + given, labels))
    return Families(tuple(tuple(by_generation[g]) for g in sorted(by_generation)), above, count)


def _grouped(above, at_ground):
    """(parent segment, its children) for all that have any; those at the ground apart."""
    for ground in (True, False):
        rows = np.flatnonzero((above != NULL) & (at_ground == ground))
        rows = rows[np.argsort(above[rows], kind="stable")]
        for group in np.split(rows, np.flatnonzero(np.diff(above[rows])) + 1):
            if len(group):
                yield int(above[group[0]]), group


def label_parameters(theta: TreeParameters, child_count: int) -> LabelParameters:
    """§4, cases 1-3: θ_1 … θ_K as columns."""
    rows = [theta.child(label, child_count) for label in range(1, child_count + 1)]
    return LabelParameters(*np.array(rows).T)


def log_gaussian(x, mean, sd):
    """log N(x; mean, sd), the constant −½ log 2π left out."""
    return -0.5 * ((x - mean) / sd) ** 2 - np.log(sd)


def log_joint(scale, tilt, turn, label: LabelParameters, theta: TreeParameters):
    """Eq. 2: log P(v_c, v_p, l | Θ). Everything broadcasts; ϕ is compared round the circle."""
    value = log_gaussian(scale, theta.mu_s, theta.sigma_s)
    value = value + log_gaussian(tilt, label.mu_divergence, label.sigma_divergence)
    return value + log_gaussian(wrap(turn - label.mu_orientation), 0.0, label.sigma_orientation)


def best_labels(score: Float[np.ndarray, "child label"]) -> Int[np.ndarray, " child"]:
    """Column of each child in the assignment of greatest total; needs as many labels as children or more."""
    child, label = linear_sum_assignment(score, maximize=True)
    return label[np.argsort(child)]
