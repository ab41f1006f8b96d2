"""No later version may find depths worse than the record: a fixed set of drawings, every method.

The record is benchmarks/data/depth_record.json: medians over benchmarks/data/quality, averaged over three seeds, written by
`python -m benchmarks.depth --set quality --record` when a change is meant.
"""

import json

import pytest

from benchmarks import cases, depth, metrics

SLACK = {"elev": 0.012, "hull": 0.04, "iou": 0.04, "depth": 0.06, "w_div": 1.0}
CHAOTIC = {"chen": 3.0, "chen-fixed": 3.0}  # many local optima: the last bits of an exp may choose another
METHODS = ("flat", "random-sign", "okabe", "chen", "elevation")


@pytest.fixture(scope="module")
def medians():
    return depth.over_seeds(cases.quality(), list(METHODS))


@pytest.mark.parametrize("method", METHODS)
def test_no_figure_is_worse_than_its_record(medians, method):
    record = json.loads(depth.RECORD.read_text())[method]
    worse = []
    for name, slack in SLACK.items():
        sign = 1 if metrics.LOWER_IS_BETTER[name] else -1
        if sign * (medians[method][name] - record[name]) > slack * CHAOTIC.get(method, 1.0):
            worse.append(f"{name}: {medians[method][name]:.3f}, record {record[name]:.3f}")
    assert not worse, f"{method} is worse than its record: " + "; ".join(worse)


def test_elevation_is_nearer_the_truth_than_okabe_and_okabe_than_chen(medians):
    elev = {method: medians[method]["elev"] for method in METHODS}
    assert elev["elevation"] < elev["okabe"] - 0.01 < elev["chen"] - 0.02, elev


def test_elevation_beats_okabe_on_three_trees_of_four(medians):
    assert medians["elevation"]["wins"] >= 0.75


def test_elevation_s_crown_is_no_worse_than_okabe_s(medians):
    assert medians["elevation"]["hull"] >= medians["okabe"]["hull"] - 0.02


def test_no_limb_of_elevation_passes_through_another(medians):
    assert medians["elevation"]["overlaps"] == 0  # the median, at every seed
