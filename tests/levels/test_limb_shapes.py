"""How many triangles is each limb worth?"""

import numpy as np
import pytest

from sketchtree.axes import NULL
from sketchtree.geometry.rings import Rings
from sketchtree.levels.shapes import choices_of, choose_shapes, circumradius, roughness


def limbs(*bars):
    """Rings of limbs given as (points, radii)."""
    points = np.concatenate([np.asarray(bar[0], float) for bar in bars])
    radius = np.concatenate([np.broadcast_to(np.asarray(bar[1], float), len(bar[0])) for bar in bars])
    start = np.r_[0, np.cumsum([len(bar[0]) for bar in bars])]
    s = np.concatenate([np.r_[0, np.cumsum(np.linalg.norm(np.diff(np.asarray(bar[0], float), axis=0), axis=1))] for bar in bars])
    return Rings(start, s, points, np.tile([[0.0, 1, 0]], (len(points), 1)), np.tile([[1.0, 0, 0]], (len(points), 1)), radius)


STRAIGHT = [[0, y, 0] for y in np.linspace(0, 1, 6)]
CROOKED = [[0.05 * (-1) ** k, y, 0] for k, y in enumerate(np.linspace(0, 1, 6))]


def chosen(ring, budget, *, full=None, parent=None, weight=None):
    count = len(ring.start) - 1
    return choose_shapes(
        ring,
        choices_of(ring, np.full(count, 8) if full is None else np.array(full)),
        np.full(count, NULL) if parent is None else np.array(parent),
        np.ones(count) if weight is None else np.array(weight),
        budget,
    )


@pytest.mark.parametrize("side", [3, 4, 5, 6, 8, 12])
def test_polygons_are_as_wide_on_average_as_the_full_trees(side):
    """Cauchy: the mean width of a convex outline is its perimeter / π."""
    turn = np.linspace(0, 2 * np.pi, 3600, endpoint=False)
    width = {}
    for n, size in ((side, circumradius(np.array([side]), np.array([7]))[0]), (7, 1.0)):
        corner = size * np.exp(2j * np.pi * np.arange(n) / n)
        across = np.real(corner[None] * np.exp(-1j * turn)[:, None])
        width[n] = np.mean(np.ptp(across, axis=1))
    assert width[side] == pytest.approx(width[7], rel=1e-5)


def test_the_same_polygon_is_not_rough_and_fewer_sides_are_rougher():
    assert roughness(8, 8) == pytest.approx(0, abs=1e-12)
    assert 0 < roughness(12, 24) < roughness(8, 24) < roughness(6, 24) < roughness(4, 24) < roughness(3, 24) < 0.25


def test_no_budget_draws_nothing_and_a_large_one_all_of_it():
    ring = limbs((STRAIGHT, 0.1), (CROOKED, 0.05))
    assert chosen(ring, 0).triangles == 0 and not chosen(ring, 0).kept.any()
    whole = chosen(ring, 10_000)
    assert whole.kept[6:].all() and (whole.side == 8).all()


def test_a_straight_limb_needs_only_its_ends():
    ring = limbs((STRAIGHT, 0.1))
    assert chosen(ring, 10_000).kept.tolist() == [True, False, False, False, False, True]


@pytest.mark.parametrize("budget", [3, 10, 30, 60, 100, 200])
def test_the_budget_is_kept(budget):
    rng = np.random.default_rng(budget)
    ring = limbs(*[(rng.normal(size=(5, 3)).cumsum(axis=0), rng.uniform(0.01, 0.2)) for _ in range(12)])
    shapes = chosen(ring, budget)
    assert shapes.triangles <= budget
    rings = np.add.reduceat(shapes.kept.astype(int), ring.start[:-1])
    drawn = shapes.side > 0
    counted = np.where(shapes.spike, 3, 2 * shapes.side * (rings - 1) + shapes.side - 2)[drawn].sum()
    assert counted == shapes.triangles


def test_the_thick_limb_is_drawn_before_the_thin_one():
    ring = limbs((STRAIGHT, 0.01), (STRAIGHT, 0.1))
    assert chosen(ring, 12).side[1] > 0 == chosen(ring, 12).side[0] or chosen(ring, 12).spike[0]
    few = chosen(ring, 3)
    assert few.side.tolist() == [0, 3]


def test_a_hidden_limb_is_left_out_first():
    ring = limbs((STRAIGHT, 0.1), (STRAIGHT, 0.1))
    assert chosen(ring, 3, weight=[0.1, 1.0]).side.tolist() == [0, 3]


def test_a_thin_limb_that_bears_a_thick_one_is_drawn():
    ring = limbs((STRAIGHT, 0.001), (STRAIGHT, 0.1))
    assert (chosen(ring, 6, parent=[NULL, 0]).side > 0).all()


def test_more_triangles_are_never_worse():
    rng = np.random.default_rng(1)
    ring = limbs(*[(rng.normal(size=(6, 3)).cumsum(axis=0), rng.uniform(0.01, 0.2)) for _ in range(20)])
    used = [chosen(ring, budget).triangles for budget in (20, 60, 180, 540, 1620)]
    assert used == sorted(used) and used[-1] > 1000


def test_for_the_surface_a_limb_that_is_left_out_lies_as_far_off_as_what_bears_it():
    """Beside its outline A = 2 r L: D = L (L / 4 + r); a straight spike L r / 2, beside A = L r."""
    wrong = choices_of(limbs((STRAIGHT, 0.02)), np.array([8]), surface=True).wrong[0]
    np.testing.assert_allclose(wrong[:2], [1.0 * (0.25 + 0.02) + 2 * 0.02, 0.5 * 0.02 + 0.02])


def test_for_the_surface_a_crooked_limb_is_no_spike():
    ring = limbs((CROOKED, 0.02))
    outline, surface = (choices_of(ring, np.array([8]), surface=wanted).wrong[0, 1] for wanted in (False, True))
    along = ring.s[:, None] / ring.s[-1]
    off = np.linalg.norm(ring.point - ring.point[0] - along * (ring.point[-1] - ring.point[0]), axis=1)
    assert outline == pytest.approx(0.02 * ring.s[-1])
    assert surface == pytest.approx(ring.s[-1] * (np.average(off, weights=[1, 2, 2, 2, 2, 1]) + 0.01) + outline)


def test_for_the_surface_long_thin_limbs_are_drawn_that_outlines_can_do_without():
    ring, parent = limbs((STRAIGHT, 0.1), *(([[0, 0, 0], [0.5, 0.5 * k, 0]], 0.002) for k in range(1, 5))), [NULL, 0, 0, 0, 0]
    drawn = {wanted: choose_shapes(ring, choices_of(ring, np.full(5, 16), surface=wanted), np.array(parent), np.ones(5), 30) for wanted in (False, True)}
    assert (drawn[True].side[1:] > 0).all() and (drawn[False].side[1:] == 0).any()
