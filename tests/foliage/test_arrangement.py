import numpy as np
import pytest

from sketchtree.errors import OptionError
from sketchtree.foliage.arrangement import ARRANGEMENTS, FROND_RISE, azimuths, leaves_per_node


def degrees(arrangement, nodes=6, **options):
    return np.degrees(azimuths(arrangement, np.arange(nodes), **options))


def test_alternate_turns_by_180_degrees():
    assert np.allclose(degrees("alternate")[:, 0], [0, 180, 0, 180, 0, 180])


def test_opposite_pairs_face_each_other_in_two_ranks():
    assert np.allclose(degrees("opposite"), [[0, 180]] * 6)


def test_decussate_pairs_cross_at_90_degrees():
    pairs = degrees("decussate", 3)
    assert np.allclose(pairs, [[0, 180], [90, 270], [180, 0]])


def test_whorls_are_even_and_stand_in_each_others_gaps():
    whorls = degrees("whorled", 2, whorl=3)
    assert np.allclose(whorls, [[0, 120, 240], [60, 180, 300]])


@pytest.mark.parametrize("arrangement", ["spiral", "fascicled"])
def test_a_spiral_turns_by_the_golden_angle(arrangement):
    assert np.allclose(degrees(arrangement)[:, 0], (137.5 * np.arange(6)) % 360)


def test_a_spiral_takes_the_habits_own_angle():
    assert np.allclose(degrees("spiral", phyllotaxis=144.0)[:, 0], (144.0 * np.arange(6)) % 360)


def test_a_frond_has_two_rows_that_make_a_v():
    assert np.allclose(degrees("frond"), [[FROND_RISE, 180 - FROND_RISE]] * 6)


@pytest.mark.parametrize("arrangement", ARRANGEMENTS)
def test_leaves_per_node_is_the_width_of_the_azimuths(arrangement):
    assert degrees(arrangement).shape == (6, leaves_per_node(arrangement))


def test_an_unknown_arrangement_is_refused_with_the_list():
    with pytest.raises(OptionError) as caught:
        leaves_per_node("random")
    assert str(caught.value) == (
        "There is no leaf arrangement called 'random'. "
        "Choose one of: opposite, decussate, alternate, whorled, spiral, fascicled, frond."
    )
