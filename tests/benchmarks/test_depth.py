"""The benchmark's table and its command line."""

import json

import numpy as np
import pytest

from benchmarks import cases, depth


@pytest.fixture(scope="module")
def two():
    return cases.quality()[:2]


def test_every_method_has_its_medians_and_its_wins(two):
    result = depth.compare(two, ["flat", "okabe"])
    table = depth.summary(result)
    assert table["okabe"]["elev"] == pytest.approx(np.median([row["elev"] for row in result["okabe"].values()]))
    assert table["flat"]["wins"] == 0.0 and "wins" not in table["okabe"]
    assert "flat" in depth.table(result) and two[0].name in depth.per_case(result)


def test_a_method_that_is_not_installed_is_left_out(two, monkeypatch, capsys):
    def missing(name):
        raise ModuleNotFoundError("gone", name="sketchtree.mrf.gone")

    monkeypatch.setattr(depth, "solver_named", missing)
    assert depth.compare(two, ["flat"]) == {}
    assert "left out" in capsys.readouterr().err


def test_the_command_writes_its_figures(tmp_path, capsys):
    folder = tmp_path / "set"
    folder.mkdir()
    for case in cases.quality()[:1]:
        cases.write_case(case, folder / f"{case.name}.json")
    depth.main(["--cases", str(folder), "--methods", "flat", "--json", str(tmp_path / "r.json")])
    report = json.loads((tmp_path / "r.json").read_text())
    assert set(report["set, exact graph"]["flat"]["median"]) >= {"elev", "hull", "iou", "s"}
    assert "set, exact graph: 1 cases" in capsys.readouterr().out


def test_a_folder_without_cases_is_named(tmp_path):
    with pytest.raises(SystemExit, match="There is no case"):
        depth.main(["--cases", str(tmp_path)])
