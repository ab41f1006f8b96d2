import numpy as np
import pytest

from sketchtree.errors import OptionError
from sketchtree.foliage.arrangement import ARRANGEMENTS
from sketchtree.foliage.models import leaf_model, leaf_names
from sketchtree.foliage.seasons import SEASONS, Palette, check_season, linear


LEAVES = (
    "oak", "beech", "maple", "birch", "willow", "poplar", "apple", "hazel", "lime", "elm", "alder", "hornbeam", "cherry", "hawthorn", "plane", "lilac",
    "cercis", "olive", "horse_chestnut", "ash", "elder", "sumac", "rowan", "acacia", "spruce", "pine", "stone_pine", "white_pine", "larch", "cedar", "fir", "juniper",
    "cypress", "palm", "fan_palm", "dragon_tree",
)  # fmt: skip
BLOSSOMS = (
    "apple_blossom", "cherry_blossom", "hawthorn_blossom", "elder_blossom", "chestnut_candle", "lilac_panicle", "cercis_blossom", "hazel_catkin", "birch_catkin",
    "alder_catkin", "willow_catkin",
)  # fmt: skip


def test_there_are_thirty_six_leaves_and_eleven_blossoms():
    assert leaf_names() == LEAVES + BLOSSOMS
    assert [name for name in leaf_names() if leaf_model(name).flower] == list(BLOSSOMS)


def test_every_blossom_is_borne_by_one_leaf_model():
    borne = [leaf_model(name).blossom for name in LEAVES if leaf_model(name).blossom]
    assert sorted(borne) == sorted(BLOSSOMS)


def test_an_unknown_model_is_refused_with_the_list():
    with pytest.raises(OptionError) as caught:
        leaf_model("gingko")
    assert str(caught.value) == f"There is no leaf model called 'gingko'. Choose one of: {', '.join(LEAVES + BLOSSOMS)}."


def test_an_unknown_season_is_refused_with_the_list():
    with pytest.raises(OptionError) as caught:
        check_season("monsoon")
    assert str(caught.value) == "There is no season called 'monsoon'. Choose one of: spring, summer, autumn, bare."


@pytest.mark.parametrize("name", leaf_names())
def test_every_model_knows_every_leafy_season_and_sits_somehow(name):
    model = leaf_model(name)
    assert set(model.palettes) == set(SEASONS) - {"bare"}
    assert model.arrangement in ARRANGEMENTS
    assert 0.005 < model.size < 1.0 and 0.002 < model.spacing < 0.2


def test_evergreens_keep_their_green_in_autumn_and_others_do_not():
    for name in leaf_names():
        red, green, _ = linear(leaf_model(name).palettes["autumn"].blade_to)
        assert (green > red) == leaf_model(name).evergreen, name


def test_the_tint_factor_is_at_most_one_and_reaches_both_ends():
    palette = Palette("#204010", "#a08020", "#ffffff", "#000000")
    factor = palette.factor(np.array([0.0, 0.5, 1.0]))
    assert (factor <= 1 + 1e-12).all()
    assert np.allclose(factor[0] * palette.texture_blade, linear("#204010"))
    assert np.allclose(factor[2] * palette.texture_blade, linear("#a08020"))
