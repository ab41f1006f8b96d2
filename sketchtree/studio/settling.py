"""Which of the settled depths are new? Those that are not stay the objects that they were: history and journal keep each only once.

And which are there before the whole tree is? Those of the hurried one, which the page shows: whoever edits a limb that was drawn just now need not wait.
"""

from dataclasses import fields, replace

import numpy as np

from sketchtree.editing.document import Document
from sketchtree.editing.settled import Depths, Settled

_FIELDS = tuple(field.name for field in fields(Depths))


def sharing(new: Settled, old: Settled) -> Settled:
    """The new depths, made of the old ones where nothing is different; `old` itself if nothing is at all."""
    limbs = {limb: old.limbs[limb] if limb in old.limbs and same(depths, old.limbs[limb]) else depths for limb, depths in new.limbs.items()}
    like = len(limbs) == len(old.limbs) and all(old.limbs.get(limb) is depths for limb, depths in limbs.items())
    others = (one.name for one in fields(Settled) if one.name != "limbs")
    return old if like and all(getattr(new, name) == getattr(old, name) for name in others) else replace(new, limbs=limbs)


def known_at_once(document: Document, limb: int, rough: Settled | None) -> Document | None:
    """The document, in which that limb, and what it grows on, have depths: settled ones, else rough ones. None: it is not drawn."""
    known = dict(document.settled.limbs)
    while limb is not None and limb not in known:
        depths = None if rough is None else rough.limbs.get(limb)
        if depths is None or not depths.strokes or any(name not in document.strokes for name in depths.strokes):
            return None
        known[limb] = depths
        limb = depths.parent
    return document if len(known) == len(document.settled.limbs) else document.replace(settled=replace(document.settled, limbs=known))


def same(one: Depths, other: Depths) -> bool:
    """Are all their fields equal, bit by bit? Unknown deviations, NaN, equal each other then."""
    return one is other or all(_equal(getattr(one, name), getattr(other, name)) for name in _FIELDS)


def _equal(one, other) -> bool:
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return one.shape == other.shape and one.dtype == other.dtype and one.tobytes() == other.tobytes()
    return type(one) is type(other) and one == other
