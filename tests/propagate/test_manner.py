import numpy as np
from tests.propagate.worlds import HABIT, THETA, drawn_tree

from sketchtree import keys
from sketchtree.propagate.blocks.attach_block import Nodes
from sketchtree.propagate.manner import Manner
from sketchtree.propagate.wanted import Wanted

KEY = keys.draw_key(keys.root_key(0))
TREE = drawn_tree(9)


def manner(**wanted):
    return Manner.of(TREE, Wanted(HABIT, THETA, **wanted))


def nodes(limbs=200, each=10, order=1, whole=4.0):
    count = limbs * each
    position = np.tile(np.arange(1, each + 1) / each, limbs)
    return Nodes(
        row=np.arange(count), tip=np.zeros((count, 3)), frame=np.tile(np.eye(3), (count, 1, 1)), limb=np.repeat(np.arange(limbs) + 7, each),
        order=np.full(count, order), tree=np.zeros(count, int), number=np.tile(np.arange(each), limbs), position=position, zone=position,
        whole=np.full(count, whole), radius=np.full(count, 0.1),
    )  # fmt: skip


def bearing(opened):
    return np.unique(opened.row)


def test_half_the_density_is_half_of_the_nodes():
    at = nodes()
    everywhere, half = (bearing(manner(density=density).laterals(at, np.zeros(len(at), bool), KEY)) for density in (1.0, 0.5))
    assert abs(len(half) / len(everywhere) - 0.5) < 0.02


def test_what_bears_at_a_lower_density_bears_at_a_higher_one():
    at = nodes()
    few, some, many = (set(bearing(manner(density=density).laterals(at, np.zeros(len(at), bool), KEY))) for density in (0.2, 0.5, 0.9))
    assert few < some < many


def test_a_sparse_limb_bears_evenly_spread():
    at = nodes(limbs=300, each=20)
    rows = bearing(manner(density=0.25).laterals(at, np.zeros(len(at), bool), KEY))
    for_limb = np.bincount(at.limb[rows] - 7, minlength=300)
    assert for_limb.min() >= 3 and for_limb.max() <= 7


def test_a_higher_density_brings_nodes_closer():
    order, whole = np.array([1, 2]), np.array([3.0, 2.0])
    np.testing.assert_allclose(2.0 * manner(density=2.0).spacing(order, whole), manner().spacing(order, whole))


def test_of_a_thorough_drawing_trunks_bear_nothing_more_and_no_limb_at_its_last_node():
    thorough = manner(thorough=1.0)
    trunk, limb = nodes(order=0), nodes()
    assert len(thorough.laterals(trunk, np.zeros(len(trunk), bool), KEY)) == 0
    assert (limb.position[bearing(thorough.laterals(limb, np.zeros(len(limb), bool), KEY))] < 1.0).all()


def test_of_a_thorough_drawing_short_drawn_limbs_bear_less_a_metre():
    thorough = manner(thorough=1.0)
    shares = [thorough.share(at, np.ones(len(at), bool)).mean() for at in (nodes(whole=1.0), nodes(whole=3.0))]
    assert shares[0] < 0.3 * shares[1]


def test_a_held_theta_makes_nothing_more_like_the_drawing():
    held = manner(fixed=True)
    assert held.thorough == 0.0
