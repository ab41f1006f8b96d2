import numpy as np

from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.crown_light import crown_light
from sketchtree.foliage.leaf_materials import leaf_factor
from sketchtree.foliage.leaves import Leaves


def ball(count=6000, size=0.12):
    """Leaves evenly through a ball of 2 m radius."""
    rng = np.random.default_rng(4)
    place = rng.normal(size=(count, 3))
    place *= 2 * rng.uniform(size=(count, 1)) ** (1 / 3) / np.linalg.norm(place, axis=1, keepdims=True)
    up, out = np.tile([0.0, 1, 0], (count, 1)), np.tile([1.0, 0, 0], (count, 1))
    return Leaves("oak", place, out, up, np.full(count, size), np.full(count, 0.5), np.zeros(count, int))


def test_light_falls_from_the_outside_of_a_crown_to_its_inside():
    leaves = ball()
    light, far = crown_light(leaves), np.linalg.norm(leaves.position, axis=1)
    assert light.max() <= 1.0 and light.min() >= 0.0
    shells = [light[(far >= r) & (far < r + 0.6)].mean() for r in (0.2, 0.8, 1.4)]
    assert np.all(np.diff(shells) > 0.02) and shells[2] > 1.35 * shells[0]


def test_the_top_is_brighter_than_the_underside():
    leaves = ball()
    light = crown_light(leaves)
    assert light[leaves.position[:, 1] > 1.5].mean() > 1.3 * light[leaves.position[:, 1] < -1.5].mean()


def test_more_leaves_let_less_light_through():
    assert crown_light(ball(size=0.2)).mean() < crown_light(ball(size=0.1)).mean()


def test_a_single_leaf_stands_in_full_light():
    assert np.isclose(crown_light(ball(count=1))[0], 1.0)
    assert crown_light(Leaves.none("oak")).shape == (0,)


def test_shaded_leaves_are_darker_and_keep_more_of_their_green_than_of_their_red():
    bright, dark = (leaf_factor(ball(1), "autumn", np.array([light]))[0] for light in (1.0, 0.0))
    assert (dark[:3] < bright[:3]).all() and dark[1] / bright[1] > dark[0] / bright[0]


def test_inner_leaves_of_a_mesh_are_darker():
    leaves = ball()
    color = leaf_mesh(leaves).color.reshape(len(leaves), -1, 4)[:, 0, :3].mean(axis=1)
    far = np.linalg.norm(leaves.position, axis=1)
    assert color[far < 0.8].mean() < 0.95 * color[far > 1.8].mean()
