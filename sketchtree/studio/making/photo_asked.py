"""What is asked about the photo under the page? Named by the server, so nothing here imports more than it does."""

from collections.abc import Hashable
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float

from sketchtree.editing.document import Document, Underlay
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.photo.photo import Photo
from sketchtree.photo.wanted import RULES, PhotoOptions
from sketchtree.sketch.strokes import Stroke, StrokeKind

KEPT = 16  # crowns whose foliage is kept, for undo; where a photo has more, limbs are traced without


@dataclass(frozen=True)
class Place:
    """Where a photo lies under the page, as `Underlay`."""

    x: float
    y: float
    width: float
    height: float

    def to_photo(self, points: Float[np.ndarray, "point 2"], photo: Photo) -> Float[np.ndarray, "point 2"]:
        """Page units, y up → pixels, y UP."""
        return (points - (self.x, self.y)) * (photo.width / self.width, photo.height / self.height)

    def to_page(self, pixels: Float[np.ndarray, "point 2"], photo: Photo) -> Float[np.ndarray, "point 2"]:
        """Pixels, y UP → page units, y up."""
        return pixels * (self.width / photo.width, self.height / photo.height) + (self.x, self.y)

    def unit(self, photo: Photo) -> float:
        """Page units a pixel: of lengths, whatever their direction."""
        return float(np.sqrt(self.width / photo.width * self.height / photo.height))


@dataclass(frozen=True, eq=False)
class Asked:
    """What is to be traced."""

    picture: str  # digest of the photo
    place: Place
    strokes: tuple[Stroke, ...]  # that mark something
    seed: int = 0
    rule: str = RULES[0]  # what counts as foliage

    @property
    def key(self) -> Hashable:
        """The same where the same is asked, for as long as both are there."""
        return self.picture, self.place, tuple(map(id, self.strokes)), self.seed, self.rule

    @classmethod
    def of(cls, document: Document, digest: str) -> "Asked | None":
        """What a drawing asks; None where the picture under it is only one to trace over."""
        underlay = document.underlay
        if not is_photo(underlay):
            return None
        marks = tuple(stroke for stroke in document.strokes.values() if is_mark(stroke))
        return cls(digest, Place(underlay.x, underlay.y, underlay.width, underlay.height), marks, document.seed, document.photo.foliage)


_WORN = ("sag", "shed", "shed_twigs", "untangle", "prune", "leaf", "season", "bark", "wood", "solid")  # options of a tree that `sketchtree photo` has too


@dataclass(frozen=True, eq=False)
class Wish:
    """The tree that is to grow in the photo: as `sketchtree photo` would make it of the same strokes, with the same options."""

    asked: Asked
    wanted: PhotoOptions
    reading: ReadingOptions
    tree: TreeOptions

    @property
    def key(self) -> Hashable:
        """The same where the same tree comes of it."""
        return self.asked.key, self.wanted, self.reading, self.tree

    @classmethod
    def of(cls, document: Document, digest: str) -> "Wish | None":
        """The tree of a drawing; None where no photo lies under it, it has no crown or no limb, or the tree is taken from scribbles (`trunk_asked`)."""
        asked = Asked.of(document, digest)
        if asked is None or document.trunk.on or {stroke.kind for stroke in asked.strokes} != {StrokeKind.BRANCH, StrokeKind.CROWN}:
            return None
        as_seen = document.photo.bare_as_seen and document.tree.season == TreeOptions().season  # another season is asked for
        reading = ReadingOptions(template=document.reading.template, height=document.reading.height)
        tree = TreeOptions(**{name: getattr(document.tree, name) for name in _WORN})
        return cls(asked, replace(document.photo, bare_as_seen=as_seen), reading, tree)


def is_photo(underlay: Underlay | None) -> bool:
    """Do strokes mark what this picture shows?"""
    return underlay is not None and underlay.photo


def is_mark(stroke: Stroke) -> bool:
    """Can it mark something in the photo? Those of turned pages can't."""
    return stroke.view_deg % 360.0 == 0.0 and stroke.kind in (StrokeKind.BRANCH, StrokeKind.CROWN)
