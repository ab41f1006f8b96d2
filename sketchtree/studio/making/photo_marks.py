"""What do the strokes on the page mark in the photo under it? The strokes of the front, in the photo's pixels.

A photo in hand is half marked most of the time, which is no error: a crown without a limb is left out and said, and without a crown the strokes alone are limbs.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from sketchtree.errors import SketchError
from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import Photo, turned_over
from sketchtree.photo.read_strokes import marked_trees
from sketchtree.sketch.files.svg_writer import sketch_svg
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind
from sketchtree.studio.making.photo_asked import Place

NO_LIMB = "Draw along the trunk, from its foot."
NO_CROWN = "Outline the crown: then branches are found in it."


@dataclass(frozen=True, eq=False)
class Marks:
    """What is marked so far."""

    trees: tuple[Marked, ...] = ()
    crowned: bool = True  # False: no crown is drawn, and that of the only tree is the whole photo
    remark: str = ""


def marks(strokes: Iterable[Stroke], place: Place, photo: Photo) -> Marks:
    """What strokes on the page (`photo_asked.is_mark`) mark. Raises SketchError for a stroke that can mark nothing."""
    there = in_pixels(strokes, place, photo)
    crowns = [stroke for stroke in there if stroke.kind == StrokeKind.CROWN]
    limbs = [stroke for stroke in there if stroke.kind == StrokeKind.BRANCH]
    if not limbs:
        return Marks(remark=NO_LIMB if crowns else "")
    if not crowns:
        return Marks(marked_trees(_sketch([*limbs, _whole(photo)], photo), photo), crowned=False, remark=NO_CROWN)
    return _of_crowns(crowns, limbs, photo)


def in_pixels(strokes: Iterable[Stroke], place: Place, photo: Photo) -> list[Stroke]:
    """The strokes in the photo's pixels, y up."""
    return [replace(stroke, points=place.to_photo(stroke.points, photo)) for stroke in strokes]


def as_svg(strokes: Iterable[Stroke], place: Place, photo: Photo) -> bytes:
    """The strokes as a drawing as large as the photo: `read_strokes` finds the same marks in it, to the last bit."""
    page = (0.0, -float(photo.height), float(photo.width), 0.0)
    pen = place.unit(photo)
    drawn = [replace(stroke, width=None if stroke.width is None else stroke.width / pen) for stroke in in_pixels(strokes, place, photo)]
    return sketch_svg(Sketch(tuple(drawn), name=photo.name, units="px", page=page)).encode()


def _of_crowns(crowns: list[Stroke], limbs: list[Stroke], photo: Photo) -> Marks:
    """The trees of all crowns that have a limb."""
    remark = ""
    while True:
        try:
            return Marks(marked_trees(_sketch([*crowns, *limbs], photo), photo), remark=remark)
        except SketchError as error:
            rest = [crown for crown in crowns if crown.id != error.stroke]
            if not rest or len(rest) == len(crowns):
                raise
            crowns, remark = rest, f"One crown is left out: {error.message.rpartition(': ')[2]}"


def _sketch(strokes: list[Stroke], photo: Photo) -> Sketch:
    return Sketch(tuple(strokes), name=photo.name, units="px")


def _whole(photo: Photo) -> Stroke:
    """All of the photo as a crown."""
    corners = np.array([(0.0, 0.0), (photo.width, 0.0), (photo.width, photo.height), (0.0, photo.height)])
    return Stroke("the photo", turned_over(corners), StrokeKind.CROWN, labelled=True, closed=True)
