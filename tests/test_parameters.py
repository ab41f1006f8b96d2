import dataclasses

import numpy as np
import pytest

from sketchtree.parameters import GENERIC, TreeParameters

THETA = TreeParameters(0.7, 0.1, 0.2, 0.05, 0.9, 0.2, 0.4, 0.3)


def test_chen_4_case_1_an_only_child_is_apical():
    assert THETA.child(1, 1) == (0.2, 0.05, 0.4, 0.3)


def test_chen_4_case_2_the_lateral_of_two_is_turned_by_pi():
    assert THETA.child(1, 2) == (0.2, 0.05, 0.4, 0.3)
    assert THETA.child(2, 2) == (0.9, 0.2, 0.4 + np.pi, 0.3)


@pytest.mark.parametrize("count", [3, 4, 7])
def test_chen_4_case_3_laterals_stand_evenly_round_their_parent(count):
    orientation = [THETA.child(label, count)[2] for label in range(2, count + 1)]
    np.testing.assert_allclose(np.diff(orientation), 2 * np.pi / (count - 1))
    assert orientation[0] == pytest.approx(0.4 + 2 * np.pi / (count - 1))


def test_labels_run_from_1_to_the_number_of_children():
    with pytest.raises(ValueError, match="labels run from 1"):
        THETA.child(3, 2)


def test_degrees_leave_the_scale_alone():
    degrees = THETA.as_dict(degrees=True)
    assert degrees["mu_s"] == 0.7 and degrees["sigma_s"] == 0.1
    assert degrees["mu_beta"] == pytest.approx(np.degrees(0.9))
    assert set(degrees) == {field.name for field in dataclasses.fields(GENERIC)}
