"""Which name does a limb keep, whatever else changes? 63-bit ids, from strokes and, for what was not drawn, from parents.

Edits and random numbers are tied to these ids, never to row numbers.
"""

import hashlib

import numpy as np
from jaxtyping import Int

GOLDEN = np.uint64(0x9E3779B97F4A7C15)
_INT63 = np.uint64(0x7FFFFFFFFFFFFFFF)


def stroke_limb_id(stroke_id: str) -> int:
    """The 63-bit id of the limb drawn by this stroke."""
    return int.from_bytes(hashlib.blake2b(stroke_id.encode(), digest_size=8).digest(), "little") >> 1


def child_limb_id(parent_id: Int[np.ndarray, " limb"], rank: Int[np.ndarray, " limb"]) -> Int[np.ndarray, " limb"]:
    """The 63-bit ids of undrawn limbs, each from its parent limb's id and its rank along that limb."""
    with np.errstate(over="ignore"):
        word = mix(np.asarray(parent_id, np.uint64) + GOLDEN * (np.asarray(rank, np.uint64) + np.uint64(1)))
    return (word & _INT63).astype(np.int64)


def mix(word):
    """The output function of splitmix64 (Steele, Lea & Flood 2014): every bit of a 64-bit word depends on every other."""
    word = np.asarray(word, np.uint64)
    word = (word ^ (word >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    word = (word ^ (word >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return word ^ (word >> np.uint64(31))
