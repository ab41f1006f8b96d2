"""The drawings that depth is measured on: honest, fixed, and as a hand would draw them."""

import re

import numpy as np
import pytest

from benchmarks import cases
from benchmarks.drawing import HEIGHT, STRAIGHT, Hand, draw, svg_of
from benchmarks.families import FAMILIES, measured, with_limbs
from benchmarks.reading import matched_depth


@pytest.fixture(scope="module")
def drawn():
    return cases.synthetic(per_family=2)


@pytest.mark.parametrize("family", FAMILIES)
def test_a_family_grows_a_sound_tree(family):
    tree = FAMILIES[family](np.random.default_rng(5))
    assert 0.7 < np.ptp(tree.tip[:, 1]) < 1.5 and tree.order.max() >= 2
    again = FAMILIES[family](np.random.default_rng(5))
    np.testing.assert_array_equal(tree.tip, again.tip)


def test_the_same_seed_gives_the_same_case(drawn):
    again = cases.synthetic(per_family=2)
    assert [c.name for c in drawn] == [c.name for c in again]
    for a, b in zip(drawn, again, strict=True):
        np.testing.assert_array_equal(a.position, b.position)


def test_drawings_have_8_to_60_strokes_of_2_or_3_orders(drawn):
    for case in drawn:
        assert 2 <= len(case.graph.limb_id) <= 60 and case.graph.order.max() <= 2


def test_drawn_lines_lie_near_their_segments(drawn):
    for case in drawn:
        for row in range(1, len(case.graph)):
            line = case.graph.curve(row)
            chord = line[-1] - line[0]
            away = np.abs((line - line[0]) @ [-chord[1], chord[0]]) / max(np.hypot(*chord), 1e-9)
            assert away.max() <= STRAIGHT * HEIGHT + 1e-6


def test_a_steady_hand_draws_the_tree_s_own_projection():
    tip = np.array([[0, 0, 0], [0, 0.5, 0], [0, 1, 0], [0.3, 0.7, 0.2], [0.5, 0.9, 0.5]])
    tree = with_limbs(np.array([-1, 0, 1, 1, 3]), tip, np.ones(5))
    case = draw(tree, Hand(azimuth=0.0, strokes=5, jitter=0.0), name="x", family="x", rng=np.random.default_rng(0))
    shown = {tuple(np.round(p, 6)) for p in case.position}
    assert {tuple(np.round(HEIGHT * p, 6)) for p in tree.tip} >= shown and len(case.graph.limb_id) == 2


def test_turning_the_tree_shows_it_from_its_side():
    tree = with_limbs(np.array([-1, 0, 1, 1]), np.array([[0, 0, 0], [0, 0.5, 0], [0, 1, 0], [0.4, 0.8, 0]]), np.ones(4))
    hand = Hand(azimuth=np.pi / 4, strokes=5, jitter=0.0)
    case = draw(tree, hand, name="x", family="x", rng=np.random.default_rng(0))
    assert abs(case.depth).max() == pytest.approx(0.4 * HEIGHT * np.sqrt(0.5))


def test_the_limb_that_goes_on_is_the_long_and_straight_one():
    tip = np.array([[0, 0, 0], [0, 1, 0], [0.1, 2, 0], [1, 1.1, 0], [0.1, 3, 0]])
    tree = with_limbs(np.array([-1, 0, 1, 1, 2]), tip, np.ones(5))
    assert tree.limb.tolist() == [0, 0, 0, 1, 0] and tree.order.tolist() == [0, 0, 0, 1, 0]


def test_a_case_comes_back_from_its_file(tmp_path, drawn):
    for case in drawn:
        path = tmp_path / f"{case.name}.json"
        cases.write_case(case, path)
        path.with_suffix(".svg").write_text(svg_of(case))
        again = cases.read_case(path)
        np.testing.assert_allclose(again.position, case.position, atol=1e-4)
        np.testing.assert_array_equal(again.graph.parent, case.graph.parent)
        np.testing.assert_array_equal(again.graph.limb, case.graph.limb)
        assert again.family == case.family and len(re.findall("<path", again.svg)) >= len(case.graph.limb_id)


def test_the_shipped_sets_are_as_large_as_the_bars_ask():
    assert len(cases.real(cases.DATA / "measured")) >= 24
    assert len({case.family for case in cases.quality()}) == 9 and len(cases.quality()) >= 15


def test_measured_trees_are_one_high_and_stand_at_the_origin():
    for path in (cases.DATA / "measured").glob("*.npz"):
        tree = measured(path)
        assert np.ptp(tree.tip[:, 1]) == pytest.approx(1) and (tree.tip[0] == 0).all()


def test_a_perfectly_read_drawing_gives_every_depth_back(drawn):
    for case in drawn:
        found, seen = matched_depth(case, case.graph, case.depth)
        assert seen == 1.0 and np.abs(found - case.depth).max() < 0.05 * HEIGHT
        assert np.median(np.abs(found - case.depth)) < 1e-9 * HEIGHT
