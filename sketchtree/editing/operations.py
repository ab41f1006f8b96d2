"""What can a person do to the tree by hand? Each takes a document and gives the next.

Nothing here infers: what an operation leaves open is solved when the tree is made again (`editing.settle`).
"""

import dataclasses
from collections.abc import Mapping

import numpy as np

from sketchtree.editing.document import Document
from sketchtree.editing.edits import Adopted, Cleared, Edits, Held
from sketchtree.editing.settled import Depths, Settled, course_of
from sketchtree.editing.turning import in_front
from sketchtree.errors import OptionError

_SAME_PLACE = 0.03  # share of a limb: two places nearer than that are one
_ROOM = 0.12  # radius of the room that a deleted limb leaves, of its length


def hold(document: Document, limb: int, share: float, depth: float) -> Document:
    """The limb's depth at one place is `depth` (sketch units) from now on. Raises OptionError for an unknown limb, or one that is locked as a whole elsewhere."""
    limb = limb_now(document, limb)
    own = _known(document, limb)
    if limb in document.edits.adopted:
        return _bent(document, limb, share, depth - float(np.interp(share, own.share, own.depth)))
    before = document.edits.held.get(limb)
    if before is not None and before.whole:
        return _held(document, Held(limb, before.share, before.depth + _lift(before.share, share) * (depth - np.interp(share, before.share, before.depth)), True))
    places, depths = (np.zeros(0), np.zeros(0)) if before is None else (before.share, before.depth)
    apart = np.abs(places - share) > _SAME_PLACE
    places, depths = np.r_[places[apart], share], np.r_[depths[apart], depth]
    order = np.argsort(places)
    return _held(document, Held(limb, places[order], depths[order]))


def flip(document: Document, limb: int) -> Document:
    """The limb, and all that grows on it, to the other side of where it starts; it is held there. Raises OptionError."""
    limb = limb_now(document, limb)
    own = _known(document, limb)
    if own.parent is None:
        raise OptionError("A trunk has no other side.", remedy="Mirror the whole tree instead.")
    if limb in document.edits.adopted:
        return _turned_adopted(document, limb)
    foot = own.depth[0]
    document = _reflected(document, (limb, *document.settled.borne(limb)), foot)
    own = document.settled.limbs[limb]
    return _held(document, Held(limb, own.share, own.depth, True))


def mirror(document: Document) -> Document:
    """The whole tree to the other side of the page. Limbs drawn on turned pages keep their own shape and move with what they grow on. Raises OptionError where points lie behind the drawing: they
    say on which side each limb is, and a mirrored tree would lie beside them."""
    if document.cloud is not None:
        raise OptionError("The points behind the drawing say on which side each limb is: a mirrored tree would lie beside them.", remedy="Flip single limbs, or take the points away first.")
    cleared = {name: dataclasses.replace(one, path=one.path * (1.0, 1.0, -1.0)) for name, one in document.edits.cleared.items()}
    document = document.replace(edits=dataclasses.replace(document.edits, cleared=cleared))
    return _reflected(document, tuple(document.settled.limbs), 0.0)


def lock(document: Document, limb: int, on: bool) -> Document:
    """The limb stays as it is, or is free again; a limb that was adopted is given up, one that was cleared may grow again. Raises OptionError for an unknown one."""
    limb, edits = limb_now(document, limb), document.edits
    if on:
        own = _known(document, limb)
        return document if limb in edits.adopted else _held(document, Held(limb, own.share, own.depth, True))
    if not any(limb in kind for kind in (edits.held, edits.cleared, edits.adopted)):
        _known(document, limb)
    document = document.replace(edits=Edits(_without(edits.held, limb), _without(edits.cleared, limb), edits.adopted))
    return _given_up(document, limb) if limb in edits.adopted else document


def delete(document: Document, limb: int) -> Document:
    """The limb and all that grows on it, their strokes too, are gone; where an adopted one stood nothing grows again. Raises OptionError for an unknown limb."""
    limb = limb_now(document, limb)
    _known(document, limb)
    gone = {limb, *document.settled.borne(limb)}
    adopted = document.edits.adopted.get(limb)
    if adopted is not None:
        document = clear(document, adopted)
    strokes = {name for one in gone for name in document.settled.limbs[one].strokes}
    edits = document.edits
    return document.replace(
        strokes={name: stroke for name, stroke in document.strokes.items() if name not in strokes},
        edits=Edits(_without(edits.held, *gone), edits.cleared, _without(edits.adopted, *gone)),
        settled=dataclasses.replace(document.settled, limbs=_without(document.settled.limbs, *gone)),
    )


def settle_anew(document: Document) -> Document:
    """All depths that nobody holds are open again; an automatic template may be another."""
    return document.replace(settled=Settled())


def pick(document: Document, settled: Settled) -> Document:
    """One of the other readings."""
    return document.replace(settled=settled)


def adopt(document: Document, adopted: Adopted) -> Document:
    """An undrawn limb counts as drawn from now on, and so does the undrawn limb it grows on. Raises OptionError if that is not there any more."""
    if adopted.on is not None:
        document = adopt(document, adopted.on)
    _known(document, adopted.parent)
    kept = dataclasses.replace(adopted, foot=None, on=None)
    edits = dataclasses.replace(document.edits, adopted={**document.edits.adopted, adopted.limb: kept})
    limbs = {**document.settled.limbs, adopted.limb: adopted_depths(kept, document.settled)}
    return document.replace(edits=edits, settled=dataclasses.replace(document.settled, limbs=limbs))


def clear(document: Document, adopted: Adopted) -> Document:
    """Nothing grows any more where this limb stands. Raises OptionError if what it grows on is not there any more."""
    if adopted.foot is None:
        _known(document, adopted.parent)
    foot = foot_on(document.settled, adopted.parent, adopted.share) if adopted.foot is None else adopted.foot
    length = float(np.linalg.norm(np.diff(adopted.path, axis=0), axis=1).sum())
    limb = adopted.limb if adopted.was < 0 else adopted.was
    room = Cleared(limb, adopted.path + foot, max(_ROOM * length, adopted.radius))
    return document.replace(edits=dataclasses.replace(document.edits, cleared={**document.edits.cleared, limb: room}))


def limb_now(document: Document, limb: int) -> int:
    """The id that a limb has now: an adopted one has another than when it was undrawn, since its place on its parent may grow anew."""
    if limb in document.settled.limbs:
        return limb
    return next((one.limb for one in document.edits.adopted.values() if one.was == limb), limb)


def foot_on(settled: Settled, limb: int, share: float):
    """Where a place on a limb is: x, y, z of the front page, sketch units; between the places that are known of its course."""
    parent = settled.limbs[limb]
    even = np.linspace(0.0, 1.0, len(parent.course))
    page = [np.interp(share, even, parent.course[:, axis]) for axis in (0, 1)]
    return in_front(np.array([*page, np.interp(share, parent.share, parent.depth)]), parent.view_deg, settled.axis)


def adopted_depths(adopted: Adopted, settled: Settled) -> Depths:
    """An adopted limb as a limb that is settled; it stands on the front page."""
    path = adopted.path + foot_on(settled, adopted.parent, adopted.share)
    along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(path[:, :2], axis=0), axis=1))]
    share = along / max(along[-1], 1e-300)
    return Depths(share, path[:, 2], np.zeros(len(path)), course_of(path[:, :2]), adopted.parent, ())


def _known(document: Document, limb: int) -> Depths:
    if limb not in document.settled.limbs:
        raise OptionError("That limb is not there any more.", remedy="Wait until the tree is ready, then pick the limb again.")
    return document.settled.limbs[limb]


def _held(document: Document, held: Held) -> Document:
    return document.replace(edits=dataclasses.replace(document.edits, held={**document.edits.held, held.limb: held}))


def _reflected(document: Document, limbs: tuple[int, ...], plane: float) -> Document:
    """These limbs' depths, settled and held, on the other side of a plane; those of turned pages stay as they are."""
    settled, held, adopted = dict(document.settled.limbs), dict(document.edits.held), dict(document.edits.adopted)
    for limb in limbs:
        if settled[limb].view_deg != 0.0:
            continue
        settled[limb] = dataclasses.replace(settled[limb], depth=2 * plane - settled[limb].depth)
        if limb in held:
            held[limb] = dataclasses.replace(held[limb], depth=2 * plane - held[limb].depth)
        if limb in adopted:
            adopted[limb] = dataclasses.replace(adopted[limb], path=adopted[limb].path * (1.0, 1.0, -1.0))
    edits = dataclasses.replace(document.edits, held=held, adopted=adopted)
    return document.replace(edits=edits, settled=dataclasses.replace(document.settled, limbs=settled))


def _lift(places, share: float):
    """How much of a move at `share` each place takes part in: from nothing at the foot to all of it there and beyond."""
    return np.clip(places / max(share, 1e-9), 0.0, 1.0)


def _bent(document: Document, limb: int, share: float, rise: float) -> Document:
    adopted, own = document.edits.adopted[limb], document.settled.limbs[limb]
    path = adopted.path + np.array([0.0, 0.0, rise]) * _lift(own.share, share)[:, None]
    return adopt(document, dataclasses.replace(adopted, path=path))


def _turned_adopted(document: Document, limb: int) -> Document:
    return adopt(document, dataclasses.replace(document.edits.adopted[limb], path=document.edits.adopted[limb].path * (1.0, 1.0, -1.0)))


def _given_up(document: Document, limb: int) -> Document:
    """No longer adopted, nor is what was adopted on it."""
    gone = {limb, *(one for one in document.settled.borne(limb) if one in document.edits.adopted)}
    edits = dataclasses.replace(document.edits, adopted=_without(document.edits.adopted, *gone))
    return document.replace(edits=edits, settled=dataclasses.replace(document.settled, limbs=_without(document.settled.limbs, *gone)))


def _without(mapping: Mapping, *names) -> dict:
    return {name: value for name, value in mapping.items() if name not in names}
