"""What can a worker be asked for? Each kind of job is a method; what it needs is imported when it is asked for the first time."""

import dataclasses
import tempfile
from functools import cached_property
from pathlib import Path

from sketchtree.editing.document import Document
from sketchtree.editing.laid_cloud import CloudChoices
from sketchtree.options import FileOptions, options_as_dict
from sketchtree.photo.wanted import PhotoOptions
from sketchtree.sketch.files.project import POINTS, TRUNK
from sketchtree.studio.making.textures import Textures, thumbnail
from sketchtree.studio.making.watching import AGED, FILMED, PHOTO, SCRIBBLED, TRACED, USUAL, pulses, watching
from sketchtree.templates.store.database import Database
from sketchtree.trunk.wanted import TrunkChoices

_UPTO = {"grow": PHOTO, "grown_files": PHOTO, "standing": PHOTO, "trunk": SCRIBBLED, "trunk_files": SCRIBBLED, "trunk_standing": SCRIBBLED, "points": TRACED, "points_files": TRACED, "points_standing": TRACED, "points_strokes": TRACED, "age": AGED, "moving": AGED, "film": FILMED}


class Jobs:
    """All that one worker knows."""

    def __init__(self, database: Path | None, desk, *, quick: bool = False):
        """`quick`: of the worker that answers in a hurry."""
        self.templates = Database.open(database)
        self.quick = quick
        self.textures = Textures()
        self.desk = desk
        self._made: dict[int, tuple] = {}  # job → revision, document, drawn, tree, chunks: the full tree that the pages have, and one that they may get

    def do(self, number: int, kind: str, arguments: tuple) -> object:
        """The answer to one job."""
        watch = watching(lambda stage, done: self.desk.say(number, "event", ("working", stage, done)), lambda: self.desk.stopped(number, kind), _UPTO.get(kind, USUAL))
        return getattr(self, f"_{kind}")(number, watch, *arguments)

    @cached_property
    def bench(self):
        """Where the tree is made."""
        from sketchtree.studio.making.work import Bench

        return Bench(self.templates)

    @cached_property
    def glance_bench(self):
        """Where one is made that is not kept."""
        from sketchtree.studio.making.work import Bench

        return Bench(self.templates)

    @cached_property
    def photo_bench(self):
        """Where the photo under the page lies."""
        from sketchtree.studio.making.photo_bench import PhotoBench

        return PhotoBench()

    @cached_property
    def growth(self):
        """What grew in it."""
        from sketchtree.studio.making.photo_growth import Growth

        return Growth(self.templates, self.photo_bench)

    @cached_property
    def trunk_bench(self):
        """What scribbles on it tell."""
        from sketchtree.studio.making.trunk_bench import TrunkBench

        return TrunkBench(self.templates, self.photo_bench)

    @cached_property
    def cloud_bench(self):
        """What stands in the points behind the drawing."""
        from sketchtree.studio.making.cloud_bench import CloudBench

        return CloudBench(self.templates)

    @cached_property
    def growths(self):
        """How the tree of a drawing grows."""
        from sketchtree.studio.making.growth import Growths

        return Growths(self._model)

    @cached_property
    def photo_answers(self):
        """What is answered about it."""
        from sketchtree.studio.making import photo_answers

        return photo_answers

    @cached_property
    def warming(self):
        """What is slow only the first time."""
        from sketchtree.studio.making.warming import Warming

        return Warming(self.quick, self.desk.rests)

    def import_all(self) -> None:
        """What trees are made with."""
        from sketchtree.studio.making import chunks, found, ghosts, remarks, warming, work  # noqa: F401

    def _full(self, number, watch, revision: int, document: Document, known: dict[str, str], shown: int):
        from sketchtree.keys import root_key
        from sketchtree.studio.making import work
        from sketchtree.studio.making.chunks import chunks_of
        from sketchtree.studio.making.remarks import how_like, how_read

        self._made = {job: made for job, made in self._made.items() if job == shown}
        drawn = work.drawn_tree(self.bench, document, watch)
        for event in (how_read(revision, drawn), how_like(revision, drawn)):
            self.desk.say(number, "event", ("event", event))
        tree = work.leafy_tree(self.bench, document, drawn, watch)
        with watch("mesh"):
            chunks = chunks_of(tree, key=root_key(document.seed), pulse=pulses(watch, 0.0, 1.0))
        watch.on_part(1.0)
        self.textures.remember(chunks.materials)
        frame, digests = work.tree_frame(revision, "full", document, drawn, tree, chunks, known)
        self._made = self._made | {number: (revision, document, drawn, tree, chunks)}  # another dict: who answers meanwhile has the old one
        return frame, digests, _basis(drawn, tree, chunks, digests)

    def _frame(self, number, watch, shown: int):
        made = self._made.get(shown)
        if made is None:
            return None
        from sketchtree.studio.making import work

        revision, document, drawn, tree, chunks = made
        return work.tree_frame(revision, "full", document, drawn, tree, chunks, {})[0]

    def _quick(self, number, watch, revision: int, document: Document, basis):
        from sketchtree.studio.making import work

        drawn, tree, chunks = work.hurried(self.bench, document, basis, watch)
        self.textures.remember(chunks.materials)
        frame, digests = work.tree_frame(revision, "quick", document, drawn, tree, chunks, {}, basis)
        return frame, digests, drawn.settled

    def _glance(self, number, watch, revision: int, document: Document, known: dict[str, str]):
        from sketchtree.keys import root_key
        from sketchtree.studio.making import work
        from sketchtree.studio.making.chunks import chunks_of

        drawn = work.drawn_tree(self.glance_bench, document, watch)
        tree = work.leafy_tree(self.glance_bench, document, drawn, watch)
        chunks = chunks_of(tree, key=root_key(document.seed), pulse=pulses(watch, 0.0, 1.0))
        self.textures.remember(chunks.materials)
        return work.tree_frame(revision, "glance", document, drawn, tree, chunks, {})[0]

    def _ghost(self, number, watch, revision: int, document: Document, stroke, hold, basis):
        from sketchtree.studio.making.ghosts import ghost

        return ghost(self.bench, revision, document, stroke, hold, basis)

    def _alternatives(self, number, watch, revision: int, document: Document):
        from sketchtree.studio.making.others import alternatives

        return alternatives(self.templates, revision, document, watch)

    def _find(self, number, watch, shown: int, limb: int):
        from sketchtree.errors import OptionError
        from sketchtree.studio.making.found import found_limb

        made = self._made.get(shown)
        if made is None:
            raise OptionError("The tree is not ready yet.", remedy="Wait until it is, then pick the branch again.")
        _, _, drawn, tree, _ = made
        return found_limb(drawn, tree.skeleton, limb)

    def _photo(self, number, watch, digest: str, picture: bytes):
        self.photo_bench.read(digest, picture)

    def _trace(self, number, watch, revision: int, asked):
        return self.photo_answers.traced(self.photo_bench, revision, asked)

    def _limbs(self, number, watch, asked):
        return self.photo_answers.limbs(self.photo_bench, asked)

    def _foliage(self, number, watch, crowns: dict[str, bytes], seed: int):
        return self.photo_answers.foliages(self.photo_bench, crowns, seed)

    def _learn(self, number, watch, found: dict[str, bytes]):
        self.photo_answers.learnt(self.photo_bench, found)

    def _tint(self, number, watch, revision: int, names: tuple[str, ...]):
        return self.photo_answers.tinted(self.photo_bench, revision, names)

    def _propose(self, number, watch, asked):
        return self.photo_answers.proposed(self.photo_bench, asked)

    def _svg(self, number, watch, asked):
        return self.photo_answers.marks_as_svg(self.photo_bench, asked)

    def _grow(self, number, watch, revision: int, wish, foliages: dict[str, bytes]):
        return self.growth.frame(revision, wish, foliages, watch)

    def _grown_files(self, number, watch, wish, foliages: dict[str, bytes], name: str, options: dict):
        return self.growth.files(wish, foliages, name, options, watch)

    def _trunk(self, number, watch, revision: int, wish):
        return self.trunk_bench.frame(revision, wish, lambda event: self.desk.say(number, "event", ("event", event)), watch)

    def _standing(self, number, watch, wish, foliages: dict[str, bytes]):
        return self.growth.standing(wish, foliages, watch)

    def _trunk_files(self, number, watch, wish, name: str, options: dict):
        return self.trunk_bench.files(wish, name, options, watch)

    def _trunk_standing(self, number, watch, wish):
        return self.trunk_bench.standing(wish, watch)

    def _points(self, number, watch, revision: int, wish):
        return self.cloud_bench.frame(revision, wish, watch)

    def _points_files(self, number, watch, wish, name: str, options: dict):
        return self.cloud_bench.files(wish, name, options, watch)

    def _points_standing(self, number, watch, wish):
        return self.cloud_bench.standing(wish, watch)

    def _points_strokes(self, number, watch, wish):
        return self.cloud_bench.strokes(wish, watch)

    def _stand(self, number, watch, name: str, standing: bytes):
        self.growths.lay(name, standing)

    def _age(self, number, watch, of: Document | str, mode: str, bend: float):
        return self.growths.glb(of, mode, bend, watch)

    def _moving(self, number, watch, of: Document | str, name: str, mode: str, bend: float, seconds: float, lod: int):
        return self.growths.files(of, name, mode, bend, seconds, lod, watch)

    _film = _moving

    def _expect_points(self, number, watch):
        """A drawing with points behind it: what its answers need is made ready, aside."""
        self.warming.for_points(lambda: self.desk.say(number, "event", ("warm",)))

    def _read(self, number, watch, data: bytes, name: str, cloud):
        from sketchtree.errors import SeveralTrees
        from sketchtree.studio.making.documents import document_of

        try:
            return document_of(data, name, cloud)
        except SeveralTrees as several:
            return several.trees  # a choice to be made, not a trouble

    def _model(self, document: Document, watch, tree_options):
        from sketchtree.keys import root_key
        from sketchtree.pipeline import complete, draw_out

        key = root_key(document.seed)
        drawn = draw_out(document.sketch, self.templates, key=key, options=document.reading, edits=document.edits, settled=document.settled, cloud=document.cloud, watch=watch)
        return complete(drawn, self.templates, key=key, options=tree_options, watch=watch)

    def _export(self, number, watch, document: Document, name: str, options: dict):
        from sketchtree.export.files import check_extension, check_program
        from sketchtree.tree_output import WHOLE, Made, check_files, write_output

        files = FileOptions(**{key: value for key, value in options.items() if key in {field.name for field in dataclasses.fields(FileOptions)}})
        made_of = {key: options[key] for key in ("wood", "solid") if options.get(key)}
        tree = dataclasses.replace(document.tree, **made_of)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / name
            check_extension(path, WHOLE)
            check_program(path)
            check_files(path, files, instead="Choose .glb.")
            model = self._model(document, watch, tree)
            written = _written(document, files)
            with watch("export"):
                write_output(model, path, Made(document.seed, written), files, underlay=document.underlay)
            return {str(one.relative_to(folder)): one.read_bytes() for one in sorted(Path(folder).rglob("*")) if one.is_file()}

    def _project(self, number, watch, document: Document):
        if document.points.traced or not document.drawn.strokes and (document.strokes or document.cloud is not None):
            return _undrawn_project(document)
        files = self._export(number, watch, document, "project.sketchtree", {})
        return files["project.sketchtree"]

    def _texture(self, number, watch, key: str, kind: str):
        return self.textures.png(key, kind)

    def _picture(self, number, watch, what: str, name: str):
        if what == "example":
            from sketchtree.studio.making.gallery import example_picture

            return example_picture(name)
        return thumbnail(what, name, self.templates)

    def _catalogue(self, number, watch):
        from sketchtree.studio.making.gallery import catalogue

        return catalogue(self.templates)


def _written(document: Document, files: FileOptions) -> dict:
    """The options of a drawing, as its project keeps them."""
    written = options_as_dict(document.reading, document.tree, files, *([document.photo] if document.photo != PhotoOptions() else []))
    chosen = ((TRUNK, document.trunk, TrunkChoices()), (POINTS, document.points, CloudChoices()))
    return written | {name: dataclasses.asdict(value) for name, value, usual in chosen if value != usual}


def _undrawn_project(document: Document) -> bytes:
    """Scribbles, or points, whose tree is not one of strokes: it is not asked for, so that they can be kept before they tell one."""
    from sketchtree.export.skeletons.hdf5 import write_undrawn

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "project.sketchtree"
        write_undrawn(path, document, options=_written(document, FileOptions()))
        return path.read_bytes()


def _basis(drawn, tree, chunks, digests: dict[str, str]):
    from sketchtree.studio.making.basis import Basis

    points = tree.skeleton.tip
    return Basis(
        drawn.similarity.scale, drawn.similarity.translate, tuple(digests), drawn.settled, tree.skeleton.height, tuple(points.min(axis=0)), tuple(points.max(axis=0)),
        tree.skeleton.segment_count, len(tree.leaves), chunks.triangles
    )
