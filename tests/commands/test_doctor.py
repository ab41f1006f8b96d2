"""`sketchtree doctor` and `sketchtree cite`."""

import json
import re
from pathlib import Path

import pytest

from sketchtree import citations, health
from sketchtree.commands import app


@pytest.fixture
def quick(monkeypatch):
    """No picture is drawn: that is tested elsewhere."""
    monkeypatch.setattr(health, "_picture", lambda: health.Check("pictures", False, "none", "Install Mesa.", health.WANTED))


def test_every_check_has_a_line(quick, capsys):
    assert app.run(["doctor"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert any(line.startswith("ok      Python: 3.") for line in lines)
    assert any(re.match(r"ok      templates: \d+ exemplars", line) for line in lines)
    assert any(line.startswith("ok      jax: ") for line in lines)
    assert "missing pictures: none Install Mesa." in lines


def test_what_only_some_options_need_is_missing_but_not_broken(quick, capsys, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    assert app.run(["doctor"]) == 0
    assert "missing usd: for writing .usd .usda .usdc .usdz. `pip install 'sketchtree[usd]'`" in capsys.readouterr().out


def test_what_the_main_job_needs_ends_it_with_status_1(quick, capsys, monkeypatch):
    monkeypatch.setattr(health, "_database", lambda: health.Check("templates", False, "none.", "Install the package again."))
    assert app.run(["doctor"]) == 1
    assert "BROKEN  templates: none. Install the package again." in capsys.readouterr().out


def test_a_package_outside_its_bounds_is_named(monkeypatch):
    monkeypatch.setattr("importlib.metadata.requires", lambda _: ["numpy<1", "nosuchpackage>=2", "pytest>=1; extra == 'test'"])
    (check,) = health._packages()
    assert not check.fine and re.fullmatch(r"numpy \S+ is not <1; nosuchpackage is not installed\.", check.found)


def test_json_is_one_object_a_line(quick, capsys):
    assert app.run(["doctor", "--json"]) == 0
    rows = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert {"Python", "packages", "templates", "jax", "pictures", "ffmpeg"} <= {row["name"] for row in rows}
    assert all(row.keys() == {"name", "fine", "needed", "found", "remedy"} for row in rows)


def test_a_picture_can_be_drawn_or_the_reason_is_told():
    check = health._picture()
    assert check.weight == health.WANTED and (check.fine or check.found.startswith("No picture"))


def test_cite_names_the_program_and_every_work(capsys):
    assert app.run(["cite"]) == 0
    said = capsys.readouterr().out
    assert citations.program_line() in said and all(work.title in said for work in citations.WORKS)


def test_bibtex_entries_are_balanced_and_distinct(capsys):
    assert app.run(["cite", "--bibtex"]) == 0
    said = capsys.readouterr().out
    keys = re.findall(r"^@\w+\{(\w+),$", said, re.M)
    assert len(keys) == len(set(keys)) == 1 + len(citations.WORKS) and said.count("{") == said.count("}")


@pytest.mark.parametrize(("method", "okabe"), [("elevation", False), ("okabe", True)])
def test_a_report_cites_only_what_its_run_used(tmp_path, capsys, method, okabe):
    (tmp_path / "r.json").write_text(json.dumps({"schema": 1, "infer": {"method": method}}))
    assert app.run(["cite", str(tmp_path / "r.json")]) == 0
    assert ("Okabe" in capsys.readouterr().out) == okabe


@pytest.mark.parametrize(("command", "tan"), [("build", False), ("photo", True)])
def test_only_a_report_of_a_photo_cites_the_paper_on_photos(tmp_path, capsys, command, tan):
    (tmp_path / "r.json").write_text(json.dumps({"schema": 1, "command": command, "infer": {"method": "elevation"}}))
    assert app.run(["cite", str(tmp_path / "r.json")]) == 0
    assert ("Single Image Tree Modeling" in capsys.readouterr().out) == tan


@pytest.mark.parametrize(("method", "used", "unused"), [("traced", "Skeletal Curves", "Space Colonization"), ("grown", "Space Colonization", "Skeletal Curves")])
def test_a_report_of_a_cloud_cites_its_method(method, used, unused):
    works = citations.works_for("cloud", citations.marks_of({"options": {"method": method}}))
    titles = " ".join(work.title for work in works)
    assert "Realistic Procedural Plant Modeling" in titles and used in titles and unused not in titles and "Sketch-Based" not in titles


def test_a_report_of_masks_with_poses_cites_the_visual_hull_and_no_stereo():
    carved = {"options": {"method": "traced", "poses": "p.json"}, "views": {"seconds": {"cameras": 0.1, "carve": 2.0}}}
    titles = " ".join(work.title for work in citations.works_for("views", citations.marks_of(carved)))
    assert "Visual Hull" in titles and "PatchMatch" not in titles and "Structure-from-Motion" not in titles


def test_a_report_of_photos_cites_how_their_cameras_and_depths_were_found():
    found = {"options": {"method": "traced", "poses": None}, "views": {"seconds": dict.fromkeys(("cameras", "patchmatch", "coherence", "filter"), 1.0)}}
    titles = " ".join(work.title for work in citations.works_for("views", citations.marks_of(found)))
    assert all(part in titles for part in ("Structure-from-Motion", "PatchMatch", "Fusion Moves", "Guided")) and "Visual Hull" not in titles


def test_the_credits_name_every_work():
    credits = " ".join((Path(__file__).parents[2] / "docs" / "credits.md").read_text(encoding="utf-8").split())
    assert [work.title for work in citations.WORKS if work.title not in credits] == []


def test_both_packages_that_photos_need_are_looked_for(quick, capsys, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    assert app.run(["doctor"]) == 0
    assert capsys.readouterr().out.count("missing photo: for sketchtree photo. `pip install 'sketchtree[photo]'`") == 2


@pytest.mark.parametrize(("content", "said"), [(None, "can't be read: no such file or directory. Check the path."), ("{", "is no report. Give the file that `--report` wrote."), ("[]", "is no report.")])
def test_what_is_no_report_is_refused(tmp_path, capsys, content, said):
    path = tmp_path / "r.json"
    if content is not None:
        path.write_text(content)
    assert app.run(["cite", str(path)]) == 2
    assert said in capsys.readouterr().err
