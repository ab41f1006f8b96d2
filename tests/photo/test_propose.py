"""Crown and trunk are proposed without a stroke, and doubts are said (`photo/auto`)."""

import numpy as np
import pytest
from PIL import Image, ImageDraw

from sketchtree.errors import SketchError
from sketchtree.keys import root_key
from sketchtree.photo.auto.propose import SURE, propose
from sketchtree.photo.foliage_mask import within
from sketchtree.photo.photo import Photo

SKY, GRASS, LEAF, WOOD = (150, 190, 235), (100, 140, 60), (45, 75, 30), (70, 52, 40)


def field(*trees, cutout=False, seed=0):
    """A meadow under the sky, 300 × 240, with round trees at (x, radius)."""
    image, cover = Image.new("RGB", (300, 240), SKY), Image.new("L", (300, 240))
    ImageDraw.Draw(image).rectangle((0, 205, 300, 240), fill=GRASS)
    for x, radius in trees:
        for draw, leaf, wood in ((ImageDraw.Draw(image), LEAF, WOOD), (ImageDraw.Draw(cover), 255, 255)):
            draw.rectangle((x - 4, 110, x + 4, 212), fill=wood)
            draw.ellipse((x - radius, 105 - radius, x + radius, 105 + radius), fill=leaf)
    grain = np.where(np.array(cover)[..., None] > 0, 40, 5) * np.random.default_rng(seed).normal(0, 1, (240, 300, 1))  # leaves are rough, skies smooth
    rgb = np.clip(np.asarray(image) + grain, 0, 255).astype(np.uint8)
    return Photo(rgb, np.array(cover) if cutout else None, name="field.jpg")


def overlap(photo, tree, x, radius):
    row, column = np.mgrid[: photo.height, : photo.width] + 0.5
    truth = np.hypot(column - x, row - 105) <= radius
    found = within(tree.crown, truth.shape)
    return (found & truth).sum() / (found | truth).sum()


@pytest.mark.parametrize(("x", "radius"), [(150, 60), (110, 50), (190, 70)])
def test_a_tree_in_a_meadow_is_found(x, radius):
    photo = field((x, radius))
    found = propose(photo, key=root_key(0))
    (tree,) = found.trees
    assert overlap(photo, tree, x, radius) > 0.85
    assert np.abs(tree.branches[0][0] - [x, 212]).max() < 12 and found.confidence > SURE and tree.warnings == ()


def test_the_trunks_stroke_rises_from_its_foot_into_the_crown():
    line = propose(field((150, 60)), key=root_key(0)).trees[0].branches[0]
    assert (np.diff(line[:, 1]) < 0).all() and line[0, 1] > 190 and line[-1, 1] < 140


def test_the_tree_about_the_middle_is_the_main_one():
    photo = field((150, 50), (30, 28))
    assert overlap(photo, propose(photo, key=root_key(0)).trees[0], 150, 50) > 0.8


def test_alpha_says_where_the_tree_stands():
    photo = field((150, 60), cutout=True)
    assert overlap(photo, propose(photo, key=root_key(0)).trees[0], 150, 60) > 0.85


def test_a_wall_of_trees_is_doubted_and_said():
    found = propose(field((0, 60), (60, 60), (150, 60), (240, 60), (300, 60)), key=root_key(0))
    assert found.confidence < SURE and "the crown runs out of both sides of the photo" in found.why
    assert found.trees[0].warnings[0].startswith("The strokes were proposed, and may be wrong: ")


def test_an_empty_sky_has_no_tree():
    rgb = np.full((240, 300, 3), SKY) + np.random.default_rng(0).normal(0, 4, (240, 300, 3))
    with pytest.raises(SketchError) as error:
        propose(Photo(rgb.astype(np.uint8), name="sky.jpg"), key=root_key(0))
    assert str(error.value) == "No tree stands out in sky.jpg. Draw a stroke round its crown and one along its trunk: --strokes."


def test_the_same_key_proposes_the_same_strokes():
    one, two = (propose(field((150, 60)), key=root_key(3)) for _ in range(2))
    assert (one.trees[0].crown == two.trees[0].crown).all() and one.confidence == two.confidence
