"""Foliage is found in a photo by its colour (`photo/foliage_mask`; Tan et al. 2008, §2)."""

import numpy as np
import pytest
from PIL import Image, ImageDraw
from scipy import ndimage

from sketchtree.errors import OptionError, SketchError
from sketchtree.keys import root_key
from sketchtree.photo.foliage_mask import SMOOTHNESS, contrast_weight, foliage_mask, within
from sketchtree.photo.greenness import greenest, greenness
from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import Photo

SKY, MEADOW, LEAF, BLOSSOM, WOOD = (120, 170, 235), (110, 150, 60), (48, 78, 28), (245, 240, 236), (60, 45, 38)
CROWN = np.array([(80 + 62 * np.cos(t), 70 + 56 * np.sin(t)) for t in np.linspace(0, 2 * np.pi, 40, endpoint=False)])


def painted(leaf, around=SKY, *, clumps=220, grain=6.0, seed=0):
    """(photo, its true foliage): clumps of leaves in a round crown, background between them."""
    rng = np.random.default_rng(seed)
    places = list(zip(rng.uniform(0, 2 * np.pi, clumps), np.sqrt(rng.uniform(0, 1, clumps)), strict=True))
    image, cover = Image.new("RGB", (160, 160), around), Image.new("1", (160, 160))
    for draw, fill in ((ImageDraw.Draw(image), leaf), (ImageDraw.Draw(cover), 1)):
        for angle, away in places:
            x, y = 80 + 52 * away * np.cos(angle), 70 + 46 * away * np.sin(angle)
            draw.ellipse((x - 4, y - 4, x + 4, y + 4), fill=fill)
    rgb = np.asarray(image) + rng.normal(0, grain, (160, 160, 3))
    return Photo(np.clip(rgb, 0, 255).astype(np.uint8)), np.array(cover)


def overlap(mask, truth):
    return (mask & truth).sum() / (mask | truth).sum()


def found(photo, **options):
    return foliage_mask(photo, Marked(CROWN, ()), key=root_key(0), **options)


def test_the_region_is_the_closed_stroke_expanded_ten_times_by_the_paper():
    photo, _ = painted(LEAF)
    expected = ndimage.binary_dilation(within(CROWN, (160, 160)), iterations=10)
    assert (found(photo, rule="paper").region == expected).all()


@pytest.mark.parametrize("times", [1, 6])
def test_by_contrast_it_is_expanded_by_ten_pixels_where_a_photo_has_1500(times):
    photo, _ = painted(LEAF)
    large = Photo(np.kron(photo.rgb, np.ones((times, times, 1), np.uint8)))
    region = foliage_mask(large, Marked(CROWN * times, ()), key=root_key(0)).region
    assert (region == ndimage.binary_dilation(within(CROWN * times, region.shape), iterations={1: 2, 6: 6}[times])).all()


def test_within_takes_the_pixels_whose_middles_are_surrounded():
    inside = within(np.array([(2.0, 1.0), (6.0, 1.0), (6.0, 4.0), (2.0, 4.0)]), (6, 8))
    assert (np.argwhere(inside).min(0) == [1, 2]).all() and (np.argwhere(inside).max(0) == [3, 5]).all() and inside.sum() == 12


def test_the_four_most_green_or_red_components_are_leaves():
    mean = np.array([(200, 200, 200), (40, 90, 30), (100, 150, 230), (190, 60, 30), (60, 70, 40), (90, 140, 60), (250, 250, 250), (20, 20, 20)], float)
    assert sorted(greenest(mean)) == [1, 3, 4, 5]


def test_blue_and_cyan_are_not_green_and_the_shade_is_as_green_as_the_sun():
    assert greenness(np.array([90, 160, 230])) <= 0 and greenness(np.array([60, 200, 220])) <= 0 and greenness(np.array([128, 128, 128])) == 0
    assert abs(greenness(np.array([40, 80, 20])) - greenness(np.array([80, 160, 40]))) < 0.02


def test_of_equal_scores_the_darker_is_a_leaf():
    assert greenest(np.array([(200.0,) * 3, (20.0,) * 3, (90.0,) * 3]), 2).tolist() == [1, 2]


def test_the_smooth_term_is_lambda_over_the_difference_at_least_one():
    pair = np.array([(10, 10, 10), (10, 10, 10), (10, 10, 10)], float), np.array([(10, 10, 10), (13, 14, 10), (10.5, 10, 10)], float)
    assert contrast_weight(*pair, 60.0).tolist() == [60.0, 12.0, 60.0]


def test_eq_without_smoothness_each_pixel_has_the_label_of_less_energy(monkeypatch):
    """E_d = −β log G(I, θ^B) − (1 − β) log G(I, θ^F), summed alone where λ = 0."""
    monkeypatch.setitem(SMOOTHNESS, "paper", 0.0)
    photo, _ = painted(LEAF)
    foliage = found(photo, rule="paper")
    colour = photo.rgb[foliage.region].astype(float)
    apart = foliage.leaf.log_density(colour) - foliage.background.log_density(colour)
    clear = np.abs(apart) > 0.01  # capacities are whole numbers
    assert (foliage.mask[foliage.region] == (apart > 0))[clear].all() and clear.mean() > 0.9


def test_the_paper_finds_green_leaves_before_a_blue_sky():
    photo, truth = painted(LEAF)
    assert overlap(found(photo, rule="paper").mask, truth) > 0.85


@pytest.mark.parametrize(("leaf", "around"), [(LEAF, SKY), (BLOSSOM, SKY), ((170, 70, 30), (225, 228, 232)), (LEAF, MEADOW), ((30,) * 3, (220,) * 3), ((70, 80, 30), (24, 34, 20))])
def test_contrast_finds_leaves_blossom_and_grey_foliage(leaf, around):
    photo, truth = painted(leaf, around)
    foliage = found(photo)
    assert overlap(foliage.mask, truth) > 0.9 and not foliage.bare and foliage.warnings == ()


def test_what_was_found_is_described_by_mixtures():
    photo, truth = painted(LEAF)
    foliage = found(photo)
    leaf, sky = photo.rgb[truth].astype(float), photo.rgb[~truth].astype(float)
    assert (foliage.leaf.log_density(leaf) > foliage.background.log_density(leaf)).mean() > 0.95
    assert (foliage.background.log_density(sky) > foliage.leaf.log_density(sky)).mean() > 0.95


def test_the_same_key_finds_the_same_foliage():
    photo, _ = painted(LEAF)
    one, two = found(photo), found(photo)
    assert (one.mask == two.mask).all() and (one.leaf.mean == two.leaf.mean).all()


def test_alpha_says_where_the_tree_is():
    photo, truth = painted(LEAF)
    assert (found(Photo(photo.rgb, (truth * 255).astype(np.uint8))).mask == (truth & found(photo).region)).all()


def bare():
    image = Image.new("RGB", (160, 160), SKY)
    draw = ImageDraw.Draw(image)
    for angle in np.linspace(-2.9, -0.2, 12):
        draw.line((80, 110, 80 + 62 * np.cos(angle), 110 + 85 * np.sin(angle)), fill=WOOD, width=2)
    return Photo(np.clip(np.asarray(image) + np.random.default_rng(1).normal(0, 3, (160, 160, 3)), 0, 255).astype(np.uint8))


def test_the_mask_of_a_bare_tree_is_what_its_twigs_span():
    foliage = found(bare())
    wood = np.abs(bare().rgb.astype(int) - WOOD).max(axis=2) < 40
    assert foliage.bare and foliage.mask.sum() > 2 * wood.sum()
    leafy = found(bare(), bare=False)
    assert not leafy.bare and leafy.mask.sum() < 1.6 * (wood & foliage.region).sum()


def test_a_large_photo_has_a_mask_of_its_own_size():
    photo, truth = painted(LEAF)
    large = Photo(np.kron(photo.rgb, np.ones((16, 16, 1), np.uint8)))
    foliage = foliage_mask(large, Marked(CROWN * 16, ()), key=root_key(0))
    assert foliage.mask.shape == (2560, 2560) and overlap(foliage.mask[8::16, 8::16], truth) > 0.85


def test_a_crown_round_the_open_sky_holds_no_foliage():
    rgb = np.full((160, 160, 3), SKY) + np.random.default_rng(2).normal(0, 3, (160, 160, 3))
    with pytest.raises(SketchError) as error:
        found(Photo(rgb.astype(np.uint8)))
    assert str(error.value).startswith("Stroke crown: there is no foliage inside it: ") and error.value.remedy == "Draw it round the crown of a tree, or give a photo that shows one."


def test_a_photo_of_one_colour_holds_no_foliage():
    for rule in ("contrast", "paper"):
        with pytest.raises(SketchError, match="there is no foliage inside it"):
            found(Photo(np.full((160, 160, 3), 200, np.uint8)), rule=rule)


def test_a_crown_in_a_wood_of_its_own_colour_is_taken_whole_and_said():
    rgb = np.full((160, 160, 3), LEAF) + np.random.default_rng(2).normal(0, 8, (160, 160, 3))
    foliage = found(Photo(np.clip(rgb, 0, 255).astype(np.uint8)))
    assert (foliage.mask == foliage.region).all()
    assert foliage.warnings == ("The crown has the colours of what is around it: all that its stroke surrounds was taken for foliage.",)


def test_grey_by_the_papers_rule_is_remarked_on():
    photo, _ = painted((30,) * 3, (220,) * 3, grain=0.0)
    grey = np.repeat(np.clip(photo.rgb[..., :1] + np.random.default_rng(0).normal(0, 5, (160, 160, 1)), 0, 255), 3, axis=2).astype(np.uint8)
    assert found(Photo(grey), rule="paper").warnings == ("Nothing inside the crown's stroke is green or red; the darkest colours were taken for leaves.",)


def test_a_crown_that_fills_the_photo_has_nothing_to_compare_with():
    photo, truth = painted(LEAF)
    whole = np.array([(0, 0), (160, 0), (160, 160), (0, 160)], float)
    foliage = foliage_mask(photo, Marked(whole, ()), key=root_key(0))
    assert foliage.warnings[0].startswith("The crown's stroke leaves nothing of the photo around it")


def test_an_unknown_rule_is_refused():
    photo, _ = painted(LEAF)
    with pytest.raises(OptionError) as error:
        found(photo, rule="magic")
    assert str(error.value) == "There is no rule of foliage 'magic'. Say one of: paper, contrast."


def plain(colour, slope=0.0, grain=4.0) -> Photo:
    """A picture of nothing but one colour, lighter by `slope` levels from its top to its foot."""
    rise = slope * np.linspace(-0.5, 0.5, 160)[:, None, None]
    return Photo(np.clip(np.array(colour) + rise + np.random.default_rng(0).normal(0, grain, (160, 160, 3)), 0, 255).astype(np.uint8))


@pytest.mark.parametrize(("colour", "slope"), [(SKY, 60.0), ((225, 228, 232), 20.0), ((120, 120, 118), 40.0)])
def test_a_crown_round_nothing_but_sky_snow_or_stone_is_refused(colour, slope):
    """A sky is lighter towards the horizon: inside the stroke it has colours that are rare around it, and yet it is no tree."""
    with pytest.raises(SketchError, match="there is no foliage inside it: it (goes on beyond the stroke|has the colours of what is around it)"):
        found(plain(colour, slope))


def test_what_hardly_stands_out_but_might_be_leaves_is_taken_and_told():
    photo = plain(MEADOW, 70.0, grain=9.0)
    assert any("hardly stands out" in told or "has the colours of what is around it" in told for told in found(photo).warnings)


@pytest.mark.parametrize("leaf", [LEAF, BLOSSOM])
def test_a_crown_before_the_sky_stands_out(leaf):
    assert not found(painted(leaf)[0]).warnings
