"""2D branching statistics agree with a slow count (§7)."""

import numpy as np
import pytest

from sketchtree.templates.seen.branching import SHORT, branching
from sketchtree.drawable import drawable
from sketchtree.templates.seen.drawing import Drawing
from sketchtree.templates.seen.footprint import view_azimuths


def slow_twin(drawing: Drawing, view: int):
    """Pair by pair, parent by parent."""
    start, tip = drawing.start[view], drawing.tip[view]
    vector = tip - start
    short = SHORT * np.ptp(tip, axis=0).max()
    found = {"s": [], "alpha": [], "beta": []}
    for parent in range(len(drawing.parent)):
        if drawing.parent[parent] < 0 or np.hypot(*vector[parent]) <= short:
            continue
        angles = []
        for child in np.flatnonzero(drawing.parent == parent):
            if np.hypot(*vector[child]) <= short:
                continue
            a = np.arctan2(vector[child][1], vector[child][0]) - np.arctan2(vector[parent][1], vector[parent][0])
            angles.append(abs((a + np.pi) % (2 * np.pi) - np.pi))
            found["s"].append(np.hypot(*vector[child]) / np.hypot(*vector[parent]))
        if angles:
            angles.sort()
            found["alpha"].append(angles[0])
            found["beta"].extend(angles[1:])
    return [(np.mean(x), np.std(x), len(x)) for x in found.values()]


@pytest.mark.parametrize("name", ["english_oak", "date_palm"])
def test_all_views_agree_with_the_slow_twin(shipped, name):
    drawing = Drawing.of_skeleton(drawable(shipped.exemplar(name).skeleton), view_azimuths())
    fast = branching(drawing)
    for view in (0, 7, 20):
        for k, (mean, sd, count) in enumerate(slow_twin(drawing, view)):
            assert fast.mean[view, k] == pytest.approx(mean, rel=1e-9)
            assert fast.sd[view, k] == pytest.approx(sd, rel=1e-7)
            assert fast.count[view, k] == count


def test_the_smallest_angle_is_apical_whatever_the_stroke(graph_of):
    xy = [[0, 0], [0, 1], [1, 2.0], [0.1, 2]]  # the stem's own stroke turns away by 45°
    found = branching(Drawing.of_graph(graph_of([-1, 0, 1, 1], xy, [0, 0, 0, 1])))
    assert found.mean[0, 1] == pytest.approx(np.arctan(0.1))
    assert found.mean[0, 2] == pytest.approx(np.pi / 4)


def test_a_statistic_of_no_pair_is_nan_and_counts_none(graph_of):
    found = branching(Drawing.of_graph(graph_of([-1, 0, 1], [[0, 0], [0, 1], [0, 3.0]], [0, 0, 0])))
    assert found.mean[0, 0] == 2.0 and found.mean[0, 1] == 0.0
    assert np.isnan(found.mean[0, 2]) and found.count[0].tolist() == [1, 1, 0]
    lone = branching(Drawing.of_graph(graph_of([-1, 0], [[0, 0], [0, 1.0]], [0, 0])))
    assert np.isnan(lone.mean).all() and not lone.count.any()


def test_mirrored_and_scaled_drawings_branch_alike(graph_of):
    rng = np.random.default_rng(4)
    parent = np.array([-1, 0, 1, 1, 2, 2, 3, 3])
    xy = np.cumsum(rng.uniform(0.2, 1, (8, 2)), axis=0)
    a, b = (branching(Drawing.of_graph(graph_of(parent, xy * s + 3, parent * 0))) for s in (np.array([1, 1]), np.array([-50, 50])))
    np.testing.assert_allclose(a.mean, b.mean)
    np.testing.assert_allclose(a.sd, b.sd)
