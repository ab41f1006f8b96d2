"""The tree that scribbles on the photo under the page tell, as `sketchtree grow` makes it of the project. What pages see on the way: the matte, then the trunk's skeleton, then the tree.

The matte takes long and hangs on the scribbles alone, so that which was found last is kept: other edits of it, or of the contour, ask for no matting. So is the tree: its files, and its growth,
ask for no other.
"""

import base64
import io
import pickle
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from jaxtyping import Float
from PIL import Image
from skimage.measure import approximate_polygon

from sketchtree.errors import OptionError
from sketchtree.growth_tree import FoundTrunk, GrowthOptions, GrownTree, grown_tree, of_picture
from sketchtree.keys import root_key
from sketchtree.matting.alpha import Matte
from sketchtree.photo.photo import turned_over
from sketchtree.pipeline import LeafyTree
from sketchtree.scribbled_tree import Scribbled, growth_of, matte_of, on_photo, repainted, trunk_of
from sketchtree.studio import messages
from sketchtree.studio.making.growth import Standing, Still
from sketchtree.studio.making.kept_files import files_of
from sketchtree.studio.making.photo_asked import Place
from sketchtree.studio.making.photo_bench import PhotoBench
from sketchtree.studio.making.photo_frame import photo_frame
from sketchtree.studio.making.trunk_asked import TrunkWish
from sketchtree.studio.making.watching import pulses
from sketchtree.studio.making.work import signature
from sketchtree.templates.store.database import Database
from sketchtree.tree_output import Made, about_of
from sketchtree.watch import Pulse, Watch

_SIDE = 1024  # pixels of the longer side of the matte that pages get
_PLAIN = 0.4  # pixels that the contour they get may be off


@dataclass(eq=False)
class TrunkBench:
    """What was found last in the photo that lies on the bench."""

    templates: Database
    bench: PhotoBench = field(default_factory=PhotoBench)
    matte: tuple[str, Matte] | None = None  # signature, and the matte without what is painted into it
    made: tuple[str, GrownTree] | None = None  # signature, and the tree whole

    def frame(self, revision: int, wish: TrunkWish, tell: Callable[[messages.Event], None], watch: Watch) -> tuple[bytes, dict[tuple[str, str], bytes]]:
        """(the frame of the tree, whole; maps of materials that it alone has). `tell` hears of the matte and of the trunk on the way. Raises SketchTreeError where there is no tree."""
        grown = self._grown(wish, watch, lambda matte: tell(messages.Matte(revision=revision, png=opaque(matte))), lambda found: tell(told_trunk(revision, found, wish.place)))
        worn, found = grown.model, grown.beginning.trunk
        leafy = LeafyTree(worn.skeleton, worn.leaves, worn.blossom, worn.dress, worn.warnings)
        return photo_frame(revision, found.similarity, found.template, [(root_key(wish.seed), leafy)], wish.place, found.photo, grown.warnings, watch)

    def standing(self, wish: TrunkWish, watch: Watch) -> bytes:
        """The tree grown up, for the process that has it grow (`making.growth.Standing`)."""
        worn = self._grown(wish, watch).model
        return pickle.dumps(Standing((Still.of(worn),), about_of(worn, Made(wish.seed))))

    def files(self, wish: TrunkWish, name: str, options: dict, watch: Watch) -> dict[str, bytes]:
        """The files that it becomes, by name: those that `sketchtree build` writes of the project. Raises SketchTreeError."""
        return files_of(lambda tree: self._grown(replace(wish, tree=tree), watch).model, wish.tree, wish.seed, name, options, watch)

    def _grown(self, wish: TrunkWish, watch: Watch, on_matte: Callable[[Matte], None] = lambda matte: None, on_trunk: Callable[[FoundTrunk], None] = lambda found: None) -> GrownTree:
        scribbled, key = self._scribbled(wish), root_key(wish.seed)
        at = signature(wish.picture, wish.place, wish.strokes, wish.choices, wish.seed, wish.reading, wish.tree)
        if self.made is not None and self.made[0] == at:
            found = self.made[1].beginning.trunk
            on_matte(found.matte), on_trunk(found)
            return self.made[1]
        with watch("read"):
            matte = self._matte(scribbled, wish, pulses(watch, 0.0, 0.9))
        on_matte(repainted(matte, scribbled))
        templates = None if wish.reading.template == "none" else self.templates
        found = trunk_of(scribbled, templates, key=key, reading=wish.reading, matte=matte, watch=watch)
        on_trunk(found)
        grown = grown_tree(of_picture(found, wish.tree, templates, key=key), growth_of(scribbled, GrowthOptions()), wish.tree, watch=watch)
        self.made = at, grown
        return grown

    def _scribbled(self, wish: TrunkWish) -> Scribbled:
        if self.bench.trouble is not None:
            raise self.bench.trouble
        photo = self.bench.photo
        if photo is None or self.bench.digest != wish.picture:
            raise OptionError("The photo is not here any more.", remedy="Add it again.")
        across = (photo.width / wish.place.width, photo.height / wish.place.height)
        return Scribbled(photo, on_photo(wish.strokes, (wish.place.x, wish.place.y), across), wish.choices)

    def _matte(self, scribbled: Scribbled, wish: TrunkWish, pulse: Pulse) -> Matte:
        at = signature(wish.picture, [(one.kind.value, one.points, one.width) for one in scribbled.saying], wish.choices.matting, wish.seed)
        if self.matte is None or self.matte[0] != at:
            self.matte = at, matte_of(scribbled, key=root_key(wish.seed), pulse=pulse)
        return self.matte[1]


def told_trunk(revision: int, found: FoundTrunk, place: Place) -> messages.Trunks:
    """The trunk as pages are told."""
    skeleton, photo = found.skeleton, found.photo
    xy = place.to_page(turned_over(skeleton.xy), photo) * (1.0, -1.0)
    limbs = messages.TracedTree(
        xy=np.round(xy.reshape(-1), 3).tolist(), parent=skeleton.parent.tolist(), width=np.round(2 * skeleton.radius * place.unit(photo), 3).tolist(), drawn=[True] * len(skeleton)
    )
    vertices = [np.round(ring.reshape(-1), 3).tolist() for ring in skeleton.vertices]
    parts = [own.tolist() for own in skeleton.parting]
    contour = [] if skeleton.outline is None else [_plain(ring) for ring in skeleton.outline.rings]
    told = {"vertices": vertices, "parts": parts, "contour": contour, "size": [photo.width, photo.height]}
    return messages.Trunks(revision=revision, state="ready", trees=[limbs], **told, remark=" ".join(found.warnings))


def _plain(ring: Float[np.ndarray, "point 2"]) -> list[float]:
    """A ring of the contour for people to see and to point at: fewer points, and nowhere farther off than `_PLAIN`."""
    closed = np.vstack([ring, ring[:1]])
    return np.round(approximate_polygon(closed, _PLAIN)[:-1].reshape(-1), 2).tolist()


def opaque(matte: Matte) -> str:
    """A matte as a picture that is as opaque as the tree is; base64 of a PNG."""
    alpha = Image.fromarray(np.round(255 * np.asarray(matte.alpha)).astype(np.uint8))
    alpha = alpha.reduce(-(-max(alpha.size) // _SIDE))
    whole = io.BytesIO()
    Image.merge("LA", (Image.new("L", alpha.size, 255), alpha)).save(whole, "PNG")
    return base64.b64encode(whole.getvalue()).decode()
