"""One mesh at many places."""

import numpy as np
from scipy.spatial.transform import Rotation

from sketchtree.geometry.instances import Instances
from sketchtree.geometry.mesh import Material, Mesh

CARD = Mesh(
    "leaf",
    np.array([[0.0, 0, 0], [1, 0, 0], [0, 2, 0]]),
    np.array([[0.0, 0, 1], [0.6, 0, 0.8], [0, 0, 1]]),
    np.array([[0.0, 1], [1, 1], [0, 0]]),
    np.array([[0, 1, 2]]),
    Material("leaf_oak"),
)


def placed(**given):
    rows = dict(translation=np.array([[0.0, 0, 0], [5, 1, 0]]), rotation=np.array([[0.0, 0, 0, 1], [0, 0, np.sqrt(0.5), np.sqrt(0.5)]]), scale=np.array([[1.0, 1, 1], [2, 2, 2]]))
    return Instances(CARD, **(rows | given))


def test_each_row_is_scaled_then_turned_then_moved():
    merged = placed().merged()
    assert np.allclose(merged.position[:3], CARD.position)
    assert np.allclose(merged.position[3:], [[5, 1, 0], [5, 3, 0], [1, 1, 0]])


def test_normals_stay_perpendicular_under_uneven_scale():
    """The inverse transpose, not the scale itself: the normal of a slanted face stays its normal."""
    slanted = Mesh("leaf", np.array([[0.0, 0, 0], [1, 0, -1], [0, 1, 0]]), np.tile([[np.sqrt(0.5), 0, np.sqrt(0.5)]], (3, 1)), CARD.uv, CARD.triangle, CARD.material)
    one = Instances(slanted, np.zeros((1, 3)), np.array([[0.0, 0, 0, 1]]), np.array([[3.0, 1, 1]])).merged()
    assert np.allclose(one.normal @ (one.position[1] - one.position[0]), 0, atol=1e-12)
    assert np.allclose(np.linalg.norm(one.normal, axis=1), 1)


def test_triangles_count_vertices_of_all_rows_before():
    two = placed()
    assert two.merged().triangle.tolist() == [[0, 1, 2], [3, 4, 5]]
    assert two.triangle_count == two.merged().triangle_count == 2


def test_the_rows_colour_multiplies_the_meshs():
    tint = np.array([[0.5, 1, 1, 1], [1, 0.25, 1, 1]])
    assert np.allclose(placed(color=tint).merged().color, np.repeat(tint, 3, axis=0))
    assert placed().merged().color is None


def test_further_columns_are_repeated():
    wind = Mesh(*(getattr(CARD, name) for name in ("name", "position", "normal", "uv", "triangle", "material")), extra={"_WIND": np.array([[0.0], [0.5], [1.0]])})
    assert Instances(wind, np.zeros((2, 3)), np.tile([[0.0, 0, 0, 1]], (2, 1)), np.ones((2, 3))).merged().extra["_WIND"].ravel().tolist() == [0, 0.5, 1, 0, 0.5, 1]


def test_no_rows_make_an_empty_mesh():
    none = Instances(CARD, np.zeros((0, 3)), np.zeros((0, 4)), np.zeros((0, 3))).merged()
    assert none.triangle_count == 0 and none.position.shape == (0, 3)


def test_rotations_are_quaternions_with_the_scalar_last():
    turn = Rotation.from_rotvec([0, np.pi / 2, 0])
    one = Instances(CARD, np.zeros((1, 3)), turn.as_quat()[None], np.ones((1, 3))).merged()
    assert np.allclose(one.position, turn.apply(CARD.position))
