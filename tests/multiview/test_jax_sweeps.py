"""PatchMatch by jax is PatchMatch by numba: the same numbers by chance, costs and planes, but for rounding."""

from dataclasses import replace

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from ring import rendered, ring

from sketchtree.errors import OptionError
from sketchtree.keys import root_key
from sketchtree.multiview import patchmatch
from sketchtree.multiview.accelerated import sweep_jax
from sketchtree.multiview.accelerated.chance_jax import chance, word
from sketchtree.multiview.accelerated.cost_jax import Others, Patches, mean_of_best, patches_of, source_costs
from sketchtree.multiview.accelerated.engine import engine_of
from sketchtree.multiview.accelerated.sweep_jax import Sweeps, energy_of
from sketchtree.multiview.cost import SIDE, UNSEEN, patch_of, source_cost
from sketchtree.multiview.cost import mean_of_best as mean_by_numba
from sketchtree.multiview.depths import Quality, depth_maps
from sketchtree.multiview.photos_cloud import photos_cloud
from sketchtree.multiview.sources import sources_of
from sketchtree.multiview.workplace import level_of, partners

VIEWS = ring(4, 12.0, size=(64, 64))
SOURCES = sources_of([view.camera for view in VIEWS], 3, np.zeros((0, 3)), [np.zeros(0, np.int64)] * len(VIEWS))
LEVELS = [level_of(view, one, 1) for view, one in zip(VIEWS, SOURCES, strict=True)]
LEVEL, NEAR = LEVELS[1], partners(LEVELS[1], LEVELS)
LOW, HIGH, FOCAL = LEVEL.sources.low, LEVEL.sources.high, float(LEVEL.camera.matrix[0, 0])
OTHERS = Others(NEAR.transfers, jnp.asarray(NEAR.others.ravel()), NEAR.sizes.astype(np.int32), NEAR.others.shape[1:])
SEED = np.uint64(0xDEADBEEF12345678)
GREY = jnp.asarray(LEVEL.grey.ravel())
numbers = jax.jit(chance)
patches, costs, energies = (jax.jit(of, static_argnames=names) for of, names in ((patches_of, "shape"), (source_costs, ()), (energy_of, "best")))


@pytest.fixture(autouse=True)
def small_pieces(monkeypatch):
    """Each colour of the little picture goes over in several pieces, as one of a large picture does."""
    assert LEVEL.used.sum() > 2 * 2 * 128
    monkeypatch.setattr(sweep_jax, "PIECE", 128)


def planes_by_chance(count):
    """Pixels of the plant and planes that they might show."""
    generator = np.random.default_rng(3)
    y, x = generator.permutation(np.argwhere(LEVEL.used))[:count].astype(np.int32).T
    rho = generator.uniform(LOW, HIGH, count)
    return x, y, np.stack([rho, *(generator.uniform(-1, 1, (2, count)) * rho / FOCAL)]).astype(np.float32)


def patch_by_numba(x, y, step=1):
    weight, value = np.empty(SIDE * SIDE, np.float32), np.empty(SIDE * SIDE, np.float32)
    return (weight, value, *patch_of(LEVEL.grey, int(x), int(y), step, weight, value))


def test_the_same_numbers_are_drawn_by_chance():
    x, y = np.arange(200, dtype=np.int32) * 31, np.arange(200, dtype=np.int32) * 77 % 1009
    for seed, draw in ((SEED, 29), (np.uint64(2**64 - 1), 0), (np.uint64(0), 41)):
        found = np.asarray(numbers(word(int(seed)), x, y, draw))
        expected = [patchmatch.chance(seed, i, j, draw) for i, j in zip(x.tolist(), y.tolist(), strict=True)]
        assert (found >= 0).all() and (found < 1).all()
        np.testing.assert_allclose(found, expected, atol=2.0**-24)


@pytest.mark.parametrize("step", [1, 2])
def test_patches_are_the_same_at_the_rim_too(step):
    y, x = np.array([[0, 0], [63, 63], [1, 62], [30, 32]], np.int32).T
    found = Patches(*map(np.asarray, patches(GREY, LEVEL.shape, x, y, step)))
    for k, (one, two) in enumerate(zip(x, y, strict=True)):
        weight, value, total, mean, variance, middle = patch_by_numba(one, two, step)
        np.testing.assert_allclose(found.weight[:, k], weight, atol=1e-6)
        np.testing.assert_allclose(found.value[:, k], value, atol=1e-6)
        assert (found.total[k], found.mean[k], found.variance[k], found.middle[k]) == pytest.approx((total, mean, variance, middle), abs=2e-6)


def test_costs_are_the_same_but_for_rounding():
    x, y, plane = planes_by_chance(300)
    found = np.asarray(costs(x, y, *plane, OTHERS, patches(GREY, LEVEL.shape, x, y, 1), 1))
    expected = np.empty_like(found)
    for k in range(len(x)):
        weight, value, total, mean, variance, middle = patch_by_numba(x[k], y[k])
        for j in range(len(NEAR.others)):
            expected[j, k] = source_cost(int(x[k]), int(y[k]), *plane[:, k].tolist(), NEAR.transfers[j], NEAR.others[j], *NEAR.sizes[j], 1, weight, value, total, mean, variance, middle)
    apart = np.abs(found - expected)
    assert 0.05 < (expected == UNSEEN).mean() < 0.95  # both kinds are there
    assert np.median(apart) < 1e-6 and (apart < 1e-5).mean() > 0.98 and apart.max() < 2e-4  # most in patches that are nearly even


def test_of_several_photos_the_same_ones_count():
    given = np.random.default_rng(0).uniform(0, 2, (5, 40)).astype(np.float32)
    for best, count in ((2, 5), (2, 1), (9, 4)):
        np.testing.assert_allclose(mean_of_best(given[:count], best), [mean_by_numba(column.copy(), best) for column in given[:count].T], rtol=1e-6)


def test_eq2_is_the_same_and_what_is_outside_the_range_or_too_steep_is_impossible():
    x, y, plane = planes_by_chance(300)
    plane[0, :10], plane[1, 10:20] = 1.1 * HIGH, 3 * plane[0, 10:20] / FOCAL
    prior = np.where(np.arange(300) % 2, 0.5 * (LOW + HIGH), 0.0).astype(np.float32)
    sought = np.array([LOW, HIGH, FOCAL], np.float32)
    found = np.asarray(energies(x, y, plane, prior, sought, OTHERS, patches(GREY, LEVEL.shape, x, y, 1), 1, best=2))
    for k in range(300):
        weight, value, total, mean, variance, middle = patch_by_numba(x[k], y[k])
        expected = patchmatch.energy_of(
            int(x[k]), int(y[k]), *plane[:, k].tolist(), LOW, HIGH, FOCAL, float(prior[k]), NEAR.transfers, NEAR.others, NEAR.sizes, 1, 2, weight, value, total, mean, variance, middle, np.empty(3), np.inf
        )
        assert found[k] == pytest.approx(expected, abs=1e-4)
    assert (found[:20] == patchmatch.IMPOSSIBLE).all()


def test_a_sweep_of_both_colours_finds_the_same_planes():
    start, prior = patchmatch.starting(LEVEL.shape, LOW, HIGH, np.random.default_rng(0)), np.zeros((*LEVEL.shape, 3), np.float32)
    prior[:, 32:, 0] = 0.35
    plane, energy = start.copy(), np.zeros(LEVEL.shape, np.float32)
    level = replace(LEVEL, plane=start.copy(), energy=np.zeros(LEVEL.shape, np.float32))
    sweep = Sweeps(level, NEAR, 1, 2)
    for colour in (0, 1):
        patchmatch.sweep(
            colour, 0, 64, LEVEL.grey, LEVEL.used, plane, energy, prior, LOW, HIGH, FOCAL, NEAR.transfers, NEAR.others, NEAR.sizes, 1, 2, 0.05, 2, SEED
        )
        sweep(colour, prior, 0.05, 2, SEED)
    same = (np.abs(level.plane - plane) < 1e-5).all(axis=2)[LEVEL.used]
    assert same.mean() > 0.99 and level.energy[LEVEL.used].mean() == pytest.approx(energy[LEVEL.used].mean(), abs=1e-3)
    assert (level.plane[~LEVEL.used] == start[~LEVEL.used]).all() and (level.plane != start)[LEVEL.used].any(axis=1).mean() > 0.9


def test_depth_maps_are_as_good_and_the_same_seed_gives_the_same_bytes():
    quality = Quality(longest=64, sources=3, shrinks=(1,), rounds=(3,), coherence=False, guided=0)
    truth = rendered(VIEWS[1].camera)[1]

    def off(engine):
        level = depth_maps(VIEWS, SOURCES, replace(quality, engine=engine), key=root_key(0))[1]
        there = level.used & (truth > 0)
        return np.abs(1 / level.plane[there][:, 0] - truth[there]), level.plane.tobytes()

    (by_numba, _), (by_jax, once), (_, again) = off("numba"), off("jax"), off("jax")
    assert np.median(by_jax) < 1.03 * np.median(by_numba) and np.median(by_jax) < 0.02  # of 3 m
    assert (by_jax > 0.05).mean() < (by_numba > 0.05).mean() + 0.01
    assert once == again


def test_jax_works_where_it_has_a_gpu_and_numba_elsewhere(monkeypatch):
    for backend, engine in (("cpu", "numba"), ("gpu", "jax")):
        monkeypatch.setattr(jax, "default_backend", lambda backend=backend: backend)
        assert engine_of("auto") == engine
        assert (engine_of("numba"), engine_of("jax")) == ("numba", "jax")


@pytest.mark.parametrize("made", [
    lambda: depth_maps(VIEWS, SOURCES, Quality(longest=64, sources=3, shrinks=(1,), rounds=(1,), engine="cuda"), key=root_key(0)),
    lambda: photos_cloud("no photos yet", key=root_key(0), engine="cuda"),
])  # fmt: skip
def test_an_engine_that_there_is_not_is_named(made):
    with pytest.raises(OptionError) as error:
        made()
    assert str(error.value) == "There is no engine called 'cuda'. Choose one of: auto, numba, jax."
