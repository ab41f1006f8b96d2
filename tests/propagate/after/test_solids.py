import numpy as np
import pytest
import trimesh

from sketchtree.propagate.after.solids import Solid
from sketchtree.propagate.space.surface import winding


def overlapping():
    moved = trimesh.transformations.translation_matrix([0.5, 0.4, 0.3])
    return trimesh.util.concatenate([trimesh.creation.box((1, 1, 1)), trimesh.creation.box((1, 1, 1), transform=moved)])


MESHES = {
    "box": lambda: trimesh.creation.box((2, 3, 4)),
    "ball": lambda: trimesh.creation.icosphere(3, 1.5),
    "ring": lambda: trimesh.creation.torus(1.0, 0.4),
    "two boxes that overlap": overlapping,
    "inside out": lambda: trimesh.Trimesh(trimesh.creation.icosphere(2, 1.5).vertices, trimesh.creation.icosphere(2, 1.5).faces[:, ::-1]),
}


@pytest.mark.parametrize("name", MESHES)
def test_it_agrees_with_the_winding_number_by_solid_angles(name):
    triangles = MESHES[name]().triangles
    point = np.random.default_rng(3).uniform(-2.2, 2.2, (3000, 3))
    inside = Solid.from_triangles(triangles).inside(point)
    np.testing.assert_array_equal(inside, np.abs(winding(point, triangles)) > 0.5)
    assert 0 < inside.sum() < len(point)


def test_a_line_through_shared_edges_and_corners_meets_one_triangle():
    """Right above each other: the middles and corners of the faces of a box whose faces are cut in four."""
    solid = Solid.from_triangles(trimesh.creation.box((2, 2, 2)).subdivide().triangles)
    x, z = np.meshgrid([-0.5, 0.0, 0.5, 0.25], [-0.5, 0.0, 0.5])
    inside = np.column_stack([x.ravel(), np.full(x.size, 0.1), z.ravel()])
    assert solid.inside(inside).all()
    assert not solid.inside(inside + [0, 1.0, 0]).any() and not solid.inside(inside - [0, 1.2, 0]).any()


def test_no_points_are_nowhere():
    assert len(Solid.from_triangles(MESHES["box"]().triangles).inside(np.zeros((0, 3)))) == 0
