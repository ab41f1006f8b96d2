"""Which numbers do pixels draw? Those of `patchmatch.chance`, for many pixels at once.

splitmix64 (Steele, Lea & Flood 2014) needs words of 64 bits, which jax has only where it is told to, for a whole program. So a word is a pair (high, low) of
32 bits here. Of the 53 bits of a number the first 24 are kept, which is what a number of single precision holds.
"""

import jax.numpy as jnp
from jaxtyping import Array, Float, Int, UInt

Word = tuple[UInt[Array, "*pixel"], UInt[Array, "*pixel"]]  # high and low half


def chance(seed: Word, x: Int[Array, " pixel"], y: Int[Array, " pixel"], draw: Int[Array, ""]) -> Float[Array, " pixel"]:
    """A number in [0, 1) for every pixel and one draw."""
    z = _add(seed, _times(x, 0x9E3779B97F4A7C15))
    z = _add(z, _times(y, 0xC2B2AE3D27D4EB4F))
    z = _add(z, _times(draw, 0x165667B19E3779F9))
    z = _product(_mixed(z, 30), 0xBF58476D1CE4E5B9)
    z = _product(_mixed(z, 27), 0x94D049BB133111EB)
    high, _ = _mixed(z, 31)
    return (high >> 8).astype(jnp.float32) * jnp.float32(2.0**-24)


def word(number: int) -> tuple[jnp.uint32, jnp.uint32]:
    """A whole number of 64 bits as a pair."""
    return jnp.uint32(number >> 32), jnp.uint32(number & 0xFFFFFFFF)


def _add(one: Word, two: Word) -> Word:
    low = one[1] + two[1]
    return one[0] + two[0] + (low < one[1]).astype(jnp.uint32), low


def _mixed(z: Word, by: int) -> Word:
    """z xor z shifted right by less than 32."""
    high, low = z
    return high ^ (high >> by), low ^ (low >> by | high << (32 - by))


def _times(count: Int[Array, "*pixel"], constant: int) -> Word:
    return _product((jnp.zeros_like(count, jnp.uint32), count.astype(jnp.uint32)), constant)


def _product(z: Word, constant: int) -> Word:
    """The lower 64 bits of a product."""
    high, low = word(constant)
    carried, rest = _whole(z[1], low)
    return carried + z[0] * low + z[1] * high, rest


def _whole(one: UInt[Array, "*pixel"], two: UInt[Array, ""]) -> Word:
    """All 64 bits of the product of two halves, by quarters."""
    a, b, c, d = one >> 16, one & 0xFFFF, two >> 16, two & 0xFFFF
    across = b * c
    middle = (b * d >> 16) + (a * d & 0xFFFF) + (across & 0xFFFF)
    return a * c + (a * d >> 16) + (across >> 16) + (middle >> 16), one * two
