"""The tree that stands in the points behind the drawing, as `sketchtree build` makes it of the project. The one that was made last is kept: its files, and its growth, ask for no other."""

import pickle
from dataclasses import dataclass, replace

from sketchtree.cloud_tree import CloudTree
from sketchtree.editing.settled import Settled
from sketchtree.keys import root_key
from sketchtree.laid_tree import Laid, as_strokes, tree_of
from sketchtree.pipeline import LeafyTree
from sketchtree.sketch.strokes import Stroke
from sketchtree.studio.making.cloud_asked import CloudWish
from sketchtree.studio.making.growth import Standing, Still
from sketchtree.studio.making.kept_files import files_of
from sketchtree.studio.making.photo_frame import Frame, whole_frame
from sketchtree.studio.making.work import signature
from sketchtree.templates.store.database import Database
from sketchtree.tree_output import Made, about_of
from sketchtree.watch import Watch


@dataclass(eq=False)
class CloudBench:
    """What was traced last."""

    templates: Database
    made: tuple[str, CloudTree] | None = None  # signature, and the tree whole

    def frame(self, revision: int, wish: CloudWish, watch: Watch) -> tuple[bytes, dict[tuple[str, str], bytes]]:
        """(the frame of the tree, whole; maps of materials that it alone has). Raises SketchTreeError where there is no tree."""
        found = self._traced(wish, watch)
        worn, cloud = found.model, wish.cloud
        leafy = LeafyTree(worn.skeleton, worn.leaves, worn.blossom, worn.dress, worn.warnings)
        frame = Frame(revision, _laid(wish).scale, (cloud.x, -cloud.y), worn.template, found.warnings)
        return whole_frame(frame, [(root_key(wish.seed), leafy)], watch)

    def standing(self, wish: CloudWish, watch: Watch) -> bytes:
        """The tree grown up, for the process that has it grow (`making.growth.Standing`)."""
        worn = self._traced(wish, watch).model
        return pickle.dumps(Standing((Still.of(worn),), about_of(worn, Made(wish.seed))))

    def files(self, wish: CloudWish, name: str, options: dict, watch: Watch) -> dict[str, bytes]:
        """The files that it becomes, by name. Raises SketchTreeError."""
        return files_of(lambda tree: self._traced(replace(wish, tree=tree), watch).model, wish.tree, wish.seed, name, options, watch)

    def strokes(self, wish: CloudWish, watch: Watch) -> tuple[dict[str, Stroke], Settled]:
        """(its stoutest limbs as strokes on the page, where their depths lie)."""
        return as_strokes(self._traced(wish, watch), _laid(wish))

    def _traced(self, wish: CloudWish, watch: Watch) -> CloudTree:
        at = signature(wish.cloud.digest, wish.reading, wish.tree, wish.seed)
        if self.made is None or self.made[0] != at:
            templates = None if wish.reading.template == "none" else self.templates
            self.made = at, tree_of(_laid(wish), templates, key=root_key(wish.seed), watch=watch)
        return self.made[1]


def _laid(wish: CloudWish) -> Laid:
    return Laid(wish.cloud, wish.reading, wish.tree)
