"""Twigs too thin for depth maps are followed as far as photos show them, and no farther."""

import numpy as np
import pytest
from drawn_twigs import BARK, CAMERAS, PIXEL, SKY, shown

from sketchtree.axes import NULL
from sketchtree.clouds.files.placed import Placement
from sketchtree.fidelity.recall import recall
from sketchtree.multiview.thin.contrasts import LEAST, contrast, told
from sketchtree.multiview.thin.followed import Following, followed
from sketchtree.multiview.thin.forks import led_back
from sketchtree.multiview.thin.roughness import smooth
from sketchtree.multiview.thin.steps import STEP
from sketchtree.similarity import Similarity
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.skeleton_rows import limbs

FOOT, TOP = np.array([0.0, -0.3, 0.0]), np.array([0.0, 0.6, 0.0])
END = np.array([0.1, 1.15, 0.05])  # of the trunk, as photos show it
FORK, TWIG = np.array([0.0, 0.3, 0.0]), np.array([0.35, 0.65, 0.2])
TRUNK = ([FOOT, TOP, END], 2.0)
NEAR = 1.5 * PIXEL / (END - FOOT)[1]  # of the height


def tree_of(*ways) -> TreeSkeleton:
    """The first way from the ground; the others from the place of it nearest to them. Steps of half a pixel."""
    parent, tip = [], []
    for way in ways:
        start = NULL if not tip else int(np.linalg.norm(np.array(tip) - way[0], axis=1).argmin())
        for one, other in zip(way[:-1], way[1:], strict=True):
            steps = max(2, int(np.linalg.norm(np.subtract(other, one)) / (0.5 * PIXEL)))
            for share in np.linspace(0.0, 1.0, steps + 1)[0 if start == NULL else 1 :]:
                parent.append(start)
                tip.append((1 - share) * np.asarray(one) + share * np.asarray(other))
                start = len(tip) - 1
    parent, tip = np.array(parent), np.array(tip)
    radius = np.full(len(tip), PIXEL)
    radius[len(tip) - 1] = 0.9 * PIXEL
    limb, order = limbs(parent, tip, radius)
    return TreeSkeleton.from_columns(parent, tip, radius, limb=limb, order=order, kind=np.full(len(tip), int(Kind.OBSERVED)))


def added(tree: TreeSkeleton, found: TreeSkeleton) -> np.ndarray:
    """Tips of the rows that are new, but for the blur round the trunk's end."""
    tip = found.tip[len(tree) :]
    return tip[np.linalg.norm(tip - END, axis=1) > STEP * PIXEL]


def test_contrast_is_how_far_a_pixel_is_from_the_even_place_beside_it():
    rgb = np.tile(SKY, (9, 9, 1)).astype(np.float32)
    rgb[:, 4] = 0.5 * SKY + 0.5 * BARK  # a twig that covers half of its pixels
    empty = np.ones((9, 9), bool)
    empty[:, 3:6] = False
    found = contrast(rgb, empty)
    assert found[4, 4] == pytest.approx(0.5 * (SKY - BARK).max(), abs=1e-6)
    assert (found[empty] == 0).all() and found[4, 3] < 1e-6
    assert (contrast(rgb, np.zeros((9, 9), bool)) == 1).all()  # nothing even is near: all may be plant


def test_photos_show_a_twig_look_past_the_air_beside_it_and_say_nothing_of_what_other_wood_hides():
    photos = shown(([FORK, TWIG], 0.7))
    one, other = 0.5 * FORK + 0.5 * TWIG, 0.4 * FORK + 0.6 * TWIG
    shows, past, much = told(one, other, *photos)
    assert shows > 0.7 * len(CAMERAS) and past == 0 and 0.1 < much / shows < 0.7
    aside = np.array([0.0, 0.0, 8 * PIXEL])
    assert told(one + aside, other + aside, *photos)[1] > 0.6 * len(CAMERAS)
    behind = shown(([FORK, TWIG], 12.0))
    assert told(one, other, *behind)[:2] == (0, 0)


def test_an_end_goes_on_to_where_photos_show_that_it_ends():
    tree = tree_of([FOOT, TOP])
    found = followed(tree, shown(([FOOT, TOP], 2.0), ([TOP, END], 0.6)), PIXEL)
    assert np.linalg.norm(found.tip[-1] - END) < STEP * PIXEL
    near = recall(tree_of([FOOT, TOP, END]), found, near=NEAR)
    assert near.length_recall > 0.97 and near.length_precision > 0.97
    assert (found.limb == found.limb[0]).all() and (found.kind == int(Kind.OBSERVED)).all()  # the same limb, and photos did show it


def test_bends_are_followed():
    angle = np.linspace(0, 1.4, 15)
    way = [TOP, *(TOP + 0.4 * np.stack([1 - np.cos(angle), np.sin(angle), 0 * angle], axis=1)[1:])]
    found = followed(tree_of([FOOT, TOP]), shown(([FOOT, TOP], 2.0), (way, 0.6)), PIXEL)
    near = recall(tree_of([FOOT, *way]), found, near=NEAR)
    assert near.length_recall > 0.95 and near.length_precision > 0.95


def test_twigs_begin_where_photos_show_that_one_leaves():
    tree = tree_of([FOOT, TOP, END])
    found = followed(tree, shown(TRUNK, ([FORK, TWIG], 0.6)), PIXEL)
    new = added(tree, found)
    assert len(set(found.limb)) == 2 and set(found.order) == {0, 1}
    assert np.linalg.norm(new[-1] - TWIG) < STEP * PIXEL
    assert np.linalg.norm(found.start[found.order == 1][0] - FORK) < 8 * PIXEL


def test_nothing_is_made_up():
    tree = tree_of([FOOT, TOP, END], [FORK, TWIG])
    found = followed(tree, shown(TRUNK, ([FORK, TWIG], 1.0)), PIXEL)
    assert found.length.sum() == pytest.approx(tree.length.sum(), abs=2 * STEP * PIXEL)
    np.testing.assert_array_equal(found.tip[: len(tree)], tree.tip)


def test_a_twig_ends_at_other_wood_and_does_not_run_along_it():
    tree = tree_of([FOOT, TOP, END], [FORK, 0.7 * FORK + 0.3 * TWIG])
    back = [FORK, TWIG, np.array([0.03, 0.95, 0.02])]  # runs back to the trunk
    found = followed(tree, shown(TRUNK, (back, 0.7)), PIXEL)
    assert added(tree, found)[:, 1].max() < 1.0
    assert recall(tree_of([FOOT, TOP, END], back), found, near=NEAR).length_precision > 0.97


def test_shadows_on_the_ground_are_no_twigs():
    lies = ([FOOT + [0.03, 0.0, 0.0], FOOT + [0.6, 0.0, 0.3]], 0.8)
    tree = tree_of([FOOT, TOP, END])
    assert not len(added(tree, followed(tree, shown(TRUNK, lies), PIXEL)))


def test_roughness_is_no_limb_and_a_short_twig_that_is_shown_is_one():
    spur, twig = [FORK, FORK + [2.5 * PIXEL, PIXEL, 0.0]], [FORK + [0.0, 0.1, 0.0], FORK + [7 * PIXEL, 0.15, 0.0]]
    photos = shown(TRUNK, (twig, 1.0))
    assert len(set(smooth(tree_of([FOOT, TOP, END], spur), photos, PIXEL).limb)) == 1
    assert len(set(smooth(tree_of([FOOT, TOP, END], twig), photos, PIXEL).limb)) == 2
    assert len(set(smooth(tree_of([FOOT, TOP, END], [FORK, TWIG]), photos, PIXEL).limb)) == 2  # a long one is not doubted


def test_a_limb_leaves_along_its_course_and_not_square_off_the_bark():
    way = (TWIG - FORK) / np.linalg.norm(TWIG - FORK)
    clear = FORK + 5 * PIXEL * way
    tree = tree_of([FOOT, TOP, END], [np.array([0.0, clear[1], 0.0]), clear, TWIG])
    found = led_back(tree, PIXEL)
    leaves = found.start[found.order == 1][0]
    assert abs(leaves[1] - FORK[1]) < 1.5 * PIXEL
    assert np.abs(leaves[[0, 2]]).max() < 1e-9  # on the trunk
    assert found.tip[found.order == 1][-1] == pytest.approx(TWIG)
    straight = tree_of([FOOT, TOP, END], [FORK, TWIG])
    np.testing.assert_array_equal(led_back(straight, PIXEL).parent, straight.parent)


def test_a_tree_that_was_placed_elsewhere_is_the_same_tree():
    tree, photos = tree_of([FOOT, TOP]), shown(([FOOT, TOP], 2.0), ([TOP, END], 0.6))
    here = followed(tree, photos, PIXEL)
    placement = Placement("y", Similarity(2.0, (1.0, -3.0, 0.5)))
    there = Following(photos, PIXEL)(tree.replace(tip=placement.to_world(tree.tip), radius=2 * tree.radius), placement)
    np.testing.assert_allclose(placement.to_file(there.tip), here.tip, atol=1e-9)
    np.testing.assert_allclose(there.radius, 2 * here.radius)
    larger = Following(photos.scaled(3.0), 3 * PIXEL)(tree.replace(tip=3 * tree.tip, radius=3 * tree.radius), Placement())
    np.testing.assert_allclose(larger.tip, 3 * here.tip, atol=1e-6)


def test_few_photos_are_not_enough():
    photos = shown(([FOOT, TOP], 2.0), ([TOP, END], 0.6))
    few = photos._replace(**{name: getattr(photos, name)[: LEAST - 1] for name in ("to_pixel", "contrast", "sizes")})
    tree = tree_of([FOOT, TOP])
    assert len(followed(tree, few, PIXEL)) == len(tree)
