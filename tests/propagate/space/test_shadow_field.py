import numpy as np
import pytest

from sketchtree.propagate.space.shadow import EXTINCTION, MOST_VOXELS, ShadowField, shadows

LOW, HIGH = np.zeros(3), np.array([8.0, 6.0, 8.0])


def field(pitch=0.5, reach=1.0):
    return ShadowField.empty(LOW, HIGH, pitch=pitch, reach=reach)


def canopy(density=0.8, count=20, height=(2.0, 6.0)):
    """(points, areas) of an even canopy of `density` m² a m³ that fills the box between two heights."""
    x, z = (np.linspace(0, 8, 2 * count + 1)[1::2] for _ in range(2))
    y = np.linspace(*height, 2 * count + 1)[1::2]
    point = np.stack(np.meshgrid(x, y, z), axis=-1).reshape(-1, 3)
    return point, np.full(len(point), density * 64 * (height[1] - height[0]) / len(point))


@pytest.mark.parametrize("shape", [(5, 7, 6), (1, 3, 1), (2, 9, 3), (12, 10, 9), (3, 1, 3)])
def test_palubicki_shadows_are_the_sum_over_all_pyramids(shape):
    rng = np.random.default_rng(1)
    leaves = np.where(rng.random(shape) < 0.3, rng.integers(0, 9, shape), 0).astype(float)
    np.testing.assert_allclose(shadows(leaves, 0.7), _slowly(leaves, 0.7), atol=1e-5)


def _slowly(leaves, fade):
    shadow = np.zeros(leaves.shape)
    for i, j, k in np.argwhere(leaves > 0):
        for q in range(1, j + 1):
            shadow[max(i - q, 0) : i + q + 1, j - q, max(k - q, 0) : k + q + 1] += leaves[i, j, k] * fade**q
    return shadow


def test_in_the_open_it_is_light_and_nothing_says_where_it_is_lighter():
    point = np.array([[4.0, 3.0, 4.0], [-1.0, 9.0, 20.0]])
    assert (field().light_at(point) == 1.0).all()
    assert (field().gradient_at(point) == 0.0).all()


def test_a_leaf_shades_what_is_below_it_and_no_other():
    lit = field().with_leaves(np.array([[4.25, 4.25, 4.25]]), np.array([2.0]))
    below, beside, above = lit.light_at(np.array([[4.25, 3.25, 4.25], [6.25, 3.75, 4.25], [4.25, 5.25, 4.25]]))
    assert below < 1.0 and beside == above == 1.0


@pytest.mark.parametrize("pitch", [0.1, 0.2, 0.4])
def test_beer_lambert_amid_an_even_canopy_at_any_size_of_voxel(pitch):
    density, reach = 0.8, 0.5
    lit = field(pitch, reach).with_leaves(*canopy(density, count=40))
    expected = EXTINCTION * density * pitch / (np.exp(pitch / reach) - 1)
    light = lit.light_at(np.array([[4.0, 2.2, 4.0]]))
    assert -np.log(light[0]) == pytest.approx(expected, rel=0.08)


def test_light_is_between_0_and_1_and_falls_downwards():
    lit = field().with_leaves(*canopy(20.0))
    light = lit.light_at(np.column_stack([np.full(20, 4.0), np.linspace(6, 0, 20), np.full(20, 4.0)]))
    assert (light > 0).all() and (light <= 1).all()
    inside = light[:13]
    assert (np.diff(inside) <= 1e-9).all() and inside[-1] < 0.2


def test_the_way_to_more_light_is_out_of_the_shadow():
    lit = field().with_leaves(np.array([[4.25, 4.25, 4.25]]), np.array([50.0]))
    way = lit.gradient_at(np.array([[5.25, 3.25, 4.25], [4.25, 3.25, 3.25]]))
    assert way[0, 0] > 0 and abs(way[0, 2]) < 1e-6 and way[1, 2] < 0
    assert (np.linalg.norm(way, axis=1) <= 1 + 1e-9).all()


def test_leaves_may_come_in_any_order_and_in_parts_to_the_last_bit():
    point, area = canopy()
    mixed = np.random.default_rng(0).permutation(len(point))
    whole, other = field().with_leaves(point, area), field().with_leaves(point[mixed], area[mixed])
    parts = field().with_leaves(point[:70], area[:70]).with_leaves(point[70:], area[70:])
    np.testing.assert_array_equal(whole.shadow, other.shadow)
    np.testing.assert_array_equal(whole.shadow, parts.shadow)


def test_leaves_can_be_taken_away_again():
    point, area = canopy()
    left = field().with_leaves(point, area).with_leaves(point, -area)
    assert (left.leaves == 0).all() and (left.shadow == 0).all()


def test_memory_is_bounded():
    large = ShadowField.empty(np.zeros(3), np.array([1000.0, 10.0, 500.0]), pitch=0.01, reach=1.0)
    assert large.leaves.size <= MOST_VOXELS and large.pitch > 0.01
    flat = ShadowField.empty(np.zeros(3), np.array([5.0, 5.0, 0.0]), pitch=0.5, reach=1.0, most=1000)
    assert flat.leaves.shape == (10, 10, 1)
