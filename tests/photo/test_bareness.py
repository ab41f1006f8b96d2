"""A tree is bare where what was found is lines and not an area (`photo/bareness`), and then a hedge beside it is no part of it."""

import numpy as np
import pytest
from PIL import Image, ImageDraw

from sketchtree.keys import root_key
from sketchtree.photo.bareness import cover, looks_bare, spanned
from sketchtree.photo.foliage_mask import foliage_mask
from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import Photo

SIDE = 320
CROWN = np.array([(160 + 130 * np.cos(a), 150 + 120 * np.sin(a)) for a in np.linspace(0, 2 * np.pi, 40, endpoint=False)])
WOOD, SKY = (60, 52, 44), (226, 228, 232)


def crown() -> np.ndarray:
    return drawn(lambda pen: pen.polygon([tuple(point) for point in CROWN], fill=1))


def drawn(how) -> np.ndarray:
    image = Image.new("L", (SIDE, SIDE), 0)
    how(ImageDraw.Draw(image))
    return np.asarray(image) > 0


def twigs(pen, fill=1, count=16) -> None:
    """A fan of limbs, each with twigs off it."""
    for angle in np.linspace(-2.9, -0.25, count):
        way = np.array([np.cos(angle), np.sin(angle)])
        tip = (160, 250) + 190 * way * (0.6 + 0.4 * abs(np.sin(angle)))
        pen.line([(160, 250), tuple(tip)], fill=fill, width=3)
        for share in (0.5, 0.75):
            foot = (160, 250) + share * (tip - (160, 250))
            for turn in (-0.6, 0.6):
                pen.line([tuple(foot), tuple(foot + 28 * np.array([np.cos(angle + turn), np.sin(angle + turn)]))], fill=fill, width=2)


def leaves(pen, fill=1, count=2600) -> None:
    draw = np.random.default_rng(3)
    for x, y in draw.uniform(30, 270, (count, 2)):
        if np.hypot((x - 160) / 125, (y - 150) / 115) < 1:
            pen.ellipse((x - 4, y - 3, x + 4, y + 3), fill=fill)


def test_twigs_are_bare_and_leaves_are_not():
    assert looks_bare(drawn(twigs), crown()) and not looks_bare(drawn(leaves), crown())


def test_leaves_with_sky_between_them_are_leaves():
    assert 0.7 < drawn(lambda pen: leaves(pen, count=1900))[crown()].mean() < 0.9
    assert not looks_bare(drawn(lambda pen: leaves(pen, count=1900)), crown())


def test_a_loose_stroke_round_a_crown_in_leaf_makes_it_no_barer():
    small = drawn(lambda pen: pen.ellipse((120, 110, 200, 190), fill=1))
    assert small[crown()].mean() < 0.15 and not looks_bare(small, crown())


def test_a_few_bare_limbs_far_apart_are_no_leaves():
    limbs = lambda pen: [pen.line([(160, 260), tip], fill=1, width=9) for tip in ((60, 150), (160, 50), (250, 110))]  # noqa: E731
    assert looks_bare(drawn(limbs), crown())


def test_a_thick_trunk_and_a_hedge_make_bare_twigs_no_leaves():
    with_more = drawn(lambda pen: (twigs(pen), pen.rectangle((150, 180, 175, 270), fill=1), pen.rectangle((60, 232, 260, 262), fill=1)))
    assert looks_bare(with_more, crown())


@pytest.mark.parametrize("times", [2, 5])
def test_a_larger_photo_of_the_same_tree_says_the_same(times):
    large = lambda mask: np.kron(mask, np.ones((times, times), bool))  # noqa: E731
    for how in (twigs, leaves):
        assert cover(large(drawn(how)), large(crown())) == pytest.approx(cover(drawn(how), crown()), abs=0.12)


def test_nothing_found_spans_nothing():
    none = np.zeros((SIDE, SIDE), bool)
    assert not spanned(none, crown()).any() and not looks_bare(none, crown())


def painted(how, behind=lambda pen: None) -> Photo:
    image = Image.new("RGB", (SIDE, SIDE), SKY)
    pen = ImageDraw.Draw(image)
    behind(pen)
    pen.rectangle((0, 275, SIDE, SIDE), fill=(150, 146, 140))
    pen.line((160, 310, 160, 250), fill=WOOD, width=14)
    how(pen, WOOD)
    return Photo(np.clip(np.asarray(image) + np.random.default_rng(1).normal(0, 4, (SIDE, SIDE, 3)), 0, 255).astype(np.uint8))


def test_a_photo_of_twigs_is_bare_and_one_of_leaves_is_not():
    for how, bare in ((twigs, True), (leaves, False)):
        assert foliage_mask(painted(how), Marked(CROWN, ()), key=root_key(0)).bare == bare


def test_a_few_limbs_are_found_though_something_as_dark_stands_around():
    """A severely pruned tree before a dark house: little of the crown is wood, and much of what is around is as dark."""
    few = foliage_mask(painted(lambda pen, fill: twigs(pen, fill, count=6), lambda pen: pen.rectangle((0, 215, SIDE, 275), fill=WOOD)), Marked(CROWN, ()), key=root_key(0))
    assert few.bare and few.warnings == () and few.mask[100:200, 60:260].any()


def test_a_hedge_beside_a_bare_tree_is_no_part_of_what_its_twigs_span():
    photo = painted(lambda pen, fill: twigs(pen, fill, count=6), lambda pen: pen.rectangle((0, 215, SIDE, 275), fill=WOOD))
    beside = crown() & ((np.arange(SIDE) < 90) & (np.arange(SIDE) > 30))[None] & (np.arange(SIDE) > 225)[:, None]
    bare, leafy = (foliage_mask(photo, Marked(CROWN, ()), key=root_key(0), bare=bare).mask for bare in (True, False))
    assert leafy[beside].mean() > 0.9 and bare[beside].mean() < 0.5
