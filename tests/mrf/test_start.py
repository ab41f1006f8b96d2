"""A run that begins where another ended: its signs stay, whatever is drawn beside it."""

from functools import cache

import jax
import numpy as np
import pytest

from sketchtree.errors import InferenceError
from sketchtree.mrf.elevation import LOYAL, Elevation
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.infer import infer
from sketchtree.mrf.prior import Prior
from sketchtree.sketch.graph import SketchGraph
from tests.mrf.drawings import random_tree, small_tree

SEEDS = (0, 1, 2)


def _fit(sketch, seed=0, **options):
    return infer(factor_graph(sketch), Prior(), Elevation(**options), key=jax.random.key(seed))


@cache
def _first(limbs):
    return _fit(_tree(limbs))


def _tree(limbs) -> SketchGraph:
    return small_tree() if limbs == 0 else random_tree(0, 8) if limbs == 8 else _without_last(random_tree(0, 8))


def _without_last(tree: SketchGraph) -> SketchGraph:
    """The drawing before its last stroke."""
    rows = tree.limb < tree.limb.max()
    columns = {name: getattr(tree, name)[rows] for name in ("parent", "xy", "limb", "stroke", "tree", "width", "joined", "root")}
    return tree.replace(**columns, curve_start=np.zeros(rows.sum() + 1, int), limb_id=tree.limb_id[:-1], stroke_ids=tree.stroke_ids[:-1])


def _by_limb(tree: SketchGraph, other: SketchGraph, depth):
    """Depths of `tree` at the rows of `other` that lie on the same limbs (told by id), NaN elsewhere."""
    start = np.full(len(other), np.nan)
    for limb, name in enumerate(other.limb_id):
        rows = np.flatnonzero(tree.limb_id[tree.limb] == name)
        if len(rows):
            start[other.limb == limb] = depth[rows]
    return start


def _rises(tree: SketchGraph, depth):
    """z of every lateral's tip over its limb's start."""
    limbs = np.flatnonzero(tree.limb_parent >= 0)
    return depth[tree.limb_tip[limbs]] - depth[tree.parent[tree.limb_first[limbs]]]


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("mirror", [1, -1])
def test_a_start_keeps_its_signs_and_its_mirror_side(mirror, seed):
    start = mirror * _first(0).depth
    again = _fit(small_tree(), seed, start=start)
    assert (np.sign(_rises(small_tree(), again.depth)) == np.sign(_rises(small_tree(), start))).all()


def test_a_start_takes_fewer_steps():
    again = _fit(small_tree(), start=_first(0).depth)
    assert again.steps == Elevation().default_steps - (len(Elevation().burn) - 1)
    assert again.steps < _first(0).steps
    assert again.log_posterior > _first(0).log_posterior - 1.0


@pytest.mark.parametrize("seed", SEEDS)
def test_one_more_stroke_leaves_the_others_on_their_sides(seed):
    before, after = _tree(7), _tree(8)
    start = _by_limb(before, after, _first(7).depth)
    assert np.isnan(start).sum() == 2
    fit = _fit(after, seed, start=start)
    old = np.sign(_rises(before, _first(7).depth))
    assert (np.sign(_rises(after, fit.depth))[: len(old)] == old).all()


def test_a_start_of_nothing_known_is_a_start_from_anywhere():
    fit = _fit(small_tree(), start=np.full(11, np.nan))
    assert np.isfinite(fit.depth).all() and fit.depth[0] == 0
    assert np.abs(_rises(small_tree(), fit.depth)).min() > 1


def test_a_start_on_the_wrong_side_is_given_up_where_others_are_much_likelier():
    """All limbs in front: the model wants them on both sides, by more than `LOYAL`."""
    start = np.abs(_first(0).depth) + np.where(factor_graph(small_tree()).is_base, 0.0, 30.0)
    fit = _fit(small_tree(), start=start)
    assert fit.log_posterior > _first(0).log_posterior - LOYAL


def test_the_first_answer_is_the_start():
    from sketchtree.mrf.infer import refine

    start = _first(0).depth
    first = next(refine(factor_graph(small_tree()), Prior(), Elevation(start=start), key=jax.random.key(0)))
    np.testing.assert_allclose(first.depth, start, atol=1e-9 * small_tree().height)


@pytest.mark.parametrize(
    "start, shape",
    [(np.zeros(10), "(10,)"), (np.zeros((11, 1)), "(11, 1)"), (0.0, "()"), (np.full(11, np.inf), "(11,)")],
    ids=["short", "two axes", "a number", "infinite"],
)
def test_a_start_of_another_shape_is_refused(start, shape):
    with pytest.raises(InferenceError) as raised:
        _fit(small_tree(), start=start)
    assert str(raised.value) == f"`start` has the shape {shape}, or a depth that is infinite. Give 11 depths, NaN where none is known."
