"""Which figures has this very plant?

The paper's own wish (§7): parameters that need no species. The internode follows from how far points lie apart and how high the plant is; angles from a skeleton that was traced in the
points, where there is one:

    l = 1.5 s, but H / 250 ≤ l ≤ H / 100      s   median distance to the nearest point: buds that look 4 l at least see the next ones
    ψ = median angle between a limb's first course and what bears it        φ = median turn about a limb from lateral to lateral
    d_k = 0.35 d_i, 1.4 l or two spacings: points farther than that from wood tell of other wood. The paper's 0.5 is meant for markers spread in space
"""

import dataclasses

import numpy as np
from jaxtyping import Float

from sketchtree.axes import NULL
from sketchtree.clouds.growing.box import SIDE, boxed
from sketchtree.clouds.growing.heading import unit
from sketchtree.clouds.growing.species import Species
from sketchtree.clouds.growing.weights import spacing
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import limb_chains

_LEAST, _MOST = 1 / 250, 1 / 100  # of the box
_SPACINGS = 1.5  # between nodes
_COURSE = 3  # nodes that a direction is told by
_ENOUGH = 8  # angles that a median is believed of
KILL = 0.35
"""d_k / d_i, where points are wood."""


def estimated(xyz: Float[np.ndarray, "point 3"], base: Species, tree: TreeSkeleton | None = None, gamma: float | None = None) -> Species:
    """The species with what the points tell; `tree`: what was traced in them, `gamma`: of Eq. 5, if that found one."""
    inside = boxed(xyz).to_sketch(xyz)
    found = {"internode": float(np.clip(_SPACINGS * spacing(inside), _LEAST * SIDE, _MOST * SIDE))}
    if tree is not None:
        branching, roll = _angles(tree)
        found |= {name: float(np.median(value)) for name, value in (("branching", branching), ("roll", roll)) if len(value) >= _ENOUGH}
    if gamma is not None:
        found["gamma"] = float(gamma)
    return dataclasses.replace(base, name="estimated", title=f"{base.title}, as estimated", source="estimated from the cloud", growing=dataclasses.replace(base.growing, kill=KILL), **found)


def _angles(tree: TreeSkeleton) -> tuple[np.ndarray, np.ndarray]:
    """(ψ of every lateral, φ between neighbours along a limb), degrees."""
    parent, tip = tree.parent, tree.tip
    chains = limb_chains(parent, tree.limb)
    laterals: dict[int, list[tuple[int, np.ndarray]]] = {}
    psi, phi = [], []
    for rows in chains:
        bearer = parent[rows[0]]
        if bearer == NULL or parent[bearer] == NULL:
            continue
        way = tip[rows[min(_COURSE, len(rows)) - 1]] - tip[bearer]
        along = tip[bearer] - tip[_back(parent, tree.limb, bearer)]
        way, along = unit(np.stack([way, along]))
        psi.append(np.degrees(np.arccos(np.clip(way @ along, -1.0, 1.0))))
        laterals.setdefault(int(tree.limb[bearer]), []).append((int(bearer), way - (way @ along) * along))
    for borne in laterals.values():
        borne.sort(key=lambda one: one[0])
        for (_, one), (_, other) in zip(borne, borne[1:], strict=False):
            size = np.linalg.norm(one) * np.linalg.norm(other)
            if size > 1e-12:
                phi.append(np.degrees(np.arccos(np.clip(one @ other / size, -1.0, 1.0))))
    return np.array(psi), np.array(phi)


def _back(parent, limb, row):
    """Some nodes back along the same limb."""
    first = row
    for _ in range(_COURSE):
        if parent[first] == NULL or limb[parent[first]] != limb[row]:
            break
        first = parent[first]
    return first if first != row else parent[row]
