import numpy as np

from sketchtree.geometry.limbs import centre_lines
from sketchtree.skeleton import Kind, TreeSkeleton

TWIG = 0.003


def drawn_limb(tip=0.045, kind=Kind.DRAWN, twig_at=3):
    """A stem with a limb of 4 m, `tip` metres thick at its end, and a thin twig on the limb's row `twig_at` (1-4)."""
    tips = np.array([[0, 0, 0], [0, 2, 0], [1, 2.2, 0], [2, 2.5, 0], [3, 2.7, 0], [4, 3, 0], [0, 0.3, 0.2]], float)
    tips[6] += tips[twig_at + 1]
    kinds = [int(kind)] * 6 + [int(Kind.PROPAGATED)]
    return TreeSkeleton.from_columns(
        [-1, 0, 1, 2, 3, 4, twig_at + 1], tips, [0.3, 0.2, 0.08, 0.07, 0.06, tip, TWIG], limb=[1, 1, 7, 7, 7, 7, 9], order=[0, 0, 1, 1, 1, 1, 2], kind=kinds
    )


def limb_radii(tree):
    lines = centre_lines(tree)
    limb = int(np.flatnonzero(lines.limb_id == 7)[0])
    own = slice(lines.start[limb], lines.start[limb + 1])
    return lines.s[own], lines.radius[own]


def test_a_limb_drawn_thick_to_its_end_runs_out_into_a_twig():
    s, radius = limb_radii(drawn_limb())
    assert np.isclose(radius[-1], TWIG) and np.all(np.diff(radius) <= 1e-12)


def test_only_its_last_stretch_grows_thinner():
    s, radius = limb_radii(drawn_limb(twig_at=1))
    _, measured = limb_radii(drawn_limb(kind=Kind.OBSERVED, twig_at=1))
    inner = s < 0.5 * s[-1]
    assert np.allclose(radius[inner], measured[inner]) and np.all(radius <= measured + 1e-12)
    assert np.abs(np.diff(radius) / np.diff(s)).max() < 0.25


def test_the_skeleton_keeps_what_was_drawn():
    tree = drawn_limb()
    centre_lines(tree)
    assert tree.radius[5] == 0.045


def test_a_limb_that_carries_something_at_its_tip_keeps_its_width():
    _, radius = limb_radii(drawn_limb(twig_at=4))
    assert np.isclose(radius[-1], 0.045)


def test_measured_wood_ends_as_it_was_measured():
    assert np.isclose(limb_radii(drawn_limb(kind=Kind.OBSERVED))[1][-1], 0.045)


def test_a_tip_not_much_thicker_than_a_twig_stays_so():
    assert np.isclose(limb_radii(drawn_limb(tip=3.9 * TWIG))[1][-1], 3.9 * TWIG)


def test_a_stump_stays_a_stump():
    assert np.isclose(limb_radii(drawn_limb(tip=17 * TWIG))[1][-1], 17 * TWIG)
