import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.propagate.worlds import circle

from sketchtree.propagate.attractors.revolved import Axes
from sketchtree.propagate.attractors.target import Target

TARGET = Target.of_outlines([circle(1.0, 5, 2)], pixels=200)
TRUNK = np.array([[0.0, 0, 0.5], [0.0, 8, 0.5]])


@settings(max_examples=40, deadline=None)
@given(st.tuples(*(st.floats(-3, 3) for _ in range(3))))
def test_eq_joints_turn_by_90_degrees_about_the_trunk_and_four_turns_come_back(offset):
    point = np.array([[offset[0], 4 + offset[1], 0.5 + offset[2]]])
    axes = Axes.about_trunk(TARGET, TRUNK)
    turned = axes.turned(point)
    assert turned[0] == pytest.approx([-offset[2], point[0, 1], 0.5 + offset[0]], abs=1e-9)
    back = axes.turned(axes.turned(axes.turned(turned)))
    assert back[0] == pytest.approx(point[0], abs=1e-9)


def test_a_leaning_trunk_is_an_axis_that_leans():
    axes = Axes.about_trunk(TARGET, np.array([[0.0, 0, 0], [4.0, 8, 2.0]]))
    x, y, z = axes.turned(np.array([[3.0, 4.0, 1.0]]))[0]
    assert (x, y, z) == pytest.approx((2.0, 4.0, 2.0), abs=0.02)


def test_about_the_crown_the_axis_is_the_middle_of_the_foliage():
    axes = Axes.about_crown(TARGET, TRUNK)
    turned = axes.turned(np.array([[2.5, 5.0, 0.5], [1.0, 5.0, 0.5]]))
    assert turned == pytest.approx(np.array([[1.0, 5.0, 2.0], [1.0, 5.0, 0.5]]), abs=0.05)


def test_every_lobe_has_an_axis_of_its_own():
    axes = Axes.about_crown(Target.of_outlines([circle(-3, 5, 1.2), circle(3, 5, 1.2)], pixels=300), TRUNK)
    turned = axes.turned(np.array([[-3.8, 5, 0.5], [3.8, 5, 0.5]]))
    assert turned[:, 0] == pytest.approx([-3, 3], abs=0.06) and turned[:, 2] == pytest.approx([-0.3, 1.3], abs=0.06)


def test_foliage_revolved_is_as_deep_as_wide():
    out = Axes.about_crown(TARGET, TRUNK).out(np.array([[1.0, 5, 0.5], [1.0, 5, 2.3], [2.8, 5, 0.5], [1.0, 5, 2.8], [1.0, 7.5, 0.5]]))
    assert out[0] == pytest.approx(0, abs=0.05) and out[1] == pytest.approx(out[2], abs=0.05) and out[1] < 1 < out[3] and np.isinf(out[4])
