"""`sketchtree grow INPUT -o GROWTH`: pictures, drawings and skeletons; all files or none, and what is wrong in one paragraph, exit status 2."""

import json
import shutil
import sys
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from PIL import Image, ImageDraw

from sketchtree.commands.app import run
from sketchtree.export.read import read_contents
from sketchtree.report import report_schema
from sketchtree.skeleton_files import read_skeleton

TREE = [((80, 199), (80, 60), 12), ((80, 130), (40, 70), 6), ((80, 110), (122, 50), 6), ((80, 60), (70, 20), 5)]  # from, to, pixels across
SWC = "1 0 0 0 0 0.2 -1\n2 0 0 3 0 0.15 1\n3 0 1 5 0.2 0.05 2\n4 0 -1 5 -0.2 0.05 2\n"


@pytest.fixture
def folder(tmp_path):
    """A dark tree before a light sky, with scribbles, its matte, and a skeleton."""
    noise = np.random.default_rng(1).normal(0, 4, (200, 160, 3))
    picture, matte = Image.new("RGB", (160, 200), (190, 205, 225)), Image.new("L", (160, 200))
    for start, end, width in TREE:
        ImageDraw.Draw(picture).line([start, end], (70, 55, 40), width)
        ImageDraw.Draw(matte).line([start, end], 255, width)
    Image.fromarray(np.clip(np.asarray(picture) + noise, 0, 255).astype(np.uint8)).save(tmp_path / "tree.png")
    matte.save(tmp_path / "matte.png")
    scribbles(tmp_path, "marks.json")
    (tmp_path / "tree.swc").write_text(SWC)
    return tmp_path


def scribbles(folder, name, *, fore=([[80, 190], [80, 70]],), back=([[20, 10], [20, 190]], [[140, 20], [140, 190]])):
    (folder / name).write_text(json.dumps({"foreground": list(fore), "background": list(back), "brush": 3}))
    return name


def grow(folder, source, *more, output="out.swc"):
    """Paths among `more` begin with `@`."""
    named = [str(folder / one[1:]) if one.startswith("@") else one for one in more]
    return run(["grow", str(folder / source), "-o", str(folder / output), "--quiet", *named])


def refused(capsys, folder, source, *more, says, output="out.swc"):
    before = sorted(path.name for path in folder.rglob("*"))
    assert grow(folder, source, *more, output=output) == 2
    told = capsys.readouterr().err.strip()
    assert says in told and "\n\n" not in told and "Traceback" not in told, told
    assert sorted(path.name for path in folder.rglob("*")) == before


KNOWN = ("--use-matte", "@matte.png", "--template", "apple", "--height", "6")


def test_a_picture_with_scribbles_becomes_a_tree_with_matte_trunk_and_report(folder):
    files = ("--matte", "@a.png", "--trunk", "@t.swc", "--report", "@r.json", "--skeleton", "@s.swc")
    assert grow(folder, "tree.png", "--scribbles", "@marks.json", "--template", "apple", "--height", "6", "--levels", "1", *files, output="out.obj") == 0
    alpha = np.asarray(Image.open(folder / "a.png"))
    assert alpha.shape == (200, 160) and alpha[150, 80] > 200 and alpha[150, 20] < 50
    trunk = read_skeleton(folder / "t.swc")
    assert trunk.tip[0, :2] == pytest.approx([80, -200], abs=3) and trunk.radius[0] == pytest.approx(6, abs=2)
    report = json.loads((folder / "r.json").read_text())
    jsonschema.validate(report, report_schema())
    assert report["growth"]["trunk"]["tips"] == 3 and report["growth"]["levels"] == 1 and report["growth"]["input"] == "picture"
    assert report["segments"]["total"] > report["segments"]["drawn"] and report["template_used"] == "apple"
    assert read_skeleton(folder / "s.swc").height == pytest.approx(report["height"], rel=1e-3)


def test_the_same_seed_gives_the_same_bytes_and_another_another_crown(folder):
    for name, seed in (("a", "3"), ("b", "3"), ("c", "4")):
        assert grow(folder, "tree.png", *KNOWN, "--levels", "2", "--seed", seed, output=f"{name}.swc") == 0
    once, again, other = ((folder / f"{name}.swc").read_bytes() for name in "abc")
    assert once == again and once != other


def test_a_trunk_keeps_its_place_in_the_picture_whatever_grows_on_it(folder):
    assert grow(folder, "tree.png", *KNOWN, "--levels", "0", output="bare.h5") == grow(folder, "tree.png", *KNOWN, "--levels", "2", output="full.h5") == 0
    bare, full = read_skeleton(folder / "bare.h5"), read_skeleton(folder / "full.h5")
    assert bare.height == pytest.approx(6.0) and len(full) > 4 * len(bare)
    assert {tuple(tip) for tip in bare.tip} <= {tuple(tip) for tip in full.tip}


def test_variations_share_the_trunk_and_the_first_is_that_of_the_plain_run(folder):
    assert grow(folder, "tree.png", *KNOWN, "--levels", "1", output="one.h5") == 0
    assert grow(folder, "tree.png", *KNOWN, "--levels", "1", "--variations", "2", "--report", "@r.json", output="crown.h5") == 0
    one, first, second = (read_skeleton(folder / name).tip for name in ("one.h5", "crown_1.h5", "crown_2.h5"))
    assert np.array_equal(one, first) and not np.array_equal(first, second)
    assert [crown["file"] for crown in json.loads((folder / "r.json").read_text())["growth"]["crowns"]] == ["crown_1.h5", "crown_2.h5"]


def test_a_drawing_is_the_tree_that_build_makes_of_it(tmp_path):
    sketch = Path(__file__).resolve().parents[2] / "examples" / "curvy.svg"
    shutil.copy(sketch, tmp_path / "c.svg")
    how = ["--method", "okabe", "--template", "apple", "--generations", "1", "--quiet"]
    assert run(["build", str(tmp_path / "c.svg"), "-o", str(tmp_path / "b.swc"), *how]) == 0
    assert run(["grow", str(tmp_path / "c.svg"), "-o", str(tmp_path / "g.swc"), *how]) == 0
    assert (tmp_path / "b.swc").read_bytes() == (tmp_path / "g.swc").read_bytes()
    assert run(["build", str(tmp_path / "c.svg"), "-o", str(tmp_path / "b.glb"), "--season", "autumn", *how]) == 0
    assert run(["grow", str(tmp_path / "b.glb"), "-o", str(tmp_path / "again.obj"), "--season", "autumn", "--report", str(tmp_path / "r.json"), "--quiet"]) == 0
    report = json.loads((tmp_path / "r.json").read_text())
    assert report["template_used"] == "apple" and report["leaves"] > 0 and report["growth"]["input"] == "skeleton"


def test_a_skeleton_is_scaled_to_a_height_and_a_sketch_is_told_from_it_by_what_it_says(folder):
    assert grow(folder, "tree.swc", "--height", "10", output="high.json") == 0
    assert read_skeleton(folder / "high.json").height == pytest.approx(10.0)
    assert grow(folder, "high.json", output="again.json") == 0
    assert (folder / "again.json").read_bytes() == (folder / "high.json").read_bytes()
    (folder / "sketch.json").write_text(json.dumps({"sketchtree": 1, "strokes": [{"points": [[0, 0], [0, 9]]}, {"points": [[0, 5], [3, 8]]}]}))
    assert grow(folder, "sketch.json", "--template", "none", "--method", "okabe", "--generations", "0", output="drawn.swc") == 0


def test_a_tree_at_an_earlier_time_is_smaller(folder):
    for name, time in (("seed", "0"), ("young", "0.4"), ("old", "1")):
        assert grow(folder, "tree.swc", "--time", time, output=f"{name}.json") == 0
    young, old = (read_skeleton(folder / f"{name}.json") for name in ("young", "old"))
    assert 0 < young.height < old.height == pytest.approx(5.0)


def test_a_matte_with_two_pieces_keeps_one_unless_a_gap_joins_them(folder, capsys):
    cut = np.array(Image.open(folder / "matte.png"))
    cut[88:93] = 0
    Image.fromarray(cut).save(folder / "cut.png")
    how = ("--use-matte", str(folder / "cut.png"), "--template", "apple", "--levels", "0")
    heights = []
    for more in ((), ("--gap", "8")):
        assert run(["grow", str(folder / "tree.png"), "-o", str(folder / "t.h5"), *how, *more, "--trunk", str(folder / "t.swc")]) == 0
        told = capsys.readouterr().err
        assert "joined to the trunk" in told if more else "The matte is in pieces" in told
        heights.append(read_skeleton(folder / "t.swc").height)
    assert heights[1] > heights[0] + 40


def test_branches_are_drawn_into_the_matte(folder):
    (folder / "more.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 160 200"><g id="add"><path d="M80 150 L130 120" fill="none" stroke="black" stroke-width="6"/></g></svg>')
    counts = []
    for more in ((), ("--edit-matte", "@more.svg")):
        assert grow(folder, "tree.png", *KNOWN, "--levels", "0", *more, "--report", "@r.json") == 0
        counts.append(json.loads((folder / "r.json").read_text())["growth"]["trunk"]["tips"])
    assert counts == [3, 4]


BACK = [[20, 10], [20, 190]]


@pytest.mark.parametrize(
    ("marks", "says"),
    [
        ({"back": ()}, "has no background line"),
        ({"fore": ()}, "has no foreground line"),
        ({"fore": (), "back": ()}, "is empty"),
        ({"fore": (BACK,), "back": (BACK,)}, "its background lines lie over all of its foreground lines"),
        ({"fore": ([[900, 10], [900, 90]],)}, "lie outside the photo"),
    ],
)
def test_scribbles_that_leave_one_side_nothing_are_refused(folder, capsys, marks, says):
    refused(capsys, folder, "tree.png", "--scribbles", "@" + scribbles(folder, "bad.json", **marks), says=says)


def test_what_is_wrong_with_the_picture_is_told(folder, capsys):
    refused(capsys, folder, "tree.png", says="nothing says what of it is tree")
    refused(capsys, folder, "none.png", "--scribbles", "@marks.json", says="none.png")
    Image.new("L", (160, 200)).save(folder / "black.png")
    refused(capsys, folder, "tree.png", "--use-matte", "@black.png", says="The matte is empty")
    Image.new("L", (16, 20)).save(folder / "small.png")
    refused(capsys, folder, "tree.png", "--use-matte", "@small.png", says="small.png has 16 × 20 pixels, the photo 160 × 200")
    refused(capsys, folder, "tree.png", "--use-matte", "@matte.png", "--scribbles", "@marks.json", says="both say what is tree")


@pytest.mark.parametrize(
    ("edits", "says"),
    [({"vertices": 2}, "at least 3"), ({"remove": [[5, 5]]}, "no vertex is there"), ({"add": [[5, 5]]}, "the contour is not there"), ({"cut": []}, "`cut` is none of")],
)
def test_edits_of_vertices_that_hit_nothing_are_told(folder, capsys, edits, says):
    (folder / "edits.json").write_text(json.dumps(edits))
    refused(capsys, folder, "tree.png", *KNOWN, "--vertices", "@edits.json", says=says)


@pytest.mark.parametrize(
    ("more", "says"),
    [
        (("--bend", "70"), "`--bend 70` is out of range"),
        (("--levels", "6"), "`--levels 6` is out of range"),
        (("--time", "1.5"), "`--time 1.5` is out of range"),
        (("--frames", "1", "--movie", "@m.gif"), "`--frames 1` is out of range"),
        (("--frames", "9"), "none is asked for"),
        (("--seconds", "4"), "nothing that is asked for moves"),
        (("--joints", "4"), "`--joints 4` is out of range"),
        (("--lod", "2"), "`--lod 2` says how fine the meshes are, and `.swc` files hold none."),
        (("--compact",), "`--compact` is for glTF, and `.swc` files have no such numbers."),
        (("--joints", "400"), "nothing that is asked for moves"),
        (("--variations", "3"), "nothing is"),
        (("--scribbles", "@marks.json"), "`--scribbles` does nothing here: tree.swc holds a tree already"),
        (("--generations", "3"), "`--generations` does nothing here"),
        (("--template", "baobab_of_mars"), "There is no template called"),
        (("--leaf", "feather"), "There is no leaf called"),
        (("--report", "@tree.swc"), "would overwrite"),
        (("--movie", "@m.avi"), "m.avi"),
    ],
)
def test_options_out_of_range_or_without_effect_are_refused(folder, capsys, more, says):
    refused(capsys, folder, "tree.swc", *more, says=says)


def test_a_movie_without_its_encoder_is_refused_before_the_work(folder, capsys, monkeypatch):
    monkeypatch.setattr("shutil.which", lambda name: None)
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    refused(capsys, folder, "tree.swc", "--movie", "@m.mp4", says="ffmpeg")


def test_outputs_that_hold_no_tree_or_another_series_are_refused(folder, capsys):
    refused(capsys, folder, "tree.swc", says="a project keeps a drawing, not its growth", output="p.sketchtree")
    refused(capsys, folder, "tree.swc", says="--movie", output="film.mp4")
    (folder / "all").mkdir()
    (folder / "all" / "out_0024.glb").touch()
    refused(capsys, folder, "tree.swc", "--series", "@all", says="of a longer series")


def test_skeletons_that_can_not_grow_are_told(folder, capsys):
    (folder / "ring.swc").write_text("1 0 0 0 0 1 3\n2 0 0 1 0 1 1\n3 0 0 2 0 1 2\n")
    refused(capsys, folder, "ring.swc", says="ring.swc")
    (folder / "dot.swc").write_text("1 0 0 0 0 1 -1\n")
    refused(capsys, folder, "dot.swc", says="nothing can grow")
    (folder / "cube.obj").write_text("v 0 0 0\n")
    refused(capsys, folder, "cube.obj", says="a mesh without a skeleton")


def test_a_matte_with_holes_is_told_and_becomes_a_tree_without_a_cycle(folder, capsys):
    holed = np.array(Image.open(folder / "matte.png"))
    holed[135:165, 78:82] = 0
    holed[180:182, 79:81] = 0
    Image.fromarray(holed).save(folder / "holed.png")
    assert run(["grow", str(folder / "tree.png"), "-o", str(folder / "t.swc"), "--use-matte", str(folder / "holed.png"), "--template", "apple", "--levels", "0", "--report", str(folder / "r.json")]) == 0
    told = capsys.readouterr().err
    assert "1 small hole in the trunk was filled" in told and "The trunk has 1 hole; the loop round each is cut" in told
    assert json.loads((folder / "r.json").read_text())["growth"]["trunk"]["tips"] >= 3


def test_a_photo_without_a_tree_is_refused(folder, capsys):
    Image.new("RGB", (160, 200), (190, 205, 225)).save(folder / "sky.png")
    refused(capsys, folder, "sky.png", says="nothing says what of it is tree")
    Image.new("L", (160, 200)).save(folder / "none.png")
    refused(capsys, folder, "sky.png", "--use-matte", "@none.png", says="The matte is empty: nowhere is it half opaque.")


def test_our_own_inference_lifts_the_trunk_too_and_keeps_its_place_in_the_picture(folder):
    for name, lift in (("one", "siblings"), ("other", "elevation")):
        assert grow(folder, "tree.png", *KNOWN, "--levels", "0", "--lift", lift, output=f"{name}.h5") == 0
    one, other = (read_skeleton(folder / f"{name}.h5") for name in ("one", "other"))
    assert one.tip[:, :2] == pytest.approx(other.tip[:, :2], abs=1e-6)
    assert np.ptp(other.tip[:, 2]) > 0 and not np.allclose(one.tip[:, 2], other.tip[:, 2])


def test_a_tree_grown_from_a_file_of_ours_wears_what_it_wore_there(folder):
    worn = ("--leaf", "apple", "--bark", "birch", "--season", "autumn", "--seed", "7")
    assert grow(folder, "tree.swc", "--levels", "1", *worn, "--time", "1", output="one.glb") == 0
    assert grow(folder, "one.glb", "--time", "1", output="two.glb") == 0
    one, two = (read_contents(folder / f"{name}.glb").asset for name in ("one", "two"))
    assert one.about == two.about and {"leaf": "apple", "bark": "birch", "season": "autumn", "seed": 7}.items() <= one.about.items()
    assert [part.merged().material.name for part in one.parts] == [part.merged().material.name for part in two.parts]


def test_a_tree_that_build_made_grows_in_the_looks_it_has(tmp_path):
    sketch = Path(__file__).resolve().parents[2] / "examples" / "curvy.svg"
    how = ("--method", "okabe", "--template", "apple", "--generations", "1", "--season", "autumn")
    assert run(["build", str(sketch), "-o", str(tmp_path / "b.glb"), "--quiet", *how]) == 0
    about = read_contents(tmp_path / "b.glb").asset.about
    assert about["season"] == "autumn" and about["leaf"] == "apple"
    assert run(["grow", str(tmp_path / "b.glb"), "-o", str(tmp_path / "g.glb"), "--quiet", "--time", "1"]) == 0
    assert read_contents(tmp_path / "g.glb").asset.about == about


def test_a_coarser_level_of_detail_moves_by_fewer_joints_and_is_a_smaller_file(folder):
    sizes, joints = [], []
    for more in ((), ("--lod", "3", "--compact")):
        assert grow(folder, "tree.swc", "--leaf", "oak", "--levels", "2", "--report", "@r.json", *more, output="g.glb") == 0
        asset = read_contents(folder / "g.glb").asset
        sizes.append([(folder / "g.glb").stat().st_size, sum(part.triangle_count for part in asset.parts if "young" not in part.name)])
        joints.append(json.loads((folder / "r.json").read_text())["growth"]["joints"])
        young = [part for part in asset.parts if "young" in part.name]
        assert young and len(asset.armature) == joints[-1]
    assert sizes[1][0] < 0.6 * sizes[0][0] and sizes[1][1] <= 0.06 * sizes[0][1] and joints[1] <= min(joints[0], 755)
