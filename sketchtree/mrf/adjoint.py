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
def from_parents(column: Float[Array, " segment"], walk) -> Float[Array, " segment"]:
    """The parent's value for every row; a base's own."""
    return column[walk.parent]


def _parents_forward(column, walk):
    return column[walk.parent], walk


def _parents_backward(walk, slope):
    running = jnp.concatenate([jnp.zeros(1, slope.dtype), jnp.cumsum(slope[walk.by_parent])])
    return running[walk.child_end] - running[walk.child_start], None


from_parents.defvjp(_parents_forward, _parents_backward)
