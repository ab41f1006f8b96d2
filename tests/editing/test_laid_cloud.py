"""Points of a scan lie behind the drawing: where, how many, and what says how deep strokes over them are."""

import numpy as np
import pytest

import sketchtree as st
from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.prepared.prepare import prepare
from sketchtree.editing import laid_cloud
from sketchtree.editing.document import Document
from sketchtree.editing.laid_cloud import CloudChoices, LaidCloud, laid, laid_under
from sketchtree.editing.seen import with_seen, with_seen_from
from sketchtree.errors import OptionError, SketchError
from sketchtree.sketch.strokes import Stroke


def scan(height: float = 8.0, points: int = 3000, radius: float = 0.2, *, colour=None):
    """A post: points round an upright stem."""
    chance = np.random.default_rng(0)
    up, turn = chance.uniform(0, height, points), chance.uniform(0, 2 * np.pi, points)
    return prepare(PointCloud(np.stack([radius * np.cos(turn), up, radius * np.sin(turn)], axis=1), colour), up="y")


@pytest.fixture(scope="module")
def post():
    return laid(scan())


def drawn(*lines) -> list[Stroke]:
    return [Stroke(f"s{k}", np.array(line, float)) for k, line in enumerate(lines)]


def test_alone_the_points_stand_at_the_page_s_origin_as_high_as_a_page():
    cloud = laid(scan())
    assert (cloud.x, cloud.y) == (0.0, 0.0)
    assert cloud.height * cloud.unit == pytest.approx(800)


def test_behind_a_drawing_foot_and_height_are_those_of_the_drawn_branches(post):
    strokes = drawn([(50, 20), (52, 300), (48, 420)], [(52, 300), (200, 380)])
    cloud = laid_under(post, strokes)
    assert (cloud.x, cloud.y) == (50, 20)
    assert cloud.height * cloud.unit == pytest.approx(400)
    assert cloud.points is post.points


def test_strokes_of_other_pages_and_scribbles_say_nothing_of_where_it_stands(post):
    turned = Stroke("t", np.array([(0.0, -500), (0, 900)]), view_deg=90.0)
    cloud = laid_under(post, [*drawn([(0, 0), (0, 100)]), turned])
    assert cloud.y == 0 and cloud.height * cloud.unit == pytest.approx(100)


def test_the_points_are_those_of_the_scan(post):
    assert len(post) == len(scan().cloud) and not post.coloured
    assert np.abs(post.cloud.xyz - scan().cloud.xyz).max() < 1e-6
    assert np.allclose(post.on_page, post.cloud.xyz * post.unit, atol=1e-3)


def test_colours_come_along():
    colour = np.tile([1.0, 0.5, 0.0], (3000, 1))
    cloud = laid(scan(colour=colour))
    assert cloud.coloured and np.allclose(cloud.cloud.colour, colour[:1], atol=1 / 255)


def test_of_more_points_some_are_kept_spread_evenly_and_that_is_said(monkeypatch):
    monkeypatch.setattr(laid_cloud, "MOST", 1000)
    cloud = laid(scan())
    assert 500 < len(cloud) <= 1000
    assert cloud.remarks[-1] == f"The drawing keeps {len(cloud):,} of the tree's {len(scan().cloud):,} points, spread evenly."


def test_the_trunk_is_as_thick_as_its_points_say(post):
    assert post.trunk == pytest.approx(0.2, rel=0.05)


def test_what_are_no_points_is_refused(post):
    for points in (b"", b"12345", np.full(3, np.nan, "<f4").tobytes()):
        with pytest.raises(SketchError, match="^The points behind the drawing can't be read. Open their cloud again.$"):
            LaidCloud(points, False, 0, 0, 1)
    for place in ((0, 0, 0), (np.inf, 0, 1)):
        with pytest.raises(OptionError, match="^The cloud lies nowhere. Lay it under the drawing again.$"):
            LaidCloud(post.points, False, *place)
    with pytest.raises(OptionError, match="^A point of 9 pixels is out of range. Choose 0.5 to 8.$"):
        CloudChoices(size=9)


def test_the_drawn_tree_hangs_on_the_points_but_not_on_how_they_are_seen(post):
    document = Document(cloud=post, points=CloudChoices(traced=True, size=3))
    assert document.drawn.cloud is post
    assert document.points.drawn == CloudChoices(size=3)


def graph_of(strokes):
    return st.sketch_graph(st.Sketch(tuple(strokes))).above_ground()


def test_a_factor_has_the_points_from_the_first_base(post):
    strokes = drawn([(50, 20), (50, 420)])
    cloud = laid_under(post, strokes)
    seen = with_seen(st.Elevation(), cloud, graph_of(strokes)).factors["seen"].points
    assert np.allclose(seen, cloud.on_page - (50, 20, 0))


def test_of_a_turned_page_they_are_turned_about_the_root_s_axis(post):
    strokes = drawn([(50, 20), (50, 420)])
    cloud = laid_under(post, strokes)
    seen = with_seen_from(st.Elevation(), cloud, graph_of(strokes), 90.0, 50.0, 7.0).factors["seen"].points
    front = cloud.on_page
    assert np.allclose(seen, np.stack([-front[:, 2], front[:, 1] - 20, front[:, 0] - 50 - 7.0], axis=1))


def test_methods_without_factors_do_not_hear_of_them(post):
    from sketchtree.mrf.methods import solver_named

    flat = solver_named("flat")
    assert with_seen(flat, post, graph_of(drawn([(0, 0), (0, 100)]))) is flat


def test_without_points_nothing_is_different():
    solver = st.Elevation()
    assert with_seen(solver, None, graph_of(drawn([(0, 0), (0, 100)]))) is solver


def test_that_points_are_not_heard_of_is_said(post):
    from sketchtree.drawn_tree import draw_out
    from sketchtree.options import ReadingOptions

    strokes = drawn([(0, 0), (0, 400)], [(0, 200), (90, 300)])
    made = draw_out(st.Sketch(tuple(strokes)), key=st.root_key(0), options=ReadingOptions(template="none", method="flat"), cloud=laid_under(post, strokes))
    assert "The method `flat` does not hear of the points behind the drawing; `elevation` does." in made.warnings
    assert made.skeleton.radius[made.skeleton.is_base].max() == pytest.approx(post.trunk, rel=0.1)
