import numpy as np
import pytest
from drawn import cloud, graph_of, ring, wedge

from sketchtree.sketch.joining.cleaning import as_line
from sketchtree.sketch.roles.implied import carried_on, implied_stems, merged

FIR = np.array([(-10, 30), (-50, 30), (-25, 60), (-38, 60), (-15, 95), (-25, 95), (0, 140), (25, 95), (15, 95), (38, 60), (25, 60), (50, 30), (10, 30)], float)
TRUNK = as_line(1, "t", np.array([(0, 0), (0, 30)], float), np.nan)


def test_a_bush_stands_on_an_implied_stem_and_a_warning_says_so():
    graph = graph_of(cloud(40, (7, 40)))
    assert graph.segment_count == 1 and graph.xy[0, 0] == pytest.approx(7, abs=2)
    assert "Draw a trunk to say otherwise" in " ".join(graph.warnings)


def test_the_stem_stands_on_the_ground_where_one_is_drawn():
    for level in (-10.0, 4.0):
        ((stem,), _) = implied_stems([ring(40, (0, 40))], [np.array([(-90, level), (90, level)])], 0, "c")
        assert stem.points[0] == pytest.approx((0, level)) and 40 < stem.points[-1, 1] < 60


def test_every_crown_has_one():
    stems, (warning,) = implied_stems([ring(20, (-50, 20)), ring(25, (50, 25))], [], 0, "c")
    assert [stem.points[0, 0] for stem in stems] == pytest.approx([-50, 50], abs=1) and "stems were put" in warning


def test_a_fir_s_trunk_runs_on_to_near_its_top():
    (_, leader), (warning,) = carried_on([TRUNK], [FIR], 0, "c")
    assert leader.points[0] == pytest.approx((0, 30)) and 125 < leader.points[-1, 1] < 140
    assert "carried on" in warning


@pytest.mark.parametrize("crown", [cloud(45), wedge(200, 30, 60), FIR * (1, -1) + (0, 170)])
def test_round_low_and_upturned_crowns_carry_none(crown):
    assert carried_on([TRUNK], [crown], 0, "c") == ([TRUNK], [])


def test_nor_does_one_with_limbs_drawn_inside_or_two_trunks():
    limb = as_line(2, "l", np.array([(0, 50), (0, 110)], float), np.nan)
    second = as_line(2, "u", np.array([(10, 0), (10, 28)], float), np.nan)
    for lines in ([TRUNK, limb], [TRUNK, second]):
        assert carried_on(lines, [FIR], 0, "c")[1] == []


def test_overlapping_outlines_are_one_and_others_stay():
    assert len(merged([wedge(100, 40, 60), wedge(80, 75, 55)])) == 1
    apart = [ring(20, (-50, 20)), ring(25, (50, 25))]
    assert merged(apart) is apart
