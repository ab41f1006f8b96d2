import numpy as np
import pytest
from drawn import box, closed, cloud, graph_of, measured, painted, ring, roles

from sketchtree.sketch.roles.stubs import stubs

CROWN = ring(40)


@pytest.mark.parametrize("trunk", [closed(box(24, 42)), painted(box(24, 42)), np.vstack([box(24, 42), box(24, 42)[:1] + 1])])
def test_a_stout_shape_under_a_crown_is_its_trunk(trunk):
    graph = graph_of(CROWN, trunk)
    assert len(graph.crown) == 1 and len(graph.limb_id) == 1 and graph.is_base.sum() == 1
    assert graph.xy[0] == pytest.approx((0, 0), abs=1.5) and graph.width[-1] == pytest.approx(24, rel=0.1)


def test_its_line_runs_up_the_middle_of_foot_and_top():
    m, _ = measured(CROWN, closed([(-20, 0), (10, 0), (18, 42), (-2, 42)]))
    (stub,) = stubs(m, np.array([1]), [CROWN])
    np.testing.assert_allclose(stub.middle, [(-5, 0), (8, 42)], atol=0.5)
    assert stub.width == pytest.approx(25)


@pytest.mark.parametrize("shape", [box(70, 42), box(24, 42, x=70), box(24, 42, y=60), ring(12, (0, 20), 30, -0.5, 4.0)])
def test_no_trunk_is_as_wide_as_its_crown_or_beside_it_or_aloft_or_open(shape):
    m, _ = measured(CROWN, shape if len(shape) > 4 else closed(shape), [(0, 0), (0, 10)])
    assert stubs(m, np.array([1]), [CROWN]) == []


def test_what_is_drawn_on_it_is_bark():
    graph = graph_of(cloud(45, (0, 95)), closed(box(30, 55)), ring(5, (0, 25), 16), [(-8, 10), (-8, 35)])
    assert roles(graph) == {"s0": "crown", "s2": "hatching", "s3": "hatching"}
    assert len(graph.limb_id) == 1


def test_without_a_crown_there_is_no_stub():
    m, _ = measured(closed(box(24, 42)), [(0, 0), (0, 90)])
    graph = graph_of(closed(box(24, 42)), [(0, 0), (0, 90)])
    assert graph.crown == () and len(m) == 2
