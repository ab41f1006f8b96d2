"""A little drawing, and what a person does to it."""

import numpy as np

from sketchtree.drawn_tree import DrawnTree, draw_out
from sketchtree.editing.document import Document
from sketchtree.keys import root_key
from sketchtree.limb_ids import stroke_limb_id
from sketchtree.options import ReadingOptions
from sketchtree.sketch.strokes import Stroke

HEIGHT = 100.0
FOOT = 50.0  # x of the trunk


def line(name: str, *points: tuple[float, float], **about) -> Stroke:
    """A stroke through these points, y up."""
    return Stroke(name, np.array(points, float), labelled=True, **about)


STROKES = (
    line("trunk", (FOOT, 0), (FOOT, 50), (FOOT, HEIGHT)),
    line("left", (FOOT, 40), (30, 60), (20, 80)),
    line("right", (FOOT, 45), (70, 62), (82, 85)),
    line("high", (FOOT, 70), (40, 85), (36, 97)),
    line("twig", (30, 60), (24, 62), (14, 66)),
)


def document(*strokes: Stroke, **fields) -> Document:
    """A document of these strokes, no template asked."""
    return Document({stroke.id: stroke for stroke in strokes or STROKES}, reading=ReadingOptions(template="none"), **fields)


def made(one: Document, **how) -> tuple[DrawnTree, Document]:
    """(its drawn tree, the document with what has settled)."""
    drawn = draw_out(one.sketch, key=root_key(one.seed), options=one.reading, edits=one.edits, settled=one.settled, **how)
    return drawn, one.replace(settled=drawn.settled)


def limb(name: str) -> int:
    """The id of the limb that a stroke draws."""
    return stroke_limb_id(name)


def tip_depth(one: Document, name: str) -> float:
    """Where a limb's tip has settled, sketch units."""
    return float(one.settled.limbs[limb(name)].depth[-1])
