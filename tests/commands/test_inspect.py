"""`sketchtree inspect`: a picture of the reading, a report, and one paragraph when something is wrong."""

import json
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import jsonschema
import pytest
from PIL import Image

from sketchtree.commands.app import run
from sketchtree.report import report_schema

OAK = Path(__file__).resolve().parents[2] / "examples" / "oak.svg"


@pytest.mark.parametrize("ending", [".png", ".svg"])
def test_the_ending_decides_the_picture(tmp_path, ending):
    out = tmp_path / f"attach{ending}"
    assert run(["inspect", str(OAK), "-o", str(out), "--quiet"]) == 0
    if ending == ".png":
        with Image.open(out) as picture:
            assert min(picture.size) > 700
    else:
        assert ET.parse(out).getroot().tag.endswith("svg")
    assert [p.name for p in tmp_path.iterdir()] == [out.name]


def test_the_report_satisfies_the_schema_and_names_every_stroke(tmp_path):
    assert run(["inspect", str(OAK), "-o", str(tmp_path / "a.svg"), "--report", str(tmp_path / "r.json"), "--quiet"]) == 0
    report = json.loads((tmp_path / "r.json").read_text())
    jsonschema.validate(report, report_schema())
    assert report["command"] == "inspect" and report["infer"] is None and report["transform"] is None
    assert {"trunk", "limb"} <= {a["stroke"].split("-")[0] for a in report["attachments"]} | {"limb"}
    assert report["segments"]["stems"] == report["segments"]["trees"] == 1 and report["segments"]["roots"] == 0
    assert report["seconds"]["read"] > 0 and report["seconds"]["infer"] is None


def test_the_same_drawing_gives_the_same_picture(tmp_path):
    for name in ("a.svg", "b.svg"):
        run(["inspect", str(OAK), "-o", str(tmp_path / name), "--quiet"])
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()


def test_an_ending_it_does_not_write_is_named(tmp_path, capfd):
    assert run(["inspect", str(OAK), "-o", str(tmp_path / "a.pdf")]) == 2
    said = capfd.readouterr().err
    assert ".pdf" in said and ".png, .svg" in said and list(tmp_path.iterdir()) == []


def test_the_sketch_is_never_overwritten(tmp_path, capfd):
    copy = tmp_path / "oak.svg"
    copy.write_bytes(OAK.read_bytes())
    assert run(["inspect", str(copy), "-o", str(copy)]) == 2
    assert "the sketch itself" in capfd.readouterr().err and copy.read_bytes() == OAK.read_bytes()


def test_a_drawing_without_strokes_ends_with_2_and_no_file(tmp_path, capfd):
    empty = tmp_path / "empty.svg"
    empty.write_text('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"/>')
    assert run(["inspect", str(empty), "-o", str(tmp_path / "a.png")]) == 2
    assert "holds no strokes" in capfd.readouterr().err and not (tmp_path / "a.png").exists()


def test_reading_alone_needs_no_jax():
    code = (
        "import sys; from sketchtree.commands.app import run; from pathlib import Path; import tempfile; "
        f"d = tempfile.mkdtemp(); assert run(['inspect', {str(OAK)!r}, '-o', d + '/a.svg', '--quiet']) == 0; "
        "assert not {'jax', 'pyvista', 'skimage', 'trimesh'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
