"""Parametric units, grafted on a bare trunk (§II.3, Figure 7)."""

import numpy as np
import pytest
from growth_trees import bare_trunk, crown, curved, same

from sketchtree.axes import NULL
from sketchtree.errors import OptionError
from sketchtree.growth.clearance import Clearance
from sketchtree.growth.crown_base import crown_base
from sketchtree.growth.grafting import Graft, variations
from sketchtree.growth.library import LIBRARY
from sketchtree.growth.manner import Manner
from sketchtree.growth.straight import straightened
from sketchtree.keys import root_key
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import child_count


def test_the_library_has_four_units_or_more_of_both_types():
    assert len(LIBRARY) >= 4
    assert {unit.name[0] for unit in LIBRARY} == {"L", "Y"}


@pytest.mark.parametrize("unit", LIBRARY, ids=lambda unit: unit.name)
def test_a_unit_is_a_branch_of_its_own_with_parents_first(unit):
    assert unit.parent[0] == NULL and unit.parent.count(NULL) == 1
    assert all(above < piece for piece, above in enumerate(unit.parent))
    run = []
    for piece, above in enumerate(unit.parent):
        run.append(unit.length[piece] + (run[above] if above != NULL else 0))
    assert max(run) == pytest.approx(1.0, abs=0.1)


@pytest.mark.parametrize("unit", LIBRARY, ids=lambda unit: unit.name)
def test_an_l_bears_at_its_sides_and_a_y_forks(unit):
    lean = np.array(unit.lean)
    forks = [[lean[piece] for piece, above in enumerate(unit.parent) if above == node] for node in range(len(unit))]
    forks = [fork for fork in forks if len(fork) > 1]
    assert forks
    for fork in forks:
        assert (0 in fork) == (unit.name[0] == "L")


def known_tree(lean: float, scale: float, count: int = 60) -> TreeSkeleton:
    """A straight trunk with straight branches that all lean alike and are all as long."""
    parent, tip, limb = [-1], [np.zeros(3)], [0]
    for k in range(count):
        parent.append(k), tip.append(np.array([0, (k + 1) / count, 0])), limb.append(0)
    for k in range(1, count):
        way = np.array([np.sin(lean) * np.cos(2.0 * k), np.cos(lean), np.sin(lean) * np.sin(2.0 * k)])
        parent.append(k), tip.append(tip[k] + scale * way), limb.append(k)
    return TreeSkeleton.from_columns(parent, np.array(tip), np.full(len(parent), 0.01), limb=limb)


def test_angles_and_scale_are_those_of_the_trees_own_pairs():
    manner = Manner.of(known_tree(np.radians(70), 0.3, 400))
    assert np.degrees(manner.lean.mean) == pytest.approx(70, abs=1)
    assert np.degrees(manner.turn.mean) == pytest.approx(np.degrees(2.0), abs=1)
    assert manner.scale.mean == pytest.approx(0.3, abs=0.01)
    assert manner.swing.mean == 0 and np.degrees(manner.swing.sd) < 2


def test_few_pairs_are_believed_little():
    usual, few, many = Manner().lean.mean, Manner.of(known_tree(np.radians(80), 0.3, 3)).lean.mean, Manner.of(known_tree(np.radians(80), 0.3)).lean.mean
    assert usual < few < many


def test_a_tree_of_one_limb_branches_as_trees_usually_do():
    pole = TreeSkeleton.from_columns([-1, 0], np.array([[0, 0, 0], [0, 1, 0]], float), [0.1, 0.1])
    assert Manner.of(pole).lean.mean == pytest.approx(Manner().lean.mean)


def test_what_was_there_stays_as_it_was():
    trunk, tree = bare_trunk(), crown(3)
    assert same(tree.select(np.arange(len(tree)) < len(trunk)), trunk)
    assert (tree.kind[len(trunk) :] == int(Kind.GROWN)).all()


def test_drawn_curves_keep_their_points():
    trunk = curved()
    tree = Graft(2)(trunk, key=root_key(0))
    pieces = straightened(trunk)
    assert same(tree.select(np.arange(len(tree)) < len(pieces)), pieces)


def test_each_level_adds_to_the_last():
    sizes = [len(Graft(levels)(bare_trunk(), key=root_key(0))) for levels in range(4)]
    assert (np.diff(sizes) > 0).all() and sizes[0] == len(bare_trunk())


def test_every_tip_that_has_room_goes_on():
    trunk, tree = bare_trunk(), crown(1)
    tips = np.flatnonzero(child_count(trunk.parent) == 0)
    assert (child_count(tree.parent)[tips] == 1).all()
    onward = np.flatnonzero(np.isin(tree.parent, tips))
    assert np.array_equal(tree.limb[onward], tree.limb[tree.parent[onward]])


def test_sides_bear_limbs_of_the_next_order():
    trunk, tree = bare_trunk(), crown(1)
    new = np.flatnonzero((np.arange(len(tree)) >= len(trunk)) & (tree.limb != tree.limb[tree.parent]))
    assert len(new) > 10 and (tree.order[new] == tree.order[tree.parent[new]] + 1).all()
    assert len(np.unique(tree.limb[new])) == len(new)


def test_radii_never_grow_towards_the_tips_and_go_on_from_the_wood_below():
    trunk, tree = bare_trunk(), crown(3)
    rows = np.arange(1, len(tree))
    new = rows[rows >= len(trunk)]
    assert (tree.radius[new] <= tree.radius[tree.parent[new]]).all()
    onward = new[(tree.parent[new] < len(trunk)) & (tree.limb[new] == tree.limb[tree.parent[new]])]
    assert (tree.radius[onward] > 0.7 * tree.radius[tree.parent[onward]]).all()


def test_nothing_goes_below_the_ground():
    tree = Graft(4)(bare_trunk(), key=root_key(3))
    assert tree.tip[:, 1].min() >= 0


def test_units_hang_little_more_than_what_bears_them():
    trunk, tree = bare_trunk(), crown(1)
    new = np.arange(len(trunk), len(tree))
    assert (trunk.vector[:, 1] >= 0).all()
    fall = -tree.vector[new, 1] / tree.length[new]
    assert fall.max() <= np.sin(np.radians(40)) + 1e-9


def test_nothing_runs_through_thick_wood():
    trunk, tree = bare_trunk(), crown(3)
    clear, new = Clearance.of(trunk), np.flatnonzero(np.arange(len(tree)) >= len(trunk))
    foot = np.arange(len(tree))
    for row in range(len(trunk), len(tree)):
        foot[row] = foot[tree.parent[row]] if tree.parent[row] >= len(trunk) else tree.parent[row]
    near = 3.0 * tree.radius[foot[new]]
    assert not clear.blocked(tree.start[new], tree.tip[new], tree.tip[foot[new]], near).any()


def test_nothing_is_grafted_on_below_the_first_limb_nor_hangs_far_below_it():
    base = crown_base(bare_trunk())
    assert base == pytest.approx(bare_trunk().tip[4, 1])
    full = crown(3)
    grown = np.flatnonzero(full.kind == int(Kind.GROWN))
    assert full.start[grown, 1].min() >= 0.8 * base and full.tip[grown, 1].min() >= 0.79 * base
    low = grown[(full.limb[full.parent[grown]] == 0) & (full.order[full.parent[grown]] == 0)]
    assert len(low) and full.start[low, 1].min() >= base


def test_a_crown_begins_with_a_limb_not_with_a_twig():
    tree = bare_trunk()
    twig = tree.append({"parent": np.array([2]), "tip": tree.tip[[2]] + [0.1, 0.05, 0], "radius": np.array([0.01]), "limb": np.array([99]), "order": np.array([1])})
    assert crown_base(twig) == crown_base(tree)
    assert crown_base(tree.select(tree.order == 0)) is None


def test_the_same_key_gives_the_same_tree_and_another_another():
    once, again, other = (Graft(2)(bare_trunk(), key=root_key(seed)) for seed in (1, 1, 2))
    assert same(once, again) and not same(once, other)


def test_variations_are_different_crowns_on_one_trunk():
    trunk = bare_trunk()
    trees = variations(trunk, 3, levels=2, key=root_key(0))
    assert len({tree.tip.tobytes() for tree in trees}) == 3
    assert all(same(tree.select(np.arange(len(tree)) < len(trunk)), trunk) for tree in trees)
    assert same(variations(trunk, 2, levels=2, key=root_key(0))[1], trees[1])


def test_a_limb_more_changes_the_branches_on_the_others_only_as_it_changes_the_manner():
    trunk = bare_trunk()
    more = trunk.append({"parent": [3, len(trunk)], "tip": [[1.0, 1.6, 0.1], [1.6, 1.8, 0.1]], "radius": [0.03, 0.02], "limb": [99, 99], "order": [1, 1]})
    tree, other = (Graft(1)(some, key=root_key(0)) for some in (trunk, more))
    found = np.isin(np.unique(tree.limb), np.unique(other.limb))
    assert found.mean() > 0.9
    near = 0
    for limb in np.unique(tree.limb)[found]:
        one, two = tree.tip[tree.limb == limb], other.tip[other.limb == limb]
        near += len(one) == len(two) and np.abs(one - two).max() < 0.1 * trunk.height
    assert near > 0.8 * found.sum()


def test_a_tree_without_wood_stays_bare():
    point = TreeSkeleton.from_columns([-1], np.zeros((1, 3)), [0.1])
    assert same(Graft(3)(point, key=root_key(0)), point)


def test_growth_ends_before_it_has_too_many_segments():
    assert len(Graft(5, most_segments=3000)(bare_trunk(), key=root_key(0))) <= 3000


@pytest.mark.parametrize("levels", [-1, 6])
def test_a_wrong_number_of_levels_is_named(levels):
    with pytest.raises(OptionError) as error:
        Graft(levels)
    assert str(error.value) == f"levels is {levels}, but must lie between 0 and 5. 0 grafts nothing on; a full tree has 3 to 5."
