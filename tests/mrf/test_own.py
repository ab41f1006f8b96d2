"""Factors of a user's own: what they may be, what they do, and what is said when they can't be used."""

import tempfile
from functools import cache
from pathlib import Path

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

from sketchtree.errors import InferenceError
from sketchtree.mrf import compilation
from sketchtree.mrf.elevation import Elevation
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.factors.own import _Held
from sketchtree.mrf.infer import infer
from sketchtree.mrf.log_posterior import KINDS, log_posterior
from sketchtree.mrf.prior import Prior
from tests.mrf.drawings import small_tree

SHORT = {"burn": (3.0, 1.0), "keep": 1, "cool": (0.1, 1e-3)}  # enough to see which way a factor pulls


class Screen(eqx.Module):
    """No tip comes nearer to the viewer than `nearest`, H."""

    nearest: jax.Array

    def log_potential(self, assignment, theta):
        return -0.5 * (jnp.maximum(assignment.tip.z - self.nearest, 0.0) / 0.01) ** 2


class Together:
    """The limbs that begin at rows 5 and 6 lie on one side of the page: elsewhere the factor is not a number."""

    def log_potential(self, assignment, theta):
        product = assignment.elevation[5] * assignment.elevation[6]
        return jnp.where(product < 0, jnp.nan, 0.0)[None]


class Forward:
    """Every limb named in `wanted` leans to the viewer; needs the drawing to know which those are (row 7)."""

    wanted = ("s3",)

    def __init__(self, graph):
        named = [limb for limb, name in enumerate(graph.limb_name) if name in self.wanted]
        self.rows = np.flatnonzero(np.isin(graph.limb, named))

    def log_potential(self, assignment, theta):
        return 40.0 * jnp.minimum(assignment.elevation[self.rows], 0.3)


@cache
def _graph():
    return factor_graph(small_tree())


def _fit(factors, seed=0, **options):
    return infer(_graph(), Prior(), Elevation(factors=factors, **SHORT, **options), key=jax.random.key(seed))


@cache
def _screened(nearest):
    """The best tree itself: its median and stretch know nothing of factors."""
    return _fit({"screen": Screen(jnp.float32(nearest))}, typical=False)


def _programs():
    """How many programs of chains there are in memory."""
    return sum(name == "chains" for name, *_ in compilation._PROGRAMS)


TOGETHER = Together()


@cache
def _together():
    """(a fit with a plain object and a class, how many programs that took, what was kept on disk)."""
    before, count = jax.config.jax_compilation_cache_dir, _programs()
    with tempfile.TemporaryDirectory() as folder:
        jax.config.update("jax_compilation_cache_dir", folder)
        try:
            fit = _fit({"together": TOGETHER, "forward": Forward})
        finally:
            jax.config.update("jax_compilation_cache_dir", before)
        kept = list(Path(folder).rglob("programs/*"))
    return fit, _programs() - count, kept


def _psi(graph, seed=0):
    psi = np.random.default_rng(seed).normal(0, 0.4, len(graph))
    return np.pad(np.where(graph.is_base, 0.0, psi), (0, 32 - len(graph))).astype(np.float32)


def _kinds(graph, factors, psi):
    """{kind: Σ log potential} at ψ and at one Θ, the prior's."""
    posterior = log_posterior(graph, Prior(), factors=factors)
    assignment, theta = posterior.page.assign(psi), posterior.belief.mean()
    return {name: float(jnp.sum(kind.log_potential(assignment, theta))) for name, kind in posterior.factors.items()}


def test_a_new_name_adds_a_kind_and_leaves_the_others_as_they_are(small):
    psi = _psi(small)
    plain, screened = _kinds(small, {}, psi), _kinds(small, {"screen": Screen(jnp.float32(-9.0))}, psi)
    assert list(screened) == [*KINDS, "screen"]
    assert screened.pop("screen") < -100
    assert screened == plain


def test_a_kind_s_name_replaces_that_kind(small):
    psi = _psi(small)
    replaced = _kinds(small, {"siblings": Screen(jnp.float32(-9.0))}, psi)
    assert set(replaced) == set(KINDS)
    assert replaced["siblings"] < -100


def test_none_leaves_a_kind_out(small):
    psi = _psi(small)
    plain, less = _kinds(small, {}, psi), _kinds(small, {"crown": None, "competition": None}, psi)
    assert set(plain) - set(less) == {"crown", "competition"}
    assert all(less[name] == plain[name] for name in less)


def test_a_kind_left_out_is_out_of_the_log_posterior(small):
    psi = _psi(small)
    whole, less = (log_posterior(small, Prior(), factors=factors) for factors in ({}, {"crown": None}))
    crown = float(jnp.sum(whole.crown.log_potential(whole.page.assign(psi), whole.belief.mean())))
    assert float(whole(psi)) - float(less(psi)) == pytest.approx(crown, abs=1e-3)


def test_theta_of_a_kind_left_out_stays_the_prior_s(small):
    psi = _psi(small)
    less = log_posterior(small, Prior(), factors={"lateral": None})
    np.testing.assert_array_equal(less.updated(psi).divergence, less.belief.divergence)
    assert not np.array_equal(less.updated(psi).bend, less.belief.bend)


def test_a_factor_pulls_the_limbs_where_it_says():
    near, free = (_screened(nearest) for nearest in (0.05, 9.0))
    assert near.depth.max() < 0.07 * small_tree().height
    assert free.depth.max() > 0.15 * small_tree().height
    assert np.quantile(near.posterior.depth.max(axis=1), 0.9) < 0.1 * small_tree().height


def test_what_is_shown_keeps_to_the_factor_too():
    """The median and the stretch know nothing of factors; where they break one, the tree itself is shown."""
    assert _fit({"screen": Screen(jnp.float32(0.05))}).depth.max() < 0.08 * small_tree().height


def test_other_numbers_in_a_module_need_no_new_program():
    _screened(0.05)
    before = len(compilation._PROGRAMS)
    _screened(9.0)
    assert len(compilation._PROGRAMS) == before


def test_an_object_and_a_class_are_compiled_once_though_a_run_asks_twice():
    fit, programs, _ = _together()
    assert programs == 1
    before = len(compilation._PROGRAMS)
    assert _fit({"together": TOGETHER, "forward": Forward}).depth.tobytes() == fit.depth.tobytes()
    assert len(compilation._PROGRAMS) == before


def test_a_program_with_an_own_factor_is_not_kept_on_disk():
    _, _, kept = _together()
    assert kept == []


def test_a_class_is_called_with_the_graph():
    fit, *_ = _together()
    assert fit.depth[7] > 0.05 * small_tree().height
    assert (fit.posterior.elevation[:, :, 7] > 0).mean() > 0.95


def test_where_a_factor_is_not_a_number_there_is_a_wall():
    fit, *_ = _together()
    assert np.isfinite(fit.depth).all() and np.isfinite(fit.log_posterior) and np.isfinite(fit.trace["log_posterior"]).all()
    assert np.isfinite(fit.posterior.value).all()
    one, other = fit.posterior.elevation[:, :, 5], fit.posterior.elevation[:, :, 6]
    assert (one * other >= 0).all()
    assert (one != 0).any()
    assert (fit.depth[5] - fit.depth[1]) * (fit.depth[6] - fit.depth[2]) > 0


def test_an_object_whose_attributes_changed_is_another_program():
    screen = Together()
    screen.nearest = 0.1
    before = _Held(screen)
    assert _Held(screen) == before and hash(_Held(screen)) == hash(before)
    screen.nearest = 0.2
    assert _Held(screen) != before
    assert _Held(Together()) != _Held(Together())
    screen.rule = lambda z: z  # can't be compared
    assert _Held(screen) != _Held(screen)


def test_a_function_that_makes_a_factor_is_as_good_as_a_class(small):
    psi = _psi(small)
    made = _kinds(small, {"screen": lambda graph: Screen(jnp.float32(-float(len(graph))))}, psi)
    assert made["screen"] == pytest.approx(_kinds(small, {"screen": Screen(jnp.float32(-11.0))}, psi)["screen"])


class _Says:
    """A factor that returns whatever `value` makes of the assignment."""

    def __init__(self, value):
        self.value = value

    def log_potential(self, assignment, theta):
        return self.value(assignment)


def _at(row, value):
    return _Says(lambda assignment: jnp.zeros_like(assignment.elevation).at[row].set(value))


SHAPES = "Return one real number a factor, in an array with one axis."
GUARD = "Guard divisions, logarithms and roots: padded rows have length 0."


@pytest.mark.parametrize(
    "given, message",
    [
        (3.0, "The factor `mine` has no `log_potential(assignment, theta)`. Give an object that has, or a class that makes one from the factor graph."),
        (lambda graph: 3.0, "The factor `mine` made an object without `log_potential(assignment, theta)`. Return an object that has one."),
        (
            _Says(lambda assignment: assignment.wall),
            "The factor `mine` failed: AttributeError: 'Assignment' object has no attribute 'wall'. "
            "Write `log_potential` with jax.numpy, for arrays of any length.",
        ),
        (_Says(lambda _: jnp.float32(1.0)), f"The factor `mine` returned an array of shape () and type float32. {SHAPES}"),
        (_Says(lambda _: 1.0), f"The factor `mine` returned float. {SHAPES}"),
        (_Says(lambda _: None), f"The factor `mine` returned NoneType. {SHAPES}"),
        (_Says(lambda _: jnp.zeros((11, 2))), f"The factor `mine` returned an array of shape (11, 2) and type float32. {SHAPES}"),
        (_Says(lambda a: a.is_segment.astype(np.int32)), f"The factor `mine` returned an array of shape (32,) and type int32. {SHAPES}"),
        (_at(9, jnp.nan), f"The factor `mine` returned nan for factor 9 (segment 9, stroke s1). {GUARD}"),
        (_at(20, jnp.nan), f"The factor `mine` returned nan for factor 20. {GUARD}"),
        (_at(10, jnp.inf), f"The factor `mine` returned inf for factor 10 (segment 10, stroke s5). {GUARD}"),
        (
            _at(4, -jnp.inf),
            "The factor `mine` rules out every depth that was tried (−∞). Let it fall off smoothly, so that the search can find its way in.",
        ),
    ],
    ids=["no factor", "made none", "fails", "scalar", "number", "nothing", "two axes", "whole numbers", "nan", "nan in the padding", "inf", "-inf"],
)
def test_a_factor_that_can_t_be_used_is_named(small, given, message):
    with pytest.raises(InferenceError) as raised:
        log_posterior(small, Prior(), factors={"mine": given})
    assert str(raised.value) == message


def test_an_error_of_ours_inside_a_factor_is_passed_on(small):
    def refuse(assignment):
        raise InferenceError("This drawing has no wall.", remedy="Draw one.")

    with pytest.raises(InferenceError, match="This drawing has no wall. Draw one."):
        log_posterior(small, Prior(), factors={"mine": _Says(refuse)})


def test_a_wall_on_one_side_is_no_error(small):
    log_posterior(small, Prior(), factors={"mine": _Says(lambda a: jnp.where(a.elevation < -0.1, -jnp.inf, 0.0))})


def test_explaining_and_sampling_know_the_factor():
    fit = _screened(0.05)
    assert fit.posterior.theta.shape == (len(fit.posterior), len(fit.posterior.theta_names))
    assert [own.name for own in fit.posterior.model.own] == ["screen"]


def test_polishing_with_a_factor_of_one_s_own_is_not_kept_on_disk_either(monkeypatch):
    from sketchtree.mrf.sampling import ascend as module

    asked = {}

    def compiled(function, *arguments, name, keep=True):
        asked[name] = keep
        return lambda posterior, padded, *rest: (padded, jnp.float32(0.0))

    monkeypatch.setattr(module, "compiled", compiled)
    graph = factor_graph(small_tree())
    module.ascend(log_posterior(graph, Prior(), factors={"together": Together()}), np.zeros(len(graph)), "minimiser")
    module.ascend(log_posterior(graph, Prior()), np.zeros(len(graph)), "minimiser of none")
    assert list(asked.values()) == [False, True]
