import numpy as np
import pytest

from sketchtree.sketch.joining.fitted import BASE, CURVES
from sketchtree.sketch.joining.likelihood import AS_THICK, BEFORE, EVEN, MOST, THICKER, THINS, arc_costs, slip_costs


def figures(count=1, **columns):
    """Every figure 0 but those given."""
    table = {name: np.zeros((count, 1)) for name in (*CURVES, "thicker", "thins", "before")}
    table["thicker"] = np.full((count, 1), -np.inf)
    return table | {name: np.array(value, float).reshape(count, -1) for name, value in columns.items()}


def test_the_cost_is_the_sum_of_the_curves_less_the_base():
    told = sum(values[0] if (knots[0] == 0) else float(np.interp(0, knots, values)) for name, (knots, values) in CURVES.items() if name != "slip")
    assert arc_costs(figures()) == pytest.approx(np.full((1, 2), told - BASE))


@pytest.mark.parametrize("name", sorted(set(CURVES) - {"slip"}))
def test_between_knots_a_curve_is_straight(name):
    knots, values = CURVES[name]
    middle = 0.5 * (knots[1] + knots[2])
    moved = arc_costs(figures(**{name: middle})) - arc_costs(figures())
    assert moved == pytest.approx(0.5 * (values[1] + values[2]) - np.interp(0, knots, values))


def test_a_figure_of_two_columns_counts_for_each_by_itself():
    both = arc_costs(figures(turn=[[0.3, 2.0]]))
    each = [arc_costs(figures(turn=t))[0, 0] for t in (0.3, 2.0)]
    assert both[0].tolist() == pytest.approx(each)


@pytest.mark.parametrize(("thicker", "cost"), [(-np.inf, 0.0), (-1.0, 0.0), (-AS_THICK, 0.0), (0.0, THICKER * AS_THICK), (1.0, THICKER * (1 + AS_THICK))])
def test_a_branch_thicker_than_its_parent_costs_more(thicker, cost):
    assert arc_costs(figures(thicker=thicker)) - arc_costs(figures()) == pytest.approx(cost)


@pytest.mark.parametrize(("thins", "cost"), [(0.0, 0.0), (EVEN, 0.0), (0.6, THINS * (0.6 - EVEN)), (9.0, THINS * MOST)])
def test_to_grow_from_the_thinner_end_costs_more_up_to_a_bound(thins, cost):
    assert arc_costs(figures(thins=thins)) - arc_costs(figures()) == pytest.approx(cost)


def test_a_branch_begun_before_its_parent_costs_a_little_more():
    assert arc_costs(figures(before=1.0)) - arc_costs(figures()) == pytest.approx(BEFORE)


@pytest.mark.parametrize("name", sorted(CURVES))
def test_knots_grow_and_the_best_of_a_curve_is_free(name):
    knots, values = CURVES[name]
    assert (np.diff(knots) > 0).all() and len(knots) == len(values) and min(values) == 0.0


def test_the_more_is_missed_the_more_it_costs():
    cost = slip_costs(np.linspace(0, 0.2, 200), 0.005)
    assert cost.shape == (200, 1) and (np.diff(cost[:, 0]) >= 0).all() and cost[0] == 0.0
