"""What is asked about the photo under the page? Named by the server, so nothing here imports more than it does."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from sketchtree.editing.document import Document, Underlay
from sketchtree.photo.photo import Photo
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

    @classmethod
    def of(cls, document: Document, digest: str) -> "Asked | None":
        """What a drawing asks; None where the picture under it is only one to trace over."""
        underlay = document.underlay
        if not is_photo(underlay):
            return None
        marks = tuple(stroke for stroke in document.strokes.values() if is_mark(stroke))
        return cls(digest, Place(underlay.x, underlay.y, underlay.width, underlay.height), marks, document.seed)


def is_photo(underlay: Underlay | None) -> bool:
    """Do strokes mark what this picture shows?"""
    return underlay is not None and underlay.photo


def is_mark(stroke: Stroke) -> bool:
    """Can it mark something in the photo? Those of turned pages can't."""
    return stroke.view_deg % 360.0 == 0.0 and stroke.kind in (StrokeKind.BRANCH, StrokeKind.CROWN)
