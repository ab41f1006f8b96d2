"""How sure each segment's depth is."""

import numpy as np
import pytest

from sketchtree.mrf.answer.intervals import LEVELS, intervals_of, mixed_quantile, same_side_odds
from sketchtree.mrf.answer.stems import is_stem
from sketchtree.mrf.depths import depth_of
from sketchtree.mrf.factor_graph import factor_graph
from tests.mrf.drawings import sketch


def _samples(graph, count=400, seed=0):
    """(ψ, z) of made-up samples."""
    psi = np.where(graph.is_base, 0.0, np.random.default_rng(seed).normal(0, 0.5, (count, len(graph))))
    return psi, depth_of(graph, psi.T).T


def test_the_quantile_of_a_sample_is_numpy_s(small):
    s = np.random.default_rng(0).uniform(size=(501, 7))
    for level in LEVELS:
        np.testing.assert_allclose(mixed_quantile(s, level, 0.0), np.quantile(s, level, axis=0, method="hazen"), atol=1e-12)


def test_a_share_spread_evenly_widens_and_half_a_sample_is_half_the_way():
    s = np.full((200, 1), 0.4)
    assert mixed_quantile(s, 0.5, 0.0)[0] == 0.4
    low, high = (mixed_quantile(s, level, 0.2)[0] for level in (0.05, 0.95))
    assert low == pytest.approx(0.25, abs=0.01)  # .2 x = .05
    assert high == pytest.approx(0.75, abs=0.01)  # .2 x + .8 = .95


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 1.0])
def test_the_mixture_holds_what_it_says(share):
    """A mixed draw lies below the quantile as often as its level."""
    rng = np.random.default_rng(3)
    s = rng.beta(2, 5, (4000, 1))
    mixed = np.where(rng.random(4000) < share, rng.random(4000), s[:, 0])
    for level in LEVELS:
        assert np.mean(mixed < mixed_quantile(s, level, share)[0]) == pytest.approx(level, abs=0.02)


def test_quantiles_rise_and_bases_have_none(small):
    psi, z = _samples(small)
    found = intervals_of(small, np.abs(np.sin(psi)), z, z[0])
    base = small.is_base
    assert all(np.isnan(column[base]).all() and np.isfinite(column[~base]).all() for column in found)
    assert (found.q05 <= found.q50)[~base].all() and (found.q50 <= found.q95)[~base].all()
    assert found.q05[~base].min() >= 0 and found.q95[~base].max() <= 1


def test_odds_are_the_share_of_samples_on_the_shown_side(small):
    z = np.tile(np.where(small.is_base, 0.0, np.arange(11.0)), (10, 1))
    above = small.parent[9]
    z[:3, 9] = z[:3, above] - 1.0  # three of ten samples have the segment on the other side
    odds = same_side_odds(small, z, z[9])
    assert odds[9] == pytest.approx(0.7)
    assert odds[5] == 1.0


def test_a_sample_and_its_mirror_image_say_the_same(small):
    _, z = _samples(small)
    flip = np.where(np.random.default_rng(1).random(len(z)) < 0.5, -1.0, 1.0)[:, None]
    np.testing.assert_array_equal(same_side_odds(small, flip * z, z[7]), same_side_odds(small, z, z[7]))
    np.testing.assert_array_equal(same_side_odds(small, z, -z[7]), same_side_odds(small, z, z[7]))


def test_a_segment_that_stays_on_the_page_has_even_odds(small):
    _, z = _samples(small)
    shown = np.where(np.isin(np.arange(11), [0, 1]), 0.0, z[0])
    assert same_side_odds(small, z, shown)[1] == 0.5


def _leaning():
    return factor_graph(sketch([-1, 0, 1, 1, 2], [[0, 0], [25, 40], [30, 100], [-30, 90], [70, 120]], [0, 0, 0, 1, 2]))


def test_a_stem_may_lie_in_the_page_and_may_lean_as_much_as_it_was_drawn_to():
    graph = _leaning()
    psi = np.where(graph.is_base, 0.0, np.random.default_rng(0).normal(0, 0.05, (400, len(graph))))
    z = depth_of(graph, psi.T).T
    found = intervals_of(graph, np.abs(np.sin(psi)), z, np.where(graph.is_base, 0.0, 0.35 * graph.xy[:, 0]))
    stem = is_stem(graph)
    assert (found.q05[stem] == 0).all()
    lean = np.abs(graph.direction[stem, 0])
    expected = np.sin(np.arctan(1.96 * lean))  # |N(0, 1)| is below 1.96 in 95 % of the cases
    np.testing.assert_allclose(found.q95[stem], expected, atol=0.12)
    assert (found.q50[stem] > 0.4 * lean).all()
    lateral = graph.order > 0
    assert (found.q95[lateral] < 0.25).all()


def test_a_stem_that_is_locked_or_planar_is_not_turned():
    graph = _leaning()
    stem = is_stem(graph)
    psi = np.where(graph.is_base, 0.0, np.random.default_rng(0).normal(0, 0.05, (400, len(graph))))
    psi[:, stem] = 0.3
    z = depth_of(graph, psi.T).T
    locked = intervals_of(graph, np.abs(np.sin(psi)), z, z[0])
    np.testing.assert_allclose(locked.q50[stem], np.sin(0.3), atol=1e-6)
    psi[:, stem] = np.random.default_rng(1).normal(0, 0.01, (400, stem.sum()))
    z = depth_of(graph, psi.T).T
    planar = intervals_of(graph, np.abs(np.sin(psi)), z, np.where(stem | graph.is_base, 0.0, z[0]))
    assert (planar.q50[stem] < 0.02).all()
