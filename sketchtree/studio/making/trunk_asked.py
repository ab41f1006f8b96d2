"""Which tree is to be taken from the scribbles on the photo under the page? Named by the server, so nothing here imports more than it does."""

from collections.abc import Hashable
from dataclasses import dataclass

from sketchtree.editing.document import Document
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.sketch.strokes import SCRIBBLES, Stroke
from sketchtree.studio.making.photo_asked import Place, is_photo
from sketchtree.trunk.wanted import TrunkChoices


@dataclass(frozen=True, eq=False)
class TrunkWish:
    """All that it hangs on."""

    picture: str  # digest of the photo
    place: Place
    strokes: tuple[Stroke, ...]  # scribbles, page units
    choices: TrunkChoices
    seed: int
    reading: ReadingOptions
    tree: TreeOptions

    @property
    def key(self) -> Hashable:
        """The same where the same tree comes of it, for as long as both are there."""
        return self.picture, self.place, tuple(map(id, self.strokes)), self.choices, self.seed, self.reading, self.tree

    @classmethod
    def of(cls, document: Document, digest: str) -> "TrunkWish | None":
        """The tree of a drawing; None where it is not taken from scribbles."""
        if not document.trunk.on or not is_photo(document.underlay):
            return None
        under = document.underlay
        strokes = tuple(stroke for stroke in document.strokes.values() if stroke.kind in SCRIBBLES)
        reading = ReadingOptions(template=document.reading.template, height=document.reading.height)
        return cls(digest, Place(under.x, under.y, under.width, under.height), strokes, document.trunk, document.seed, reading, document.tree)
