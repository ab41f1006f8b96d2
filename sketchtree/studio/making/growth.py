"""The growth of the tree, as an animated GLB. The tree that was made last is kept: another mode, or bend, moves the same meshes."""

from collections.abc import Callable

from sketchtree.animation.growing import Growing
from sketchtree.editing.document import Document
from sketchtree.export.gltf import asset_bytes
from sketchtree.growth.plan import GrowthPlan
from sketchtree.studio.making.work import signature
from sketchtree.tree_output import Made, about_of
from sketchtree.watch import Watch

SECONDS = 10.0  # as `sketchtree grow` has it


class Growths:
    """`model`: makes the whole tree of a document."""

    def __init__(self, model: Callable):
        self._model = model
        self._made: tuple[str, object] | None = None

    def glb(self, document: Document, mode: str, bend: float, watch: Watch) -> bytes:
        """Raises SketchTreeError where nothing can grow."""
        at = signature(tuple(document.strokes.values()), document.edits, document.settled, document.reading, document.tree, document.seed)
        if self._made is None or self._made[0] != at:
            self._made = at, self._model(document, watch, document.tree)
        model = self._made[1]
        with watch("mesh"):
            watch.on_part(0.3)
            plan = GrowthPlan.of(model.skeleton, mode=mode, bend=bend)
            watch.on_part(0.4)
            growing = Growing.of(model, plan)
            watch.on_part(0.5)
            asset = growing.asset(seconds=SECONDS, about=about_of(model, Made(document.seed, {})))
        with watch("export"):
            watch.on_part(0.0)
            return asset_bytes(asset)
