"""A search by blocks finds what a comparison with everything at once finds."""

from dataclasses import replace

import numpy as np
import pytest

from sketchtree.templates.matching import search
from sketchtree.templates.seen.branching import Branching
from sketchtree.templates.exemplar import Views
from sketchtree.templates.matching.likeness import SketchShape, calibrated_terms, chen_terms
from sketchtree.templates.matching.search import best_views
from sketchtree.templates.matching.weights import BARE, CROWN


@pytest.fixture(scope="module")
def crowd(shipped):
    """The shipped views many times over with noise, and a sketch like one of them."""
    rng, v, times = np.random.default_rng(2), shipped.views, 30

    def many(x, noise):
        x = np.tile(x, (times, 1, 1))
        return (x + noise * rng.normal(size=x.shape)).astype(np.float32)

    b = v.branching
    moments = Branching(many(b.mean, 0.05), np.abs(many(b.sd, 0.01)), many(b.count, 0))
    views = Views(many(v.footprint, 0.01), moments, many(v.posture, 0.02))
    one = Branching(*(x[77, [5]].astype(float) for x in (moments.mean, moments.sd, moments.count)))
    return SketchShape(views.footprint[77, 5].astype(float), one, views.posture[77, 5].astype(float)), views


@pytest.mark.parametrize("crown", [True, False])
@pytest.mark.parametrize("score", ["calibrated", "chen"])
def test_blocks_in_single_precision_agree_with_all_at_once_in_double(crowd, crown, score):
    shape, views = crowd
    shape = shape if crown else replace(shape, footprint=None)
    metric = CROWN if crown else BARE
    b = views.branching
    double = Views(views.footprint.astype(float), Branching(*(x.astype(float) for x in (b.mean, b.sd, b.count))), views.posture.astype(float))
    terms = calibrated_terms(shape, double, metric) if score == "calibrated" else chen_terms(shape, double)
    total = sum(term for term in terms if term is not None)
    found = best_views(shape, views, metric if score == "calibrated" else None)
    assert found.score.dtype == np.float32, "large databases are compared as they are stored"
    np.testing.assert_allclose(found.score, total.max(axis=1), rtol=1e-3, atol=2e-3)
    best = np.argsort(-total.max(axis=1))[:20]
    np.testing.assert_array_equal(found.view[best], total.argmax(axis=1)[best])
    np.testing.assert_array_equal(np.argsort(-found.score, kind="stable")[:5], best[:5])
    for got, whole in zip(found.terms, terms, strict=True):
        assert (got is None) == (whole is None)
        if got is not None:
            np.testing.assert_allclose(got[best], whole[best, found.view[best]], rtol=1e-3, atol=2e-3)


def test_a_small_database_is_compared_in_double_precision(shipped, crowd):
    assert best_views(crowd[0], shipped.views, CROWN).score.dtype == np.float64


def test_the_size_of_a_block_changes_nothing(crowd, monkeypatch):
    shape, views = crowd
    whole = best_views(shape, views, CROWN)
    monkeypatch.setattr(search, "BLOCK", 111)
    np.testing.assert_array_equal(best_views(shape, views, CROWN).view, whole.view)


def test_what_sketch_and_exemplars_lack_is_treated_as_the_formulas_say(shipped):
    v = shipped.views
    posture, mean = v.posture.copy(), v.branching.mean.copy()
    posture[3, 7, 2], posture[5, :, 8], mean[9, 1, 2], mean[9, 2] = np.nan, np.nan, np.nan, np.nan
    views = Views(v.footprint, replace(v.branching, mean=mean), posture)
    sketch = v.posture[4, 2].astype(float)
    sketch[[3, 8]] = np.nan
    for lacking in ([], [2], [0, 1, 2]):
        drawn = v.branching.mean[4, 2].astype(float)
        drawn[lacking] = np.nan
        shape = SketchShape(None, Branching(drawn[None], np.zeros((1, 3)), np.ones((1, 3))), sketch)
        terms = calibrated_terms(shape, views, BARE)
        np.testing.assert_allclose(best_views(shape, views, BARE).score, sum(terms[1:]).max(axis=1), rtol=1e-6, atol=1e-6)


def test_what_is_kept_of_a_database_goes_with_it(crowd):
    shape, views = crowd
    twin = replace(views, footprint=views.footprint)
    best_views(shape, twin, CROWN)
    before = len(search._kept)
    del twin
    assert len(search._kept) == before - 1
