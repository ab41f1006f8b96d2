"""`sketchtree photo IMAGE --strokes S.svg -o TREE`: all files or none, and every bad photo, stroke or option named in one paragraph, exit status 2."""

import json
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "photo"))

import leafy  # noqa: E402

from sketchtree.commands.app import run  # noqa: E402
from sketchtree.export.gltf import read_glb, read_glb_skeleton  # noqa: E402
from sketchtree.skeleton import TreeSkeleton  # noqa: E402
from sketchtree.studio.making.documents import document_of  # noqa: E402

FAST = ["--replacements", "0", "--lift", "okabe", "--template", "apple", "--height", "6", "--quiet"]


@pytest.fixture
def folder(tmp_path):
    """A photo with strokes."""
    Image.fromarray(leafy.leafy_photo().rgb).save(tmp_path / "tree.png")
    (tmp_path / "strokes.svg").write_text(leafy.strokes_svg())
    return tmp_path


def photo(folder, *more, image="tree.png", strokes="strokes.svg", output="out.glb"):
    given = [] if strokes is None else ["--strokes", str(folder / strokes)]
    return run(["photo", str(folder / image), *given, "-o", str(folder / output), *FAST, *more])


def refused(capsys, folder, *more, says, **how):
    """Exit status 2, one paragraph with these words, and no file more."""
    before = sorted(path.name for path in folder.iterdir())
    assert photo(folder, *more, **how) == 2
    told = capsys.readouterr().err.strip()
    assert says in told and "\n\n" not in told and "Traceback" not in told, told
    assert sorted(path.name for path in folder.iterdir()) == before


def test_every_file_that_is_asked_for_is_written(folder):
    names = {"--report": "r.json", "--mask": "m.png", "--traced": "v.swc", "--skeleton": "g.swc"}
    assert photo(folder, "--replacements", "2", *(part for option, name in names.items() for part in (option, str(folder / name)))) == 0
    report = json.loads((folder / "r.json").read_text())
    assert report["command"] == "photo" and report["leaves"] > 500 and report["height"] == pytest.approx(6.0, rel=0.2)
    assert report["options"]["library"] == ["visible", "I", "II"] and report["options"]["leaf_size"] == 1.0
    mask = np.asarray(Image.open(folder / "m.png"))
    assert mask.shape == (leafy.HIGH, leafy.WIDE) and set(np.unique(mask)) == {0, 255} and mask[105, 120] == 255
    first = next(line for line in (folder / "v.swc").read_text().splitlines() if line and not line.startswith("#")).split()
    assert (float(first[2]), float(first[3])) == pytest.approx((120.0, -240.0), abs=0.01)
    assert {mesh.name for mesh in read_glb(folder / "out.glb")} >= {"wood", "leaf"}
    assert read_glb_skeleton(folder / "out.glb").height > 4


def test_a_project_keeps_the_photo_and_its_strokes_and_builds_the_same_tree_again(folder):
    assert photo(folder, "--leaf-size", "0.7") == photo(folder, "--leaf-size", "0.7", output="tree.sketchtree") == 0
    built = ["build", str(folder / "tree.sketchtree"), "--method", "okabe", "--template", "apple", "--height", "6", "--quiet"]
    assert run([*built, "-o", str(folder / "again.glb")]) == run([*built, "-o", str(folder / "tree2.sketchtree")]) == 0
    assert (folder / "again.glb").read_bytes() == (folder / "out.glb").read_bytes()
    (folder / "tree.sketchtree").rename(folder / "first.sketchtree")
    (folder / "tree2.sketchtree").rename(folder / "tree.sketchtree")
    assert run([*built, "-o", str(folder / "third.glb")]) == 0
    assert (folder / "third.glb").read_bytes() == (folder / "out.glb").read_bytes()


def test_a_projects_strokes_alone_are_a_drawing(folder):
    assert photo(folder, output="tree.sketchtree") == 0
    assert run(["build", str(folder / "tree.sketchtree"), "-o", str(folder / "drawn.swc"), "--as-drawn", "--generations", "0", "--leaf", "none", "--report", str(folder / "drawn.json"), "--quiet"]) == 0
    report = json.loads((folder / "drawn.json").read_text())
    assert report["command"] == "build" and "replacements" not in report["options"] and report["segments"]["limbs"] >= 1


def test_a_project_keeps_a_picture_that_the_studio_can_show_and_tells_what_it_can_not_keep(capsys, folder):
    Image.open(folder / "tree.png").save(folder / "tree.tif")
    assert photo(folder, "--mask", str(folder / "m.png"), "--leaf", "none") == 0
    capsys.readouterr()
    assert run(["photo", str(folder / "tree.tif"), "--strokes", str(folder / "strokes.svg"), "-o", str(folder / "tree.sketchtree"), *FAST[:-1], "--leaf", "none", "--use-mask", str(folder / "m.png")]) == 0
    told = capsys.readouterr().err
    assert "The project keeps tree.tif as PNG, in 8 bits." in told and "A project keeps no mask" in told
    document = document_of((folder / "tree.sketchtree").read_bytes(), "tree.sketchtree")
    assert document.underlay.photo and document.underlay.picture.startswith(b"\x89PNG") and (document.underlay.width, document.underlay.height) == (leafy.WIDE, leafy.HIGH)
    assert [stroke.kind for stroke in document.strokes.values()].count("crown") == 1 and document.photo.replacements == 0


def test_its_own_mask_gives_the_foliage_back(folder):
    assert photo(folder, "--mask", str(folder / "m.png"), "--leaf", "none") == 0
    assert photo(folder, "--use-mask", str(folder / "m.png"), "--mask", str(folder / "again.png"), "--leaf", "none", output="again.glb") == 0
    mask, again = (np.asarray(Image.open(folder / name)) > 0 for name in ("m.png", "again.png"))
    assert (mask & again).sum() / (mask | again).sum() > 0.95


def test_without_replacements_nothing_grows(folder):
    assert photo(folder, "--leaf", "none", "--report", str(folder / "r.json")) == 0
    report = json.loads((folder / "r.json").read_text())
    assert report["leaves"] == 0 and report["segments"]["total"] == report["segments"]["drawn"]


@pytest.mark.parametrize("name, make", [
    ("cmyk.jpg", lambda image: image.convert("CMYK")),
    ("grey16.png", lambda image: Image.fromarray((np.asarray(image.convert("L")).astype(np.uint16) * 257))),
    ("palette.png", lambda image: image.convert("P", palette=Image.Palette.ADAPTIVE, colors=64)),
    ("alpha.png", lambda image: image.convert("RGBA")),
])  # fmt: skip
def test_any_kind_of_picture_gives_the_same_mask(folder, name, make):
    """CMYK, 16 bits, a palette, alpha: the trace, without growth, lies in the same foliage."""
    make(Image.open(folder / "tree.png")).save(folder / name)
    assert photo(folder, "--mask", str(folder / "m.png"), "--leaf", "none", image=name) == 0
    mask = np.asarray(Image.open(folder / "m.png")) > 0
    truth = np.hypot(np.arange(leafy.WIDE)[None] - 120, (np.arange(leafy.HIGH)[:, None] - 105) * 88 / 85) <= 88
    assert (mask & truth).sum() / (mask | truth).sum() > 0.85


def test_a_turned_photo_is_upright_first(folder):
    image = Image.open(folder / "tree.png").transpose(Image.Transpose.ROTATE_90)
    exif = Image.Exif()
    exif[0x0112] = 6  # turn by 90° clockwise to see it upright
    image.save(folder / "turned.jpg", exif=exif, quality=95)
    assert photo(folder, "--mask", str(folder / "m.png"), "--leaf", "none", image="turned.jpg") == 0
    assert np.asarray(Image.open(folder / "m.png")).shape == (leafy.HIGH, leafy.WIDE)


def test_without_strokes_it_asks_for_them(capsys, folder):
    refused(capsys, folder, strokes=None, says="There are no strokes to say which tree is meant. Give `--strokes FILE`")


def test_strokes_and_auto_together_are_refused(capsys, folder):
    refused(capsys, folder, "--auto", says="`--strokes` and `--auto` both say which tree is meant.")


@pytest.mark.parametrize("more, says", [
    (["--library", "visible,III"], "names no library of subtrees. Choose all, or some of: visible, I, II."),
    (["--leaf-size", "0"], "`--leaf-size 0` is out of range. Give 0.1 to 10"),
    (["--leaf-density", "11"], "`--leaf-density 11` is out of range."),
    (["--height", "-3"], "`--height -3` is no height of a tree."),
    (["--template", "yggdrasil"], "There is no template called “yggdrasil”."),
    (["--leaf", "gingko"], "There is no leaf called “gingko”."),
    (["--compare", "c.jpg"], "is no .png file. Name it c.png."),
    (["--mask", "m.svg"], "is no .png file."),
    (["--traced", "t.glb"], "is no"),
    (["--prune", "y<<3"], "y<<3"),
])  # fmt: skip
def test_a_wrong_option_is_named_before_any_work(capsys, folder, more, says):
    refused(capsys, folder, *more, says=says)


@pytest.mark.parametrize("output", ["tree.png", "strokes.svg"])
def test_what_is_read_is_never_written_over(capsys, folder, output):
    before = (folder / output).read_bytes()
    assert photo(folder, output=output) == 2
    assert (folder / output).read_bytes() == before


def test_an_output_that_cannot_be_written_is_named_before_any_work(capsys, folder):
    refused(capsys, folder, output="nowhere/out.glb", says="nowhere")
    refused(capsys, folder, "--mask", str(folder / "nowhere" / "m.png"), says="nowhere")


def test_two_outputs_of_one_name_are_refused(capsys, folder):
    refused(capsys, folder, "--mask", str(folder / "x.png"), "--compare", str(folder / "x.png"), says="would overwrite what `--mask` writes.")


def strokes(folder, **how):
    (folder / "strokes.svg").write_text(leafy.strokes_svg(**how))


def test_strokes_outside_the_photo_are_refused(capsys, folder):
    strokes(folder, crown_at=leafy.crown() + [1000.0, 0.0], limbs=[[(x + 1000, y) for x, y in leafy.TRUNK]])
    refused(capsys, folder, says="outside the photo")


def test_strokes_drawn_over_another_photo_are_refused(capsys, folder):
    strokes(folder, size=(600, 200))
    refused(capsys, folder, says="is drawn on a page of 600 × 200, but tree.png has 240 × 260 pixels.")


def test_a_crown_without_a_limb_is_refused(capsys, folder):
    strokes(folder, limbs=())
    refused(capsys, folder, says="strokes.svg has no branch strokes")


def test_a_crown_round_nothing_green_is_refused(capsys, folder):
    sky = np.zeros((leafy.HIGH, leafy.WIDE, 3), np.uint8) + np.array([120, 170, 230], np.uint8)
    Image.fromarray(sky).save(folder / "sky.png")
    refused(capsys, folder, image="sky.png", says="there is no foliage inside it")


def test_a_picture_too_small_to_show_a_tree_is_refused(capsys, folder):
    Image.new("RGB", (1, 1)).save(folder / "dot.png")
    refused(capsys, folder, image="dot.png", says="dot.png")


def test_a_picture_too_large_is_refused_before_it_is_decoded(capsys, folder):
    Image.new("L", (4000, 4000)).save(folder / "large.png")
    refused(capsys, folder, "--max-megapixels", "10", image="large.png", says="large.png")


@pytest.mark.parametrize("content, says", [(b"", "is empty"), (b"not a picture", "picture")])
def test_what_is_no_picture_is_refused(capsys, folder, content, says):
    (folder / "odd.png").write_bytes(content)
    refused(capsys, folder, image="odd.png", says=says)


def test_a_photo_that_is_not_there_is_named(capsys, folder):
    refused(capsys, folder, image="none.png", says="none.png")


def test_a_mask_of_another_size_is_refused(capsys, folder):
    Image.new("L", (50, 50), 255).save(folder / "small.png")
    refused(capsys, folder, "--use-mask", str(folder / "small.png"), says="small.png has 50 × 50 pixels, the photo 240 × 260.")


def test_a_project_of_two_trees_is_refused_before_the_work(capsys, folder):
    both = leafy.strokes_svg(limbs=[leafy.TRUNK, leafy.LIMB])
    second = '<g id="crown 2"><polygon points="10,150 10,200 40,200 40,150"/></g><g id="branches 2"><polyline points="25,225 25,170"/></g></svg>'
    (folder / "strokes.svg").write_text(both.replace("</svg>", second))
    refused(capsys, folder, output="tree.sketchtree", says="A project holds one tree, and 2 are marked in tree.png.")


def test_without_drawing_off_the_screen_the_tree_is_written_and_the_picture_told_missing(capsys, folder, monkeypatch):
    monkeypatch.setattr("sketchtree.view.beside.draw_in_child", lambda *_: (False, "no OpenGL here; install libgl1"))
    assert photo(folder, "--compare", str(folder / "c.png"), "--leaf", "none", "--report", str(folder / "r.json")) == 0
    assert any("c.png was not drawn: no OpenGL here" in told for told in json.loads((folder / "r.json").read_text())["warnings"])
    assert (folder / "out.glb").exists() and not (folder / "c.png").exists()


def test_rounds_and_replacements_are_one_option(folder):
    for name in ("--rounds", "--replacements"):
        assert run(["photo", str(folder / "tree.png"), "--strokes", str(folder / "strokes.svg"), "-o", str(folder / f"{name}.swc"), *FAST[2:], "--leaf", "none", name, "0"]) == 0
    assert (folder / "--rounds.swc").read_bytes() == (folder / "--replacements.swc").read_bytes()
