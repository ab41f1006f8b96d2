"""The fit finds again a metric that sketches were made with."""

import numpy as np
import pytest

from benchmarks.fit_match import Sample, _first, fit, measured, written
from sketchtree.templates.seen.branching import Branching
from sketchtree.templates.store.database import Database
from sketchtree.templates.matching.likeness import SketchShape, calibrated_terms
from sketchtree.templates.matching.metric import BRANCHING, POSTURE, TRAITS, Metric, correlations
from sketchtree.templates.making.regenerate import recipe_folder
from sketchtree.templates.matching.weights import BARE

SHIFT, SD = 0.1, 0.08


@pytest.fixture(scope="module")
def shipped():
    """The committed database."""
    return Database(recipe_folder() / "exemplars.h5")


@pytest.fixture(scope="module")
def made(shipped):
    """Sketches that miss a view of their exemplar by a known shift and standard deviation."""
    rng, views, samples = np.random.default_rng(3), shipped.views, []
    for seed in range(4):
        for own in range(len(shipped)):
            view = rng.integers(36)
            mean = views.branching.mean[own, view] + SHIFT + rng.normal(0, SD, 3)
            posture = views.posture[own, view] + SHIFT + rng.normal(0, SD, 11)
            outline = views.footprint[own, view] + 0.01 * rng.normal(size=64)
            one = Branching(mean[None], np.full((1, 3), 0.1), np.full((1, 3), 20.0))
            samples.append(Sample(own, seed, SketchShape(outline, one, posture), SketchShape(None, one, posture)))
    return samples


@pytest.mark.parametrize("crown", [True, False])
def test_shift_and_spread_are_found_again_and_own_exemplars_become_likelier(shipped, made, crown):
    train, held = [s for s in made if s.seed], [s for s in made if not s.seed]
    learnt = fit(train, shipped.views, crown)
    free = [i for i, name in enumerate(TRAITS) if name != "stems"]
    assert learnt.shift[free] == pytest.approx(SHIFT, abs=0.03)
    assert learnt.sd[free] == pytest.approx(SD, abs=0.03)
    names = np.array(shipped.names)
    before, after = (
        measured(held, crown, lambda shape, m=m: calibrated_terms(shape, shipped.views, m), names) for m in (_first(shipped.views), learnt)
    )
    assert after[0] > before[0] and after[1] >= 0.9, (before, after)


def test_without_correlations_there_are_none(shipped, made):
    plain = fit(made, shipped.views, False, diagonal=True, rounds=1)
    np.testing.assert_array_equal(plain.correlation, np.eye(len(TRAITS)))
    assert not fit(made, shipped.views, False, rounds=1).correlation[BRANCHING, POSTURE].any()


def test_what_is_written_is_the_metric():
    room = {"Metric": Metric, "np": np, "correlations": correlations}
    exec(written("AGAIN", BARE), room)
    for field in ("weight", "harmonic_sd", "shift", "sd", "correlation"):
        np.testing.assert_allclose(getattr(room["AGAIN"], field), getattr(BARE, field))
