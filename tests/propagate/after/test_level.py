import dataclasses

import numpy as np
import pytest
from tests.propagate.worlds import HABIT, THETA, circle, drawn_tree

from sketchtree import keys
from sketchtree.errors import OptionError
from sketchtree.geometry.radii import PipeRadii
from sketchtree.propagate.after.level import cut_back
from sketchtree.propagate.generations import propagate
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import is_tip, limb_chains

KEY = keys.root_key(3)
CROWN = (circle(points=90),)
SETTINGS = {"free": {}, "crown": {"crown": CROWN}, "filled": {"crown": CROWN, "fill": True}}
DEEP = dataclasses.replace(HABIT, max_order=6)


def grown(level, setting="free", limbs=4):
    return propagate(drawn_tree(limbs), DEEP, THETA, generations=level, key=KEY, **SETTINGS[setting])


def places(tree):
    """(limb, place along it) → row."""
    return {(int(tree.limb[row]), rank): row for chain in limb_chains(tree.parent, tree.limb) for rank, row in enumerate(chain)}


def paths(tree):
    """limb → its nodes from foot to tip."""
    return {int(tree.limb[chain[0]]): np.vstack([tree.start[chain[:1]], tree.tip[chain]]) for chain in limb_chains(tree.parent, tree.limb)}


def at_fraction(path, length):
    """The point of a path `length` metres from its start."""
    s = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))]
    return np.array([np.interp(length, s, path[:, axis]) for axis in range(3)])


@pytest.mark.parametrize("setting", SETTINGS)
@pytest.mark.parametrize(("less", "more"), [(1.0, 1.3), (1.3, 1.31), (2.0, 2.4), (2.4, 3.0), (3.7, 4.2), (5.5, 6.0), (6.0, 8.0)])
def test_a_level_is_the_beginning_of_every_higher_one(setting, less, more):
    few, many = grown(less, setting).skeleton, grown(more, setting).skeleton
    here, there = places(few), places(many)
    assert set(here) <= set(there)
    ends = {int(few.limb[row]) for row in np.flatnonzero(is_tip(few.parent))}
    for (limb, rank), row in here.items():
        last = limb in ends and (limb, rank + 1) not in here
        if not last:
            np.testing.assert_array_equal(few.tip[row], many.tip[there[limb, rank]])
        above = few.parent[row]
        assert above < 0 or few.limb[above] == many.limb[many.parent[there[limb, rank]]]


@pytest.mark.parametrize("setting", SETTINGS)
def test_a_limb_cut_back_lies_on_the_path_of_the_whole_one(setting):
    half, whole = grown(2.5, setting), grown(3, setting).skeleton
    path = paths(whole)
    for limb, cut in paths(half.skeleton).items():
        length = np.linalg.norm(np.diff(cut, axis=0), axis=1).sum()
        np.testing.assert_allclose(at_fraction(path[limb], length), cut[-1], atol=1e-9)


@pytest.mark.parametrize("level", [1.0, 1.5, 2.0, 2.9, 3.0, 3.999])
@pytest.mark.parametrize("setting", SETTINGS)
def test_tips_move_by_no_more_than_the_level_does(setting, level):
    step = 1e-3
    one, two = grown(level, setting).skeleton, grown(level + step, setting).skeleton
    longest = 6.0
    before, after = paths(one), paths(two)
    for limb, path in after.items():
        old = before[limb][-1] if limb in before else path[0]
        assert np.linalg.norm(path[-1] - old) <= step * longest


def test_half_a_generation_is_half_of_every_limb():
    half, whole, before = grown(1.5), grown(2).skeleton, grown(1).skeleton
    total = {limb: np.linalg.norm(np.diff(path, axis=0), axis=1).sum() for limb, path in paths(whole).items()}
    had = paths(before)
    compared = 0
    for limb, path in paths(half.skeleton).items():
        if limb not in had:
            compared += 1
            length = np.linalg.norm(np.diff(path, axis=0), axis=1).sum()
            assert length == pytest.approx(0.5 * total[limb], abs=1e-9)
    assert compared > 50


def test_whole_levels_are_the_integer_generations_to_the_last_bit():
    whole, real = grown(3), grown(3.0)
    for name in ("parent", "tip", "radius", "limb"):
        np.testing.assert_array_equal(getattr(whole.skeleton, name), getattr(real.skeleton, name))
    assert whole.tip_weight is None and real.tip_weight is None


def test_drawn_rows_stay_to_the_last_bit():
    tree, result = drawn_tree(4), grown(1.25)
    np.testing.assert_array_equal(result.skeleton.tip[result.drawn_row], tree.tip)
    assert (result.skeleton.kind[result.generation == 0] == Kind.DRAWN).all()


def test_a_fork_within_the_last_generation_is_cut_by_its_longest_way():
    tree = TreeSkeleton.from_columns(
        np.array([-1, 0, 1, 1]), np.array([[0, 0, 0], [0, 1, 0], [0, 3.0, 0], [0.5, 1, 0]]), np.full(4, 0.01)
    )
    cut = cut_back(tree, np.array([0, 1, 1, 1]), 1, 0.5)
    np.testing.assert_allclose(cut.skeleton.tip, [[0, 0, 0], [0, 1, 0], [0, 1.5, 0], [0.5, 1, 0]])
    np.testing.assert_array_equal(cut.rows, np.arange(4))


def test_pipes_pass_from_a_tip_to_what_it_bears():
    tree = TreeSkeleton.from_columns(np.array([-1, 0, 1]), np.array([[0, 0, 0], [0, 1, 0], [0, 2.0, 0]]), np.full(3, 0.01))
    np.testing.assert_allclose(cut_back(tree, np.array([0, 0, 1]), 1, 0.25).tip_weight, [0, 0.75, 0.25])


@pytest.mark.parametrize("whole", [1, 2])
def test_wood_thickens_without_a_jump_where_a_generation_begins(whole):
    before, after = grown(whole), grown(whole + 1e-3)
    slim = dataclasses.replace(DEEP, trunk_ratio=0.006)
    thin = PipeRadii(slim, tip_weight=before.tip_weight)(before.skeleton)
    smooth = PipeRadii(slim, tip_weight=after.tip_weight)(after.skeleton)
    abrupt = PipeRadii(slim)(after.skeleton)
    here, there = places(thin), places(smooth)
    rows, others = np.array([(row, there[place]) for place, row in here.items()]).T
    assert (smooth.radius[others] / thin.radius[rows]).max() < 1.02
    assert (abrupt.radius[others] / thin.radius[rows]).max() > 1.1


@pytest.mark.parametrize("level", [-0.5, 50.5, np.nan])
def test_a_level_out_of_range_is_refused(level):
    with pytest.raises(OptionError) as caught:
        grown(level)
    assert str(caught.value) == f"generations is {level:g}, but must lie between 0 and 50. 5 to 12 make a full tree."
