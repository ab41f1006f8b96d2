"""A tree that grows, as an animated file or a film. The tree that was made last is kept: another mode, or bend, moves the same meshes.

The tree of a drawing is made here of its document; one that another process made, of a photo, is laid before this one (`laid`) under a name.
"""

import pickle
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from sketchtree.animation.growing import Growing
from sketchtree.animation.together import Together, growing_of
from sketchtree.animation.wanted import joints_of
from sketchtree.dressing import Dress
from sketchtree.editing.document import Document
from sketchtree.errors import OptionError
from sketchtree.export.files import check_program
from sketchtree.export.gltf import asset_bytes
from sketchtree.export.write import write_asset
from sketchtree.foliage.leaves import Leaves
from sketchtree.geometry.mesh import Mesh
from sketchtree.levels.make import Model, level_of_detail
from sketchtree.skeleton import TreeSkeleton
from sketchtree.studio.growth import FILMS
from sketchtree.studio.making.shared_materials import with_shared_materials
from sketchtree.studio.making.watching import pulses
from sketchtree.studio.making.work import signature
from sketchtree.tree_output import Made, about_of
from sketchtree.view.growth_film import growth_film
from sketchtree.watch import Watch

SECONDS = 10.0  # as `sketchtree grow` has it
FRAMES = 72  # of a film, likewise


@dataclass(frozen=True, eq=False)
class Still:
    """A tree grown up, without all that it was made of (as `levels.make.Model`)."""

    skeleton: TreeSkeleton
    leaves: Leaves
    blossom: Leaves | None
    meshes: tuple[Mesh, ...]
    dress: Dress

    @classmethod
    def of(cls, model: Model) -> "Still":
        """What it takes of a tree to grow."""
        return cls(model.skeleton, model.leaves, model.blossom, tuple(model.meshes), model.dress)


@dataclass(frozen=True, eq=False)
class Standing:
    """Trees, and what their file tells of them."""

    models: tuple[Still, ...]
    about: dict


class Growths:
    """`model`: makes the whole tree of a document."""

    def __init__(self, model: Callable):
        self._model = model
        self._standing: tuple[str, Standing] | None = None
        self._growing: tuple[tuple, Growing | Together] | None = None

    def lay(self, name: str, standing: bytes) -> None:
        """This tree goes by that name, until there is another."""
        self._standing = name, pickle.loads(standing)

    def glb(self, of: Document | str, mode: str, bend: float, watch: Watch) -> bytes:
        """An animated GLB of a drawing's tree, or of the one that was laid under a name. Raises SketchTreeError where nothing can grow."""
        growing, about = self._grown(of, mode, bend, watch)
        asset = with_shared_materials(growing.asset(seconds=SECONDS, about=about))
        with watch("export"):
            watch.on_part(0.0)
            return asset_bytes(asset)

    def files(self, of: Document | str, name: str, mode: str, bend: float, seconds: float, lod: int, watch: Watch) -> dict[str, bytes]:
        """The files that it becomes, by name: one that moves, or a film; `lod`: its level of detail, 0-3. Raises SketchTreeError."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / name
            film = path.suffix in FILMS
            if not film:
                check_program(path)
            growing, about = self._grown(of, mode, bend, watch, lod)
            if film:
                with watch("film"):
                    drawn, reason = growth_film(growing, path, frames=FRAMES, seconds=seconds, part=watch.on_part)
                if not drawn:
                    raise OptionError(reason, remedy="Choose an animated file, such as .glb.")
            else:
                asset = with_shared_materials(growing.asset(seconds=seconds, about=about))
                with watch("export"):
                    watch.on_part(0.0)
                    write_asset(path, asset)
            return {str(one.relative_to(folder)): one.read_bytes() for one in sorted(Path(folder).rglob("*")) if one.is_file()}

    def _grown(self, of: Document | str, mode: str, bend: float, watch: Watch, lod: int = 0) -> tuple[Growing | Together, dict]:
        at, standing = self._stands(of, watch)
        wish = at, mode, bend, lod
        if self._growing is None or self._growing[0] != wish:
            self._growing = None
            models = standing.models if lod == 0 else [replace(model, meshes=level_of_detail(model, lod)) for model in standing.models]
            with watch("grow"):
                grown = growing_of(models, mode=mode, bend=bend, most_joints=joints_of(lod), pulse=pulses(watch, 0.0, 1.0, step=0.1))
                grown.get_ready()
            self._growing = wish, grown
        return self._growing[1], standing.about

    def _stands(self, of: Document | str, watch: Watch) -> tuple[str, Standing]:
        """(what it is known by, the tree grown up)."""
        if isinstance(of, Document):
            at = signature(tuple(of.strokes.values()), of.edits, of.settled, of.reading, of.tree, of.cloud, of.seed)
            if self._standing is None or self._standing[0] != at:
                model = self._model(of, watch, of.tree)
                self._standing = at, Standing((Still.of(model),), about_of(model, Made(of.seed, {})))
        elif self._standing is None or self._standing[0] != of:
            raise OptionError("That tree is not here any more.", remedy="Ask for its growth again.")
        return self._standing
