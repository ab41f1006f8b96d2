"""How does a tree come of scribbles on a photo that a drawing keeps? One chain for the studio and for a project of it (`sketchtree grow PROJECT`).

    strokes of the kinds foreground, background → matte       as `matting.find_matte`
    strokes of the kinds matte_add, matte_erase → its edits   as `trunk.edit_matte`
    TrunkChoices                                → the matting, the contour's edits, root, gap, lift, levels of branches

A project holds them as strokes on its page, the photo as its underlay; the tree is made of them anew.
"""

import dataclasses
import json
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from jaxtyping import Array, Key

from sketchtree.errors import SketchError
from sketchtree.growth_tree import Beginning, FoundTrunk, GrowthOptions, TrunkOptions, find_trunk, of_picture
from sketchtree.keys import stage_key
from sketchtree.matting.alpha import Matte
from sketchtree.matting.matte import find_matte
from sketchtree.matting.scribbles import scribbled
from sketchtree.options import DrawingOptions, ReadingOptions, TreeOptions
from sketchtree.photo.photo import Photo
from sketchtree.photo.read_photo import photo_in
from sketchtree.sketch.files.project import TRUNK, column, holds_photo
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.strokes import SCRIBBLES, Sketch, Stroke, StrokeKind
from sketchtree.templates.store.database import Database
from sketchtree.trunk.edit_matte import sketched
from sketchtree.trunk.wanted import TrunkChoices
from sketchtree.watch import Pulse, Watch, no_pulse

_SAYS = (StrokeKind.FOREGROUND, StrokeKind.BACKGROUND)
_NAME = "The drawing"


@dataclass(frozen=True, eq=False)
class Scribbled:
    """A photo, what is scribbled on it, and how the tree is wanted."""

    photo: Photo
    strokes: tuple[Stroke, ...]  # of SCRIBBLES; pixels, y UP
    choices: TrunkChoices = TrunkChoices()
    reading: ReadingOptions = ReadingOptions()  # its template and height

    @property
    def saying(self) -> tuple[Stroke, ...]:
        """Those that the matte is found by."""
        return tuple(stroke for stroke in self.strokes if stroke.kind in _SAYS)

    @property
    def painted(self) -> tuple[Stroke, ...]:
        """Those that are painted into it and out of it."""
        return tuple(stroke for stroke in self.strokes if stroke.kind not in _SAYS)


def on_photo(strokes: Iterable[Stroke], corner: tuple[float, float], across: tuple[float, float]) -> tuple[Stroke, ...]:
    """The scribbles among strokes of a page, in the pixels (y up) of the photo whose top left corner lies there, so many pixels to a unit of the page."""
    front = [stroke for stroke in strokes if stroke.kind in SCRIBBLES and stroke.view_deg % 360.0 == 0.0]
    size = (across[0] * across[1]) ** 0.5
    return tuple(dataclasses.replace(stroke, points=(stroke.points - corner) * across, width=None if stroke.width is None else stroke.width * size) for stroke in front)


def matte_of(wanted: Scribbled, *, key: Key[Array, ""], pulse: Pulse = no_pulse) -> Matte:
    """The matte that the scribbles tell, without what is painted into it; `pulse` is called a few times a second meanwhile. Raises SketchError where they tell none."""
    said = scribbled(wanted.saying, _NAME) if wanted.saying else None
    return find_matte(wanted.photo, said, key=stage_key(key, "matte"), method=wanted.choices.matting, pulse=pulse)


def repainted(matte: Matte, wanted: Scribbled) -> Matte:
    """The matte with what is painted into it and out of it."""
    if not wanted.painted:
        return matte
    page = (0.0, -float(wanted.photo.height), float(wanted.photo.width), 0.0)
    return dataclasses.replace(matte, alpha=sketched(matte.alpha, Sketch(wanted.painted, name=_NAME, page=page)))


def trunk_of(
    wanted: Scribbled, templates: Database | None, *, key: Key[Array, ""], reading: ReadingOptions = ReadingOptions(), matte: Matte | None = None, watch: Watch | None = None
) -> FoundTrunk:
    """The trunk. `matte`: that of `matte_of`, where it is known. Raises SketchError, OptionError."""
    watch = watch or Watch()
    with watch("read"):
        known = repainted(matte_of(wanted, key=key) if matte is None else matte, wanted)
    said = wanted.choices
    options = TrunkOptions(said.matting, said.lift, said.gap, said.root)
    return find_trunk(wanted.photo, None, templates, key=key, wanted=options, reading=reading, edits=said.edits, known=known, watch=watch)


def beginning_of(
    wanted: Scribbled, templates: Database | None, *, key: Key[Array, ""], reading: ReadingOptions, tree: TreeOptions, watch: Watch | None = None
) -> Beginning:
    """What the tree that grows begins as."""
    return of_picture(trunk_of(wanted, templates, key=key, reading=reading, watch=watch), tree, templates, key=key)


def growth_of(wanted: Scribbled, growth: GrowthOptions = GrowthOptions()) -> GrowthOptions:
    """How it grows: with as many levels as the drawing says, unless others are asked for."""
    return growth if growth.levels is not None else dataclasses.replace(growth, levels=wanted.choices.levels)


def read_scribbled(path: str | Path, limits: DrawingOptions = DrawingOptions()) -> Scribbled | None:
    """The scribbles of a project whose tree is taken from them; None for any other file. Raises SketchError."""
    path = Path(path)
    if not holds_photo(path):
        return None
    import h5py

    try:
        with h5py.File(path, "r") as file:
            options = json.loads(column(file, "options").tobytes()) if "options" in file else {}
            said = options.get(TRUNK)
            if not said or not said.get("on"):
                return None
            at, picture = file["underlay"].attrs, column(file, "underlay").tobytes()
            x, y, width, height = (float(at[name]) for name in ("x", "y", "width", "height"))
        if not (width > 0 and height > 0):
            raise ValueError("its photo has no size")
        choices = TrunkChoices(**{field.name: said[field.name] for field in dataclasses.fields(TrunkChoices) if field.name in said})
        reading = ReadingOptions(**{name: options[name] for name in ("template", "height") if name in options})
    except (OSError, RuntimeError, ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        raise SketchError(f"The photo in {path.name} can't be read ({error}).", remedy="Open an older copy of it.") from error
    photo = photo_in(picture, path.name, max_megapixels=limits.max_megapixels)
    sketch = read_sketch(path, max_strokes=limits.max_strokes, max_mb=limits.max_mb)
    return Scribbled(photo, on_photo(sketch.strokes, (x, y), (photo.width / width, photo.height / height)), choices, reading)
