import numpy as np
import pytest
from drawn import box, closed, cloud, drawing, edge, graph_of, measured, painted, ring, roles, wedge

from sketchtree.sketch.roles.crown import closed_crowns, has_area, outline
from sketchtree.sketch.strokes import Stroke

STEM = [(0, 0), (0, 60)]


def found(*things):
    m, free = measured(*things)
    return {one.row: one.role for one in closed_crowns(m, free, free)}


@pytest.mark.parametrize("crown", [ring(40), cloud(40), closed(ring(40)[:-1]), ring(40, begin=-1.4, end=1.5 * np.pi), painted(cloud(40)[:-1])])
def test_an_outline_around_the_tip_is_a_crown(crown):
    assert found(STEM, crown) == {1: "crown"}


@pytest.mark.parametrize(
    "other",
    [
        ring(40, begin=0.1, end=np.pi - 0.1),  # an open arch
        ring(25, centre=(0, 0)),  # at the foot
        [(-50, 70), (50, 74), (50, 76), (-50, 72), (-50, 70)],  # a thin loop
        ring(30, centre=(110, 80)),  # around no tip
        ring(4, centre=(0, 62)),  # a bud
    ],
)
def test_other_closed_lines_are_none(other):
    assert 1 not in found(STEM, other)


def test_several_outlines_on_limbs_of_their_own_are_crowns_together():
    limbs = [[(0, 0), (0, 90)], [(0, 50), (40, 85)], [(0, 45), (-38, 80)]]
    assert found(*limbs, ring(18, (0, 105)), ring(18, (52, 95)), ring(18, (-50, 90))) == {3: "crown", 4: "crown", 5: "crown"}


def test_a_lobe_that_is_less_closed_than_those_beside_it_is_one_of_them():
    lobes = [ring(20, (-30, 80)), ring(20, (30, 80)), ring(20, (0, 95), begin=-1.0, end=1.3 * np.pi)]
    assert found([(-5, 0), (-30, 80)], [(5, 0), (30, 80)], *lobes) == {2: "crown", 3: "crown", 4: "crown"}


@pytest.mark.parametrize("made", [closed, painted, lambda points: np.vstack([points, points[:1]])])
def test_tiers_that_overlap_are_one_fir(made):
    graph = graph_of(*(made(wedge(*tier)) for tier in ((100, 40, 60), (80, 75, 55), (60, 110, 50))), [(-8, 0), (-8, 40)], [(8, 40), (8, 0)])
    assert len(graph.crown) == 3 and len(graph.limb_id) == 1
    assert graph.xy[:, 1].max() > 140, "the trunk is carried on through all tiers"
    assert np.abs(graph.xy[:, 0]).max() < 1


def test_small_shapes_on_a_painted_fir_are_no_wood():
    star = ring(9, (0, 162), 9)
    baubles = [painted(ring(4, place, 12), "b") for place in ((-20, 60), (10, 95), (5, 130))]
    graph = graph_of(*(painted(wedge(*tier)) for tier in ((100, 40, 60), (80, 75, 55), (60, 110, 50))), painted(box(18, 44)), painted(star), *baubles)
    assert {roles(graph)[f"s{k}"] for k in (4, 5, 6, 7)} == {"leaves"}
    assert len(graph.limb_id) == 1 and graph.xy[0] == pytest.approx((0, 0), abs=1)


def test_a_trunk_painted_as_a_rectangle_is_no_crown_and_stands():
    for size in ((22, 45), (18, 75)):
        graph = graph_of(painted(ring(40, (0, size[1] + 35))), painted(box(*size)))
        assert roles(graph) == {"s0": "crown"} and len(graph.limb_id) == 1
        assert graph.width[-1] == pytest.approx(size[0], rel=0.1)


def test_a_dome_on_the_ground_is_closed_by_it():
    graph = graph_of(ring(45, (0, 0), begin=0, end=np.pi), [(-80, -1), (80, 0)])
    assert len(graph.crown) == 1 and len(graph.ground) == 1 and graph.segment_count == 1


def test_a_small_round_crown_on_a_long_stick_is_no_loop():
    graph = graph_of(ring(20, (0, 130)), [(0, 0), (0, 112)])
    assert len(graph.crown) == 1 and len(graph.limb_id) == 1


def test_an_outline_s_first_point_is_not_repeated():
    assert len(outline(np.array([(0, 0), (1, 0), (1, 0), (0, 1), (0, 0)], float))) == 3
    assert not has_area(Stroke("a", np.array([(0, 0), (1, 1), (2, 2)], float)))


def test_a_crown_around_two_edges_is_found_though_they_end_below_it():
    sketch = drawing(cloud(40), edge(-8, high=34), edge(8, high=34))
    assert roles(graph_of(*sketch.strokes)) == {"s0": "crown"}


def test_the_painted_leaves_of_a_palm_are_limbs():
    t = np.linspace(0, 1, 30)

    def frond(x, y, width=8.0):
        middle = np.c_[x * t, 100 + 25 * np.sin(np.pi * t) + (y - 100) * t]
        half = np.c_[np.zeros(30), width * np.sin(np.pi * t)]
        return painted(np.vstack([middle + half, (middle - half)[::-1]]))

    graph = graph_of(painted([(-6, 0), (6, 0), (4, 100), (-4, 100)]), *(frond(*tip) for tip in ((60, 80), (-60, 80), (45, 115), (-45, 115))))
    assert graph.crown == () and graph.is_base.sum() == 1 and len(graph.limb_id) in (4, 5)


def test_a_tall_painted_ellipse_is_a_poplar_s_crown():
    graph = graph_of(painted(ring(18, (-60, 110), high=70)[:-1]), painted(ring(18, (60, 110), high=70)[:-1]), [(-60, 0), (-60, 45)], [(60, 0), (60, 45)])
    assert len(graph.crown) == 2 and len(graph.limb_id) == 2
