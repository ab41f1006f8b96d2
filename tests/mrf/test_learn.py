"""A prior learnt from trees whose depths are known."""

from functools import cache

import numpy as np
import pytest

from sketchtree.errors import SkeletonError
from sketchtree.export.skeletons import write_skeleton_json, write_swc
from sketchtree.mrf.chen.em import FLOORS
from sketchtree.mrf.conjugate import GENERIC_BELIEF, checked_belief, limb_prior
from sketchtree.mrf.prior import Prior
from sketchtree.skeleton import TreeSkeleton

LATERALS = 6


def _tree(divergence: float, ratio: float, seed: int) -> TreeSkeleton:
    """A trunk of 10 m and six straight limbs at about one angle (radians), each `ratio` of the trunk, all round it."""
    rng = np.random.default_rng(seed)
    height = np.linspace(2.0, 10.0, LATERALS + 1)
    trunk = [[0, 0, 0], *([0, y, 0] for y in height)]
    angle = rng.normal(divergence, 0.05, LATERALS)
    azimuth = np.arange(LATERALS) * 2.4 + rng.uniform(0, 6)
    length = 10 * ratio * np.exp(rng.normal(0, 0.05, LATERALS))
    out = np.stack([np.sin(angle) * np.cos(azimuth), np.cos(angle), np.sin(angle) * np.sin(azimuth)], 1) * length[:, None]
    tip = np.array([*trunk, *(np.array(trunk)[1:-1] + out)])
    parent = np.r_[-1, np.arange(LATERALS + 1), 1 + np.arange(LATERALS)]
    limb = np.r_[np.zeros(LATERALS + 2, int), 1 + np.arange(LATERALS)]
    order = (limb > 0).astype(int)
    return TreeSkeleton.from_columns(parent, tip, np.where(order > 0, 0.05, 0.2), order=order, limb=limb)


@cache
def _species(divergence, ratio, count=6):
    return Prior.from_skeletons([_tree(divergence, ratio, seed) for seed in range(count)])


@pytest.mark.parametrize("divergence", [0.5, 1.3])
def test_divergences_of_a_species_move_their_mean_towards_it(divergence):
    learnt, generic = _species(divergence, 0.4).belief.divergence[0, 0], GENERIC_BELIEF["divergence"][0][0]
    assert abs(learnt - divergence) < 0.5 * abs(generic - divergence)
    assert (learnt - generic) * (divergence - generic) > 0


@pytest.mark.parametrize("ratio", [0.15, 0.6])
def test_limb_lengths_of_a_species_move_their_mean_towards_it(ratio):
    """Towards log ratio; trunks are as long as the drawing is high, and so are segments told."""
    short, long = (_species(0.9, r).belief.length[0, 0] for r in (0.15, 0.6))
    assert long - short > 0.5 * np.log(0.6 / 0.15)
    generic = GENERIC_BELIEF["length"][0][0]
    assert (_species(0.9, ratio).belief.length[0, 0] > generic) == (np.log(ratio) > generic)


def test_trees_of_one_kind_make_a_surer_prior():
    """All alike: the variance shrinks, and the mean of the next tree is known better."""
    _, kappa, _, s2 = _species(0.5, 0.4).belief.divergence[:, 0]
    assert s2 < GENERIC_BELIEF["divergence"][3][0]
    assert kappa < 1e3 and s2 > 0


def test_what_the_trees_do_not_have_stays_generic():
    belief = _species(0.5, 0.4).belief
    np.testing.assert_allclose(belief.divergence[:, 1], np.array(GENERIC_BELIEF["divergence"])[:, 1], rtol=1e-3)
    np.testing.assert_allclose(belief.bend[:, 2], np.array(GENERIC_BELIEF["bend"])[:, 2], rtol=1e-3)


def test_one_tree_is_no_catastrophe():
    belief = checked_belief(_species(0.5, 0.4, 1).belief)
    assert 0.4 < belief.divergence[0, 0] < GENERIC_BELIEF["divergence"][0][0] + 0.1
    np.testing.assert_array_equal(limb_prior(Prior(belief=belief), np.float64).divergence, belief.divergence)


def test_chen_s_theta_is_measured_too():
    theta = _species(0.5, 0.4).theta
    assert theta.mu_beta == pytest.approx(0.5, abs=0.06)
    assert theta.mu_alpha < 0.05
    assert theta.sigma_alpha == FLOORS["alpha"]  # their trunks are straight, and σ = 0 would be no prior


def test_a_folder_is_read_whatever_its_files_are_and_in_any_order(tmp_path):
    trees = [_tree(0.6, 0.4, seed) for seed in range(3)]
    write_swc(tmp_path / "a.SWC", trees[0], header={})
    write_skeleton_json(tmp_path / "b.json", trees[1])
    np.savez(tmp_path / "c.npz", parent=trees[2].parent, pos=trees[2].tip, radius=trees[2].radius)
    (tmp_path / "readme.txt").write_text("no tree")
    folder, given = Prior.from_skeletons(tmp_path), Prior.from_skeletons(trees)
    assert Prior.from_skeletons(str(tmp_path)).belief.divergence.tolist() == folder.belief.divergence.tolist()
    for name in GENERIC_BELIEF:
        np.testing.assert_allclose(getattr(folder.belief, name), getattr(given.belief, name), rtol=1e-3)


def test_a_learnt_prior_is_saved_and_loaded(tmp_path):
    prior = _species(0.5, 0.4)
    prior.save(tmp_path / "p.json")
    back = Prior.load(tmp_path / "p.json")
    for name in GENERIC_BELIEF:
        np.testing.assert_array_equal(getattr(back.belief, name), getattr(prior.belief, name))


ENDINGS = ".swc, .json, .npz"


def test_no_tree_is_named(tmp_path):
    for none in (tmp_path, []):
        with pytest.raises(SkeletonError) as raised:
            Prior.from_skeletons(none)
        assert str(raised.value) == f"There is no skeleton to learn from. Give trees, or a folder of {ENDINGS} files."


def test_a_folder_that_is_none_is_named(tmp_path):
    (tmp_path / "file.swc").write_text("1 0 0 0 0 1 -1\n")
    for path in (tmp_path / "nowhere", tmp_path / "file.swc"):
        with pytest.raises(SkeletonError) as raised:
            Prior.from_skeletons(path)
        assert str(raised.value) == f"{path} is no folder. Give a folder of {ENDINGS} files."


def test_a_broken_file_is_named(tmp_path):
    write_swc(tmp_path / "a.swc", _tree(0.6, 0.4, 0), header={})
    (tmp_path / "b.swc").write_text("1 0 0 0\n")
    with pytest.raises(SkeletonError) as raised:
        Prior.from_skeletons(tmp_path)
    assert str(raised.value) == (
        f"{tmp_path / 'b.swc'}, line 1: expected `id type x y z radius parent`, got `1 0 0 0`. Repair the line or start it with #."
    )
