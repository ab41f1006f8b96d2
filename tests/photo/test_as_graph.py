"""Traced limbs become the drawing that strokes on paper would be."""

import jax
import numpy as np
import pytest

from painted import CROWN, bare_tree, distance, marked, walked
from sketchtree.axes import NULL
from sketchtree.limb_ids import stroke_limb_id
from sketchtree.photo.as_graph import as_drawing
from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import turned_over
from sketchtree.photo.trace.trace import Tracing
from sketchtree.photo.trace.traced import Traced

KEY = jax.random.key(0)


@pytest.fixture(scope="module")
def traced():
    return Tracing()(bare_tree(), marked("left"), key=KEY)


def test_the_graph_shows_every_traced_joint_as_a_node_or_on_a_curve(traced):
    _, graph = as_drawing([(traced, marked("left"))], "painted")
    points = turned_over(np.concatenate([graph.xy, graph.curve_points]))
    assert len(points) == len(traced)
    np.testing.assert_array_equal(np.sort(points, axis=0), np.sort(traced.xy, axis=0))


def test_a_limb_is_named_by_its_stroke_and_what_was_found_by_what_it_grows_from(traced):
    sketch, graph = as_drawing([(traced, marked("left"))], "painted")
    ids = [stroke.id for stroke in sketch.strokes]
    assert ids[:1] == ["trunk"] and "left" in ids and "trunk.1" in ids and "left.1" in ids and ids[-1] == "crown1"
    assert graph.limb_id[0] == stroke_limb_id("trunk")
    assert {a.stroke: a.parent for a in graph.attachments}["left"] == "trunk"


def test_a_stroke_more_leaves_the_names_of_other_strokes(traced):
    more = Tracing()(bare_tree(), marked("left", "right"), key=KEY)
    _, graph = as_drawing([(more, marked("left", "right"))], "painted")
    assert {stroke_limb_id(name) for name in ("trunk", "left", "right")} <= set(graph.limb_id.tolist())


def test_one_base_one_trunk_and_the_crown_round_it(traced):
    _, graph = as_drawing([(traced, marked("left"))], "painted")
    assert graph.is_base.sum() == 1 and graph.limb_order[0] == 0 and (graph.limb_order[1:] > 0).all()
    np.testing.assert_array_equal(graph.crown[0], turned_over(np.array(CROWN, float)))
    assert graph.width_is_wood and graph.width[0] == pytest.approx(2 * traced.radius[0])


def test_the_sketch_read_as_a_drawing_is_the_same_tree(traced):
    """The strokes alone, given to `sketchtree build`, make the same limbs."""
    from sketchtree.sketch.reading import sketch_graph

    sketch, graph = as_drawing([(traced, marked("left"))], "painted")
    read = sketch_graph(sketch)
    assert len(read.limb_id) == len(graph.limb_id)
    line = np.concatenate([walked(graph.curve(row)) for row in np.flatnonzero(graph.parent != NULL)])
    again = np.concatenate([walked(read.curve(row)) for row in np.flatnonzero(read.parent != NULL)])
    assert np.max(distance(line, again)) < 6


def test_two_trees_in_one_photo_share_no_name():
    first = Traced(np.array([NULL, 0]), np.array([(100.0, 500.0), (100.0, 300.0)]), np.ones(2), np.zeros(2, int), np.zeros(2, int), np.ones(2, bool))
    second = Traced(np.array([NULL, 0]), np.array([(400.0, 500.0), (400.0, 300.0)]), np.ones(2), np.zeros(2, int), np.zeros(2, int), np.ones(2, bool))
    own = Marked(np.array([(0.0, 0.0), (9.0, 0.0), (9.0, 9.0)]), (first.xy,), ("trunk",))
    sketch, graph = as_drawing([(first, own), (second, own)], "two")
    assert len({stroke.id for stroke in sketch.strokes}) == len(sketch.strokes) == 4
    assert graph.tree.tolist() == [0, 0, 1, 1] and graph.parent.tolist() == [NULL, 0, NULL, 2] and len(set(graph.limb_id.tolist())) == 2
