"""What would the stroke in hand be, in space; or the limb that is being dragged, with all that grows on it?"""

import numpy as np

from sketchtree.drawn_tree import DrawnTree, draw_out
from sketchtree.editing import operations
from sketchtree.editing.document import Document
from sketchtree.errors import SketchTreeError
from sketchtree.keys import root_key
from sketchtree.limb_ids import stroke_limb_id
from sketchtree.similarity import Similarity
from sketchtree.skeleton import Kind
from sketchtree.studio import messages
from sketchtree.studio.making.basis import Basis
from sketchtree.studio.making.frames import Arrays
from sketchtree.studio.making.work import Bench
from sketchtree.studio.wire import stroke_in

_MOST = 60  # limbs that a ghost shows


def ghost(bench: Bench, revision: int, document: Document, stroke: messages.Stroke | None, hold: messages.Hold | None, basis: Basis | None) -> bytes:
    """A `Ghost` frame; without limbs where nothing can be said."""
    try:
        drawn, limbs = _stroke(bench, document, stroke, basis) if stroke is not None else _held(bench, document, hold, basis)
    except SketchTreeError:  # half a stroke is often no drawing yet; the whole one will be told of
        drawn, limbs = None, ()
    arrays, radius = Arrays(), []
    for k, limb in enumerate(limbs[:_MOST]):
        path, thick = _path(drawn, limb)
        arrays.put(f"{k}/path", "f4", path)
        radius.append(thick)
    return arrays.frame(messages.Ghost(revision=revision, radius=radius, arrays=[]))


def _stroke(bench: Bench, document: Document, stroke: messages.Stroke, basis: Basis | None):
    said = stroke_in(stroke)
    drawn = _quick(bench, document.replace(strokes={**document.strokes, said.id: said}), basis)
    limb = stroke_limb_id(said.id)
    return drawn, [limb] if limb in drawn.settled.limbs else sorted(drawn.touched)


def _held(bench: Bench, document: Document, hold: messages.Hold | None, basis: Basis | None):
    if hold is None:
        return None, ()
    limb = operations.limb_now(document, int(hold.limb))
    drawn = _quick(bench, operations.hold(document, limb, hold.share, hold.depth), basis)
    return drawn, [limb, *drawn.settled.borne(limb)]


def _quick(bench: Bench, document: Document, basis: Basis | None) -> DrawnTree:
    similarity = None if basis is None else Similarity(basis.scale, basis.translate)
    known = {"edits": document.edits, "settled": document.settled, "cloud": document.cloud, "similarity": similarity}
    return draw_out(document.sketch, bench.templates, key=root_key(document.seed), options=document.reading, quick=True, **known)


def _path(drawn: DrawnTree, limb: int):
    """(a limb's course, metres; its radius at the foot)."""
    tree = drawn.skeleton
    rows = np.flatnonzero((tree.limb == limb) & ~tree.is_base & (tree.kind != Kind.ROOT))
    if not len(rows):
        return np.zeros((0, 3)), 0.0
    return np.concatenate([tree.curve(rows[0])[:1], *[tree.curve(row)[1:] for row in rows]]), float(tree.radius[rows[0]])
