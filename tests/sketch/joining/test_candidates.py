"""Which lines are tried for every end, held to all distances of a small drawing."""

import numpy as np
import pytest
import shapely
from little_lines import line, lines, random_lines

from sketchtree.sketch.joining import candidates
from sketchtree.sketch.joining.bundle import Bundle
from sketchtree.sketch.joining.candidates import FOOT, LIKELY, NEAREST, TOUCHES, bridging_arcs, candidate_arcs, foot_reach, nearest_places

ROOT = np.array([0.0, 0.0])


def distances(made):
    """(end, line) distance of every end from every line; infinite from its own."""
    table = np.array([[one.shape.distance(shapely.Point(p)) for one in made] for other in made for p in other.points[[0, -1]]])
    table[np.arange(2 * len(made)), np.repeat(np.arange(len(made)), 2)] = np.inf
    return table


@pytest.mark.parametrize(("seed", "count"), [(0, 2), (1, 9), (2, 40), (3, 60)])
def test_the_nearest_places_are_the_nearest(seed, count):
    made = random_lines(seed, count)
    places, table = nearest_places(Bundle.of(made)), distances(made)
    wanted = min(NEAREST, count - 1)
    for end in range(2 * count):
        mine = 2 * places.child + places.end == end
        assert np.sort(places.gap[mine])[:wanted] == pytest.approx(np.sort(table[end])[:wanted], abs=1e-9)
        assert places.gap[mine] == pytest.approx(table[end][places.parent[mine]], abs=1e-9)
        assert mine.sum() == wanted or places.gap[mine].max() <= TOUCHES * 110


def test_a_place_is_the_nearest_point_of_its_line():
    made = random_lines(4, 12)
    bundle = Bundle.of(made)
    places = nearest_places(bundle)
    point = bundle.at(places.parent, places.s)
    assert np.hypot(*(point - bundle.ends[2 * places.child + places.end]).T) == pytest.approx(places.gap, abs=1e-7)


def test_where_many_touch_one_point_more_are_tried():
    star = [[(0, 0), (30 * np.cos(a), 30 * np.sin(a))] for a in np.linspace(0, 2 * np.pi, 40, endpoint=False)]
    places = nearest_places(Bundle.of(lines(*star)))
    assert ((places.child == 0) & (places.end == 0)).sum() == 39
    assert ((places.child == 0) & (places.end == 1)).sum() == NEAREST


def test_in_a_drawing_of_many_fewer_are_tried(monkeypatch):
    monkeypatch.setattr(candidates, "MANY", 30)
    places = nearest_places(Bundle.of(random_lines(5, 31)))
    per_end = np.bincount(2 * places.child + places.end)
    assert np.median(per_end) == NEAREST // 2


def test_one_line_alone_has_no_places():
    places = nearest_places(Bundle.of(lines([(0, 0), (0, 10)])))
    assert len(places.child) == 0


@pytest.mark.parametrize("seed", range(3))
def test_of_every_line_the_cheapest_arcs_are_kept(seed, monkeypatch):
    bundle = Bundle.of(random_lines(seed, 30))
    arcs, slip = candidate_arcs(bundle, ROOT)
    monkeypatch.setattr(candidates, "LIKELY", 10**6)
    every, same = candidate_arcs(bundle, ROOT)
    assert slip == same and len(every.child) > len(arcs.child)
    for child in range(30):
        cost = np.sort(every.cost(slip)[every.child == child].min(1))
        assert np.sort(arcs.cost(slip)[arcs.child == child].min(1)).tolist() == cost[:LIKELY].tolist()


def test_the_arcs_kept_stay_in_their_order():
    bundle = Bundle.of(random_lines(1, 20))
    arcs, _ = candidate_arcs(bundle, ROOT)
    assert (np.diff(2 * arcs.child + arcs.end) >= 0).all()


def test_a_coarser_hand_pays_less_for_what_it_misses():
    arcs, _ = candidate_arcs(Bundle.of(random_lines(2, 20)), ROOT)
    fine, coarse = arcs.cost(0.003), arcs.cost(0.03)
    assert (coarse <= fine).all() and (coarse < fine).any()
    assert (fine[:, 1] - fine[:, 0]) == pytest.approx(arcs.base[:, 1] - arcs.base[:, 0])


def test_bridges_lead_from_every_end_of_a_group_to_the_nearest_line_outside_it():
    made = random_lines(6, 14)
    inside = np.arange(14) >= 9
    arcs, table = bridging_arcs(Bundle.of(made), inside, ROOT), distances(made)
    assert sorted(set((2 * arcs.child + arcs.end).tolist())) == [end for end in range(28) if inside[end // 2]]
    assert not inside[arcs.parent].any()
    assert arcs.gap == pytest.approx(table[:, ~inside].min(1)[2 * arcs.child + arcs.end])


def test_arcs_are_joined_column_by_column():
    arcs, _ = candidate_arcs(Bundle.of(random_lines(2, 6)), ROOT)
    both = arcs.joined(arcs)
    assert both.child.tolist() == arcs.child.tolist() * 2 and both.base.shape == (2 * len(arcs.child), 2)


@pytest.mark.parametrize(
    ("width", "length", "reach"), [(np.nan, 100, 100 * FOOT), (2.0, 100, 2.0), (0.1, 100, 100 * FOOT), (np.nan, 1, 0.3), (50.0, 20, 6.0)]
)
def test_at_the_foot_is_within_little_of_h_or_within_the_ink_but_never_most_of_the_line(width, length, reach):
    assert foot_reach(line([(0, 0), (0, length)], width=width), 100.0) == pytest.approx(reach)
