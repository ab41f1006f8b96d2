"""The factor graph in print: how many factors of each kind, and what they look at."""

import jax.numpy as jnp
import numpy as np
import pytest

from sketchtree.axes import NULL
from sketchtree.mrf.blocks import EQUATION, blocks, table
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.log_posterior import KINDS, log_posterior
from sketchtree.mrf.prior import Prior
from tests.mrf.drawings import lone_stroke, random_tree, shrub, sketch, small_tree

WORLDS = {"small": small_tree, "random": lambda: random_tree(3, 7), "shrub": shrub, "lone": lone_stroke}


@pytest.fixture(params=list(WORLDS))
def graph(request):
    """One drawing after the other."""
    return factor_graph(WORLDS[request.param]())


def test_there_are_as_many_factors_as_the_drawing_has_parts(graph):
    count = {kind: len(block) for kind, block in blocks(graph).items()}
    drawn = ~graph.is_base
    stems = graph.limb_parent == NULL
    expected = {
        "solid_angle": drawn.sum(),
        "lateral": graph.is_lateral.sum(),
        "apical": graph.is_apical.sum(),
        "stem": stems.sum(),
        "limb_length": (~stems).sum(),
        "segment_length": (graph.order[drawn] > 0).sum(),
        "siblings": len(graph.sibling),
        "competition": len(graph.competitor),
        "extent": len(np.unique(graph.tree[graph.limb_tip[graph.limb_spreads]])),
        "crown": graph.limb_spreads.sum(),
    }
    assert count == {kind: n for kind, n in expected.items() if n}


def test_factors_that_count_in_the_log_posterior_are_those_of_the_blocks(graph):
    posterior, told = log_posterior(graph, Prior()), blocks(graph)
    columns = {
        "lateral": posterior.lateral.kind,
        "apical": posterior.apical.kind,
        "segment_length": posterior.segment_length.kind,
        "limb_length": posterior.limb_length.kind,
    }
    for kind, column in columns.items():
        assert float(jnp.sum(column)) == len(told.get(kind, ()))


def test_kinds_come_in_the_order_of_the_log_posterior(graph):
    told = list(blocks(graph))
    assert told == [kind for kind in KINDS if kind in told]


def test_every_row_is_a_segment_of_the_drawing(graph):
    for block in blocks(graph).values():
        rows = block.rows[block.rows != NULL]
        assert rows.min() >= 0 and rows.max() < len(graph)
        assert (block.rows != NULL).any(axis=1).all()


def test_every_kind_has_its_equation():
    assert set(EQUATION) == set(KINDS) - {"plane"}


def test_laterals_look_at_their_parents_and_limbs_at_their_own_rows(small):
    told = blocks(small)
    assert told["lateral"].rows.tolist() == [[5, 1], [6, 2], [7, 2], [8, 3], [10, 5]]
    assert told["limb_length"].rows.tolist() == [[5, 9], [6, NULL], [7, NULL], [8, NULL], [10, NULL]]
    assert told["extent"].rows.tolist() == [[9, 6, 7, 8, 10]]
    assert told["lateral"].theta == ("divergence",) and told["crown"].theta == ()


def test_the_table_of_the_small_tree(small):
    assert table(small).splitlines() == [
        "FactorGraph: 10 segments, 6 limbs up to order 2, 6 sibling pairs, 9 competition pairs; H = 105 sketch units",
        "  kind            factors  looks at  Θ             log potential",
        "  solid_angle          10         1                log cos ψ",
        "  lateral               5         2  divergence    −½((a − μ_o)/σ_o)² − log σ_o − log(sin a + .02)",
        "  apical                4         2  bend          −½(a/τ_o)² − 2 log τ_o",
        "  stem                  1         1                −½(ψ/.08)²",
        "  limb_length           5         2  length        −½((r − a_o − b(u − ½))/ς_o)² − log ς_o",
        "  segment_length        6         1  segment       −½((log L − m_o)/s_o)² − log s_o",
        "  siblings              6         2                −κ c_d w·w'",
        "  competition           9         2                −w_d exp(−λ|p − p'|/R_c)",
        "  extent                1         5                −½(r/.2)² − ½(mean z/rms x/.35)²",
        "  crown                 5         1                −log(1 + ((log ρ − m)/s)²)",
    ]


def test_one_segment_has_a_table_too():
    graph = factor_graph(sketch([-1, 0], [[0, 0], [0, 9]], [0, 0]))
    assert list(blocks(graph)) == ["solid_angle", "stem"]
    assert table(graph).startswith("FactorGraph: 1 segments")
