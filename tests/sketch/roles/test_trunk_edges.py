import numpy as np
import pytest
from drawn import box, cloud, edge, graph_of, ring, roles

from sketchtree.sketch.joining.cleaning import as_line
from sketchtree.sketch.roles.trunk_edges import trunks_of_edges

CROWN = ring(40)


def lines(*points):
    return [as_line(k, f"s{k}", np.asarray(line, float), np.nan) for k, line in enumerate(points)]


def test_two_edges_under_a_crown_are_one_trunk_as_wide_as_they_are_apart():
    trunks = trunks_of_edges(lines(edge(-8), edge(8)), [CROWN])
    (middle,) = trunks.lines
    assert np.abs(middle.points[:, 0]).max() < 1e-6
    assert np.interp(40, middle.points[:, 1], middle.width) == pytest.approx(16, abs=1)
    assert [other.id for _, other in trunks.sides] in (["s0"], ["s1"])


def test_direction_and_order_of_the_edges_do_not_matter():
    one = trunks_of_edges(lines(edge(-8), edge(8)), [CROWN]).lines[0]
    other = trunks_of_edges(lines(edge(8)[::-1], edge(-8)), [CROWN]).lines[0]
    np.testing.assert_allclose(one.at(np.linspace(0, one.length, 9)), other.at(np.linspace(0, other.length, 9)), atol=1e-9)


@pytest.mark.parametrize("far", [60, 90])
def test_stems_far_apart_or_parting_are_two(far):
    apart = [(-far / 2, 0), (-far / 2, 45)], [(far / 2, 0), (far / 2, 45)]
    parting = [(-3, 0), (-far / 2, 45)], [(3, 0), (far / 2, 45)]
    for pair in (apart, parting):
        assert len(trunks_of_edges(lines(*pair), []).lines) == 2


def test_without_a_crown_the_edges_must_be_close_and_even():
    assert len(trunks_of_edges(lines([(-6, 0), (-6, 90)], [(6, 0), (6, 90)]), []).lines) == 1
    assert len(trunks_of_edges(lines([(-20, 0), (-20, 90)], [(20, 0), (20, 90)]), []).lines) == 2


def test_what_is_drawn_between_the_edges_is_bark():
    graph = graph_of(CROWN, edge(-12), edge(12), [(-3, 8), (-3, 30)], [(4, 12), (4, 34)])
    assert roles(graph) == {"s0": "crown", "s3": "hatching", "s4": "hatching"} and len(graph.limb_id) == 1


def test_an_edge_may_be_drawn_in_two_pieces():
    left = edge(-8)
    graph = graph_of(CROWN, left[:3], left[2:], edge(8))
    assert len(graph.limb_id) == 1 and np.abs(graph.xy[:, 0]).max() < 1.5


def test_one_line_down_along_the_ground_and_up_draws_both():
    graph = graph_of(CROWN, [(-8, 42), (-8, 0), (8, 0), (8, 42)])
    assert len(graph.limb_id) == 1 and graph.width[-1] == pytest.approx(16, abs=1)


def test_limbs_that_start_at_the_top_of_a_bare_trunk_hang_on_its_middle():
    graph = graph_of(edge(-7, high=70, flare=3), edge(7, high=70, flare=3), [(-7, 70), (-40, 120)], [(7, 70), (45, 110)], [(0, 70), (3, 130)])
    assert graph.is_base.sum() == 1 and len(graph.limb_id) == 3
    assert graph.xy[0, 0] == pytest.approx(0, abs=1)


def test_trees_side_by_side_have_a_trunk_each():
    one, two = np.array([-60.0, 0.0]), np.array([60.0, 0.0])
    graph = graph_of(cloud(30) + one, edge(-6) + one, edge(6) + one, cloud(35, (0, 90)) + two, edge(-6, high=52) + two, edge(6, high=52) + two)
    assert len(graph.crown) == 2 and graph.is_base.sum() == 2 and len(graph.limb_id) == 2
    assert sorted(graph.xy[graph.is_base][:, 0].round()) == [-60, 60]


def test_edges_wider_than_their_length_are_no_trunk():
    corners = box(80, 45)
    assert len(trunks_of_edges(lines(corners[[0, 3]], corners[[1, 2]]), [CROWN]).lines) == 2


def test_a_short_line_across_the_top_of_a_trunk_is_no_limb():
    graph = graph_of(cloud(40), edge(-12), edge(12), [(-11, 46), (11, 47)])
    assert len(graph.limb_id) == 1 and roles(graph)["s3"] == "hatching"


def test_two_limbs_from_one_place_are_no_trunk_without_a_crown():
    left, right = [(0, 0), (-9, 25), (-10, 60), (-9, 90)], [(0, 0), (9, 25), (10, 60), (9, 90)]
    assert len(trunks_of_edges(lines(left, right), []).lines) == 2


def test_a_side_gone_over_again_outside_the_trunk_is_bark():
    graph = graph_of(CROWN, edge(-16, high=60), edge(16, high=60), [(18.9, 30), (19.0, 40), (18.9, 52)])
    assert roles(graph) == {"s0": "crown", "s3": "hatching"} and len(graph.limb_id) == 1
    assert next(role for role in graph.roles if role.stroke == "s3").reason.endswith("or along one")


def test_a_limb_that_leaves_a_side_is_no_bark():
    graph = graph_of(CROWN, edge(-12), edge(12), [(12.5, 20.0), (14.0, 28.0), (24.0, 40.0)])
    assert roles(graph) == {"s0": "crown"} and len(graph.limb_id) == 2
