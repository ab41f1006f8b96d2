"""A project with points that the studio saves: every file of its tree, and its growth, is the one that the command line makes of it."""

import shlex

import pytest
from scanned_stick import stick

from sketchtree.commands.app import run
from sketchtree.editing.document import Document
from sketchtree.editing.laid_cloud import CloudChoices
from sketchtree.laid_tree import Laid, as_strokes, tree_of
from sketchtree.keys import root_key
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.studio import exports
from sketchtree.studio.growth import Grown
from sketchtree.studio.making.cloud_asked import CloudWish
from sketchtree.studio.making.jobs import Jobs
from sketchtree.watch import Watch

TRACED = Document(cloud=stick(), points=CloudChoices(traced=True), reading=ReadingOptions(template="none"), tree=TreeOptions(leaf="oak", season="autumn", generations=1), seed=4, name="scan")


@pytest.fixture(scope="module")
def jobs():
    return Jobs(None, None)


@pytest.fixture(scope="module")
def drawn():
    """Strokes over the same points, with the depths of the points."""
    laid = Laid(TRACED.cloud)
    strokes, settled = as_strokes(tree_of(laid, None, key=root_key(0)), laid)
    return TRACED.replace(strokes=strokes, settled=settled, points=CloudChoices())


@pytest.fixture
def save(jobs, tmp_path, monkeypatch):
    """The document is a project of the folder."""
    monkeypatch.chdir(tmp_path)
    return lambda document: (tmp_path / "scan.sketchtree").write_bytes(jobs._project(0, Watch(), document))


@pytest.fixture
def command(save, tmp_path):
    """Bytes of the file that the command line, as the studio tells it, makes of the saved project."""

    def made(document, export: exports.Export, *more: str) -> bytes:
        save(document)
        assert run([*shlex.split(exports.command_line(document, export))[1:], *more, "--quiet"]) == 0
        return (tmp_path / f"scan{export.format}").read_bytes()

    return made


def test_a_traced_tree_has_the_bytes_of_build(jobs, command):
    export = exports.Export(format=".glb", tree="photo")
    assert jobs.cloud_bench.files(CloudWish.of(TRACED), "scan.glb", export.options, Watch())["scan.glb"] == command(TRACED, export)


def test_so_has_a_tree_drawn_over_points(jobs, command, drawn):
    export = exports.Export(format=".glb")
    assert jobs._export(0, Watch(), drawn, "scan.glb", export.options)["scan.glb"] == command(drawn, export)


def test_the_growth_that_the_page_plays_has_the_bytes_of_grow_leaves_and_all(jobs, command):
    jobs.growths.lay("scan", jobs.cloud_bench.standing(CloudWish.of(TRACED), Watch()))
    assert jobs.growths.glb("scan", "full", 0.0, Watch()) == command(TRACED, exports.Export(format=".glb", tree="photo", growth=Grown()))


def test_grow_writes_one_moment_of_it_that_does_not_move(command):
    moment = command(TRACED, exports.Export(format=".glb", tree="photo", growth=Grown()), "--time", "0.2")
    assert moment.startswith(b"glTF") and b"leaf_oak" in moment and b'"animations"' not in moment


def test_batch_says_what_makes_its_tree(save, capsys):
    save(TRACED)
    assert run(["batch", "scan.sketchtree", "--out", "made", "--quiet"]) == 1
    told = capsys.readouterr().err
    assert told.strip() == (
        "sketchtree: scan.sketchtree: The tree of scan.sketchtree is traced in the points behind its drawing, and `batch` reads drawings. `sketchtree build scan.sketchtree -o TREE.glb` makes its tree."
    )
