import numpy as np
import pytest
from tests.propagate.after.hanging import grown, shuffled
from tests.propagate.worlds import HABIT

from sketchtree.errors import OptionError
from sketchtree.propagate.after.shed import LEAF_AREA, Shed, branch_starts, leaf_area, light_of_branches
from sketchtree.propagate.space.shadow import EXTINCTION
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.stage import SkeletonStage


@pytest.fixture(scope="module")
def tree():
    return grown()


def storeys(levels=8):
    """A drawn mast with the same undrawn whorl at every metre of height."""
    parent, tip, limb, kind = [-1], [[0, 0, 0]], [0], [0]
    for level in range(1, levels + 1):
        parent.append(parent.index(-1) if level == 1 else mast)
        mast = len(parent) - 1
        tip.append([0, float(level), 0])
        limb.append(0)
        kind.append(0)
        for side in range(12):
            out = np.array([np.cos(side * np.pi / 6), 0.1, np.sin(side * np.pi / 6)])
            above = mast
            for step in range(1, 6):
                parent.append(above)
                above = len(parent) - 1
                tip.append([0, float(level), 0] + 0.5 * step * out)
                limb.append(100 * level + side)
                kind.append(1)
    rows = len(parent)
    return TreeSkeleton.from_columns(np.array(parent), np.array(tip, float), np.full(rows, 0.003), limb=np.array(limb),
                                     order=np.array(kind), kind=np.array(kind))  # fmt: skip


def test_it_is_a_stage():
    assert isinstance(Shed(0.3), SkeletonStage)


def test_off_leaves_the_tree_as_it_was(tree):
    assert Shed(0.0, 0.0, HABIT)(tree) is tree


def test_palubicki_the_shaded_storeys_fall_and_the_sunlit_stay():
    tree = storeys()
    left = Shed(0.55, habit=HABIT)(tree)
    level = np.unique(left.limb[left.kind == 1] // 100)
    assert 8 in level and 1 not in level
    assert (np.diff(level) == 1).all()


def test_light_of_a_branch_is_that_of_its_leafy_wood_weighed_by_length():
    tree = storeys()
    light = light_of_branches(tree, HABIT)
    first = np.flatnonzero(branch_starts(tree))
    level = tree.limb[first] // 100
    mean = [light[first][level == k].mean() for k in range(1, 9)]
    assert (np.diff(mean[-4:]) > 0).all() and max(mean[:4]) < mean[-3] and mean[-1] == pytest.approx(1.0, abs=0.05)


def test_a_dense_even_crown_is_as_dark_as_beer_and_lambert_say():
    rng = np.random.default_rng(0)
    ball = rng.uniform(-1, 1, (60_000, 3))
    ball = 4.0 * ball[np.linalg.norm(ball, axis=1) < 1] + [0, 6, 0]
    count = len(ball)
    bearers, twigs = np.zeros(count, int), np.arange(1, count + 1)
    tree = TreeSkeleton.from_columns(
        np.r_[-1, bearers, twigs], np.vstack([[0, 0, 0], ball, ball + [0.001, 0, 0]]), np.r_[1.0, np.full(count, 0.5), np.full(count, 0.003)],
        limb=np.r_[0, twigs, twigs + count],
    )  # fmt: skip
    leafy = tree.radius < 0.1
    area = leaf_area(tree, leafy, reach=2.0)
    assert area.sum() == pytest.approx(LEAF_AREA / 2.0 * 4 / 3 * np.pi * 4.0**3, rel=0.03)
    light = light_of_branches(tree, HABIT)[leafy]
    deep = np.linalg.norm(ball - [0, 5, 0], axis=1) < 0.5
    assert -np.log(light[deep].mean()) == pytest.approx(EXTINCTION * LEAF_AREA, rel=0.4)
    assert light[ball[:, 1] > 9.5].min() > 0.7


@pytest.mark.parametrize("stage", [Shed(1.0, 20.0, HABIT), Shed(0.5, 0.0, HABIT), Shed(0.0, 2.0, HABIT)])
def test_drawn_wood_is_never_shed(tree, stage):
    left = stage(tree)
    np.testing.assert_array_equal(left.tip[left.kind == Kind.DRAWN], tree.tip[tree.kind == Kind.DRAWN])


def test_what_bears_drawn_wood_is_never_shed():
    tree = storeys()
    kind = np.array(tree.kind)
    kind[6] = 0  # the end of a limb of the lowest storey
    left = Shed(1.0, 20.0, HABIT).run(tree.replace(kind=kind))
    assert set(range(2, 7)) <= set(left.rows.tolist())


def test_all_undrawn_goes_where_all_the_light_is_asked_for(tree):
    left = Shed(1.0, habit=HABIT)(tree)
    assert len(left) < len(tree)
    assert Shed(1.0, habit=HABIT)(storeys()).kind.tolist().count(1) < 12 * 5 * 2


def test_a_higher_threshold_drops_more_and_what_was_dropped_stays_dropped(tree):
    kept = [set(Shed(shade, habit=HABIT).run(tree).rows.tolist()) for shade in (0.0, 0.3, 0.5, 0.8)]
    assert all(more < less for less, more in zip(kept, kept[1:], strict=False))


def test_twigs_that_are_short_and_bear_nothing_go_and_no_others(tree):
    length = 1.5 * HABIT.twig_length
    left = Shed(twigs=1.5, habit=HABIT).run(tree)
    gone = np.setdiff1d(np.arange(len(tree)), left.rows)
    assert len(gone) > 50
    whole = np.bincount(np.unique(tree.limb, return_inverse=True)[1], tree.length)[np.unique(tree.limb, return_inverse=True)[1]]
    alone = ~np.isin(tree.limb, tree.limb[tree.parent[1:]][tree.limb[1:] != tree.limb[tree.parent[1:]]])
    undrawn = ~np.isin(tree.limb, tree.limb[tree.kind == Kind.DRAWN])
    np.testing.assert_array_equal(np.flatnonzero((whole < length) & alone & undrawn), np.setdiff1d(gone, np.flatnonzero(~undrawn)))


@pytest.mark.parametrize("seed", [1, 2])
def test_the_order_of_rows_does_not_matter(tree, seed):
    other, rows = shuffled(tree, seed)
    stage = Shed(0.45, 1.2, HABIT)
    np.testing.assert_array_equal(np.sort(rows[stage.run(other).rows]), stage.run(tree).rows)
    light = light_of_branches(tree, HABIT)
    np.testing.assert_array_equal(light_of_branches(other, HABIT), light[rows])


def test_what_is_left_is_not_changed(tree):
    left = Shed(0.5, 1.0, HABIT).run(tree)
    for name in ("tip", "radius", "limb", "order", "kind"):
        np.testing.assert_array_equal(getattr(left.skeleton, name), getattr(tree, name)[left.rows])


def test_an_empty_tree_stays_empty():
    empty = TreeSkeleton.from_columns(np.zeros(0, int), np.zeros((0, 3)), np.zeros(0))
    assert len(Shed(0.5, 1.0)(empty)) == 0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"shade": 1.1}, "shade is 1.1, but must lie between 0 and 1. 0.2 to 0.5 thin the inside of a crown."),
        ({"shade": np.nan}, "shade is nan, but must lie between 0 and 1. 0.2 to 0.5 thin the inside of a crown."),
        ({"twigs": -1}, "twigs is -1, but must lie between 0 and 20. 1 to 2 drop the shortest twigs."),
    ],
)
def test_options_out_of_range_are_refused(options, message):
    with pytest.raises(OptionError) as caught:
        Shed(**options)
    assert str(caught.value) == message
