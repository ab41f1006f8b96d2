"""Branches added to or erased from the matte by sketching (§III)."""

import re

import numpy as np
import pytest
from PIL import Image
from silhouettes import LEFT, RIGHT, STEM, capsules, forked

from sketchtree.errors import SketchError
from sketchtree.trunk.edit_matte import covered, edit_matte, painted
from sketchtree.trunk.skeletonise import trunk_skeleton

SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="100" height="120" viewBox="0 0 100 120">{}</svg>'


def svg(tmp_path, body: str):
    path = tmp_path / "edits.svg"
    path.write_text(SVG.format(body))
    return path


def line(layer: str, a, b, width: float) -> str:
    return f'<g id="{layer}"><path d="M{a[0]} {a[1]} L{b[0]} {b[1]}" fill="none" stroke="black" stroke-width="{width}"/></g>'


def test_a_stroke_that_adds_is_a_branch_more(tmp_path):
    alpha = edit_matte(forked(), svg(tmp_path, line("add", (50, 95), (80, 80), 6)))
    skeleton = trunk_skeleton(alpha)
    assert len(skeleton.tips) == 4 and np.hypot(*(skeleton.xy[skeleton.tips] - [82.7, 78.7]).T).min() < 2.0


def test_a_stroke_that_erases_takes_a_branch_away(tmp_path):
    alpha = edit_matte(forked(), svg(tmp_path, line("erase", (40, 70), (15, 45), 14)))
    assert len(trunk_skeleton(alpha).tips) == 2


def test_a_stroke_covers_what_its_width_covers(tmp_path):
    alpha = edit_matte(np.zeros((120, 100)), svg(tmp_path, line("add", (20, 60), (80, 60), 6)))
    assert np.abs(alpha - capsules([((20.0, 60.0), (80.0, 60.0), 3.0)])).max() < 1e-6


def test_later_strokes_lie_over_earlier_ones(tmp_path):
    alpha = edit_matte(np.zeros((120, 100)), svg(tmp_path, line("add", (20, 60), (80, 60), 6) + line("erase", (50, 40), (50, 80), 6)))
    assert alpha[60, 50] == 0.0 and alpha[60, 30] == 1.0


def test_strokes_that_leave_the_picture_are_cut():
    window, cover = covered(np.array([[-10.0, 5.0], [4.0, 5.0]]), 4.0, (10, 10))
    assert cover.shape == (window[0].stop - window[0].start, window[1].stop - window[1].start) and window[1].start == 0


def test_a_stroke_without_a_name_is_refused(tmp_path):
    with pytest.raises(SketchError, match=re.escape("it says neither `add` nor `erase`. Draw strokes over the picture in layers named `add` and `erase`.")):
        edit_matte(forked(), svg(tmp_path, line("twig", (50, 95), (80, 80), 6)))


def test_a_page_of_another_shape_is_refused(tmp_path):
    path = svg(tmp_path, line("add", (50, 95), (80, 80), 6))
    with pytest.raises(SketchError, match=re.escape("edits.svg is drawn on a page of 100 × 120, but the matte has 120 × 120 pixels.")):
        edit_matte(np.zeros((120, 120)), path)


def test_a_larger_page_of_the_same_shape_is_scaled(tmp_path):
    alpha = edit_matte(np.zeros((240, 200)), svg(tmp_path, line("add", (20, 60), (80, 60), 6)))
    assert alpha.sum() == pytest.approx(4.0 * (60 * 6 + np.pi * 9), rel=0.02)


def test_white_adds_black_erases_and_grey_leaves_alone(tmp_path):
    grey = np.full((120, 100), 128, np.uint8)
    grey[:, :10], grey[:, -10:] = 255, 0
    Image.fromarray(grey).save(tmp_path / "edits.png")
    alpha = np.full((120, 100), 0.3)
    assert np.unique(edit_matte(alpha, tmp_path / "edits.png")).tolist() == pytest.approx([0.0, 0.3, 1.0])


def test_half_painted_pixels_change_by_half():
    assert painted(np.array([[0.5, 0.5, 0.5]]), np.array([[0.5, -0.5, 0.0]])).tolist() == [[0.75, 0.25, 0.5]]


def test_a_picture_of_another_size_is_refused(tmp_path):
    Image.fromarray(np.full((30, 30), 255, np.uint8)).save(tmp_path / "edits.png")
    with pytest.raises(SketchError, match=re.escape("edits.png has 30 × 30 pixels, but the matte has 100 × 120.")):
        edit_matte(forked(), tmp_path / "edits.png")


def test_a_picture_that_edits_nothing_is_refused(tmp_path):
    Image.fromarray(np.full((120, 100), 128, np.uint8)).save(tmp_path / "edits.png")
    with pytest.raises(SketchError, match=re.escape("edits.png is grey all over: it edits nothing.")):
        edit_matte(forked(), tmp_path / "edits.png")


def test_the_shapes_of_these_tests_are_what_they_say():
    assert np.array_equal(forked(), capsules([STEM, LEFT, RIGHT]))
