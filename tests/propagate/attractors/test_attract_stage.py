import dataclasses

import numpy as np
import pytest
from tests.propagate.attractors.attractor_worlds import KEY, QUICK, TARGET, straight, tree
from tests.propagate.worlds import circle

from sketchtree import keys
from sketchtree.axes import NULL
from sketchtree.errors import OptionError
from sketchtree.propagate.attractors.attractors import distances
from sketchtree.propagate.attractors.candidates import SET, candidates
from sketchtree.propagate.attractors.stage import Attract, attract
from sketchtree.propagate.attractors.subtree import RATIO
from sketchtree.propagate.attractors.target import Target
from sketchtree.propagate.attractors.wanted import PAPER
from sketchtree.propagate.attractors.wood import Limb, Stretch, Wood
from sketchtree.skeleton import Kind
from sketchtree.skeleton_joined import joined
from sketchtree.stage import SkeletonStage, stages

COLUMNS = ("parent", "tip", "radius", "order", "limb", "stroke", "tree", "kind", "curve_points", "curve_start")


def grown(given=None, target=TARGET, key=KEY, **wanted):
    return attract(tree() if given is None else given, target, key=key, **(QUICK | wanted))


@pytest.fixture(scope="module")
def found():
    return grown()


@pytest.fixture(scope="module")
def as_in_the_paper():
    return grown(**PAPER | {"iterations": 14})


def test_it_comes_through_the_door_of_stages():
    assert stages()["attract"] is Attract and isinstance(Attract(targets=TARGET), SkeletonStage)


def test_what_was_given_stays_where_it_is(found):
    given, row = tree(), found.drawn_row
    assert np.array_equal(found.skeleton.tip[row], given.tip) and np.array_equal(found.skeleton.limb[row], given.limb)
    assert np.array_equal(found.skeleton.kind[row], given.kind) and (found.generation[row] == 0).all()
    lines = [set(map(tuple, np.concatenate([one.curve_points, one.tip]).round(9))) for one in (given, found.skeleton)]
    assert lines[0] <= lines[1], "every drawn point is still one"


def test_splitting_a_row_does_not_leave_its_drawn_curve(found):
    drawn = found.skeleton.kind == int(Kind.DRAWN)
    start, end = (np.concatenate(ends) for ends in zip(*((t.curve(k)[:-1], t.curve(k)[1:]) for t in [tree()] for k in range(len(t)) if t.parent[k] != NULL), strict=True))
    assert distances(found.skeleton.tip[drawn & ~found.skeleton.is_base], start, end)[0].max() < 1e-6


def test_new_rows_are_propagated_and_of_limbs_of_their_own(found):
    tree_, new = found.skeleton, found.generation > 0
    assert new.sum() > 50 and (tree_.kind[new] == int(Kind.PROPAGATED)).all() and (tree_.stroke[new] == NULL).all()
    assert not set(tree_.limb[new]) & set(tree_.limb[~new])
    first = new & (tree_.limb != tree_.limb[tree_.parent])
    assert len(np.unique(tree_.limb[new])) == first.sum(), "an id is one limb's"
    assert (tree_.order[first] == tree_.order[tree_.parent[first]] + 1).all()


def test_the_radius_is_three_quarters_of_what_bears_it(found):
    tree_ = found.skeleton
    of_limb = {limb: one.radius[one.limb == limb].max() for one in (tree_, tree()) for limb in np.unique(one.limb)}
    first = np.flatnonzero((found.generation > 0) & (tree_.limb != tree_.limb[tree_.parent]))
    for row in first[:200]:
        assert tree_.radius[row] == pytest.approx(RATIO * of_limb[tree_.limb[tree_.parent[row]]])


def test_all_that_grew_is_seen_in_the_foliage(found):
    free = TARGET.coarser().closed(QUICK["leaf_length"])
    assert free.inside(found.skeleton.tip[found.generation > 0]).all()


def test_same_key_same_bytes_and_another_key_another_tree(found):
    again, other = grown(), grown(key=keys.root_key(1))
    assert all(getattr(again.skeleton, name).tobytes() == getattr(found.skeleton, name).tobytes() for name in COLUMNS)
    assert len(other.skeleton) != len(found.skeleton) or not np.array_equal(other.skeleton.tip, found.skeleton.tip)


def test_the_image_energy_never_rises_and_both_fall(found):
    course = found.grown[0].course
    assert (np.diff(course.image) <= 1e-9).all() and (np.diff(course.space) <= 1e-9).all()
    assert course.image[-1] < 0.5 * course.image[0] and course.space[-1] < 0.6 * course.space[0]
    assert {"boughs", "image", "space", "twigs"} == set(course.driver) and course.driver[0] == "boughs"


def test_image_and_space_drive_by_turns_unless_asked_not_to():
    assert grown(iterations=4, boughs=False, twigs=False).grown[0].course.driver == ["image", "space", "image", "space"]
    assert grown(iterations=3, twigs=False, alternate=False).grown[0].course.driver == ["image"] * 3


def test_attractors_in_space_make_the_crown_deeper():
    flat = tree().replace(tip=tree().tip * [1, 1, 0.05], curve_points=tree().curve_points * [1, 1, 0.05])
    deep = {name: np.ptp(one.skeleton.tip[one.generation > 0, 2]) for name, one in
            (("alternating", grown(flat, iterations=16, twigs=False)), ("image", grown(flat, iterations=16, twigs=False, alternate=False)))}  # fmt: skip
    assert deep["alternating"] > deep["image"]


def test_the_papers_choices_grow_too(as_in_the_paper):
    course = as_in_the_paper.grown[0].course
    assert as_in_the_paper.generation.max() >= 1 and course.image[-1] < course.image[0]
    assert course.in_space[-1] > course.in_space[0], "joints of what grew become attractors"


def test_in_the_end_every_attractor_is_within_about_a_leaf(found):
    assert np.mean(found.grown[0].image.distance <= QUICK["leaf_length"]) > 0.9


def test_several_trees_grow_each_to_its_own_target():
    one = tree()
    other = one.replace(tip=one.tip + [20, 0, 0], curve_points=one.curve_points + [20.0, 0, 0], tree=np.full(len(one), 4), limb=one.limb ^ 1)
    both = joined([one, other])
    targets = {0: TARGET, 4: Target.of_outlines([circle(20.2, 5.4, 3.2)], pixels=160)}
    found = grown(both, targets)
    new = found.generation > 0
    assert {0, 4} == set(found.skeleton.tree[new].tolist()) and set(found.grown) == {0, 4} == set(found.spaces)
    assert np.array_equal(found.skeleton.tip[found.drawn_row], both.tip)
    assert (found.skeleton.tip[new, 0] > 10).tolist() == (found.skeleton.tree[new] == 4).tolist()
    alone = grown(one)
    assert np.array_equal(found.skeleton.tip[found.skeleton.tree == 0], alone.skeleton.tip), "a tree is what it is alone"


def test_a_tree_without_a_target_stays_as_it_is():
    found = grown(target={})
    assert len(found.skeleton) == len(tree()) and found.generation.max() == 0


def test_roots_stay_and_bear_nothing():
    one = tree()
    rooted = one.append({"parent": np.array([0]), "tip": np.array([[1.0, -1.0, 0.2]]), "radius": np.array([0.05]), "limb": np.array([99]), "kind": np.array([int(Kind.ROOT)])})
    found = grown(rooted)
    assert np.array_equal(found.skeleton.tip[found.drawn_row], rooted.tip) and len(found.generation) == len(found.skeleton)
    assert (found.skeleton.kind == int(Kind.ROOT)).sum() == 1


def test_foliage_out_of_reach_is_told():
    found = grown(target=Target.of_outlines([circle(60, 5, 2)], pixels=60), iterations=3, twigs=False)
    assert found.warnings == ("Nothing grew: no limb comes near the foliage. Draw a limb into it, or the crown around the limbs.",)


def test_growth_ends_at_max_segments_and_says_so():
    found = grown(max_segments=40)
    assert found.stopped_by == "max_segments" and "Growth stopped at" in found.warnings[0]


def test_what_pulse_raises_ends_the_growth():
    def stop():
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        Attract(targets=TARGET, **QUICK).run(tree(), key=KEY, pulse=stop)


def _stretches(radius, generation):
    wood = Wood([Limb(k, NULL, 0.0, straight().limbs[0].point, g, r, 0) for k, (r, g) in enumerate(zip(radius, generation, strict=True))])
    return [Stretch(k, 0.0, 2.0, k) for k in range(len(radius))], wood


def test_candidates_are_the_thick_ones_and_older_ones_are_taken_more_often():
    stretches, wood = _stretches(np.linspace(1, 0.1, 40), [1] * 3 + [4] * 37)
    taken = np.array([[k in candidates(stretches, wood, keys.draw_key(KEY), i) for k in range(40)] for i in range(300)])
    assert (taken.sum(axis=1) <= SET).all()
    assert taken[:, :3].all(), "generation 1: probability 1"
    assert np.mean(taken[:, 3]) == pytest.approx(0.25, abs=0.08), "generation 4: probability 1/4"
    assert taken[:, 30:].mean() < 0.05


def test_candidates_by_need_are_those_near_which_attractors_are_far():
    stretches, wood = _stretches(np.ones(20), [1] * 20)
    need = np.r_[np.full(10, 5.0), np.full(10, 0.01)]
    taken = [candidates(stretches, wood, keys.draw_key(KEY), i, need) for i in range(50)]
    assert np.mean(np.concatenate(taken) < 10) > 0.97
    assert candidates(stretches, wood, keys.draw_key(KEY), 0, np.zeros(20)) == []


@pytest.mark.parametrize(("wanted", "message"), [
    ({"iterations": -1}, "iterations is -1, but must lie between 0 and 10000. About 100 fill a crown."),
    ({"depth": "deep"}, "depth is 'deep', but must be volume or joints. volume is what is taken by default."),
    ({"replacements": 0}, "replacements is 0, but must be 1 or more. Give a positive number."),
    ({"leaf_length": 0.0}, "leaf_length is 0, but must be above zero. Give metres, or nothing: then it goes by the tree's height."),
    ({"thrift": -1.0}, "thrift is -1, but may not be below zero. 0 switches it off."),
    ({"rise": -1.0}, "rise is -1 and apart 0.15, but neither may be below zero. 0 switches either off."),
])  # fmt: skip
def test_a_wrong_choice_is_named(wanted, message):
    with pytest.raises(OptionError) as error:
        Attract(targets=TARGET, **wanted)
    assert str(error.value) == message


def test_one_target_for_two_trees_is_refused():
    both = joined([tree(), dataclasses.replace(tree(), tree=np.ones(len(tree()), int))])
    with pytest.raises(OptionError, match="There is one target for 2 trees. Give one for each, by the tree's number."):
        grown(both)
