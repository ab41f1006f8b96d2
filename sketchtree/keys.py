"""A random key for each named stage, and random numbers tied to a limb rather than to a row.

A stage receives an explicit jax key and splits it by name, so changing one stage leaves the others
alone. Within a stage, numbers are drawn by *limb id*: a drawn limb takes its id from its stroke, any other
from its parent limb's id and its rank along it. Adding a stroke therefore leaves the numbers of
every other limb as they were.

The per-limb generator is counter-based: splitmix64 (Steele, Lea & Flood 2014, "Fast splittable
pseudorandom number generators") over (key, id, draw).
"""

import zlib

import jax
import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree.limb_ids import GOLDEN, mix


def root_key(seed: int) -> Key[Array, ""]:
    """The key of a whole run, from the user's `--seed`."""
    return jax.random.key(seed)


def stage_key(key: Key[Array, ""], name: str) -> Key[Array, ""]:
    """The key of the stage called `name`: independent of every other stage's."""
    return jax.random.fold_in(key, zlib.crc32(name.encode()))


def numpy_generator(key: Key[Array, ""]) -> np.random.Generator:
    """A numpy generator (Philox) that draws the same numbers for the same key."""
    return np.random.Generator(np.random.Philox(np.asarray(jax.random.key_data(key)).astype(np.uint64)))


def uniform(key: Key[Array, ""] | np.uint64, limb_id: Int[np.ndarray, " limb"], draw: int) -> Float[np.ndarray, " limb"]:
    """One number in [0, 1) per limb; `draw` numbers the independent draws of one limb."""
    with np.errstate(over="ignore"):
        salt = mix(_words(key) + GOLDEN * np.uint64(draw + 1))
        word = mix(mix(np.asarray(limb_id, np.uint64) ^ salt) + salt)
    return (word >> np.uint64(11)).astype(np.float64) * 2.0**-53


def normal(key: Key[Array, ""] | np.uint64, limb_id: Int[np.ndarray, " limb"], draw: int) -> Float[np.ndarray, " limb"]:
    """One standard normal number per limb (Box-Muller over two uniform draws)."""
    radius = np.sqrt(-2.0 * np.log1p(-uniform(key, limb_id, 2 * draw + 1_000_003)))
    return radius * np.cos(2.0 * np.pi * uniform(key, limb_id, 2 * draw + 1_000_004))


def draw_key(key: Key[Array, ""] | np.uint64) -> np.uint64:
    """The key as one word: `uniform` and `normal` take it in the key's place and answer the same, without
    asking jax for its words on every call."""
    return _words(key)


def _words(key: Key[Array, ""] | np.uint64) -> np.uint64:
    if isinstance(key, np.uint64):
        return key
    high, low = (np.uint64(int(word)) for word in np.asarray(jax.random.key_data(key)).ravel()[:2])
    return (high << np.uint64(32)) | low
