import numpy as np

from sketchtree.foliage.outline import closed, inside, smooth
from sketchtree.foliage.venation import branching, midrib, parallel, pinnate, reaching

OUTLINE = closed(smooth([(0, 0), (0.2, 0.2), (0.3, 0.5), (0.1, 0.9), (0, 1)]))


def test_the_midrib_starts_at_the_petioles_end():
    assert midrib(0.3, 0.02).path[0].tolist() == [0.0, -0.3]


def test_laterals_come_in_pairs_and_end_within_the_blade():
    veins = pinnate(OUTLINE, 6, first=0.1, last=0.8, angle=50.0, bend=15.0, width=0.01)
    assert len(veins) == 12
    assert all(inside(vein.path[1:], OUTLINE).all() for vein in veins)


def test_laterals_lean_towards_the_tip():
    for vein in pinnate(OUTLINE, 6, first=0.1, last=0.8, angle=50.0, bend=15.0, width=0.01):
        assert vein.path[-1, 1] > vein.path[0, 1]


def test_veins_reach_the_places_they_are_sent_to_on_both_sides():
    right, left = reaching([(0.2, 0.25, 0.5)], 0.01)
    assert np.allclose(right.path[-1], (0.25, 0.5)) and np.allclose(left.path[-1], (-0.25, 0.5))


def test_veins_of_a_lobe_start_on_its_vein():
    lobe = reaching([(0.2, 0.25, 0.5)], 0.01)[0]
    starts = [vein.path[0] for vein in branching(OUTLINE, lobe, 3, angle=40.0, width=0.01)]
    assert all(np.linalg.norm(lobe.path - start, axis=1).min() < 1e-12 for start in starts)


def test_parallel_veins_do_not_cross():
    x = np.stack([vein.path[:, 0] for vein in parallel(9, 0.03)])
    assert (np.diff(x, axis=0) > 0).all()
