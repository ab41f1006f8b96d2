"""The tree in the photo under the page, as `sketchtree photo` makes it of the same strokes, options and seed (Tan et al. 2008).

What was grown last is kept: other leaves, or its files, ask for no growth.
"""

import pickle
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from sketchtree.errors import SketchError
from sketchtree.export.files import check_extension, check_program
from sketchtree.keys import root_key
from sketchtree.options import FileOptions, TreeOptions, options_as_dict
from sketchtree.photo_tree import GrownInPhoto, PhotoModel, complete_photo, each_grown, to_finish
from sketchtree.pipeline import leafy
from sketchtree.planting import tree_key
from sketchtree.studio.making.growth import Standing, Still
from sketchtree.studio.making.photo_asked import Wish
from sketchtree.studio.making.photo_bench import PhotoBench, crown_name
from sketchtree.studio.making.photo_frame import photo_frame
from sketchtree.studio.making.photo_marks import Marks
from sketchtree.studio.making.work import signature
from sketchtree.templates.store.database import Database
from sketchtree.tree_output import WHOLE, Made, about_of, check_files, write_output
from sketchtree.watch import Watch

_GROWING = ("foliage", "trace", "library", "replacements", "alternate")  # options that the wood hangs on


@dataclass(eq=False)
class Growth:
    """What was grown last in the photo that lies on the bench."""

    templates: Database
    bench: PhotoBench = field(default_factory=PhotoBench)
    grown: tuple[str, list] | None = None  # signature, and each tree with its place

    def frame(self, revision: int, wish: Wish, foliages: Mapping[str, bytes], watch: Watch) -> tuple[bytes, dict[tuple[str, str], bytes]]:
        """(the frame of it, whole; maps of materials that it alone has). Raises SketchTreeError where it can't be grown."""
        found, told, trees = self._marked(wish), [], []
        for number, (one, at) in enumerate(self._each(wish, found, foliages, watch)):
            key = tree_key(root_key(wish.asked.seed), number)
            trees.append((key, leafy(to_finish(one, key, wish.tree, self._templates(wish), at, wish.wanted), watch)))
            told += [*one.seen.photo.warnings, *one.marked.warnings, *one.foliage.warnings, *one.choice.warnings(wish.tree.leaf), *one.drawn.warnings, *trees[-1][1].warnings]
        if found.remark:
            told.append(found.remark)
        drawn = self.grown[1][0][0].drawn
        template = drawn.exemplar.name if drawn.exemplar else None
        return photo_frame(revision, drawn.similarity, template, trees, wish.asked.place, self.bench.photo, tuple(dict.fromkeys(told)), watch)

    def files(self, wish: Wish, foliages: Mapping[str, bytes], name: str, options: dict, watch: Watch) -> dict[str, bytes]:
        """The files that it becomes, by name: those that `sketchtree photo` writes. Raises SketchTreeError."""
        with tempfile.TemporaryDirectory() as folder:
            path, files = Path(folder) / name, FileOptions(**{key: value for key, value in options.items() if key not in ("wood", "solid")})
            check_extension(path, WHOLE)
            check_program(path)
            check_files(path, files, instead="Choose .glb.")
            tree = replace(wish.tree, **{key: options[key] for key in ("wood", "solid") if options.get(key)})
            made = self._complete(wish, tree, foliages, watch)
            with watch("export"):
                write_output(made.model, path, Made(wish.asked.seed, options_as_dict(wish.reading, tree, files, wish.wanted)), files)
            return {str(one.relative_to(folder)): one.read_bytes() for one in sorted(Path(folder).rglob("*")) if one.is_file()}

    def standing(self, wish: Wish, foliages: Mapping[str, bytes], watch: Watch) -> bytes:
        """The trees grown up, for the process that has them grow (`making.growth.Standing`)."""
        made = self._complete(wish, wish.tree, foliages, watch)
        return pickle.dumps(Standing(tuple(Still.of(tree.model) for tree in made.trees), about_of(made.trees[0].model, Made(wish.asked.seed, {}))))

    def _complete(self, wish: Wish, tree: TreeOptions, foliages: Mapping[str, bytes], watch: Watch) -> PhotoModel:
        found = self._marked(wish)
        each = self._each(wish, found, foliages, watch)
        return complete_photo(self.bench.photo, each, self._templates(wish), key=root_key(wish.asked.seed), wanted=wish.wanted, tree=tree, watch=watch)

    def _marked(self, wish: Wish) -> Marks:
        """The trees that are marked. Raises SketchTreeError where none is."""
        found = self.bench.marks(wish.asked)
        if not found.trees or not found.crowned:
            raise SketchError(found.remark or "No tree is marked in the photo.", remedy="Outline its crown, and draw along its trunk.")
        return found

    def _each(self, wish: Wish, found: Marks, foliages: Mapping[str, bytes], watch: Watch) -> list[tuple[GrownInPhoto, object]]:
        """Every tree, grown, and its place."""
        asked = wish.asked
        at = signature(asked.picture, [(one.crown, one.branches, one.names) for one in found.trees], asked.seed, [getattr(wish.wanted, name) for name in _GROWING], wish.reading)
        if self.grown is None or self.grown[0] != at:
            names = [crown_name(self.bench.digest, one, number, asked.seed, asked.rule) for number, one in enumerate(found.trees)]
            known = [pickle.loads(foliages[name]) if name in foliages else None for name in names]
            grown = each_grown(
                self.bench.photo, found.trees, self._templates(wish), key=root_key(asked.seed), wanted=wish.wanted, reading=wish.reading, foliages=known, watch=watch
            )
            self.grown = at, list(grown)
        return self.grown[1]

    def _templates(self, wish: Wish) -> Database | None:
        return None if wish.reading.template == "none" else self.templates
