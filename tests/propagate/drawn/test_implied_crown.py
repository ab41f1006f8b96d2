"""The crown of a tree whose crown nobody drew has the template's shape and the drawing's size."""

import numpy as np
import pytest

from sketchtree.propagate.space.envelope import Lobe
from sketchtree.propagate.drawn.implied import LEVELS, NARROWEST, TEMPLATES_SHARE, crown_profile, implied_crown, shaped
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.store.database import Database
from tests.propagate.drawn.test_ends import HABIT, drawn_tree


def _whorls(reach):
    """A trunk with a ring of eight limbs every metre, `reach(u)` long at the share u of the height."""
    parent, tip, order, limb = [-1], [[0.0, 0.0, 0.0]], [0], [0]
    for k in range(1, 11):
        parent.append(0 if k == 1 else spine)  # noqa: F821
        tip.append([0.0, float(k), 0.0])
        order.append(0)
        limb.append(0)
        spine = len(parent) - 1
        for turn in np.arange(8) * np.pi / 4:
            parent.append(spine)
            size = reach(k / 10)
            tip.append([size * np.cos(turn), float(k), size * np.sin(turn)])
            order.append(1)
            limb.append(len(parent))
    return TreeSkeleton.from_columns(np.array(parent), np.array(tip), np.full(len(parent), 0.01), order=np.array(order), limb=np.array(limb))


def test_the_profile_of_a_cone_falls_and_of_a_column_does_not():
    cone = crown_profile(_whorls(lambda u: 3.0 * (1.02 - u)))
    assert len(cone) == LEVELS and cone.max() == 1.0
    assert (np.diff(cone) <= 1e-9).all() and cone[-1] < 0.15
    column = crown_profile(_whorls(lambda u: 2.0))
    np.testing.assert_allclose(column, 1.0, atol=1e-6)


def test_size_and_place_of_the_exemplar_do_not_matter():
    tree = _whorls(lambda u: 1.0 + u)
    larger = tree.replace(tip=7.0 * tree.tip)
    np.testing.assert_allclose(crown_profile(larger), crown_profile(tree), atol=1e-6)


def test_a_tree_without_limbs_has_no_profile():
    assert crown_profile(drawn_tree(0)) is None


@pytest.mark.parametrize("profile", [np.linspace(1.0, 0.05, LEVELS), np.ones(LEVELS), np.linspace(0.1, 1.0, LEVELS)])
def test_the_shaped_outline_is_halfway_between_drawing_and_template(profile):
    turn = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    lobe = Lobe.from_outline(np.column_stack([2.0 * np.cos(turn), 5.0 + 3.0 * np.sin(turn)]))
    outline = np.column_stack([2.0 * np.cos(turn), 5.0 + 3.0 * np.sin(turn)])
    new = Lobe.from_outline(shaped(outline, profile))
    y = lobe.height[0] + (lobe.height[-1] - lobe.height[0]) * (np.arange(LEVELS) + 0.5) / LEVELS
    own = lobe.half_width_at(y)
    expected = (1 - TEMPLATES_SHARE) * own + TEMPLATES_SHARE * profile * own.mean() / profile.mean()
    expected = np.maximum(expected, NARROWEST * own)
    np.testing.assert_allclose((np.diff(np.array(new.edges_at(y)), axis=0)[0]) / 2, expected, rtol=1e-6)
    assert new.height[0] == lobe.height[0] and new.height[-1] == lobe.height[-1]


def test_a_lopsided_drawing_stays_lopsided():
    outline = np.array([[-1.0, 0.0], [4.0, 0.0], [4.0, 6.0], [-1.0, 6.0]])
    left, right = Lobe.from_outline(shaped(outline, np.ones(LEVELS))).edges_at(np.array([3.0]))
    assert left[0] == pytest.approx(-1.0, abs=0.05) and right[0] == pytest.approx(4.0, abs=0.05)


def test_the_same_strokes_have_another_crown_under_another_template():
    tree, templates = drawn_tree(8), Database.open()
    width = {}
    for name in ("norway_spruce", "stone_pine"):
        (lobe,) = implied_crown(tree, HABIT, templates.exemplar(name).skeleton).lobes
        low, high = lobe.height[0], lobe.height[-1]
        ends = lobe.edges_at(low + (high - low) * np.array([0.2, 0.85]))
        width[name] = ends[1] - ends[0]
    ratio = {name: above / below for name, (below, above) in width.items()}
    assert ratio["norway_spruce"] < 0.8 * ratio["stone_pine"]
