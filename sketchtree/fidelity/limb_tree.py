"""A tree as its limbs: how long, how thick, which way, and where on which other limb each leaves. What measures of structure compare."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import limb_chains


@dataclass(frozen=True, eq=False)
class LimbTree:
    """Limbs, those that bear before those that are borne."""

    parent: Int[np.ndarray, " limb"]  # NULL: stands on the ground
    length: Float[np.ndarray, " limb"]  # metres
    thickness: Float[np.ndarray, " limb"]  # radius where it leaves, metres
    divergence: Float[np.ndarray, " limb"]  # degrees from the limb that bears it; NaN on the ground
    slope: Float[np.ndarray, " limb"]  # degrees from straight up, of its chord
    straightness: Float[np.ndarray, " limb"]  # chord / length, 0-1
    place: Float[np.ndarray, " limb"]  # where on what bears it, 0 foot - 1 tip; 0 on the ground

    def __len__(self) -> int:
        return len(self.parent)


def limb_tree(tree: TreeSkeleton) -> LimbTree:
    """The limbs that have length."""
    each, starts, vectors = tree.length, tree.start, tree.vector
    chains = [rows for rows in limb_chains(tree.parent, tree.limb) if each[rows].sum() > 0]
    number = np.full(len(tree), NULL)
    for k, rows in enumerate(chains):
        number[rows] = k
    along = np.zeros(len(tree))
    for rows in chains:
        along[rows] = np.cumsum(each[rows])
    columns = {name: np.zeros(len(chains)) for name in ("length", "thickness", "divergence", "slope", "straightness", "place")}
    parent = np.full(len(chains), NULL)
    for k, rows in enumerate(chains):
        foot = tree.parent[rows[0]]
        start = starts[rows[0]]
        length, chord = each[rows].sum(), tree.tip[rows[-1]] - start
        parent[k] = NULL if foot == NULL else number[foot]
        columns["length"][k], columns["thickness"][k] = length, tree.radius[rows[0]]
        columns["straightness"][k] = np.linalg.norm(chord) / length
        columns["slope"][k] = _angle(chord, np.array([0.0, 1.0, 0.0]))
        columns["divergence"][k] = np.nan if parent[k] == NULL else _angle(_course(tree.tip[rows], each[rows], start), vectors[foot])
        columns["place"][k] = 0.0 if parent[k] == NULL else along[foot] / columns["length"][parent[k]]
    return LimbTree(parent, **columns)


def _course(tip, length, start):
    """Which way a limb leaves: to the end of its first tenth, or of its first row."""
    total = np.cumsum(length)
    return tip[np.searchsorted(total, 0.1 * total[-1])] - start


def _angle(one, other) -> float:
    size = np.linalg.norm(one) * np.linalg.norm(other)
    return float(np.degrees(np.arccos(np.clip(one @ other / size, -1.0, 1.0)))) if size > 0 else 0.0
