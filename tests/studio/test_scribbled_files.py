"""The tree of scribbles leaves the studio as the very files that `sketchtree build` and `sketchtree grow` write of the saved project: grown up, and as it grows."""

import asyncio
import shlex

import pytest
from test_trunk_bench import PICTURE, SAID, brush, drawn

from sketchtree.commands.app import run
from sketchtree.errors import OptionError
from sketchtree.options import FileOptions
from sketchtree.sketch.strokes import StrokeKind
from sketchtree.studio import exports
from sketchtree.studio.growth import Ageing, Ager, Grown
from sketchtree.studio.hand import Hand
from sketchtree.studio.laid_photo import LaidPhoto
from sketchtree.studio.making.jobs import Jobs
from sketchtree.studio.making.trunk_asked import TrunkWish
from sketchtree.studio.trunker import Trunker
from sketchtree.trunk.wanted import TrunkChoices
from sketchtree.watch import Watch

DOCUMENT = drawn(*SAID, brush(StrokeKind.MATTE_ERASE, [(34, 56), (10, 26)], 14.0), gap=2.0, root=(40.0, 90.0)).replace(seed=3, name="bare")
WISH = TrunkWish.of(DOCUMENT, "bare")
PLAIN = exports.Export(format=".glb").options


@pytest.fixture(scope="module")
def jobs():
    made = Jobs(None, None)
    made.photo_bench.read("bare", PICTURE)
    return made


@pytest.fixture
def command(jobs, tmp_path, monkeypatch):
    """What the command line that the page shows writes of the saved project."""
    (tmp_path / "bare.sketchtree").write_bytes(jobs._project(0, Watch(), DOCUMENT))
    monkeypatch.chdir(tmp_path)

    def write(export: exports.Export) -> bytes:
        words = shlex.split(exports.command_line(DOCUMENT, export))
        assert words[:3] == ["sketchtree", "build" if export.growth is None else "grow", "bare.sketchtree"] and run([*words[1:], "--quiet"]) == 0
        return (tmp_path / f"bare{export.format}").read_bytes()

    return write


@pytest.mark.parametrize("said", [{"format": ".glb"}, {"format": ".swc"}, {"format": ".obj", "lod": 2}, {"format": ".glb", "leaves": "instanced", "wood": "one-piece"}])
def test_grown_up_it_has_the_bytes_of_the_command_line(jobs, command, said):
    export = exports.Export(tree="photo", **said)
    files = jobs.trunk_bench.files(WISH, f"bare{export.format}", export.options, Watch())
    assert files[f"bare{export.format}"] == command(export)


def test_grown_up_it_is_what_grow_ends_with(jobs, command, tmp_path):
    assert run(["grow", "bare.sketchtree", "-o", "end.glb", "--time", "1", "--quiet"]) == 0
    assert jobs.trunk_bench.files(WISH, "bare.glb", PLAIN, Watch())["bare.glb"] == (tmp_path / "end.glb").read_bytes()


@pytest.mark.parametrize(("on", "tree"), [(True, "drawn"), (False, "photo")])
def test_a_growth_that_no_command_makes_is_told(on, tree):
    with pytest.raises(OptionError, match="^No command makes this tree grow: "):
        exports.command_line(DOCUMENT.replace(trunk=TrunkChoices(on=on)), exports.Export(format=".glb", tree=tree, growth=Grown()))


@pytest.mark.parametrize(("mode", "bend", "lod"), [("full", 0.0, 0), ("age", -15.0, 0), ("full", 0.0, 2)])
def test_growing_it_has_the_bytes_of_the_command_line(jobs, command, mode, bend, lod):
    jobs.growths.lay("bare", jobs.trunk_bench.standing(WISH, Watch()))
    wanted = exports.Export(format=".glb", tree="photo", growth=Grown(mode=mode, bend=bend, seconds=4.0, lod=lod))
    assert jobs.growths.files("bare", "bare.glb", mode, bend, 4.0, lod, Watch())["bare.glb"] == command(wanted)


def test_the_page_plays_the_same(jobs):
    jobs.growths.lay("bare", jobs.trunk_bench.standing(WISH, Watch()))
    assert jobs.growths.glb("bare", "full", 0.0, Watch()) == jobs.growths.files("bare", "bare.glb", "full", 0.0, 10.0, 0, Watch())["bare.glb"]


def test_it_goes_from_the_process_that_made_it_to_the_one_that_has_it_grow(jobs):
    async def grown():
        trunk, told = Hand("trunk", None, lambda number, value: None), []
        trunker = Trunker(trunk, LaidPhoto(), lambda outcome: None, lambda work: None)
        ager = Ager(lambda: Hand("age", None, lambda number, value: None))
        try:
            glb = await ager.made(trunker.whose(DOCUMENT), Ageing(), lambda stage, done: told.append((stage, done)))
        finally:
            ager.end(), trunker.end()
        return glb, told

    glb, told = asyncio.run(grown())
    done = [one for _, one in told]
    assert {"read", "mesh", "grow", "export"} <= {stage for stage, _ in told} and done == sorted(done) and done[-1] <= 1
    jobs.growths.lay("bare", jobs.trunk_bench.standing(WISH, Watch()))
    assert glb == jobs.growths.glb("bare", "full", 0.0, Watch())


def test_its_files_ask_for_no_other_tree(jobs):
    jobs.trunk_bench.files(WISH, "bare.glb", PLAIN, Watch())
    stages = []
    jobs.trunk_bench.files(WISH, "bare.glb", PLAIN, Watch(on_stage=stages.append))
    assert stages == ["export"]


def test_levels_and_packs_are_as_of_any_tree(jobs):
    apart = jobs.trunk_bench.files(WISH, "bare.glb", PLAIN | {"levels": "apart"}, Watch())
    assert {"bare_LOD0.glb", "bare_LOD3.glb", "bare_impostor.glb"} <= set(apart)
    pack = jobs.trunk_bench.files(WISH, "bare.glb", PLAIN | {"pack": "game"}, Watch())
    assert any(name.endswith(".glb") for name in pack) and len(pack) > 1
    coarse, full = (jobs.trunk_bench.files(WISH, "bare.glb", PLAIN | {"lod": lod}, Watch())["bare.glb"] for lod in (3, 0))
    assert len(coarse) < len(full)


@pytest.mark.parametrize(
    ("name", "options", "said"),
    [
        ("bare.obj", {"leaves": "instanced"}, "`.obj` files can't hold instanced leaves. Write .glb, .gltf or .usd, or leave `--leaves instanced` out."),
    ],
)
def test_what_a_file_can_not_hold_is_refused_before_the_work(jobs, name, options, said):
    with pytest.raises(OptionError) as told:
        jobs.trunk_bench.files(WISH, name, PLAIN | options, Watch(on_stage=lambda stage: pytest.fail(stage)))
    assert str(told.value) == said


def test_all_options_of_an_export_are_those_of_files_and_of_wood():
    assert {*PLAIN} - {"wood", "solid"} < {*FileOptions.__dataclass_fields__}
