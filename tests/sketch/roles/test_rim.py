import numpy as np
import pytest
from drawn import measured, ring

from sketchtree.sketch.joining.cleaning import as_line
from sketchtree.sketch.roles.rim import pieces_of_rims, without_rims

CROWN = ring(40)


def line(points):
    return as_line(0, "a", np.asarray(points, float), np.nan)


def test_a_line_that_runs_up_a_trunk_and_along_the_crown_is_cut_where_it_leaves_the_trunk():
    along = line(np.vstack([[(0, 0), (0, 20), (0, 39)], ring(40)[:25]]))
    (kept,), cut = without_rims([along], [CROWN])
    assert cut == [along] and kept.points[:, 1].max() < 52 and kept.points[0] == pytest.approx((0, 0))


def test_a_line_all_along_it_is_dropped():
    (kept, cut) = without_rims([line(ring(41)[:30])], [CROWN])
    assert kept == [] and len(cut) == 1


@pytest.mark.parametrize("points", [[(0, 0), (0, 119)], [(0, 50), (38, 80)], [(-60, 60), (60, 100)]])
def test_limbs_that_meet_or_cross_the_outline_are_whole(points):
    limb = line(points)
    assert without_rims([limb], [CROWN]) == ([limb], [])


def test_without_a_crown_nothing_is_cut():
    limb = line([(0, 0), (0, 100)])
    assert without_rims([limb], []) == ([limb], [])


def test_a_loose_stroke_along_the_outline_is_a_piece_of_it_and_a_twig_at_it_is_not():
    piece, twig, across = ring(41)[20:24], [(20, 80), (40, 82)], [(36, 95), (46, 99)]
    m, free = measured(CROWN, [(0, 0), (0, 60)], piece, twig, across)
    wood = np.array([False, True, True, True, True])
    assert [one.row for one in pieces_of_rims(m, wood, wood, [CROWN])] == [2]
    held = np.vstack([[(0, 60)], ring(41)[20:24]])
    m, free = measured(CROWN, [(0, 0), (0, 60)], held)
    assert pieces_of_rims(m, np.array([False, True, True]), np.array([False, True, True]), [CROWN]) == []
