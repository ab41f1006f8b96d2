"""The tree in the photo under the page: the very tree that `sketchtree photo` makes of the same strokes, options and seed."""

import dataclasses

import numpy as np
import painted_photo as painted
import pytest
from click.testing import CliRunner

from sketchtree.animation.posing import posed
from sketchtree.commands.photo import photo as photo_command
from sketchtree.editing.document import Document
from sketchtree.errors import SketchError
from sketchtree.export.gltf.read import read_asset
from sketchtree.foliage.wear import FREE
from sketchtree.photo.read_strokes import read_strokes
from sketchtree.photo.wanted import ARRANGEMENTS, LIBRARIES, PhotoOptions
from sketchtree.propagate.attractors.library import NAMES
from sketchtree.studio import exports
from sketchtree.studio.making import photo_answers
from sketchtree.studio.making.frames import opened
from sketchtree.studio.making.growth import Growths
from sketchtree.studio.making.photo_asked import Asked, Wish
from sketchtree.studio.making.photo_growth import Growth
from sketchtree.studio.making.photo_marks import marks
from sketchtree.studio.wire import choose
from sketchtree.templates.store.database import Database
from sketchtree.watch import Watch

PICTURE = painted.photo(0.5, leafy=True)
MARKS = (painted.mark("crown", painted.CROWN, crown=True), painted.mark("trunk", painted.TRUNK), painted.mark("left", painted.LEFT))
FILES = {"lod": 0, "levels": "one", "leaves": "merged", "pack": None, "wood": None, "solid": False}
ROUNDS = PhotoOptions(replacements=3)  # growth is not what is tested here


def wanted(**options) -> Document:
    document = painted.document(*MARKS, picture=PICTURE).replace(photo=ROUNDS, name="elm")
    return choose(document, options)


@pytest.fixture(scope="module")
def growth():
    made = Growth(Database.open())
    made.bench.read("elm", PICTURE)
    return made


def wish(document: Document) -> Wish:
    return Wish.of(document, "elm")


@pytest.fixture(scope="module")
def frame(growth):
    return opened(growth.frame(3, wish(wanted()), {}, Watch())[0])


def test_it_is_shown_whole_where_the_photo_lies(frame):
    head, arrays = frame
    assert (head.phase, head.revision) == ("photo", 3)
    assert head.limbs == [] and head.segments > 100 and head.leaves > 100 and sorted(head.owners) == sorted(chunk.owner for chunk in head.chunks)
    foot = painted.on_page([painted.TRUNK[0]])[0] * (1.0, -1.0)
    assert np.abs(np.array(head.root) - foot).max() < 3.0  # page units, y down
    left, _, width = painted.AT
    assert head.root[0] + head.low[0] / head.scale > left - 0.1 * width and head.root[0] + head.high[0] / head.scale < left + 1.1 * width
    assert any(material.key.endswith(".seen") for material in head.materials)  # leaves in the photo's colours


def test_other_leaves_ask_for_no_growth(growth, frame):
    before = growth.grown
    large = opened(growth.frame(4, wish(wanted(leaf_size=1.5)), {}, Watch())[0])[0]
    assert growth.grown is before and large.segments == frame[0].segments


def test_its_files_are_those_of_the_command_line(growth, tmp_path):
    document = wanted(library="I,II", leaf_size=1.25, seed=3, season="autumn")
    (tmp_path / "elm.png").write_bytes(PICTURE)
    (tmp_path / "elm.svg").write_bytes(photo_answers.marks_as_svg(growth.bench, Asked.of(document, "elm")))
    before = growth.grown
    found = growth.files(wish(document), {}, "elm.glb", FILES, Watch())
    assert growth.grown is not before  # other subtrees, and another seed
    command = exports.command_line(document, exports.Export(format=".glb", tree="photo")).split()
    assert command == [
        "sketchtree", "photo", "elm.png", "--strokes", "elm.svg", "-o", "elm.glb", "--replacements", "3", "--leaf-size", "1.25", "--library", "I,II",
        "--season", "autumn", "--seed", "3",
    ]  # fmt: skip
    assert exports.command_line(document, exports.Export(format=".glb")).split()[:6] == ["sketchtree", "build", "elm.sketchtree", "-o", "elm.glb", "--as-drawn"]
    words = [str(tmp_path / word) if word.startswith("elm.") else word for word in command[2:]]
    answer = CliRunner().invoke(photo_command, [*words, "--quiet"])
    assert answer.exit_code == 0, answer.output
    assert list(found) == ["elm.glb"] and found["elm.glb"] == (tmp_path / "elm.glb").read_bytes()


def read(folder, data: bytes):
    (folder / "read.glb").write_bytes(data)
    return read_asset(folder / "read.glb")


def test_it_grows_up_to_the_tree_that_its_file_has(growth, tmp_path):
    growths = Growths(None)
    growths.lay("elm", growth.standing(wish(wanted()), {}, Watch()))
    moving = growths.files("elm", "elm.glb", "full", 0.0, 4.0, 0, Watch())["elm.glb"]
    still = growth.files(wish(wanted()), {}, "elm.glb", FILES, Watch())["elm.glb"]
    asset, end = read(tmp_path, moving), read(tmp_path, still)
    assert asset.animation.seconds == 4.0 and asset.about == end.about
    assert {mesh.material.name for mesh in end.parts} == {mesh.material.name for mesh in asset.parts}
    assert sum(mesh.triangle_count for mesh in posed(asset, 4.0)) == sum(mesh.triangle_count for mesh in end.parts)
    assert sum(mesh.triangle_count for mesh in posed(asset, 0.0)) == 0


def test_strokes_kept_as_svg_mark_the_same_to_the_last_bit(growth, tmp_path):
    document = wanted()
    asked = Asked.of(document, "elm")
    path = tmp_path / "elm.svg"
    path.write_bytes(photo_answers.marks_as_svg(growth.bench, asked))
    here, there = marks(asked.strokes, asked.place, growth.bench.photo).trees[0], read_strokes(path, growth.bench.photo)[0]
    assert there.names == here.names and (there.crown == here.crown).all()
    assert all((one == other).all() for one, other in zip(there.branches, here.branches, strict=True))


def test_two_crowns_are_two_trees(growth, tmp_path):
    halves = [painted.mark(f"crown {k}", [(x / 2 + 300 * k, y) for x, y in painted.CROWN], crown=True) for k in range(2)]
    trunks = [painted.mark(f"trunk {k}", [((x - 300) / 2 + 150 + 300 * k, y) for x, y in line]) for k, line in enumerate((painted.TRUNK, painted.TRUNK))]
    document = painted.document(*halves, *trunks, picture=PICTURE).replace(photo=dataclasses.replace(ROUNDS, replacements=2))
    head = opened(growth.frame(6, wish(document), {}, Watch())[0])[0]
    assert len(set(head.owners)) == len(head.owners)
    width = painted.AT[2]
    assert (head.high[0] - head.low[0]) / head.scale > 0.5 * width  # one stands beside the other
    growths = Growths(None)
    growths.lay("elms", growth.standing(wish(document), {}, Watch()))
    grown = read(tmp_path, growths.glb("elms", "age", 0.0, Watch()))
    assert {mesh.name.rpartition("_")[2] for mesh in grown.parts} == {"1", "2"} and grown.armature.name.count("root") == 1


def test_what_marks_no_tree_grows_none(growth):
    assert wish(painted.document(MARKS[1], picture=PICTURE)) is None and wish(painted.document(MARKS[0], picture=PICTURE)) is None
    assert Wish.of(painted.document(*MARKS, picture=PICTURE, is_photo=False), "elm") is None
    outside = painted.mark("trunk", [(5000, 5000), (5000, 4000)])
    with pytest.raises(SketchError, match="has no stroke along a limb inside the photo"):
        growth.frame(7, wish(painted.document(MARKS[0], outside, picture=PICTURE)), {}, Watch())


def test_a_season_that_is_asked_for_counts_more_than_a_bare_photo():
    assert wish(wanted()).wanted.bare_as_seen and not wish(wanted(season="autumn")).wanted.bare_as_seen


def test_libraries_and_arrangements_are_called_alike():
    assert LIBRARIES == NAMES and ARRANGEMENTS == FREE
