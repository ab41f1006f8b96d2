"""All that a person has made: the drawing, what was done to the tree by hand, the options. A project file keeps this, and so does every step of undo."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field

from sketchtree.editing.edits import Edits
from sketchtree.editing.laid_cloud import CloudChoices, LaidCloud
from sketchtree.editing.settled import Settled
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.photo.wanted import PhotoOptions
from sketchtree.sketch.strokes import SCRIBBLES, Sketch, Stroke
from sketchtree.trunk.wanted import TrunkChoices


@dataclass(frozen=True)
class Underlay:
    """A picture to trace over. It has no part in the tree: strokes have, and limbs that were traced in it once they are taken over."""

    picture: bytes = field(repr=False)  # PNG, JPEG or WebP, as it came
    x: float  # of its top left corner, sketch units
    y: float  # up
    width: float  # sketch units
    height: float
    opacity: float = 0.4
    photo: bool = False  # it shows the tree: strokes mark its crown and limbs (`sketchtree.photo`)


BEGINNING = "english_oak"  # what an empty page grows by until the drawing says otherwise


@dataclass(frozen=True, eq=False)
class Document:
    """Immutable; `replace` makes the next. Strokes are told by their ids, in the order they were drawn."""

    strokes: Mapping[str, Stroke] = field(default_factory=dict)
    edits: Edits = Edits()
    settled: Settled = Settled()  # what the depths have come to; not of the user's making, but the next answer starts here
    reading: ReadingOptions = ReadingOptions()
    tree: TreeOptions = TreeOptions()
    photo: PhotoOptions = PhotoOptions()  # of the tree in a photo under the page
    trunk: TrunkChoices = TrunkChoices()  # of that which scribbles mark in it
    seed: int = 0
    underlay: Underlay | None = None
    cloud: LaidCloud | None = None  # points of a scan behind the strokes
    points: CloudChoices = CloudChoices()  # how they are seen, and used
    name: str = "untitled"
    units: str = "px"
    page: tuple[float, float, float, float] | None = None  # left, bottom, right, top; y up
    warnings: tuple[str, ...] = ()  # of the file it was read from

    def replace(self, **fields) -> "Document":
        """The same document with some fields exchanged."""
        return dataclasses.replace(self, **fields)

    @property
    def sketch(self) -> Sketch:
        """The drawing; strokes of turned pages too (`Stroke.view_deg`)."""
        return Sketch(tuple(self.strokes.values()), name=self.name, units=self.units, page=self.page, warnings=self.warnings)

    @property
    def drawn(self) -> "Document":
        """What the drawn tree hangs on: not the picture, which may be large, nor what is scribbled on it."""
        strokes = self.strokes
        if any(stroke.kind in SCRIBBLES for stroke in strokes.values()):
            strokes = {name: stroke for name, stroke in strokes.items() if stroke.kind not in SCRIBBLES}
        return self.replace(strokes=strokes, underlay=None)

    @classmethod
    def blank(cls, **fields) -> "Document":
        """An empty page."""
        return cls(settled=Settled(template=BEGINNING), **fields)
