import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree
from tests.propagate.space.solids import ball, box, open_below, wall

from sketchtree.propagate.space.surface import APART, enclosed, line_samples, pieces, surface_samples, winding

LOW, HIGH = np.full(3, -3.0), np.full(3, 3.0)


@pytest.mark.parametrize("mesh", [ball((0, 0, 0), 2.0, 1), box((-2, -1, -1), (1, 2, 1)), wall(0.5)])
def test_no_point_of_the_surface_is_farther_than_apart_from_every_sample(mesh):
    sample, normal = surface_samples(np.asarray(mesh.triangles), LOW, HIGH, 0.3)
    np.testing.assert_allclose(np.linalg.norm(normal, axis=1), 1.0)
    point, _ = trimesh.sample.sample_surface(mesh, 4000, seed=0)
    point = point[((point >= LOW) & (point <= HIGH)).all(axis=1)]
    assert cKDTree(sample).query(point)[0].max() <= APART * 0.3 + 1e-12


def test_pieces_cover_what_lies_in_the_box_and_little_else():
    mesh = ball((0, 0, 0), 2.0)
    piece = pieces(np.asarray(mesh.triangles), LOW, HIGH, 0.2)
    area = 0.5 * np.linalg.norm(np.cross(piece[:, 1] - piece[:, 0], piece[:, 2] - piece[:, 0]), axis=1).sum()
    assert area == pytest.approx(mesh.area)
    huge = wall(0.0, half=1e6, top=1e6)
    assert len(pieces(np.asarray(huge.triangles), LOW, HIGH, 0.2)) < 20_000


def test_a_surface_outside_the_box_has_no_samples():
    assert len(surface_samples(np.asarray(ball((50, 0, 0), 2.0).triangles), LOW, HIGH, 0.3)[0]) == 0


def test_samples_of_an_outline_are_no_farther_apart_than_asked():
    outline = np.array([[0, 0], [3, 0], [3, 0], [1, 2]], float)
    sample, normal = line_samples(outline, 0.25)
    np.testing.assert_allclose(normal[0], [0, -1])
    ring = np.concatenate([sample, sample[:1]])
    assert np.linalg.norm(np.diff(ring, axis=0), axis=1).max() <= 0.25 + 1e-12
    assert all((np.abs(sample - corner).sum(axis=1) < 1e-12).any() for corner in outline)


def test_the_winding_number_is_one_inside_and_zero_outside():
    triangle = np.asarray(ball((1, 2, 3), 2.0, 2).triangles)
    np.testing.assert_allclose(np.abs(winding(np.array([[1, 2, 3], [1.5, 3, 3.5], [1, 2, 6], [-4, 0, 0.0]]), triangle)), [1, 1, 0, 0], atol=1e-9)


def test_the_winding_number_at_the_centre_of_a_hemisphere_is_a_half():
    mesh = trimesh.intersections.slice_mesh_plane(ball((0, 0, 0), 1.0), [0, 1, 0], [0, 0, 0])
    assert abs(winding(np.zeros((1, 3)), np.asarray(mesh.triangles))[0]) == pytest.approx(0.5, abs=1e-6)


CORNERS = tuple(np.arange(-3.0, 3.01, 0.25) for _ in range(3))


def corners():
    return np.stack(np.meshgrid(*CORNERS, indexing="ij"), axis=-1)


@pytest.mark.parametrize("flipped", [False, True])
def test_what_a_closed_mesh_encloses_is_what_lies_inside_it(flipped):
    mesh = ball((0.1, 0.2, -0.1), 1.77)
    if flipped:
        mesh.invert()
    within = np.linalg.norm(corners() - [0.1, 0.2, -0.1], axis=-1)
    clear = np.abs(within - 1.77) > 0.03
    np.testing.assert_array_equal(enclosed(np.asarray(mesh.triangles), CORNERS)[clear], (within < 1.77)[clear])


def test_the_cavity_of_a_shell_is_not_enclosed():
    inner = ball((0, 0, 0), 1.0)
    inner.invert()
    shell = trimesh.util.concatenate([ball((0, 0, 0), 2.0), inner])
    solid = enclosed(np.asarray(shell.triangles), CORNERS)
    within = np.linalg.norm(corners(), axis=-1)
    assert not solid[within < 0.9].any() and solid[(within > 1.1) & (within < 1.9)].all()


def test_two_bodies_that_overlap_are_both_enclosed():
    pair = trimesh.util.concatenate([box((-2, -1, -1), (0.5, 1, 1)), box((-0.5, -1, -1), (2, 1, 1))])
    solid = enclosed(np.asarray(pair.triangles), CORNERS)
    within = (np.abs(corners()) < [2, 1, 1]).all(axis=-1)
    assert solid[within].all()


def test_a_house_without_its_floor_is_enclosed_and_a_wall_encloses_nothing():
    house = open_below(box((-2.1, -2.1, -2.1), (2.1, 2.1, 2.1)))
    assert not house.is_watertight
    np.testing.assert_array_equal(enclosed(np.asarray(house.triangles), CORNERS), (np.abs(corners()) < 2.1).all(axis=-1))
    assert not enclosed(np.asarray(wall(0.3).triangles), CORNERS).any()


def test_beyond_the_grid_the_surface_still_counts():
    mesh = box((-50, -50, -50), (50, 50, 50))
    assert enclosed(np.asarray(mesh.triangles), CORNERS).all()
