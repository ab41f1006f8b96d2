import dataclasses

import numpy as np
import pytest
from tests.propagate.worlds import HABIT, THETA, circle, drawn_tree

from sketchtree import keys, limb_ids
from sketchtree.axes import NULL
from sketchtree.errors import OptionError
from sketchtree.propagate.space.envelope import Envelope
from sketchtree.propagate.generations import Propagate, propagate
from sketchtree.propagate.growing import Growing
from sketchtree.propagate.wanted import Wanted
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.stage import SkeletonStage
from sketchtree.traverse import limb_chains

KEY = keys.root_key(0)
DEEP = dataclasses.replace(HABIT, max_order=12, twig_length=0.05, lateral_ratio=0.6)
COLUMNS = ("parent", "tip", "radius", "order", "limb", "stroke", "tree", "kind", "curve_points", "curve_start")


def grown(tree=None, habit=HABIT, key=KEY, **options):
    return propagate(drawn_tree() if tree is None else tree, habit, THETA, key=key, **options)


def same(one, two):
    return all(np.array_equal(getattr(one, name), getattr(two, name)) for name in COLUMNS)


CROWN = (circle(points=180),)


@pytest.fixture(scope="module")
def plain():
    return grown()


@pytest.fixture(scope="module")
def crowned():
    return grown(crown=CROWN)


def test_it_is_a_stage():
    stage = Propagate(HABIT, THETA)
    assert isinstance(stage, SkeletonStage)
    assert same(stage(drawn_tree(), key=KEY), stage.run(drawn_tree(), key=KEY).skeleton)


@pytest.mark.parametrize("crown", [(), CROWN])
def test_drawn_rows_stay_to_the_last_bit(crown):
    tree = drawn_tree()
    result = grown(tree, crown=crown)
    rows = result.drawn_row
    np.testing.assert_array_equal(result.skeleton.tip[rows], tree.tip)
    for name in ("order", "limb", "stroke", "tree", "kind"):
        np.testing.assert_array_equal(getattr(result.skeleton, name)[rows], getattr(tree, name))
    kept = {tuple(p) for p in np.concatenate([result.skeleton.tip, result.skeleton.curve_points])}
    assert all(tuple(point) in kept for point in tree.curve_points)


def test_new_rows_are_propagated_and_belong_to_no_stroke(plain):
    tree, new = plain.skeleton, plain.generation > 0
    assert new.sum() > 500
    assert (tree.kind[new] == Kind.PROPAGATED).all() and (tree.stroke[new] == NULL).all()
    assert (tree.kind[~new] == Kind.DRAWN).all()


def test_parents_come_first_and_in_the_same_or_the_generation_before(plain):
    tree, generation = plain.skeleton, plain.generation
    rows = np.flatnonzero(tree.parent != NULL)
    assert (tree.parent[rows] < rows).all()
    step = generation[rows] - generation[tree.parent[rows]]
    assert set(np.unique(step)) <= {0, 1}


def test_orders_rise_by_one_at_a_lateral_and_never_along_a_limb(plain):
    tree = plain.skeleton
    rows = np.flatnonzero(tree.parent != NULL)
    above = tree.parent[rows]
    lateral = tree.limb[rows] != tree.limb[above]
    np.testing.assert_array_equal(tree.order[rows] - tree.order[above], lateral.astype(int))


def test_every_limb_is_one_chain(plain):
    tree = plain.skeleton
    for chain in limb_chains(tree.parent, tree.limb):
        np.testing.assert_array_equal(tree.parent[chain[1:]], chain[:-1])


def test_every_propagated_limb_has_several_segments(plain):
    tree = plain.skeleton
    new = tree.order > 1
    _, count = np.unique(tree.limb[new], return_counts=True)
    assert (count >= 2).mean() > 0.9


@pytest.mark.parametrize("generations", [0, 1, 2, 4])
def test_without_a_crown_exactly_the_generations_asked_for(generations):
    result = grown(habit=DEEP, generations=generations)
    assert result.generations_done == generations == result.generation.max()
    assert result.stopped_by == "generations"


def test_five_generations_by_default():
    assert grown(habit=DEEP, max_segments=10**6).generations_done == 5


def test_fewer_generations_are_the_beginning_of_more():
    two, three = grown(generations=2), grown(generations=3)
    count = len(two.skeleton)
    np.testing.assert_array_equal(two.skeleton.tip, three.skeleton.tip[:count])
    np.testing.assert_array_equal(two.skeleton.parent, three.skeleton.parent[:count])


def test_no_generation_leaves_the_tree_as_it_was():
    tree = drawn_tree()
    assert grown(tree, generations=0).skeleton is tree


def test_growth_ends_at_the_deepest_order(plain):
    assert plain.skeleton.order.max() <= HABIT.max_order
    assert plain.stopped_by == "habit" and plain.warnings == ()


def test_no_wood_beyond_the_fronds_of_a_palm():
    palm = dataclasses.replace(HABIT, max_order=1)
    assert grown(habit=palm).skeleton.order.max() == 1


def test_everything_new_lies_within_the_crown(crowned):
    envelope = Envelope.from_outlines(CROWN)
    new = crowned.skeleton.tip[crowned.generation > 0]
    assert len(new) > 500
    assert envelope.lobes[0].margin(new).min() >= -1e-6


def test_within_a_crown_growth_reaches_its_surface(crowned):
    margin = Envelope.from_outlines(CROWN).lobes[0].margin(crowned.skeleton.tip)
    assert np.sum(np.abs(margin) < 1e-5) >= 20


def test_with_several_outlines_everything_new_lies_in_one_of_them():
    outlines = (circle(x=-1.5, y=5.0, radius=2.5), circle(x=1.5, y=6.5, radius=3.0))
    result = grown(crown=outlines)
    lobes = Envelope.from_outlines(outlines).lobes
    new = result.skeleton.tip[result.generation > 0]
    assert np.max([lobe.margin(new) for lobe in lobes], axis=0).min() >= -1e-6


def test_a_crown_far_from_the_tree_grows_nothing_and_says_so():
    result = grown(crown=(circle(x=100.0),))
    assert (result.generation == 0).all()
    assert result.warnings == (
        "All drawn branches lie outside the crown, so nothing grew. Draw the crown around the tips, or use --crown off.",
    )


def test_the_same_key_grows_the_same_bytes():
    assert same(grown(crown=CROWN).skeleton, grown(crown=CROWN).skeleton)


def test_another_key_grows_another_tree(plain):
    other = grown(key=keys.root_key(1)).skeleton
    assert not (len(other) == len(plain.skeleton) and np.array_equal(other.tip, plain.skeleton.tip))


def test_a_stroke_more_leaves_the_growth_of_other_limbs_as_it_was():
    few, more = grown(drawn_tree(6), crown=CROWN), grown(drawn_tree(7), crown=CROWN)
    limbs = [limb_ids.stroke_limb_id(f"limb {slot}") for slot in range(12)]
    limbs = [limb for limb in limbs if limb in few.skeleton.limb]
    assert len(limbs) == 6
    for limb in limbs:
        np.testing.assert_allclose(_borne(few.skeleton, limb), _borne(more.skeleton, limb), atol=1e-9)


def _borne(tree, limb):
    """Tips of everything that grows from one drawn limb."""
    on = tree.limb == limb
    for row in np.flatnonzero(tree.parent != NULL):
        on[row] |= on[tree.parent[row]]
    return tree.tip[on]


def test_the_segments_stay_within_the_limit_and_the_warning_says_so():
    for limit in (500, 1234, 5000):
        result = grown(habit=DEEP, max_segments=limit)
        assert result.skeleton.segment_count <= limit
        assert result.skeleton.segment_count > 0.9 * limit
        assert result.stopped_by == "max_segments"
        assert result.warnings[0].startswith(f"Growth stopped at max_segments = {limit} in generation ")
        assert result.warnings[0].endswith("Raise --max-segments, or ask for fewer generations.")


def test_fewer_segments_than_drawn_grow_nothing():
    result = grown(max_segments=3)
    assert (result.generation == 0).all() and result.stopped_by == "max_segments"


def test_fifty_generations_are_bounded():
    result = grown(habit=dataclasses.replace(DEEP, max_order=60), generations=50, max_segments=20_000)
    assert result.skeleton.segment_count <= 20_000


@pytest.mark.parametrize(
    "options, message",
    [
        ({"generations": -1}, "generations is -1, but must lie between 0 and 50. 5 to 12 make a full tree."),
        ({"generations": 51}, "generations is 51, but must lie between 0 and 50. 5 to 12 make a full tree."),
        ({"max_segments": 0}, "max_segments is 0, but must be 1 or more. Give a positive number."),
    ],
)
def test_options_out_of_range_are_refused(options, message):
    with pytest.raises(OptionError) as caught:
        grown(**options)
    assert str(caught.value) == message


def test_the_side_is_as_full_as_the_front(plain):
    tip = plain.skeleton.tip[plain.generation > 0]
    wide, deep = (np.std(tip[:, axis]) for axis in (0, 2))
    assert 0.6 < deep / wide < 1.7


def test_no_side_seen_from_above_is_empty(plain):
    tip = plain.skeleton.tip[plain.generation > 0]
    azimuth = np.sort(np.arctan2(tip[:, 2], tip[:, 0]))
    assert np.diff(np.r_[azimuth, azimuth[0] + 2 * np.pi]).max() < np.radians(60)


def test_twigs_are_shorter_and_thinner_with_every_order(plain):
    tree = plain.skeleton
    length, radius = (
        [np.median(column[(tree.order == order) & (plain.generation > 0)]) for order in (1, 2, 3, 4)]
        for column in (tree.length, tree.radius)
    )
    assert sorted(radius, reverse=True) == radius
    assert length[0] > length[3]


def test_an_exemplar_lends_its_blocks():
    """Twigs at right angles on the exemplar are at right angles on the tree, where Θ is held."""
    exemplar = _comb()
    theta = dataclasses.replace(THETA, sigma_beta=0.01, mu_beta=np.pi / 2)
    result = propagate(drawn_tree(4), HABIT, theta, exemplar=exemplar, fixed=True, key=KEY)
    tree = result.skeleton
    rows = np.flatnonzero((tree.order == 2) & (tree.order[np.maximum(tree.parent, 0)] == 1))
    above = tree.parent[rows]
    cosine = np.einsum("bi,bi->b", tree.vector[rows], tree.vector[above]) / (tree.length[rows] * tree.length[above])
    assert np.median(np.abs(np.degrees(np.arccos(cosine)) - 90)) < 5


def _comb():
    """A trunk whose level limbs bear level twigs at right angles."""
    parent, tip, order, limb = [NULL], [[0, 0, 0]], [0], [0]

    def add(above, step, its_order, its_limb):
        parent.append(above)
        tip.append(list(np.add(tip[above], step)))
        order.append(its_order)
        limb.append(its_limb)
        return len(parent) - 1

    trunk, number = 0, 0
    for level in range(20):
        trunk = add(trunk, [0, 0.5, 0], 0, 0)
        angle, number = level * 2.4, number + 1
        out, across = np.array([np.cos(angle), 0, np.sin(angle)]), np.array([-np.sin(angle), 0, np.cos(angle)])
        row, own = trunk, number
        for node in range(6):
            row = add(row, 0.4 * out, 1, own)
            number += 1
            add(row, 0.6 * across * (-1) ** node, 2, number)
    return TreeSkeleton.from_columns(np.array(parent), np.array(tip), np.full(len(parent), 0.01),
                                     order=np.array(order), limb=np.array(limb))  # fmt: skip


def test_an_exemplar_without_branches_is_no_help_and_no_harm():
    pole = TreeSkeleton.from_columns(np.array([NULL, 0]), np.array([[0, 0, 0], [0, 5.0, 0]]), np.ones(2))
    assert len(propagate(drawn_tree(), HABIT, THETA, exemplar=pole, key=KEY).skeleton) > 500


def test_a_trunk_alone_becomes_a_tree():
    result = grown(drawn_tree(0))
    assert result.skeleton.order.max() == HABIT.max_order


def test_two_stems_grow_as_two_trees():
    one = drawn_tree(5)
    two = TreeSkeleton.from_columns(
        np.r_[one.parent, np.where(one.parent == NULL, NULL, one.parent + len(one))],
        np.concatenate([one.tip, one.tip + [6.0, 0, 0]]), np.r_[one.radius, one.radius],
        order=np.r_[one.order, one.order], limb=np.r_[one.limb, one.limb + 1], stroke=np.r_[one.stroke, one.stroke + 50],
        tree=np.repeat([0, 1], len(one)), kind=np.zeros(2 * len(one), int),
    )  # fmt: skip
    tree = grown(two).skeleton
    rows = np.flatnonzero(tree.parent != NULL)
    np.testing.assert_array_equal(tree.tree[rows], tree.tree[tree.parent[rows]])
    assert np.bincount(tree.tree).min() > 500


def test_an_empty_skeleton_stays_empty():
    empty = TreeSkeleton.from_columns(np.zeros(0, int), np.zeros((0, 3)), np.zeros(0))
    assert len(grown(empty).skeleton) == 0


def test_a_small_tree_has_small_twigs():
    small, large = grown(drawn_tree(height=2.0, seed=1)), grown(drawn_tree(height=10.0, seed=1))
    lengths = [np.median(r.skeleton.length[r.skeleton.order == 4]) for r in (small, large)]
    assert lengths[0] < lengths[1]


def test_limbs_that_hang_stand_farther_apart():
    upright, hanging = (
        Growing(drawn_tree(3), Wanted(dataclasses.replace(HABIT, gravitropism=pull), THETA), KEY) for pull in (0.0, 60.0)
    )
    order, whole = np.array([1, 2]), np.array([3.0, 2.0])
    assert (hanging.manner.spacing(order, whole) > 1.1 * upright.manner.spacing(order, whole)).all()


def test_orders_of_what_grows_follow_its_parent_limbs():
    tree = drawn_tree(5)
    deep = tree.replace(order=np.where(tree.order > 0, 7, 0))
    found = grown(deep).skeleton
    new = np.flatnonzero((found.parent != NULL) & (found.kind == int(Kind.PROPAGATED)))
    above = found.parent[new]
    step = (found.limb[new] != found.limb[above]).astype(int)
    np.testing.assert_array_equal(found.order[new], found.order[above] + step)
    assert (found.order[new] > 7).any()
