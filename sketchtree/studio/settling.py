"""Which of the settled depths are new? Those that are not stay the objects that they were: history and journal keep each only once."""

from dataclasses import fields, replace

import numpy as np

from sketchtree.editing.settled import Depths, Settled

_FIELDS = tuple(field.name for field in fields(Depths))


def sharing(new: Settled, old: Settled) -> Settled:
    """The new depths, made of the old ones where nothing is different; `old` itself if nothing is at all."""
    limbs = {limb: old.limbs[limb] if limb in old.limbs and same(depths, old.limbs[limb]) else depths for limb, depths in new.limbs.items()}
    like = len(limbs) == len(old.limbs) and all(old.limbs.get(limb) is depths for limb, depths in limbs.items())
    others = (one.name for one in fields(Settled) if one.name != "limbs")
    return old if like and all(getattr(new, name) == getattr(old, name) for name in others) else replace(new, limbs=limbs)


def same(one: Depths, other: Depths) -> bool:
    """Are all their fields equal, bit by bit? Unknown deviations, NaN, equal each other then."""
    return one is other or all(_equal(getattr(one, name), getattr(other, name)) for name in _FIELDS)


def _equal(one, other) -> bool:
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return one.shape == other.shape and one.dtype == other.dtype and one.tobytes() == other.tobytes()
    return type(one) is type(other) and one == other
