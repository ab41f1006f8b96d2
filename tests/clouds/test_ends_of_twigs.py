"""Twigs that are thinner than a pixel go on beyond what photos show of them."""

import numpy as np
import pytest

from sketchtree.axes import NULL
from sketchtree.clouds.growing.ends import gone_on
from sketchtree.errors import OptionError
from sketchtree.cloud_tree import CloudOptions
from sketchtree.skeleton import Kind, TreeSkeleton

GAMMA = 0.5


def forked(end: float = 0.002) -> TreeSkeleton:
    """A trunk of two metres, 0.1 m thick at its foot, with two limbs of one metre that lean to either side."""
    tip = [[0, 0, 0], [0, 1, 0], [0, 2, 0], [0.8, 2.6, 0], [-0.8, 2.6, 0]]
    return TreeSkeleton.from_columns([NULL, 0, 1, 2, 2], tip, [0.1, 0.08, 0.05, end, end], limb=[0, 0, 0, 0, 1], order=[0, 0, 0, 0, 1])


def test_eq5_says_how_much_wood_is_borne_by_what_just_shows():
    tree = gone_on(forked(), 0.01, GAMMA)
    more, whole = tree.length[5:], tree.length.sum()
    assert more == pytest.approx([whole * (0.01 / 0.1) ** (1 / GAMMA)] * 2)  # l = l_root (r / r_root)^(1/γ), l_root with what was added


def test_a_limb_goes_on_the_way_it_went_and_tapers():
    tree = gone_on(forked(), 0.01, GAMMA)
    assert tree.parent[5:].tolist() == [3, 4] and tree.limb[5:].tolist() == [0, 1]
    assert tree.vector[5] / tree.length[5] == pytest.approx([0.8, 0.6, 0])
    assert (tree.radius[5:] < 0.005).all() and (tree.radius[:5] >= 0.01).all()


def test_what_was_not_seen_is_not_called_observed():
    assert (gone_on(forked(), 0.01, GAMMA).kind[5:] == int(Kind.GROWN)).all()


def test_a_stump_ends_where_it_ends():
    assert len(gone_on(forked(end=0.05), 0.01, GAMMA)) == 5


def test_a_limb_goes_on_no_farther_than_it_was_seen_and_a_spur_not_at_all():
    spur = forked().append({"parent": np.array([1]), "tip": np.array([[0.02, 1, 0]]), "radius": np.array([0.002]), "limb": np.array([2]), "order": np.array([1])})
    assert gone_on(spur, 0.02, GAMMA).parent[6:].tolist() == [3, 4]
    assert gone_on(forked(), 0.06, 0.9).length[6] == pytest.approx(1.0)


def test_many_ends_never_outgrow_the_tree():
    tree = forked()
    fan = np.array([[np.cos(turn), 3.0, np.sin(turn)] for turn in np.linspace(0, 6, 400)])
    many = tree.append({"parent": np.full(400, 2), "tip": fan, "radius": np.full(400, 0.002), "limb": np.arange(10, 410)})
    grown = gone_on(many, 0.03, GAMMA)
    assert grown.length.sum() <= 2.01 * many.length.sum()


def test_each_stem_has_ends_of_its_own_length():
    one, other = forked(), forked()
    both = TreeSkeleton.from_columns(
        np.r_[one.parent, np.where(other.parent == NULL, NULL, other.parent + 5)], np.r_[one.tip, other.tip + [5, 0, 0]], np.r_[one.radius, 0.6 * other.radius],
        limb=np.r_[one.limb, other.limb + 2], order=np.r_[one.order, other.order], tree=np.repeat([0, 1], 5),
    )  # fmt: skip
    more = gone_on(both, 0.01, GAMMA).length[10:]
    assert more[0] == pytest.approx(more[1]) and more[2] == pytest.approx(more[3]) and more[2] > 1.5 * more[0]


def test_a_pixel_that_makes_no_sense_is_refused():
    with pytest.raises(OptionError) as caught:
        CloudOptions(pixel=-1.0)
    assert str(caught.value) == "`--pixel -1` is out of range. Give metres of the plant that one pixel of its photos is, 0.005 say, or 0: then twigs end where the points end."
