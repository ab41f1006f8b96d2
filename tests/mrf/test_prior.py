"""Priors as files, and beliefs that are none."""

import dataclasses
import json

import equinox as eqx
import jax
import numpy as np
import pytest

from sketchtree.errors import InferenceError, TemplateError
from sketchtree.mrf.conjugate import GENERIC_BELIEF, LimbBelief, checked_belief, limb_prior
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.infer import infer
from sketchtree.mrf.log_posterior import log_posterior
from sketchtree.mrf.methods import solver_named
from sketchtree.mrf.prior import Prior
from sketchtree.parameters import GENERIC, LimbStatistics, TreeParameters
from tests.mrf.drawings import small_tree

OURS = "Give a file written by `Prior.save`."


def _belief(**changed) -> LimbBelief:
    return LimbBelief(**{name: np.array(value) for name, value in (GENERIC_BELIEF | changed).items()})


def _statistics() -> LimbStatistics:
    return LimbStatistics(
        np.array([3, 0]), np.array([0.5, 0.0]), np.array([0.01, 0.0]), np.array([3, 2]), np.array([-0.7, -0.6]),
        np.array([0.05, 0.02]), np.array([4, 3, 0]), np.array([0.02, 0.1, 0.0]),
    )  # fmt: skip


PRIORS = {
    "generic": Prior(),
    "of a template": Prior(TreeParameters(*np.linspace(0.1, 0.8, 8).tolist()), _statistics()),
    "learnt": Prior(belief=_belief(divergence=[[0.5, 0.6], [1.0, 2.0], [5.0, 6.0], [0.1, 1 / 3]])),
}


@pytest.mark.parametrize("name", list(PRIORS))
def test_what_is_saved_can_be_loaded_to_the_last_bit(tmp_path, name):
    prior = PRIORS[name]
    prior.save(tmp_path / "p.json")
    back = Prior.load(tmp_path / "p.json")
    assert back.theta == prior.theta
    assert (back.limbs is None) == (prior.limbs is None) and (back.belief is None) == (prior.belief is None)
    for part in ("limbs", "belief"):
        for column, value in vars(getattr(prior, part) or Prior()).items() if getattr(prior, part) is not None else ():
            np.testing.assert_array_equal(vars(getattr(back, part))[column], value)
    for one, other in zip(vars(limb_prior(back)).values(), vars(limb_prior(prior)).values(), strict=True):
        np.testing.assert_array_equal(one, other)


def test_saving_what_was_loaded_gives_the_same_bytes(tmp_path):
    PRIORS["of a template"].save(tmp_path / "p.json")
    Prior.load(tmp_path / "p.json").save(tmp_path / "q.json")
    assert (tmp_path / "p.json").read_bytes() == (tmp_path / "q.json").read_bytes()


def test_a_prior_is_plain_json_that_says_what_it_is(tmp_path):
    PRIORS["learnt"].save(tmp_path / "p.json")
    content = json.loads((tmp_path / "p.json").read_text())
    assert set(content) == {"sketchtree_prior", "theta", "limbs", "belief"}
    assert content["sketchtree_prior"] == 1 and content["limbs"] is None
    assert content["belief"]["divergence"][0] == [0.5, 0.6]


def _written(folder, **changed):
    """A saved prior with some keys changed; None takes a key out."""
    PRIORS["of a template"].save(folder / "p.json")
    content = json.loads((folder / "p.json").read_text()) | changed
    (folder / "p.json").write_text(json.dumps({k: v for k, v in content.items() if v != "gone"}))
    return folder / "p.json"


def _sound() -> dict:
    return {k: np.asarray(v).tolist() for k, v in vars(_belief()).items()}


@pytest.mark.parametrize(
    "changed, message",
    [
        ({"sketchtree_prior": "gone"}, f"{{path}} is not a prior of ours. {OURS}"),
        ({"sketchtree_prior": 2}, "{path} has prior format 2; this version reads 1. Update sketchtree."),
        ({"theta": "gone"}, f"{{path}} is a prior with missing or misspelt parts. {OURS}"),
        ({"theta": {"mu_s": 1.0}}, f"{{path}} is a prior with missing or misspelt parts. {OURS}"),
        ({"theta": GENERIC.as_dict() | {"mu_s": "x"}}, f"{{path}} is a prior with missing or misspelt parts. {OURS}"),
        ({"theta": GENERIC.as_dict() | {"sigma_s": 0.0}}, "{path}: `sigma_s` of Θ is 0.0. Give finite numbers; every σ above 0."),
        ({"theta": [1, 2]}, f"{{path}} is a prior with missing or misspelt parts. {OURS}"),
        ({"limbs": {"divergence": [1]}}, f"{{path}} is a prior with missing or misspelt parts. {OURS}"),
        ({"limbs": 7}, f"{{path}} is a prior with missing or misspelt parts. {OURS}"),
        ({"belief": {"divergence": [[1]]}}, f"{{path}} is a prior with missing or misspelt parts. {OURS}"),
        ({"belief": _sound() | {"length": "x"}}, f"{{path}} is a prior with missing or misspelt parts. {OURS}"),
        (
            {"belief": _sound() | {"length": [[1.0, 2.0]]}},
            "{path}: `length` of the prior has the shape (1, 2). Give (4, 2): a row a hyperparameter, a column an order.",
        ),
        (
            {"belief": _sound() | {"bend": [[6.0, 6.0, 6.0], [0.1, 0.1, 0.0]]}},
            "{path}: `bend` of order 2 of the prior is [6.0, 0.0]. Give finite numbers; κ, ν and variances above 0.",
        ),
    ],
    ids=["no mark", "newer", "no theta", "part of theta", "theta a word", "no sigma", "theta a list", "limbs misspelt", "limbs a number", "belief misspelt", "belief a word", "belief short", "no variance"],
)
def test_a_file_that_is_no_prior_is_named(tmp_path, changed, message):
    path = _written(tmp_path, **changed)
    with pytest.raises(TemplateError) as raised:
        Prior.load(path)
    assert str(raised.value) == message.format(path=path)


@pytest.mark.parametrize("text", ["", "no json", "[1]", "3", "null"])
def test_another_file_is_named(tmp_path, text):
    (tmp_path / "p.json").write_text(text)
    with pytest.raises(TemplateError) as raised:
        Prior.load(tmp_path / "p.json")
    assert str(raised.value) == f"{tmp_path / 'p.json'} is not a prior of ours. {OURS}"


def test_a_file_of_bytes_is_named(tmp_path):
    (tmp_path / "p.json").write_bytes(b"\xff\xfe\x00\x81")
    with pytest.raises(TemplateError, match="is not a prior of ours"):
        Prior.load(tmp_path / "p.json")


def test_a_place_that_can_t_be_read_or_written_is_named(tmp_path):
    away = tmp_path / "nowhere" / "p.json"
    with pytest.raises(TemplateError) as raised:
        Prior.load(away)
    assert str(raised.value) == f"Can't read {away}: no such file or directory. Check the path."
    with pytest.raises(TemplateError) as raised:
        Prior().save(away)
    assert str(raised.value) == f"Can't write {away}: no such file or directory. Choose another place."


@pytest.mark.parametrize("bad", [0.0, -0.1, np.nan, np.inf])
@pytest.mark.parametrize(
    "kind, row, column, order",
    [("divergence", 3, 0, 1), ("divergence", 3, 1, 2), ("length", 3, 0, 1), ("segment", 3, 1, 2), ("bend", 1, 0, 0), ("bend", 1, 2, 2)],
)
def test_a_variance_that_is_none_is_refused_naming_kind_and_order(kind, row, column, order, bad):
    value = np.array(GENERIC_BELIEF[kind])
    value[row, column] = bad
    with pytest.raises(InferenceError) as raised:
        log_posterior(factor_graph(small_tree()), Prior(belief=_belief(**{kind: value})))
    told = f"`{kind}` of order {order} of the prior is {value[:, column].tolist()}. Give finite numbers; κ, ν and variances above 0."
    assert str(raised.value) == told


@pytest.mark.parametrize("row", [1, 2])
def test_kappa_and_nu_have_to_be_positive_too(row):
    value = np.array(GENERIC_BELIEF["length"])
    value[row, 0] = 0.0
    with pytest.raises(InferenceError, match="`length` of order 1 of the prior is"):
        checked_belief(_belief(length=value))


def test_a_mean_may_be_anything_finite():
    value = np.array(GENERIC_BELIEF["length"])
    value[0] = -4.0
    assert checked_belief(_belief(length=value)).length[0, 0] == -4.0
    value[0, 1] = np.nan
    with pytest.raises(InferenceError, match="`length` of order 2"):
        checked_belief(_belief(length=value))


def test_another_shape_is_refused():
    with pytest.raises(InferenceError) as raised:
        checked_belief(_belief(bend=np.ones((2, 2))))
    assert str(raised.value) == "`bend` of the prior has the shape (2, 2). Give (2, 3): a row a hyperparameter, a column an order."


def test_a_belief_of_one_s_own_is_the_prior_and_a_template_moves_it():
    own = _belief(divergence=[[0.3, 0.4], [2.0, 2.0], [9.0, 9.0], [0.1, 0.1]])
    plain, moved = limb_prior(Prior(belief=own), np.float64), limb_prior(Prior(GENERIC, _statistics(), own), np.float64)
    np.testing.assert_array_equal(plain.divergence, own.divergence)
    assert moved.divergence[0, 0] == pytest.approx((2 * 0.3 + 3 * 0.5) / 5)
    np.testing.assert_array_equal(moved.divergence[:, 1], own.divergence[:, 1])
    assert eqx.tree_equal(limb_prior(Prior(belief=_belief())), limb_prior(Prior()))


@pytest.mark.parametrize("name, bad", [("sigma_s", 0.0), ("sigma_beta", -1.0), ("sigma_gamma", np.nan), ("mu_alpha", np.inf)])
@pytest.mark.parametrize("method", ["chen", "chen-fixed"])
def test_a_theta_that_is_none_is_refused_naming_the_parameter(method, name, bad):
    theta = dataclasses.replace(GENERIC, **{name: bad})
    with pytest.raises(InferenceError) as raised:
        infer(factor_graph(small_tree()), Prior(theta), solver_named(method), key=jax.random.key(0))
    assert str(raised.value) == f"`{name}` of Θ is {bad}. Give finite numbers; every σ above 0."


@pytest.mark.parametrize(
    "part, bad, kind, order",
    [
        ("divergence_variance", [-5.0, 0.0], "divergence", 1),
        ("length_mean", [-0.7, np.nan], "length", 2),
        ("bend_square", [0.02, -9.0, 0.0], "bend", 1),
    ],
)
def test_statistics_that_are_none_are_refused_naming_kind_and_order(part, bad, kind, order):
    limbs = dataclasses.replace(_statistics(), **{part: np.array(bad)})
    with pytest.raises(InferenceError, match=f"`{kind}` of order {order} of the prior is .* Give finite numbers; κ, ν and variances above 0."):
        limb_prior(Prior(limbs=limbs))
