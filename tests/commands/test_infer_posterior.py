"""`sketchtree infer --samples --posterior --alternatives`: what is written, and that its ids are those of the SWC."""

import json

import jsonschema
import numpy as np
import pytest

from sketchtree.commands.app import run
from sketchtree.mrf.conjugate import theta_names
from sketchtree.report import report_schema
from sketchtree.skeleton_files import read_swc

SKETCH = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 220" fill="none" stroke="black">
<path id="trunk" d="M100 210 C101 170 98 120 101 60"/>
<path id="left" d="M100 150 C80 140 60 130 40 100"/>
<path id="right" d="M100 120 L150 80"/>
<path id="high" d="M100 90 L70 50"/>
<path id="twig" d="M60 126 L45 130"/>
</svg>"""
K = 3


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """One run with everything it can write, in each frame."""
    folder = tmp_path_factory.mktemp("infer")
    (folder / "sketch.svg").write_text(SKETCH)
    for frame in ("sketch", "world"):
        status = run(
            ["infer", str(folder / "sketch.svg"), "-o", str(folder / f"{frame}.swc"), "--frame", frame, "--quiet", "--template", "none",
             "--samples", "700", "--posterior", str(folder / f"{frame}.npz"), "--alternatives", str(K), "--report", str(folder / f"{frame}.json")]
        )  # fmt: skip
        assert status == 0
    return folder


def _samples(folder, frame):
    with np.load(folder / f"{frame}.npz", allow_pickle=False) as file:
        return {name: file[name] for name in file.files}


def _rows(path):
    return np.array([line.split() for line in path.read_text().splitlines() if not line.startswith("#")], float)


def _report(folder, frame="sketch"):
    return json.loads((folder / f"{frame}.json").read_text())


@pytest.mark.parametrize("frame", ["sketch", "world"])
def test_the_samples_are_at_least_as_many_as_asked_for_and_complete(written, frame):
    told = _samples(written, frame)
    n, segments = told["z"].shape
    assert n >= 700
    assert told["theta"].shape == (n, len(theta_names())) and told["parameter"].tolist() == list(theta_names())
    assert told["log_posterior"].shape == told["chain"].shape == (n,)
    assert told["segment_id"].shape == (segments,)
    assert all(np.isfinite(column).all() for name, column in told.items() if name != "parameter")


@pytest.mark.parametrize("frame", ["sketch", "world"])
def test_ids_are_those_of_the_swc(written, frame):
    """The tip of the node of that id moves as the column of z does, in the same units."""
    told, rows = _samples(written, frame), _rows(written / f"{frame}.swc")
    place = {int(row[0]): row for row in rows}
    z = told["z"] * np.where(told["z"] @ [place[i][4] for i in told["segment_id"]] < 0, -1.0, 1.0)[:, None]
    shown = np.array([place[i][4] for i in told["segment_id"]])
    low, high = z.min(axis=0), z.max(axis=0)
    assert ((low - 1e-6 <= shown) & (shown <= high + 1e-6)).mean() > 0.8
    deep = np.abs(shown) > 0.3 * np.abs(shown).max()
    assert np.corrcoef(np.median(np.abs(z), axis=0)[deep], np.abs(shown)[deep])[0, 1] > 0.7
    assert (told["z"][:, shown == 0] == 0).any()  # the base
    forks_and_ends = {int(row[0]) for row in rows if row[1] in (5, 6)}
    assert forks_and_ends <= set(told["segment_id"].tolist())


def test_depths_of_both_frames_differ_by_the_scale_alone(written):
    scale = _report(written, "world")["transform"]["scale"]
    one, other = _samples(written, "sketch"), _samples(written, "world")
    np.testing.assert_allclose(one["z"] * scale, other["z"], atol=1e-9)
    np.testing.assert_array_equal(one["theta"], other["theta"])
    np.testing.assert_array_equal(one["segment_id"], other["segment_id"])


@pytest.mark.parametrize("frame", ["sketch", "world"])
def test_other_readings_differ_in_depth_and_in_nothing_else(written, frame):
    answer = _rows(written / f"{frame}.swc")
    count = len(_report(written, frame)["infer"]["alternatives"])
    assert 2 <= count <= K
    for k in range(2, count + 1):
        other = _rows(written / f"{frame}.{k}.swc")
        np.testing.assert_array_equal(other[:, [0, 1, 2, 3, 6]], answer[:, [0, 1, 2, 3, 6]])
        nodes = np.isin(answer[:, 1], [5, 6])
        np.testing.assert_array_equal(other[nodes, 5], answer[nodes, 5])
        np.testing.assert_allclose(other[:, 5], answer[:, 5], rtol=0.01)  # between nodes they follow the length in space
        assert np.abs(other[:, 4] - answer[:, 4]).max() > 0.02 * np.ptp(answer[:, 3])
        assert read_swc(written / f"{frame}.{k}.swc").segment_count == read_swc(written / f"{frame}.swc").segment_count
    assert not (written / f"{frame}.{count + 1}.swc").exists()
    assert not (written / f"{frame}.1.swc").exists()


@pytest.mark.parametrize("frame", ["sketch", "world"])
def test_the_report_tells_intervals_readings_and_diagnostics(written, frame):
    report = _report(written, frame)
    jsonschema.validate(report, report_schema())
    told = report["infer"]
    assert told["rhat"] >= 0.9 and told["ess"] > 1
    assert sum(reading["odds"] for reading in told["alternatives"]) == pytest.approx(1.0)
    assert told["alternatives"][0]["log_posterior"] == told["log_posterior"]
    ids = _samples(written, frame)["segment_id"].tolist()
    for interval in told["intervals"]:
        assert set(interval) == {"id", "q05", "q50", "q95", "same_side_odds"}
        assert 0 <= interval["q05"] <= interval["q50"] <= interval["q95"] <= 1
        assert 0 <= interval["same_side_odds"] <= 1
        assert interval["id"] in ids
    assert len(told["intervals"]) == len(ids) - 1  # no base
    assert report["options"]["samples"] == 700 and report["options"]["alternatives"] == K


def test_the_samples_asked_for_do_not_change_with_what_is_written(written, tmp_path):
    """--posterior only writes: the same tree without it."""
    arguments = ["--frame", "sketch", "--quiet", "--template", "none", "--samples", "700"]
    assert run(["infer", str(written / "sketch.svg"), "-o", str(tmp_path / "t.swc"), *arguments]) == 0
    assert (tmp_path / "t.swc").read_bytes() == (written / "sketch.swc").read_bytes()
    assert [path.name for path in tmp_path.iterdir()] == ["t.swc"]


def _refused(folder, capfd, *arguments):
    """What is said on stderr by a run that is refused: one paragraph, and nothing is written."""
    (folder / "sketch.svg").write_text(SKETCH)
    before = (folder / "sketch.svg").read_bytes()
    assert run(["infer", str(folder / "sketch.svg"), "-o", str(folder / "t.swc"), "--quiet", "--template", "none", *arguments]) == 2
    assert [path.name for path in folder.iterdir()] == ["sketch.svg"]
    assert (folder / "sketch.svg").read_bytes() == before
    out, err = capfd.readouterr()
    assert out == "" and err.startswith("sketchtree: ") and err.count("\n") == 1
    return err.removeprefix("sketchtree: ").rstrip("\n")


@pytest.mark.parametrize("method", ["okabe", "chen", "flat"])
def test_a_method_without_a_posterior_can_t_be_sampled(tmp_path, capfd, method):
    said = _refused(tmp_path, capfd, "--method", method, "--samples", "10")
    assert said == f"The method `{method}` has no posterior to sample. Use the method `elevation`, or leave the samples out."


def test_a_method_without_a_posterior_has_none_to_write(tmp_path, capfd):
    path = tmp_path / "p.npz"
    said = _refused(tmp_path, capfd, "--method", "okabe", "--posterior", str(path))
    assert said == f"`--posterior {path}`: the method `okabe` has no posterior. Use the method `elevation`, or leave the option out."


def test_another_ending_is_refused(tmp_path, capfd):
    said = _refused(tmp_path, capfd, "--posterior", str(tmp_path / "p.csv"))
    assert "writes .npz here" in said and "\n" not in said


def test_the_sketch_is_never_overwritten(tmp_path, capfd):
    (tmp_path / "sketch.npz").write_text(SKETCH)
    arguments = ["infer", str(tmp_path / "sketch.npz"), "-o", str(tmp_path / "t.swc"), "--posterior", str(tmp_path / "sketch.npz")]
    assert run(arguments) == 2
    said = capfd.readouterr().err
    assert said == f"sketchtree: `--posterior {tmp_path / 'sketch.npz'}` would overwrite the sketch itself. Give it another name.\n"
    assert [path.name for path in tmp_path.iterdir()] == ["sketch.npz"]


def test_two_outputs_of_one_name_are_refused(tmp_path, capfd):
    said = _refused(tmp_path, capfd, "--alternatives", "2", "--report", str(tmp_path / "t.2.swc"))
    assert said == f"`--alternatives {tmp_path / 't.2.swc'}` would overwrite what `--report` writes. Give it another name."


def test_a_folder_that_does_not_exist_is_named_before_the_work(tmp_path, capfd):
    path = tmp_path / "nowhere" / "p.npz"
    said = _refused(tmp_path, capfd, "--posterior", str(path))
    assert said == f"Can't write {path}: the folder {path.parent} does not exist. Create it, or choose another path."


def test_a_lone_stroke_has_nothing_to_sample(tmp_path, capfd):
    (tmp_path / "line.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 99"><path d="M4 90L5 10" fill="none" stroke="black"/></svg>')
    path = tmp_path / "p.npz"
    assert run(["infer", str(tmp_path / "line.svg"), "-o", str(tmp_path / "t.swc"), "--quiet", "--template", "none", "--posterior", str(path)]) == 2
    assert "there is nothing to sample in this drawing" in capfd.readouterr().err
    assert [found.name for found in tmp_path.iterdir()] == ["line.svg"]


@pytest.mark.parametrize("option, most", [("--samples", 1_000_000), ("--alternatives", 64)])
def test_counts_out_of_range_are_refused(tmp_path, capfd, option, most):
    (tmp_path / "sketch.svg").write_text(SKETCH)
    for count in (-1, most + 1):
        assert run(["infer", str(tmp_path / "sketch.svg"), "-o", str(tmp_path / "t.swc"), option, str(count)]) == 2
        assert f"{count} is not in the range 0<=x<={most}" in capfd.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["sketch.svg"]
