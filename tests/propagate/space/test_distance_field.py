import numpy as np
import pytest
from tests.propagate.space.solids import ball

from sketchtree.propagate.space.distance_field import DistanceField, grid
from sketchtree.propagate.space.surface import APART, enclosed, line_samples, surface_samples

CENTRE, RADIUS = np.array([0.3, -0.2, 0.1]), 1.5
BAND = 1.6


@pytest.fixture(scope="module")
def field():
    low, high = CENTRE - 3.2, CENTRE + 3.2
    triangle = np.asarray(ball(CENTRE, RADIUS, 4).triangles)
    corners = grid(low, high, 0.2)
    return DistanceField.from_samples(*surface_samples(triangle, low, high, 0.06), corners, enclosed(triangle, corners), BAND, APART * 0.06)


@pytest.fixture(scope="module")
def points():
    return CENTRE + np.random.default_rng(0).uniform(-4, 4, (20_000, 3))


def true_distance(point):
    return np.linalg.norm(point - CENTRE, axis=1) - RADIUS


def test_distances_are_true_but_for_the_slack_and_cut_off_at_the_band(field, points):
    true = np.clip(true_distance(points), -BAND, BAND)
    assert np.abs(field.at(points) - true).max() < field.slack
    assert np.abs(field.at(points) - true).mean() < 0.03


def test_the_nearest_corner_tells_the_distance_but_for_the_slack(field, points):
    true = np.clip(true_distance(points), -BAND, BAND)
    assert np.abs(field.roughly(points) - true).max() < field.slack


def test_the_distance_is_never_less_than_it_is_at_least(field, points):
    least = field.at_least(points, 0.3)
    outside = true_distance(points) > 0
    assert (least[outside] <= true_distance(points)[outside] + 2e-3).all()  # the mesh lies a little inside its sphere
    close = outside & (true_distance(points) < 0.25)
    assert (true_distance(points)[close] - least[close]).max() < 2 * field.apart + 2e-3


def test_deep_inside_a_solid_there_is_no_free_distance(field, points):
    assert (field.at_least(points, 0.3)[true_distance(points) < -0.6] == 0).all()


def test_away_points_from_the_surface_outwards(field, points):
    near = points[np.abs(true_distance(points) - 0.5) < 0.4]
    away = field.away(near)
    np.testing.assert_allclose(np.linalg.norm(away, axis=1), 1.0)
    radial = (near - CENTRE) / np.linalg.norm(near - CENTRE, axis=1)[:, None]
    cosine = np.einsum("pi,pi->p", away, radial)
    assert cosine.min() > 0.8 and cosine.mean() > 0.99


def test_beyond_the_grid_nothing_is_near(field):
    far = np.array([[50.0, 0, 0], [0, -50, 0]])
    assert (field.at(far) == BAND).all() and (field.roughly(far) == BAND).all() and (field.away(far) == 0).all()


def test_without_samples_everything_is_far():
    corners = grid(np.zeros(2), np.ones(2), 0.1)
    empty = DistanceField.from_samples(np.zeros((0, 2)), np.zeros((0, 2)), corners, np.zeros([len(x) for x in corners], bool), 0.5, 0.01)
    assert (empty.distance == np.float32(0.5)).all()


def test_it_works_in_the_plane_too():
    outline = np.array([[0, 0], [2, 0], [2, 2], [0, 2]], float)
    corners = grid(np.full(2, -2.0), np.full(2, 4.0), 0.1)
    x, y = np.meshgrid(*corners, indexing="ij")
    solid = (x > 0) & (x < 2) & (y > 0) & (y < 2)
    field = DistanceField.from_samples(*line_samples(outline, 0.05), corners, solid, 1.0, 0.025)
    point = np.array([[2.5, 1.0], [1.0, -0.3], [1.0, 1.5], [3.0, 3.0]])
    np.testing.assert_allclose(field.at(point), [0.5, 0.3, -0.5, 1.0], atol=0.02)
    np.testing.assert_allclose(field.away(point[:2]), [[1, 0], [0, -1]], atol=0.05)


def test_a_grid_reaches_from_corner_to_corner():
    along, up = grid(np.array([-1.0, 2.0]), np.array([1.0, 2.5]), 0.3)
    assert along[0] == -1 and along[-1] >= 1 and up[0] == 2 and up[-1] >= 2.5
    np.testing.assert_allclose(np.diff(along), 0.3)
