import numpy as np
import pytest
import shapely
from drawn import ring, scribble

from sketchtree.sketch.roles.masses import border, bulk_and_trunk, mass


def test_a_scribble_covers_the_space_it_runs_through():
    area = mass(scribble())
    assert 0.6 * np.pi * 40**2 < area.area < 1.4 * np.pi * 40**2
    assert area.centroid.y == pytest.approx(90, abs=6)


def test_a_straight_line_covers_next_to_nothing():
    assert mass(np.array([(0, 0), (0, 100)], float)).area < 0.02 * 100**2


@pytest.mark.parametrize("scale", [1.0, 50.0])
def test_a_tree_in_one_piece_falls_into_crown_and_trunk(scale):
    tree = shapely.union_all([shapely.Polygon(ring(40)), shapely.box(-6, 0, 6, 60)])
    crown, (trunk,) = bulk_and_trunk(shapely.transform(tree, lambda p: p * scale))
    assert crown.centroid.y == pytest.approx(80 * scale, rel=0.05) and trunk.bounds[1] == pytest.approx(0)
    assert trunk.bounds[2] - trunk.bounds[0] == pytest.approx(12 * scale, rel=0.1)


@pytest.mark.parametrize("area", [shapely.Polygon(ring(40)), shapely.box(-6, 0, 6, 100), shapely.union_all([shapely.Polygon(ring(40, (0, 40))), shapely.box(-5, 60, 5, 140)])])
def test_a_disc_a_stick_and_a_balloon_upside_down_are_none(area):
    assert bulk_and_trunk(area) == (None, [])


def test_a_border_does_not_repeat_its_first_point():
    points = border(shapely.Polygon(ring(40)))
    assert np.hypot(*(points[0] - points[-1])) > 0 and len(points) < 40


def test_a_crown_keeps_its_points():
    fir = shapely.Polygon([(-8, 0), (8, 0), (8, 30), (50, 30), (20, 70), (35, 70), (0, 130), (-35, 70), (-20, 70), (-50, 30), (-8, 30)])
    crown, (trunk,) = bulk_and_trunk(fir)
    assert crown.bounds == pytest.approx((-50, 30, 50, 130), abs=2.5) and trunk.bounds[3] == pytest.approx(30, abs=2.5)
