"""Sums along a tree whose gradients need no scatter.

On the processor a scatter costs a hundred times a gather. Two maps of a tree have adjoints that are differences of
running sums over a well-chosen order, so both directions are gathers:

    to tips       z_i = Σ_{j on the way from the base to i} r_j          adjoint: Σ over the subtree of j
    from parents  u_i = v_{p(i)}                                       adjoint: Σ over the children of j
"""

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float


@jax.custom_vjp
def sum_to_tips(rise: Float[Array, " segment"], walk) -> Float[Array, " segment"]:
    """Σ of `rise` from the base to every row. `walk` is a `Walk`.

    Over rows in the order in which a depth-first walk opens them, less over those it has closed by then.
    """
    zero = jnp.zeros(1, rise.dtype)
    closed = jnp.concatenate([zero, jnp.cumsum(rise[walk.closed])])
    return jnp.cumsum(rise[walk.opened])[walk.rank] - closed[walk.behind]


def _tips_forward(rise, walk):
    return sum_to_tips(rise, walk), walk


def _tips_backward(walk, slope):
    running = jnp.concatenate([jnp.zeros(1, slope.dtype), jnp.cumsum(slope[walk.opened])])
    return running[walk.rank + walk.extent] - running[walk.rank], None


sum_to_tips.defvjp(_tips_forward, _tips_backward)


@jax.custom_vjp
def from_parents(vector: Float[Array, "segment 3"], walk) -> Float[Array, "segment 3"]:
    """The parent's row for every row; a base's own."""
    return vector[walk.parent]


def _parents_forward(vector, walk):
    return vector[walk.parent], walk


def _parents_backward(walk, slope):
    running = jnp.concatenate([jnp.zeros((1, 3), slope.dtype), jnp.cumsum(slope[walk.by_parent], axis=0)])
    return running[walk.child_end] - running[walk.child_start], None


from_parents.defvjp(_parents_forward, _parents_backward)
