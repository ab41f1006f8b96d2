"""Points of a file are read as somebody says in the dialog: the axis that is up, the unit, or the height of the plant."""

import numpy as np
import pytest
from scanned_stick import points

from sketchtree.studio.making.points_of_file import points_of
from sketchtree.studio.messages import CloudReading
from sketchtree.studio.server import Unread, _reading


def scan(tmp_path, xyz):
    path = tmp_path / "scan.xyz"
    np.savetxt(path, xyz, fmt="%.6f")
    return path


def test_in_the_unit_that_is_said(tmp_path):
    assert points_of(scan(tmp_path, 1000 * points()), CloudReading(up="y", unit=0.001)).height == pytest.approx(6.0, rel=0.02)


@pytest.mark.parametrize("unit", [1.0, 1000.0, 0.0123])
def test_by_the_height_of_the_plant_whatever_the_unit_was(tmp_path, unit):
    assert points_of(scan(tmp_path, unit * points()), CloudReading(up="y", height=2.5)).height == pytest.approx(2.5, rel=0.002)


def test_upright_as_it_is_said(tmp_path):
    lies = scan(tmp_path, points()[:, [2, 0, 1]])  # z up
    assert points_of(lies, CloudReading(up="z")).height == pytest.approx(6.0, rel=0.02)


def test_what_the_command_line_says_by_options_is_said_by_what_the_page_has(tmp_path):
    (remark,) = [one for one in points_of(scan(tmp_path, 100 * points()), CloudReading(up="y")).remarks if "metres" in one]
    assert remark == "The tree would be 599 m high: the cloud is probably not in metres. Open it again with its unit."
    ball = np.random.default_rng(0).normal(size=(3000, 3))
    (remark,) = [one for one in points_of(scan(tmp_path, ball), CloudReading()).remarks if "axis" in one]
    assert remark.endswith("If the tree lies down, open it again and say which.")


def test_an_address_says_it_in_words():
    assert _reading({"name": "scan.ply", "tree": "2", "up": "z", "unit": "0.01", "height": ""}) == CloudReading(tree=2, up="z", unit=0.01)


@pytest.mark.parametrize(
    ("said", "message"),
    [
        ({"unit": "0"}, "The cloud's unit can't be that: expected `float` >= 1e-06. Choose another value."),
        ({"height": "900"}, "The cloud's height can't be that: expected `float` <= 150.0. Choose another value."),
        ({"up": "x"}, "The cloud's up can't be that: invalid enum value 'x'. Choose another value."),
        ({"tree": "0"}, "The cloud's tree can't be that: expected `int` >= 1. Choose another value."),
    ],
)
def test_what_can_not_be_is_named(said, message):
    with pytest.raises(Unread) as caught:
        _reading(said)
    assert str(caught.value) == message
