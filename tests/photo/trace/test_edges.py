"""How thick a limb is, by where its colour ends; and which of the limbs found stand out (`photo/trace/edges`, `clear`)."""

import jax
import numpy as np
import pytest
from PIL import Image, ImageDraw, ImageFilter

from painted import BARK, SKY, bare_tree, marked
from sketchtree.axes import NULL
from sketchtree.photo.photo import Photo
from sketchtree.photo.trace.clear import plainly_seen
from sketchtree.photo.trace.edges import edges_at, roughness, tapered
from sketchtree.photo.trace.follow import Walk
from sketchtree.photo.trace.trace import Tracing

HEDGE = (84, 66, 52)


def bar(width: int, *, behind=SKY, grain: float = 4.0, blur: float = 0.0, bark: float = 0.0) -> np.ndarray:
    """An upright bar in the middle of a picture."""
    image = Image.new("RGB", (200, 200), behind)
    ImageDraw.Draw(image).rectangle((100 - width // 2, 0, 100 - width // 2 + width - 1, 200), fill=BARK)
    image = image.filter(ImageFilter.GaussianBlur(blur)) if blur else image
    draw = np.random.default_rng(0)
    furrows = bark * draw.normal(size=(200, 200, 1)) * (np.asarray(image)[..., :1] < 100)
    return np.clip(np.asarray(image) + furrows + draw.normal(0, grain, (200, 200, 3)), 0, 255).astype(np.uint8)


def across(rgb, *, x: float = 100.0, reach: float = 40.0):
    place = np.stack([np.full(9, x), np.linspace(180.0, 20.0, 9)], axis=1)
    return edges_at(rgb, place, np.tile([0.0, -1.0], (9, 1)), reach=reach, step=20.0)


@pytest.mark.parametrize("width", [2, 4, 7, 12, 30])
@pytest.mark.parametrize("blur", [0.0, 1.0])
def test_a_bar_is_half_as_wide_as_it_was_painted_sharp_or_blurred(width, blur):
    assert np.median(across(bar(width, blur=blur)).half) == pytest.approx(width / 2, abs=max(0.8, 0.08 * width))


def test_a_line_beside_the_middle_measures_the_same_limb_and_says_how_far_off_it_is():
    seen = across(bar(12), x=103.0)
    assert np.median(seen.half) == pytest.approx(6, abs=1) and np.median(seen.aside) == pytest.approx(-3, abs=1)


def test_furrows_of_the_bark_are_no_edges():
    assert np.median(across(bar(30, bark=30.0)).half) == pytest.approx(15, abs=2)


def test_contrast_is_what_lies_between_a_limb_and_its_fainter_side():
    clear, faint = (np.median(across(bar(12, behind=behind)).contrast) for behind in (SKY, HEDGE))
    assert clear == pytest.approx(np.linalg.norm(np.subtract(SKY, BARK)), rel=0.1) and faint < 0.25 * clear


def test_places_off_the_picture_are_those_at_its_border():
    place = np.array([(-5.0, 100.0), (1.0, 100.0)])
    assert np.isfinite(across(bar(12)).half).all() and np.isfinite(edges_at(bar(12), place, np.tile([0.0, -1.0], (2, 1)), reach=20.0, step=10.0).half).all()


def test_widths_never_grow_towards_the_tip_and_one_crossing_limb_changes_little():
    half = np.array([9.0, 8.5, 8.0, 30.0, 7.0, 7.5, 6.0, 1.0, 5.0, 4.0])
    fitted = tapered(half)
    assert (np.diff(fitted) <= 1e-9).all() and fitted[3] < 9 and fitted[7] > 3
    assert (tapered(half, 6.0) <= 6 + 1e-9).all()


@pytest.mark.parametrize("half", [[3.0], [3.0, 2.0], [2.0, 3.0]])
def test_short_limbs_have_widths_too(half):
    fitted = tapered(np.array(half))
    assert len(fitted) == len(half) and (np.diff(fitted) <= 1e-9).all()


def test_even_widths_are_smooth_and_wild_ones_rough():
    assert roughness(np.full(9, 4.0)) < 0.1 < roughness(np.array([1.0, 9.0, 2.0, 8.0]))
    assert roughness(np.array([4.0])) > roughness(np.full(9, 4.0))


def faint_and_clear():
    """A trunk, a limb as dark to its right, and one hardly darker than the sky to its left."""
    image = Image.new("RGB", (300, 300), SKY)
    pen = ImageDraw.Draw(image)
    pen.line((150, 300, 150, 0), fill=BARK, width=14)
    pen.line((150, 200, 260, 120), fill=BARK, width=6)
    pen.line((150, 200, 40, 120), fill=tuple(int(v - 14) for v in SKY), width=6)
    photo = Photo(np.clip(np.asarray(image) + np.random.default_rng(0).normal(0, 3, (300, 300, 3)), 0, 255).astype(np.uint8))
    walk, last = Walk(), NULL
    for y in np.arange(295.0, 10.0, -10.0):
        last = walk.add(last, np.array([150.0, y]), 7.0, 0, True, 0)
    fork = int(np.argmin(np.abs(np.array(walk.xy)[:, 1] - 200)))
    for side in (-1, 1):
        last = fork
        for k in range(1, 6):
            last = walk.add(last, np.array([150.0 + side * 20 * k, 200.0 - 14.5 * k]), 9.0, 0, False, 1)
    return photo, walk


def test_a_limb_that_hardly_stands_out_is_left_out_with_all_it_bears():
    photo, walk = faint_and_clear()
    seen = plainly_seen(walk, photo, 20.0)
    right, left = (sum(side * (xy[0] - 150) > 5 for xy in seen.xy) for side in (1, -1))
    assert right == 5 and left == 0 and sum(seen.drawn) == sum(walk.drawn)


def test_limbs_found_are_as_thick_as_their_edges_say():
    photo, walk = faint_and_clear()
    seen = plainly_seen(walk, photo, 20.0)
    found = [half for half, drawn in zip(seen.half, seen.drawn, strict=True) if not drawn]
    assert found == pytest.approx([3.0] * 5, abs=1.0)


def test_strokes_alone_are_all_kept():
    photo, walk = faint_and_clear()
    alone = Walk()
    for row in range(sum(walk.drawn)):
        alone.add(walk.parent[row], walk.xy[row], walk.half[row], 0, True, 0)
    assert plainly_seen(alone, photo, 20.0) is alone


def test_a_hedge_as_dark_as_the_bark_makes_a_trunk_no_thicker():
    photo = bare_tree()
    rgb = np.array(photo.rgb)
    rgb[430:540] = np.where((np.abs(np.arange(600) - 300) > 14)[None, :, None], np.random.default_rng(0).normal(HEDGE, 6, (110, 600, 3)), rgb[430:540]).astype(np.uint8)
    traced = Tracing()(Photo(rgb), marked(), key=jax.random.key(0))
    low = traced.drawn & (traced.xy[:, 1] > 400)
    assert np.max(traced.radius[low]) < 18


def test_the_papers_widths_are_left_to_the_paper():
    """§2: no limb is dropped for being faint where the paper's way is asked for."""
    paper = Tracing(widths="paper", strict=False)(bare_tree(), marked(), key=jax.random.key(0))
    ours = Tracing()(bare_tree(), marked(), key=jax.random.key(0))
    assert len(paper) >= len(ours)
