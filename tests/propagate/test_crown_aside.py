"""Crowns that hold little or nothing of the drawing say so."""

import numpy as np
from tests.propagate.worlds import HABIT, THETA, circle, drawn_tree

from sketchtree import keys
from sketchtree.propagate.generations import propagate

KEY = keys.root_key(0)


def warnings(outline):
    return propagate(drawn_tree(5), HABIT, THETA, crown=(outline,), key=KEY).warnings


def test_a_crown_beside_all_tips_is_told():
    (said,) = warnings(circle(x=0.0, y=3.8, radius=1.0))
    assert said == (
        "None of the 5 drawn limbs ends inside the crown, so none of them bears anything new. "
        "Draw the crown around their tips, or use --crown off."
    )


def test_a_crown_around_some_tips_is_not():
    assert warnings(circle()) == ()


def test_a_crown_that_leaves_the_root_outside_holds_what_grows():
    tree = drawn_tree(5)
    grown = propagate(tree, HABIT, THETA, crown=(circle(y=6.0, radius=3.5),), key=KEY)
    assert grown.warnings == () and len(grown.skeleton) > 2 * len(tree)


def test_a_crown_that_crosses_itself_holds_what_grows():
    bow = np.array([[-4.0, 2.0], [4.0, 9.0], [4.0, 2.0], [-4.0, 9.0]])
    grown = propagate(drawn_tree(5), HABIT, THETA, crown=(bow,), key=KEY)
    new = grown.skeleton.tip[grown.generation > 0]
    assert len(new) > 100 and (np.abs(new[:, 0]) <= 4.0 + 1e-6).all()


def test_limbs_that_only_their_depth_takes_out_of_the_crown_are_told_otherwise():
    tree = drawn_tree(5)
    deep = tree.replace(tip=tree.tip * [0.3, 1.0, 1.0] + np.where((tree.order > 0)[:, None], [0.0, 0.0, 6.0], 0.0))
    (said,) = propagate(deep, HABIT, THETA, crown=(circle(radius=2.5),), key=KEY).warnings
    assert said == (
        "None of the 5 drawn limbs ends inside the crown: their tips lie nearer or farther than it is deep there, so they bear little. "
        "Draw the crown wider around them, or use --crown off."
    )
