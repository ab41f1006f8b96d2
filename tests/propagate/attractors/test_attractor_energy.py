import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.propagate.attractors.attractor_worlds import TARGET, predefined, straight

from sketchtree.axes import NULL
from sketchtree.propagate.attractors.attractors import Attractors, distances, image_attractors, turned_joints, volume_attractors
from sketchtree.propagate.attractors.gain import gains
from sketchtree.propagate.attractors.placement import placed
from sketchtree.propagate.attractors.revolved import Axes
from sketchtree.propagate.attractors.wood import Stretch

AXES = Axes.about_crown(TARGET, np.array([[0.2, 0, 0], [0.2, 8, 0.0]]))
UP = np.array([0.0, 1.0, 0.0])


def _world(seed, pieces=7):
    rng = np.random.default_rng(seed)
    start = rng.uniform(-2, 2, (pieces, 3))
    return rng.uniform(-3, 3, (40, 3)), start, start + rng.normal(size=(pieces, 3)), rng.integers(0, 4, pieces)


def test_image_attractors_are_a_square_grid_in_the_foliage():
    points = image_attractors(TARGET, 0.3)
    assert TARGET.inside(points).all()
    assert len(points) == pytest.approx(TARGET.mask.sum() * TARGET.pixel**2 / 0.09, rel=0.03)
    apart = np.linalg.norm(points[:, None] - points[None], axis=-1) + 9 * np.eye(len(points))
    assert apart.min(axis=1) == pytest.approx(np.full(len(points), 0.3))


def test_foliage_smaller_than_the_interval_still_has_an_attractor():
    assert len(image_attractors(TARGET, 50.0)) == 1


def test_eq_dist_is_that_to_the_densest_samples_of_the_tree():
    place, start, end, _ = _world(1)
    share = np.linspace(0, 1, 2001)[:, None]
    dense = (start[:, None] + share * (end - start)[:, None]).reshape(-1, 3)
    assert distances(place, start, end)[0] == pytest.approx(np.linalg.norm(place[:, None] - dense, axis=-1).min(axis=1), abs=2e-3)


@pytest.mark.parametrize("axes", [2, 3])
def test_eq_energy_is_the_sum_of_distances_on_the_page_and_in_space(axes):
    place, start, end, limb = _world(2)
    attractors = Attractors.at(place[:, :axes])
    attractors.approach(start, end, limb)
    slow = []
    for point in place[:, :axes]:
        each = []
        for p, q in zip(start[:, :axes], end[:, :axes], strict=True):
            t = np.clip((point - p) @ (q - p) / ((q - p) @ (q - p)), 0, 1)
            each.append(np.linalg.norm(p + t * (q - p) - point))
        slow.append(min(each))
    assert attractors.energy == pytest.approx(sum(slow))


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 6))
def test_eq_incremental_distances_are_those_found_anew(seed, cut):
    place, start, end, limb = _world(seed)
    whole, bit = Attractors.at(place), Attractors.at(place)
    whole.approach(start, end, limb)
    bit.approach(start[:cut], end[:cut], limb[:cut])
    before = bit.distance.copy()
    bit.approach(start[cut:], end[cut:], limb[cut:])
    assert bit.distance == pytest.approx(whole.distance) and (bit.nearest == whole.nearest).all()
    assert (bit.distance <= before).all(), "no branch is discarded: nothing comes to be farther"


@pytest.mark.parametrize("axes", [2, 3])
@pytest.mark.parametrize("seed", range(4))
def test_the_gain_is_by_how_much_the_energy_falls(axes, seed):
    rng = np.random.default_rng(seed)
    wood, library = straight(), predefined()
    at = placed(library, wood, Stretch(0, 0.0, 2.0, 7), UP, 0.2)
    attractors = Attractors.at(rng.uniform(-2, 4, (90, axes)))
    attractors.approach(*wood.pieces())
    found = gains(attractors, at, library.reach * 2.0)
    for subtree, turn in rng.integers([0, 0], [len(library), 12], (6, 2)):
        there = at.there[subtree, turn]
        after = Attractors(attractors.place, attractors.distance, attractors.nearest)
        after.approach(at.start[subtree, turn][there], at.end[subtree, turn][there], np.zeros(there.sum(), int))
        assert found[subtree, turn] == pytest.approx(attractors.energy - after.energy, abs=1e-3)


def test_what_was_pruned_gains_nothing():
    import dataclasses

    wood, library = straight(), predefined()
    at = placed(library, wood, Stretch(0, 0.0, 2.0, 7), UP, 0.0)
    attractors = Attractors.at(np.array([[1.0, 3.0], [0.5, 2.0]]))
    attractors.approach(*wood.pieces())
    assert gains(attractors, at, 9.0).max() > 0
    assert gains(attractors, dataclasses.replace(at, there=np.zeros_like(at.there)), 9.0).max() == 0


def test_turned_joints_lie_in_the_foliage_and_joints_outside_turn_into_none():
    joints = np.array([[1.5, 5.4, 0.0], [0.2, 0.1, 0.0], [0.2, 5.4, 3.0]])
    turned = turned_joints(joints, TARGET, AXES)
    assert len(turned) == 2 and TARGET.inside(turned).all()
    assert turned[0] == pytest.approx([0.2, 5.4, 1.3], abs=0.05) and turned[1] == pytest.approx([-2.8, 5.4, 0.0], abs=0.05)


def test_attractors_of_the_volume_are_as_deep_as_wide():
    points = volume_attractors(TARGET, AXES, 0.3)
    assert TARGET.inside(points).all()
    assert np.ptp(points[:, 2]) == pytest.approx(np.ptp(points[:, 0]), abs=0.4)
    assert len(points) == pytest.approx(4 / 3 * np.pi * 3.2**3 / 0.027, rel=0.05)


def test_need_is_counted_for_the_limb_that_is_nearest():
    attractors = Attractors(np.zeros((4, 2)), np.array([1.0, 2.0, 4.0, 0.1]), np.array([0, 2, 2, 2]))
    assert attractors.need(3, floor=0.5).tolist() == [1.0, 0.0, 6.0]
    assert Attractors.at(np.zeros((2, 2))).nearest.tolist() == [NULL, NULL]
