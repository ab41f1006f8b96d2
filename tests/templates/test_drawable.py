"""What a person would draw of an exemplar is a part of it, in few long segments."""

import numpy as np
import pytest

from sketchtree.skeleton import TreeSkeleton
from sketchtree.drawable import ALONG_LIMB, ALONG_STEM, DEEPEST, TOLERANCE, bends, drawable
from sketchtree.templates.seen.drawing import Drawing
from sketchtree.traverse import limb_chains


@pytest.mark.parametrize("name", ["english_oak", "norway_spruce", "date_palm", "hazel", "weeping_willow"])
def test_it_keeps_stems_and_main_limbs_only(shipped, name):
    tree = shipped.exemplar(name).skeleton
    drawn = drawable(tree)
    assert drawn.is_base.sum() == tree.is_base.sum()
    assert drawn.order.max() <= DEEPEST
    assert drawn.segment_count < 300 < tree.segment_count
    points = {tuple(point) for point in tree.tip}
    assert all(tuple(point) in points for point in drawn.tip), "no point is made up"
    assert drawn.height > 0.8 * tree.height
    laterals = np.bincount([_limb_of_parent(drawn, rows) for rows in limb_chains(drawn.parent, drawn.limb) if rows[0]])
    assert laterals.max() <= ALONG_STEM


def _limb_of_parent(tree, rows):
    above = tree.parent[rows[0]]
    return 0 if above < 0 else int(np.flatnonzero(np.unique(tree.limb) == tree.limb[above])[0])


def test_limbs_of_the_drawing_stay_near_those_of_the_exemplar(shipped):
    tree = shipped.exemplar("english_oak").skeleton
    drawn = drawable(tree)
    far = 0.0
    for rows in limb_chains(drawn.parent, drawn.limb):
        whole = tree.tip[np.flatnonzero(tree.limb == drawn.limb[rows[0]])]
        for row in rows[1:]:
            a, b = drawn.start[row], drawn.tip[row]
            share = np.clip((whole - a) @ (b - a) / max((b - a) @ (b - a), 1e-12), 0, 1)
            inside = (share > 0) & (share < 1)
            gap = np.linalg.norm(whole - a - share[:, None] * (b - a), axis=1)[inside]
            far = max(far, float(np.min(gap)) if len(gap) else 0.0)
    assert far <= 2 * TOLERANCE * tree.height


def test_of_many_laterals_the_longest_of_every_run_is_kept():
    """A trunk of 48 m with a lateral a metre, every second one twice as long."""
    parent, tip, limb, order = [-1], [[0, 0, 0]], [0], [0]
    for k in range(48):
        parent.append(len(parent) - 1 if k == 0 else trunk)
        tip.append([0, k + 1, 0])
        limb.append(0)
        order.append(0)
        trunk = len(parent) - 1
        parent.append(trunk)
        tip.append([2 if k % 2 else 1, k + 1, 0])
        limb.append(k + 1)
        order.append(1)
    tree = TreeSkeleton.from_columns(parent, tip, np.full(len(parent), 0.1), limb=np.array(limb), order=np.array(order))
    drawn = drawable(tree)
    kept = drawn.length[drawn.order == 1]
    assert len(kept) == ALONG_STEM and (kept == 2).all()
    assert ALONG_LIMB < ALONG_STEM


def test_near_junctions_become_one():
    tip = [[0, 0, 0], [0, 10, 0], [0, 10.05, 0], [0, 20, 0], [3, 12, 0], [-3, 12, 0]]
    tree = TreeSkeleton.from_columns(
        [-1, 0, 1, 2, 1, 2], tip, np.full(6, 0.1), limb=np.array([0, 0, 0, 0, 1, 2]), order=np.array([0, 0, 0, 0, 1, 1])
    )
    drawn = drawable(tree)
    assert len(drawn) == 5
    assert (drawn.parent == 1).sum() == 3, "both laterals and the stem go on from one junction"


def test_bends_keeps_corners_and_drops_wiggles():
    line = np.array([[0, 0], [1, 0.01], [2, 0], [3, 2], [4, 4.01], [5, 6.0]])
    np.testing.assert_array_equal(bends(line, 0.05), [2])
    assert len(bends(line[:2], 0.05)) == 0


def test_a_sketch_and_a_skeleton_give_the_same_drawing(graph_of):
    tip = np.array([[0, 0, 0], [0, 1, 0], [0.2, 2, 0], [1, 1.5, 0.0]])
    parent, limb = np.array([-1, 0, 1, 1]), np.array([0, 0, 0, 1])
    tree = TreeSkeleton.from_columns(parent, tip, np.full(4, 0.1), limb=limb, order=limb)
    a, b = Drawing.of_skeleton(tree, np.array([0.0])), Drawing.of_graph(graph_of(parent, tip[:, :2], limb))
    for name in ("parent", "limb", "order", "start", "tip"):
        np.testing.assert_allclose(getattr(a, name), getattr(b, name), err_msg=name)
    np.testing.assert_allclose(a.size, 2.0)
