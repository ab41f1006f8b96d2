"""Which limbs show in the photo under the page? Asked anew at each stroke, so what hangs on the photo alone, and on its crowns alone, is kept.

The palette is the photo's; the foliage is a crown's, and is found elsewhere (`foliages`), since it takes long: until it is here, limbs are traced without it.
"""

import base64
import hashlib
import importlib.util
import io
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from jaxtyping import Array, Bool, Float, Key
from PIL import Image

from sketchtree.errors import OptionError, SketchTreeError
from sketchtree.keys import root_key, stage_key
from sketchtree.photo.as_graph import as_drawing
from sketchtree.photo.foliage import Foliage
from sketchtree.photo.foliage_mask import foliage_mask
from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import Photo, turned_over
from sketchtree.photo.read_photo import photo_in
from sketchtree.photo.trace.palette import Palette
from sketchtree.photo.trace.trace import Tracing
from sketchtree.photo.trace.traced import Traced
from sketchtree.photo.wanted import RULES, PhotoOptions
from sketchtree.planting import tree_key
from sketchtree.sketch.strokes import Stroke, StrokeKind
from sketchtree.studio import messages
from sketchtree.studio.making.photo_asked import KEPT, Asked, Place
from sketchtree.studio.making.photo_marks import Marks, marks

_TINT = 1024  # pixels of the longer side of the mask that pages get


@dataclass(frozen=True, eq=False)
class Crown:
    """A crown whose foliage is wanted."""

    name: str  # what its foliage is known by
    number: int  # of its tree
    marked: Marked
    rule: str = RULES[0]  # what counts as foliage


@dataclass(frozen=True, eq=False)
class Shown:
    """What shows in the photo."""

    marks: Marks
    limbs: list[Traced]  # of each tree
    known: tuple[str, ...]  # crowns whose foliage was known
    unknown: tuple[Crown, ...]  # and those whose was not


@dataclass(eq=False)
class PhotoBench:
    """One photo, and what is known of it."""

    digest: str = ""
    photo: Photo | None = None
    palette: Palette | None = None
    foliages: dict[str, Foliage] = field(default_factory=dict)  # by `Crown.name`; the newest last
    trouble: SketchTreeError | None = None  # why there is no photo

    def read(self, digest: str, picture: bytes) -> None:
        """The photo is in these bytes. What can't be read is told by who asks."""
        self.digest, self.photo, self.trouble = digest, None, None
        try:
            self.lay(digest, photo_of(picture))
        except SketchTreeError as error:
            self.trouble = error

    def lay(self, digest: str, photo: Photo) -> None:
        """This is the photo."""
        self.digest, self.photo, self.palette, self.foliages = digest, photo, Palette.of(photo), {}

    def learn(self, found: Mapping[str, Foliage]) -> None:
        """The foliage of some crowns."""
        self.foliages |= found
        for name in list(self.foliages)[:-KEPT]:
            del self.foliages[name]

    def marks(self, asked: Asked) -> Marks:
        """What is marked in it. Raises SketchTreeError."""
        if self.trouble is not None:
            raise self.trouble
        check_package()
        if self.photo is None or asked.picture != self.digest:
            raise OptionError("The photo is not here any more.", remedy="Add it again.")
        return marks(asked.strokes, asked.place, self.photo)

    def trace(self, asked: Asked) -> Shown:
        """The limbs of each tree that is marked. Raises SketchTreeError."""
        found = self.marks(asked)
        key, limbs, known, unknown = root_key(asked.seed), [], [], []
        tracing = PhotoOptions().tracing if found.crowned else Tracing(most=0)
        for number, marked in enumerate(found.trees):
            crown = Crown(crown_name(self.digest, marked, number, asked.seed, asked.rule), number, marked, asked.rule)
            foliage = self.foliages.get(crown.name)
            if found.crowned:
                known.append(crown.name) if foliage is not None else unknown.append(crown)
            limbs.append(tracing(self.photo, marked, foliage, key=stage_key(tree_key(key, number), "trace"), palette=self.palette))
        return Shown(found, limbs, tuple(known), tuple(unknown))


def check_package() -> None:
    """Raises OptionError where the package that learns colours is missing."""
    if importlib.util.find_spec("sklearn") is None:
        raise OptionError("Tracing limbs in a photo needs the package `scikit-learn`.", remedy="Install it with pip install 'sketchtree[photo]'.")


def photo_of(picture: bytes) -> Photo:
    """The photo in a file's bytes. Raises SketchError."""
    return photo_in(picture, "The picture")


def crown_name(digest: str, marked: Marked, number: int, seed: int, rule: str = RULES[0]) -> str:
    """The same for crowns of which the same foliage is found."""
    told = hashlib.blake2b(f"{digest} {number} {seed} {rule}".encode(), digest_size=12)
    told.update(np.ascontiguousarray(marked.crown).tobytes())
    return told.hexdigest()


def foliage_of(photo: Photo, crown: Crown, seed: int) -> Foliage:
    """The foliage of a crown, as `photo_tree` finds it. Raises SketchError."""
    return foliage_mask(photo, crown.marked, key=foliage_key(root_key(seed), crown.number), rule=crown.rule)


def foliage_key(key: Key[Array, ""], number: int) -> Key[Array, ""]:
    """The key by which the foliage of one tree is found."""
    return stage_key(tree_key(key, number), "foliage mask")


def told_limbs(traced: Iterable[Traced], place: Place, photo: Photo) -> list[messages.TracedTree]:
    """The limbs of each tree as pages are told."""
    return [_told(one, place, photo) for one in traced]


def _told(traced: Traced, place: Place, photo: Photo) -> messages.TracedTree:
    xy = place.to_page(turned_over(traced.xy), photo) * (1.0, -1.0)
    width = 2 * traced.radius * place.unit(photo)
    drawn = np.ones(len(traced), bool) if traced.drawn is None else traced.drawn
    return messages.TracedTree(xy=_short(xy.reshape(-1)), parent=traced.parent.tolist(), width=_short(width), drawn=drawn.tolist())


def _short(values: Float[np.ndarray, " value"]) -> list[float]:
    return np.round(values, 3).tolist()


def limbs_as_strokes(found: Marks, traced: list[Traced], place: Place, photo: Photo) -> list[Stroke]:
    """The traced limbs as strokes on the page; those that a stroke marks go by its name."""
    if not traced:
        return []
    sketch, _ = as_drawing(list(zip(traced, found.trees, strict=True)), photo.name, outlines=[() for _ in traced])
    limbs = [stroke for stroke in sketch.strokes if stroke.kind == StrokeKind.BRANCH]
    made = {}
    for stroke in limbs:
        name = stroke.id
        while name in made:
            name += "'"
        made[name] = replace(stroke, id=name, points=place.to_page(stroke.points, photo), width=stroke.width * place.unit(photo))
    return list(made.values())


def tint(masks: Iterable[Bool[np.ndarray, "row column"]]) -> str:
    """Where foliage is, as a picture that is opaque there; base64 of a PNG."""
    whole = None
    for mask in masks:
        whole = mask if whole is None else whole | mask
    if whole is None:
        return ""
    step = -(-max(whole.shape) // _TINT)
    opaque = Image.fromarray(np.where(whole, np.uint8(255), np.uint8(0))).reduce(step)
    picture = Image.merge("LA", (Image.new("L", opaque.size, 255), opaque))
    data = io.BytesIO()
    picture.save(data, "PNG")
    return base64.b64encode(data.getvalue()).decode()
