import dataclasses

import numpy as np
from scipy.spatial import cKDTree
from tests.propagate.worlds import HABIT, THETA, circle, drawn_tree

from sketchtree import keys
from sketchtree.propagate.drawn.implied import implied_crown
from sketchtree.propagate.space.envelope import Envelope
from sketchtree.propagate.fill import GAP, HOLLOW, HOLLOW_GAP, emptiness, empty_points, halton
from sketchtree.propagate.generations import propagate

KEY = keys.root_key(0)
CROWN = (circle(points=120, radius=4.5),)


def test_empty_points_lie_inside_and_away_from_every_tip():
    envelope, tips = Envelope.from_outlines(CROWN), drawn_tree(6).tip
    points = empty_points(envelope, tips, 1.0)
    assert len(points) > 50 and envelope.inside(points).all()
    assert cKDTree(tips).query(points)[0].min() >= 1.0


def test_where_the_tree_is_everywhere_nothing_is_empty():
    envelope = Envelope.from_outlines(CROWN)
    grid = np.stack(np.meshgrid(*[np.arange(-6, 12, 0.5)] * 3), axis=-1).reshape(-1, 3)
    assert len(empty_points(envelope, grid, 1.0)) == 0


def test_filling_leaves_less_of_the_crown_empty():
    tree, envelope = drawn_tree(3), Envelope.from_outlines(CROWN)
    plain, filled = (propagate(tree, HABIT, THETA, crown=CROWN, fill=fill, key=KEY) for fill in (False, True))
    gap = GAP * HABIT.lateral_spacing * tree.height / HABIT.height
    left = [len(empty_points(envelope, result.skeleton.tip, gap)) for result in (plain, filled)]
    assert left[1] < 0.75 * left[0]


def test_what_fills_keeps_the_rules():
    result = propagate(drawn_tree(3), HABIT, THETA, crown=CROWN, fill=True, key=KEY)
    tree, new = result.skeleton, result.generation > 0
    assert Envelope.from_outlines(CROWN).lobes[0].margin(tree.tip[new]).min() >= -1e-6
    assert tree.order.max() <= HABIT.max_order and result.generations_done <= 12
    starts = (tree.parent >= 0) & (tree.limb != tree.limb[np.maximum(tree.parent, 0)])
    assert len(np.unique(tree.limb[starts])) == starts.sum()


def test_filling_keeps_to_the_limit_of_segments():
    fine = dataclasses.replace(HABIT, lateral_spacing=0.15)
    result = propagate(drawn_tree(3), fine, THETA, crown=CROWN, fill=True, max_segments=2000, key=KEY)
    assert result.skeleton.segment_count <= 2000


def test_filling_the_same_crown_twice_grows_the_same_tree():
    one, two = (propagate(drawn_tree(3), HABIT, THETA, crown=CROWN, fill=True, key=KEY).skeleton for _ in range(2))
    np.testing.assert_array_equal(one.tip, two.tip)


def test_halton_mirrors_the_digits_of_the_counter():
    np.testing.assert_allclose(halton(4), [[0, 0, 0], [1 / 2, 1 / 3, 1 / 5], [1 / 4, 2 / 3, 2 / 5], [3 / 4, 1 / 9, 3 / 5]])


def test_a_drawing_of_few_limbs_without_a_crown_is_not_left_hollow():
    tree = drawn_tree(3)
    result = propagate(tree, HABIT, THETA, key=KEY)
    scaled = HOLLOW_GAP * HABIT.lateral_spacing * tree.height / HABIT.height
    crown = implied_crown(tree, HABIT)
    assert emptiness(crown, tree.tip, scaled) > HOLLOW
    assert emptiness(crown, result.skeleton.tip, scaled) < HOLLOW
