"""What every matting holds to, and each equation of the paper's."""

import jax
import numpy as np
import pytest
from scipy.ndimage import gaussian_filter

from benchmarks.matting_cases import before, drawn_tree, made_backgrounds
from sketchtree.errors import OptionError, SketchError
from sketchtree.matting.closed_form import LAMBDA, closed_form, factored, normalised_objective
from sketchtree.matting.dissection import dissected
from sketchtree.matting.layered import layered
from sketchtree.matting.laplacian import laplacian, volume
from sketchtree.matting.matte import DEFAULT, MATTINGS, find_matte
from sketchtree.matting.normalised import least_ratio, normalised
from sketchtree.matting.reach import FAR, STEP, held
from sketchtree.matting.scribbles import Scribbles
from sketchtree.matting.standing_out import TOLD, told_apart
from sketchtree.photo.photo import Photo

KEY = jax.random.key(0)
FORE, TRUTH, SCRIBBLES = drawn_tree(80, 60)
BACKS = made_backgrounds(80, 60)
SKY = before(FORE, TRUTH, BACKS["sky"], "sky")


def sad(alpha) -> float:
    return float(np.abs(alpha - TRUTH).sum() / TRUTH.sum())


def flat(photo: Photo) -> np.ndarray:
    return photo.rgb / 255.0


def test_eq2_volume_is_the_number_of_windows_that_hold_a_pixel():
    counted = np.zeros((5, 6))
    for row in range(1, 4):
        for column in range(1, 5):
            counted[row - 1 : row + 2, column - 1 : column + 2] += 1
    np.testing.assert_array_equal(volume((5, 6)).reshape(5, 6), counted)


def test_eq2_rows_of_the_affinity_sum_to_the_volume():
    """L = D − A has rows that sum to 0; D is no diagonal of L, which lacks A_ii."""
    matrix = laplacian(flat(SKY))
    np.testing.assert_allclose(matrix @ np.ones(80 * 60), 0.0, atol=1e-8)
    assert np.abs(matrix.diagonal() - volume((80, 60))).max() > 0.1


def test_eq2_laplacian_is_that_of_its_definition():
    draw = np.random.default_rng(0)
    rgb = draw.uniform(size=(4, 4, 3))
    expected = np.zeros((16, 16))
    for row in range(1, 3):
        for column in range(1, 3):
            members = np.array([(r, c) for r in range(row - 1, row + 2) for c in range(column - 1, column + 2)])
            colours = rgb[members[:, 0], members[:, 1]]
            apart = colours - colours.mean(axis=0)
            inverse = np.linalg.inv(apart.T @ apart / 9 + np.eye(3) * 1e-3 / 9)
            at = members[:, 0] * 4 + members[:, 1]
            expected[np.ix_(at, at)] += np.eye(9) - (1 + apart @ inverse @ apart.T) / 9
    np.testing.assert_allclose(laplacian(rgb, epsilon=1e-3).toarray(), expected, atol=1e-9)


def test_every_pixel_stands_once_in_the_order_of_dissection():
    np.testing.assert_array_equal(np.sort(dissected(23, 31)), np.arange(23 * 31))


def test_eq1_closed_form_solves_its_linear_system():
    fore, back = SCRIBBLES.masks(SKY)
    matrix = laplacian(flat(SKY))
    alpha = factored(matrix, fore | back).solve(LAMBDA * fore.ravel().astype(float))
    left = matrix @ alpha + LAMBDA * (fore | back).ravel() * alpha
    np.testing.assert_allclose(left, LAMBDA * fore.ravel(), atol=1e-4)
    np.testing.assert_allclose(np.clip(alpha, 0, 1).reshape(fore.shape), closed_form(SKY, SCRIBBLES, key=KEY).alpha, atol=1e-6)


@pytest.mark.parametrize("back", ["sky", "grass"])
def test_eq3_objective_never_rises_and_ends_below_closed_form(back):
    photo = before(FORE, TRUTH, BACKS[back], back)
    found = normalised(photo, SCRIBBLES, key=KEY)
    assert (np.diff(found.course) <= 0).all() and len(found.course) > 2
    matrix = laplacian(flat(photo))
    assert normalised_objective(matrix, found.alpha) < normalised_objective(matrix, closed_form(photo, SCRIBBLES, key=KEY).alpha)
    assert found.course[-1] == pytest.approx(normalised_objective(matrix, found.alpha), rel=1e-3)


def test_eq4_quadratic_form_is_the_ratio_of_eq3():
    """w = D^½ α / q, W = D^-½ L D^-½: wᵀWw = αᵀLα / αᵀDα. Pixels in no window have no part in either."""
    matrix, weight = laplacian(flat(SKY)), volume((80, 60))
    alpha = np.random.default_rng(1).uniform(size=80 * 60)
    q = np.sqrt(alpha @ (weight * alpha))
    w = np.sqrt(weight) * alpha / q
    quadratic = (w / np.sqrt(weight)) @ (matrix @ (w / np.sqrt(weight)))
    assert quadratic == pytest.approx(normalised_objective(matrix, alpha.reshape(80, 60)), rel=1e-9)


@pytest.mark.parametrize("method", MATTINGS)
def test_mattes_lie_in_0_to_1_and_the_same_key_gives_the_same_bytes(method):
    one, two = (find_matte(SKY, SCRIBBLES, key=KEY, method=method) for _ in range(2))
    assert one.method == method and one.alpha.dtype == np.float32 and one.alpha.min() >= 0 and one.alpha.max() <= 1
    assert one.alpha.tobytes() == two.alpha.tobytes()


@pytest.mark.parametrize("method", MATTINGS)
def test_a_matte_that_nobody_wants_any_more_ends_at_a_pulse(method):
    def enough():
        raise StopIteration

    with pytest.raises(StopIteration):
        find_matte(SKY, SCRIBBLES, key=KEY, method=method, pulse=enough)


@pytest.mark.parametrize("method", ["normalised", "layered"])
def test_scribbles_are_kept_exactly(method):
    fore, back = SCRIBBLES.masks(SKY)
    alpha = find_matte(SKY, SCRIBBLES, key=KEY, method=method).alpha
    assert (alpha[fore] == 1).all() and (alpha[back] == 0).all()


@pytest.mark.parametrize("back", BACKS)
def test_ours_beats_closed_form_and_the_empty_matte(back):
    photo = before(FORE, TRUTH, BACKS[back], back)
    ours, theirs = sad(layered(photo, SCRIBBLES, key=KEY).alpha), sad(closed_form(photo, SCRIBBLES, key=KEY).alpha)
    assert ours <= 0.9 * theirs and ours < 1, f"{ours:.3f}, closed form {theirs:.3f}"


def test_a_mirrored_photo_has_about_the_mirrored_matte():
    turned = Scribbles(*(tuple(line * [-1, 1] + [60, 0] for line in side) for side in (SCRIBBLES.foreground, SCRIBBLES.background)), SCRIBBLES.brush)
    mirrored = layered(Photo(SKY.rgb[:, ::-1]), turned, key=KEY).alpha[:, ::-1]
    assert np.abs(mirrored - layered(SKY, SCRIBBLES, key=KEY).alpha).mean() < 0.02


def test_where_the_surroundings_look_like_wood_it_says_so():
    patches = gaussian_filter(np.random.default_rng(0).normal(size=(80, 60)), 3.0)
    back = np.clip(0.5 + 0.25 * patches / patches.std(), 0, 1)[..., None] * [1.0, 0.86, 0.74]
    found = layered(before(FORE, TRUTH, back, "bark"), SCRIBBLES, key=KEY)
    assert sad(found.alpha) < 1.0
    assert found.warnings == ("The surroundings have the wood's colours in places; what could be either was left out of the matte. More scribbles there, of both kinds, help.",)


def test_the_alpha_of_a_file_is_its_matte_and_that_is_said():
    alpha = np.round(255 * TRUTH).astype(np.uint8)
    found = find_matte(Photo(SKY.rgb, alpha, "tree.png"), SCRIBBLES, key=KEY)
    np.testing.assert_allclose(found.alpha, alpha / 255, atol=1e-6)
    assert found.warnings == ("tree.png is transparent in part; its own alpha was taken as the matte, and the scribbles were not used.",)


def test_a_large_photo_is_matted_smaller_and_that_is_said():
    found = find_matte(SKY, SCRIBBLES, key=KEY, largest=3000)
    assert found.alpha.shape == TRUTH.shape and sad(found.alpha) < 1
    assert found.warnings == ("sky has 60 × 80 pixels; the matte was found on 47 × 63 and enlarged.",)


def test_a_photo_of_one_colour_gives_a_matte_not_an_error():
    grey = Photo(np.full((40, 30, 3), 128, np.uint8))
    lines = Scribbles(([[15, 35], [15, 10]],), ([[3, 5], [3, 35]],))
    for method in MATTINGS:
        assert np.isfinite(find_matte(grey, lines, key=KEY, method=method).alpha).all()


def test_what_cannot_be_matted_is_named():
    with pytest.raises(OptionError, match="There is no matting called 'magic'. Choose one of: layered, closed-form, normalised."):
        find_matte(SKY, SCRIBBLES, key=KEY, method="magic")
    with pytest.raises(SketchError, match="sky needs scribbles that say what is tree. Give --scribbles FILE"):
        find_matte(SKY, None, key=KEY)
    with pytest.raises(SketchError, match="tiny has 2 × 2 pixels; 3 × 3 are the least. Give a larger photo."):
        find_matte(Photo(np.zeros((2, 2, 3), np.uint8), None, "tiny"), Scribbles(([[0.5, 0.5]],), ([[1.5, 1.5]],), 0.5), key=KEY)
    assert DEFAULT in MATTINGS


def test_a_marked_limb_is_held_up_to_its_edge_whatever_its_surroundings_colours():
    """A trunk whose colours are those of the bushes behind it: what is marked along its middle is learnt as tree, never as what is behind."""
    rgb = np.full((40, 60, 3), 0.3)
    rgb[:, [24, 35]] = 0.5  # the edges of a trunk of the same grey as its surroundings
    fore, back = np.zeros((40, 60), bool), np.zeros((40, 60), bool)
    fore[5:35, 30], back[5:35, [5, 55]] = True, True
    surely = held(rgb, fore, back)
    assert surely[20, 30] == 1.0 and surely[20, 27] == pytest.approx(np.exp(-3 * STEP / FAR), rel=0.02)
    assert surely[20, 21] < 0.5 * surely[20, 27]
    assert surely[20, 6] == 0.0


def test_eq4_falls_too_where_the_preconditioner_is_of_no_use():
    matrix, known = laplacian(flat(SKY)), SCRIBBLES.masks(SKY)[0] | SCRIBBLES.masks(SKY)[1]
    start = np.where(SCRIBBLES.masks(SKY)[0], 1.0, np.where(known, 0.0, 0.5)).ravel()
    _, course = least_ratio(matrix, volume(known.shape), start, ~known.ravel(), lambda right: -right)
    assert (np.diff(course) < 0).all() and course[-1] < 0.5 * course[0]


@pytest.mark.parametrize("back", ["flat white", "sky", "grass", "brick"])
def test_lines_on_a_mere_background_are_remarked_on(back):
    plain = Photo(np.round(255 * np.broadcast_to(BACKS[back], (80, 60, 3))).astype(np.uint8))
    assert TOLD in find_matte(plain, SCRIBBLES, key=KEY).warnings


@pytest.mark.parametrize("back", BACKS)
def test_a_tree_stands_out(back):
    photo = before(FORE, TRUTH, BACKS[back], back)
    assert told_apart(flat(photo), *SCRIBBLES.masks(photo), KEY) > 0.9
    assert TOLD not in find_matte(photo, SCRIBBLES, key=KEY).warnings
