import numpy as np

from sketchtree import keys, limb_ids

KEY = keys.root_key(0)
IDS = np.arange(20_000)


def test_stages_have_different_keys():
    one = keys.uniform(keys.stage_key(KEY, "foliage"), IDS, 0)
    other = keys.uniform(keys.stage_key(KEY, "propagate"), IDS, 0)
    assert not np.allclose(one, other)


def test_the_same_key_and_limb_give_the_same_number_whatever_the_row():
    order = np.random.default_rng(1).permutation(IDS)
    np.testing.assert_array_equal(keys.uniform(KEY, IDS, 3)[order], keys.uniform(KEY, order, 3))


def test_uniform_numbers_are_uniform_and_draws_independent():
    one, two = keys.uniform(KEY, IDS, 0), keys.uniform(KEY, IDS, 1)
    assert (one >= 0).all() and (one < 1).all()
    counts = np.histogram(one, 20, (0, 1))[0]
    assert np.sum((counts - 1000) ** 2 / 1000) < 45  # χ² with 19 degrees of freedom, p < 0.001
    assert abs(np.corrcoef(one, two)[0, 1]) < 0.03


def test_normal_numbers_have_mean_0_and_sd_1():
    number = keys.normal(KEY, IDS, 0)
    assert abs(number.mean()) < 0.03 and abs(number.std() - 1) < 0.03


def test_stroke_ids_do_not_depend_on_the_process():
    assert limb_ids.stroke_limb_id("stroke-1") == limb_ids.stroke_limb_id("stroke-1") >= 0
    assert limb_ids.stroke_limb_id("stroke-1") != limb_ids.stroke_limb_id("stroke-2")


def test_children_of_limbs_have_ids_of_their_own():
    parents = np.repeat(np.arange(1000), 50)
    ids = limb_ids.child_limb_id(parents, np.tile(np.arange(50), 1000))
    assert len(np.unique(ids)) == 50_000 and (ids >= 0).all()
