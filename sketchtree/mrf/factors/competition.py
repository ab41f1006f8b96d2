"""Tips compete for light: log P_d(p_i) = −w_d Σ_k m_k exp(−λ |p_i − p_k| / R_c).

Chen et al. 2008, §5.2.1, name this field but the formula is lost in our copy; this one is ours, with their default
attenuation λ = 5.

    R_c   half the drawn width      m_k = 1      w_d = 1      each pair once

It must stay local: extent and crown hold the scale of the depths.
"""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int

from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.padding import Padding
from sketchtree.mrf.factors.angles import total

ATTENUATION = 5.0  # λ
WEIGHT = 1.0  # w_d
RIVALS = 12  # that one tip may have
RIVALS_OF_MANY = 6  # in very large drawings
MANY_LIMBS = 1024


class Competition(eqx.Module):
    """One factor a competing tip, for its half of the pairs."""

    point: Int[Array, " point"]  # row
    rival: Int[Array, "rival point"]  # points
    present: Float[Array, "rival point"]
    page_square: Float[Array, "rival point"]  # squared distance on the page, which no ψ changes
    crown_radius: Float[Array, ""]  # R_c

    @classmethod
    def of(cls, graph: FactorGraph, pad: Padding, *, shape: float) -> "Competition":
        """The factors of a drawing: every competing tip's nearest rivals, each pair from both ends or not at all."""
        most = RIVALS if pad.limbs <= MANY_LIMBS else RIVALS_OF_MANY
        rows, index = np.unique(graph.competitor, return_inverse=True)
        both = index.reshape(-1, 2)
        one, other = np.r_[both[:, 0], both[:, 1]], np.r_[both[:, 1], both[:, 0]]
        pair = np.tile(np.arange(len(both)), 2)
        apart = np.linalg.norm(graph.xy[rows[one]] - graph.xy[rows[other]], axis=1)
        while len(one):
            by = np.lexsort((np.arange(len(one)), apart, one))
            one, other, pair, apart = one[by], other[by], pair[by], apart[by]
            slot = np.arange(len(one)) - np.searchsorted(one, one)
            if slot.max() < most:
                break
            keep = ~np.isin(pair, pair[slot >= most])
            one, other, pair, apart = one[keep], other[keep], pair[keep], apart[keep]
        rival, present, square = (np.zeros((2 * pad.limbs, most), kind) for kind in (int, float, float))
        if len(one):
            rival[one, slot], present[one, slot], square[one, slot] = other, shape, apart**2
        points = 2 * pad.limbs
        return cls(
            pad.index(rows, points), pad.index(rival, points).T, pad.real(present, points).T,
            pad.real(square, points).T, np.asarray(graph.crown_radius, pad.dtype),
        )  # fmt: skip

    def log_potential(self, assignment, theta) -> Float[Array, " point"]:
        """−½ w_d Σ_k exp(−λ d / R_c). The gradient by p_k comes from k's own factor, so here it is held."""
        twice = _field(assignment.tip.z[self.point], self)
        return twice - 0.5 * jax.lax.stop_gradient(twice)


@jax.custom_vjp
def _field(z: Float[Array, " point"], rivals: Competition) -> Float[Array, " point"]:
    """−w_d Σ_k exp(−λ d / R_c) at every point, the rivals held."""
    return _field_forward(z, rivals)[0]


def _field_forward(z, rivals):
    apart = z - z[rivals.rival]
    distance = jnp.sqrt(rivals.page_square + apart**2 + 1e-8)
    rate = ATTENUATION / rivals.crown_radius
    each = WEIGHT * rivals.present * jnp.exp(-rate * distance)
    return -total(each), total(rate * each * apart / distance)


def _field_backward(slope_by_z, slope):
    return slope * slope_by_z, None


_field.defvjp(_field_forward, _field_backward)

