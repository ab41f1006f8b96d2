"""--wood and --solid on the command line, and what the report says of them."""

import json
import sys
from pathlib import Path

import pytest

from sketchtree.commands.app import run

PALM = Path(__file__).resolve().parents[2] / "examples" / "palm.svg"


@pytest.mark.parametrize(("asked", "used"), [([], "one-piece"), (["--wood", "tubes"], "tubes"), (["--wood", "one-piece"], "one-piece")])
def test_the_report_says_how_the_wood_was_made(asked, used, tmp_path):
    report = tmp_path / "r.json"
    assert run(["build", str(PALM), "-o", str(tmp_path / "palm.glb"), "--leaf", "none", *asked, "--report", str(report), "--quiet"]) == 0
    assert json.loads(report.read_text())["wood_used"] == used


def test_a_solid_without_its_package_is_refused_before_the_work(tmp_path, capfd, monkeypatch):
    monkeypatch.setitem(sys.modules, "manifold3d", None)
    assert run(["build", str(PALM), "-o", str(tmp_path / "palm.glb"), "--solid", "--quiet"]) == 2
    said = " ".join(capfd.readouterr().err.split())
    assert "A solid needs the package `manifold3d`. Install it with pip install 'sketchtree[solid]', or leave out `--solid`." in said
    assert not (tmp_path / "palm.glb").exists()
