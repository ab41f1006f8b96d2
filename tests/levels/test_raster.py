"""Which triangle is seen at each pixel of a parallel view?"""

import numpy as np
import pytest

from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.levels.raster import Seen, View, render, render_both, silhouette
from sketchtree.levels.texels import Pyramid

FRONT = View.round(0.0, [0.0, 0.0, 0.0], 1.0, 100)


def mesh(points, triangle=((0, 1, 2),), *, material=Material("wood"), uv=None, color=None, name="wood"):
    points = np.array(points, float)
    normal = np.tile([[0.0, 0, 1]], (len(points), 1))
    return Mesh(name, points, normal, np.zeros((len(points), 2)) if uv is None else np.array(uv, float), np.array(triangle), material, color)


def square(half=0.5, z=0.0, **given):
    points = [[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]]
    return mesh(points, ((0, 1, 2), (0, 2, 3)), uv=[[0, 1], [1, 1], [1, 0], [0, 0]], **given)


def checked(cutoff=0.5):
    """Left half solid red, right half clear."""
    image = np.zeros((8, 8, 4), np.uint8)
    image[..., 0] = 255
    image[:, :4, 3] = 255
    return Material("leaf", base_color_texture=image, alpha_cutoff=cutoff, double_sided=True)


def test_a_square_of_half_the_width_covers_a_quarter_of_the_pixels():
    seen = silhouette([square()], FRONT)
    assert seen.sum() == 2500 and seen[25:75, 25:75].all()


def test_two_triangles_share_an_edge_without_a_gap_or_an_overlap():
    turned = View.round(0.3, [0.1, 0.05, 0.0], 0.9, 333)
    whole = square()
    halves = [silhouette([mesh(whole.position, (tri,))], turned) for tri in whole.triangle]
    assert not (halves[0] & halves[1]).any()
    assert (silhouette([whole], turned) == (halves[0] | halves[1])).all()


def test_a_random_triangle_covers_as_many_pixels_as_its_area_says():
    rng = np.random.default_rng(0)
    for points in rng.uniform(-0.9, 0.9, (20, 3, 3)):
        e, f = points[1] - points[0], points[2] - points[0]
        area = 0.5 * abs(e[0] * f[1] - e[1] * f[0]) * 50**2
        edge = 50 * sum(np.hypot(*(points[i] - points[j])[:2]) for i, j in ((0, 1), (1, 2), (2, 0)))
        assert abs(silhouette([mesh(points)], FRONT).sum() - area) < 0.5 * edge + 1


def test_what_is_off_the_picture_or_has_no_area_is_left_out():
    assert not silhouette([mesh([[5, 5, 0], [6, 5, 0], [5, 6, 0]])], FRONT).any()
    assert not silhouette([mesh([[0, 0, 0], [0, 0, 1], [0, 0, 2]])], FRONT).any()
    assert silhouette([square(half=50.0)], FRONT).all()


def test_the_nearer_surface_hides_the_farther_one_in_any_order():
    near, far = (square(z=z, color=np.tile([[*shade, 1.0]], (4, 1))) for z, shade in ((0.5, (1, 0, 0)), (-0.5, (0, 1, 0))))
    for order in ([near, far], [far, near]):
        assert render(order, FRONT).color[50, 50].tolist() == [1, 0, 0]
    behind = View.round(np.pi, [0.0, 0, 0], 1.0, 100)
    assert render([near, far], behind).color[50, 50].tolist() == [0, 1, 0]


def test_pixels_with_less_alpha_than_the_cutoff_are_cut_away():
    seen = silhouette([square(material=checked(), name="leaf")], FRONT)
    assert seen[25:75, 25:50].all() and not seen[25:75, 50:75].any()


def test_the_picture_from_a_quarter_turn_shows_x_in_depth():
    side = View.round(np.pi / 2, [0.0, 0, 0], 1.0, 100)
    column, row, depth = side.place(np.array([[0.3, 0.2, 0.4]]))[0]
    assert np.allclose([column, row, depth], [50 - 0.4 * 50, 50 - 0.2 * 50, 0.3])


def test_normals_are_those_of_the_side_that_is_seen():
    back = View.round(np.pi, [0.0, 0, 0], 1.0, 50)
    seen = render([square(material=checked(), name="leaf")], back)
    shown = np.isfinite(seen.depth)
    assert np.allclose(seen.normal[shown], [0, 0, -1]) and not seen.facing[shown].any()


def test_from_afar_a_texture_shows_its_mean():
    image = np.zeros((16, 16, 3), np.uint8)
    image[::2, ::2] = 255
    texels = Pyramid.of(Material("wood", base_color_texture=image))
    assert texels.at(np.array([[0.1, 0.9]]), np.array([1.0]))[0, :3] == pytest.approx(0.25)
    assert set(texels.at(np.random.default_rng(0).random((50, 2)), np.full(50, 1 / 16))[:, 0]) == {0.0, 1.0}


def test_colours_are_averaged_in_linear_light_and_multiplied_by_the_tint():
    image = np.full((4, 4, 3), 188, np.uint8)  # sRGB 188 is half the light
    tint = np.tile([[0.5, 1, 1, 1]], (4, 1))
    seen = render([square(material=Material("wood", base_color_texture=image), color=tint)], FRONT)
    assert np.allclose(seen.color[50, 50], [0.25, 0.5, 0.5], atol=0.005)


def test_odd_textures_have_levels_too():
    texels = Pyramid.of(Material("wood", base_color_texture=np.full((7, 3, 4), 128, np.uint8)))
    assert texels.height.tolist() == [7, 3, 1] and texels.width.tolist() == [3, 1, 1] and texels.has_alpha


def test_both_sides_at_once_are_those_seen_one_by_one():
    rng = np.random.default_rng(3)
    cloud = mesh(rng.uniform(-0.8, 0.8, (90, 3)), np.arange(90).reshape(-1, 3), material=Material("leaf", double_sided=True), color=rng.random((90, 4)))
    for azimuth in (0.0, 0.7):
        views = [View.round(azimuth + turn, [0.0, 0, 0], 1.0, 80) for turn in (0.0, np.pi)]
        for seen, both in zip((render([cloud], view) for view in views), render_both([cloud], views[0]), strict=True):
            for name in Seen.__dataclass_fields__:
                same = np.isclose(getattr(seen, name), getattr(both, name))
                assert same.mean() > 0.995, name  # pixels on an edge may fall to either side
