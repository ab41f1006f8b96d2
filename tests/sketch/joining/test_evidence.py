"""Every figure of the evidence, held to a slow twin that goes arc by arc as the docstring says."""

from dataclasses import replace

import numpy as np
import pytest
import shapely
from little_lines import lines, random_lines

from sketchtree.sketch.joining.aims import FAR as FAR_BACK
from sketchtree.sketch.joining.aims import LOOK, NEAR
from sketchtree.sketch.joining.bundle import Bundle
from sketchtree.sketch.joining.candidates import nearest_places
from sketchtree.sketch.joining.evidence import BESIDE, COARSE, FAR, OVERSHOOT, PRECISE, REACH, TIP, Places, evidence, first_slip, overshoots, slip_of
from sketchtree.sketch.joining.lines import angle_between, extent, unit

ROOT = np.array([0.0, 0.0])
BOTH_WAYS = ("turn", "sweep", "at_tip", "foot", "tip", "place")


def drawing(seed):
    """Nine random lines with widths and times, some of them unknown."""
    rng = np.random.default_rng(seed)
    made = random_lines(seed, 9)
    width = rng.choice([0.5, 1.0, 3.0, np.nan], 9)
    begun = rng.choice([*range(100), np.nan], 9)
    taper = rng.choice([1.0, 0.4, 3.0], 9)
    return [replace(one, width=w * np.linspace(1, r, len(one.points)), begun=t) for one, w, r, t in zip(made, width, taper, begun, strict=True)]


class Twin:
    """One arc, looked at in plain words."""

    def __init__(self, made, places, k):
        self.made, self.places, self.h = made, places, extent(made)
        self.child, self.parent, self.end = made[places.child[k]], made[places.parent[k]], int(places.end[k])
        self.s, self.gap_drawn = float(places.s[k]), float(places.gap[k])
        self.k = k
        self.footed = self.child.reversed() if self.end else self.child  # p is its first point
        self.p, self.other = self.footed.points[0], self.footed.points[-1]

    def _crossing(self):
        reach = min(OVERSHOOT * self.h, 0.3 * self.child.length)
        met = self.footed.cut(0.0, reach).shape.intersection(self.parent.shape)
        return None if met.is_empty else max(np.hypot(*(p - self.p)) for p in shapely.get_coordinates(met))

    def over(self):
        return (self._crossing() or 0.0) / self.h

    def gap(self):
        return 0.0 if self._crossing() is not None else self.miss()

    def miss(self):
        half = 0.5 * float(np.nan_to_num(np.median(self.parent.width)))
        return (self.gap_drawn - 0.65 * min(self.gap_drawn, half)) / self.h

    def rise(self):
        return (self.p - self.other)[1] / self.child.length

    def outward(self):
        return (np.hypot(*(self.other - ROOT)) - np.hypot(*(self.p - ROOT))) / self.child.length

    def longer(self):
        return np.log(self.child.length / self.parent.length)

    def size(self):
        return np.log(self.parent.length / self.h)

    def carries(self):
        nearest = {}
        for arc in range(len(self.places.child)):
            key = (int(self.places.child[arc]), int(self.places.end[arc]))
            found = (float(self.places.gap[arc]), int(self.places.parent[arc]))
            nearest[key] = min(nearest.get(key, found), found)
        mine = (int(self.places.child[self.k]), self.end)
        return sum(found[1] == self.places.parent[self.k] for key, found in nearest.items() if key != mine)

    def _aim(self, piece):
        back = -unit(self.footed.at(min(piece * self.h, 0.5 * self.child.length)) - self.p)
        met = shapely.LineString([self.p, self.p + back * LOOK[piece] * self.h]).intersection(self.parent.shape)
        return 2 * LOOK[piece] if met.is_empty else met.distance(shapely.Point(self.p)) / self.h

    def aim(self):
        return self._aim(NEAR)

    def aimed(self):
        return self._aim(FAR_BACK)

    def beside(self):
        reach = min(BESIDE * self.h, 0.5 * self.child.length)
        return self.parent.shape.distance(shapely.Point(self.footed.at(reach))) / reach

    def thicker(self):
        ratio = np.log(np.median(self.child.width) / np.median(self.parent.width))
        return -np.inf if np.isnan(ratio) else ratio

    def thins(self):
        places = [np.linspace(0.05, 0.35, 8), np.linspace(0.65, 0.95, 8)]
        near, far = (np.median(np.interp(at * self.footed.length, self.footed.along, self.footed.width)) for at in places)
        return 0.0 if np.isnan(near) else max(np.log(far / near), 0.0)

    def before(self):
        return float(self.child.begun < self.parent.begun)

    def _angle(self, reach, side):
        leaving = self.footed.at(min(reach * self.h, 0.4 * self.child.length)) - self.p
        onward = self.parent.direction(self.s, min(reach * self.h, 0.4 * self.parent.length))
        return angle_between(leaving, -onward if side else onward)

    def turn(self, side):
        return self._angle(REACH, side)

    def sweep(self, side):
        return self._angle(FAR, side)

    def foot(self, side):
        return (self.parent.length - self.s if side else self.s) / self.h

    def tip(self, side):
        return self.parent.length / self.h - self.foot(side)

    def place(self, side):
        return self.foot(side) / (self.foot(side) + self.tip(side))

    def at_tip(self, side):
        return self.turn(side) * min(max(1 - self.tip(side) / TIP, 0), 1)


@pytest.mark.parametrize("seed", range(8))
def test_every_figure_is_what_the_docstring_says(seed):
    made = drawing(seed)
    bundle = Bundle.of(made)
    places = nearest_places(bundle)
    figures = evidence(bundle, places, ROOT)
    twins = [Twin(made, places, k) for k in range(len(places.child))]
    for name, found in figures.items():
        sides = (0, 1) if name in BOTH_WAYS else (None,)
        assert found.shape == (len(twins), len(sides)), name
        told = np.array([[getattr(twin, name)() if side is None else getattr(twin, name)(side) for side in sides] for twin in twins])
        known = np.isfinite(told)
        assert (known == np.isfinite(found)).all() and found[known] == pytest.approx(told[known], abs=1e-7), name


def test_the_random_drawings_show_what_is_to_be_shown():
    parts = [(b := Bundle.of(drawing(seed)), p := nearest_places(b), evidence(b, p, ROOT)) for seed in range(8)]
    shown = {name: np.concatenate([figures[name].ravel() for _, _, figures in parts]) for name in ("over", "aim", "at_tip", "before", "thicker", "thins", "gap")}
    assert (shown["over"] > 0).sum() > 5 and (shown["aim"] < 2 * LOOK[NEAR]).sum() > 5 and (shown["at_tip"] > 0).sum() > 5
    assert {0.0, 1.0} == set(shown["before"]) and np.isinf(shown["thicker"]).any() and (shown["gap"] == 0).any()
    assert (shown["thins"] > 0.5).sum() > 5 and (shown["thins"] == 0).any()


def arc(*strokes, end=0):
    """(bundle, the one arc from line 0 to line 1)."""
    bundle = Bundle.of(lines(*strokes))
    point = shapely.Point(bundle.ends[end])
    shape = bundle.shapes[1]
    return bundle, Places(*(np.array([v]) for v in (0, end, 1, shape.project(point), shape.distance(point))))


def test_a_foot_begun_before_its_parent_overshoots_by_what_it_went():
    bundle, places = arc([(-1, 50), (40, 50)], [(0, 0), (0, 100)])
    assert overshoots(bundle, places).tolist() == pytest.approx([1.0])


def test_a_foot_on_this_side_overshoots_nothing():
    bundle, places = arc([(0.1, 50), (40, 50)], [(0, 0), (0, 100)])
    assert overshoots(bundle, places).tolist() == [-1.0]


def test_a_branch_that_crosses_far_from_its_foot_overshoots_nothing():
    bundle, places = arc([(-5, 50), (40, 50)], [(0, 0), (0, 100)])
    assert overshoots(bundle, places).tolist() == [-1.0]


def test_overshoots_are_known_by_either_end():
    bundle, places = arc([(40, 50), (-1, 50)], [(0, 0), (0, 100)], end=1)
    assert overshoots(bundle, places).tolist() == pytest.approx([1.0])


def test_the_first_slip_is_twice_the_middle_distance_to_the_nearest_line():
    bundle, places = arc([(1, 50), (40, 50)], [(0, 0), (0, 100)])
    assert first_slip(bundle, places) == pytest.approx(0.02)


def test_slips_are_what_three_in_four_keep_to():
    assert slip_of(np.array([0.0, 0.004, 0.006, 0.01, 0.5])) == pytest.approx(0.01)


@pytest.mark.parametrize(("gaps", "slip"), [([], PRECISE), ([0.0], PRECISE), ([0.3], COARSE)])
def test_no_hand_is_taken_for_finer_or_coarser_than_the_bounds(gaps, slip):
    assert slip_of(np.array(gaps)) == slip
