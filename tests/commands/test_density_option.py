"""`sketchtree build --density TIMES`."""

import json
from pathlib import Path

import pytest

from sketchtree.commands.app import run

POPLAR = Path(__file__).resolve().parents[2] / "examples" / "poplar.svg"


def segments(folder, density):
    report = folder / "report.json"
    arguments = ["--density", density, "--leaf", "none", "--report", str(report), "--quiet"]
    assert run(["build", str(POPLAR), "-o", str(folder / "tree.swc"), *arguments]) == 0
    found = json.loads(report.read_text())
    assert found["options"]["density"] == float(density)
    return found["segments"]["total"]


def test_a_denser_tree_has_more_segments(tmp_path):
    sparse, usual, dense = (segments(tmp_path, density) for density in ("0.3", "1", "2"))
    assert 1.3 * sparse < usual < dense / 1.3


@pytest.mark.parametrize("density", ["0", "-1", "11", "nan"])
def test_a_density_out_of_range_is_named_and_nothing_is_written(tmp_path, capsys, density):
    assert run(["build", str(POPLAR), "-o", str(tmp_path / "tree.swc"), "--density", density]) == 2
    said = capsys.readouterr().err
    assert f"`--density {float(density):g}` is out of range." in said and "Give 0.01 to 10" in said
    assert list(tmp_path.iterdir()) == []
