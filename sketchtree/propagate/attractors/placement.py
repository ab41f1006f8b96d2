"""Where does every subtree lie on a branch that it replaces, in every turn (Tan et al. 2008, §3.1)?

The supporting branch coincides with the branch replaced: the subtree is scaled by the branch's length ℓ and turned about it, 12 levels of 360°.
Of each piece, v in the subtree, at the share t of the branch with the frame F there,

    v' = ℓ F(t) R_y(2π k / 12) v        k = 0 … 11
    v″ = |v'| (v' + κ a |v'| u) / |…|   a: how far along its branch the piece is; u: to the light

The second line is ours: a twig bows upward and out of the crown by κ as it gets longer. κ = 0 is the paper's.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.propagate.attractors.library import Library
from sketchtree.propagate.attractors.wood import Stretch, Wood

TURNS = 12


@dataclass(frozen=True, eq=False)
class Placed:
    """A library's subtrees in all turns on one branch."""

    stretch: Stretch
    middle: Float[np.ndarray, " 3"]  # of the stretch, metres
    start: Float[np.ndarray, "subtree turn piece 3"]  # metres
    end: Float[np.ndarray, "subtree turn piece 3"]
    there: Bool[np.ndarray, "subtree turn piece"]  # pieces that would be left after pruning


def placed(library: Library, wood: Wood, stretch: Stretch, light: Float[np.ndarray, " 3"], rise: float, turns: int = TURNS) -> Placed:
    """Every subtree of a library in every turn on a stretch. `light`: unit direction, `rise`: κ."""
    origin, frame = wood.line(stretch, library.share)
    angle = 2 * np.pi * np.arange(turns) / turns
    cosine, sine, none, one = np.cos(angle), np.sin(angle), np.zeros(turns), np.ones(turns)
    about = np.array([[cosine, none, sine], [none, one, none], [-sine, none, cosine]]).transpose(2, 0, 1)
    turned = np.einsum("spi,tji->stpj", library.vector * stretch.length, about)
    vector = np.einsum("spij,stpj->stpi", frame, turned)
    length = np.linalg.norm(vector, axis=-1, keepdims=True)
    bent = vector + rise * library.along[:, None, :, None] * length * light
    vector = bent * (length / np.maximum(np.linalg.norm(bent, axis=-1, keepdims=True), 1e-300))
    end = origin[:, None] + np.einsum("spq,stqi->stpi", library.below, vector)
    there = np.broadcast_to(library.there[:, None], end.shape[:3])
    middle, _ = wood.line(stretch, np.array(0.5))
    return Placed(stretch, middle, end - vector, end, there)
