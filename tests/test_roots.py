"""Drawn roots: they run below the ground to all sides, and no stage that grows a crown touches them."""

from pathlib import Path

import numpy as np
import pytest
from jax import random

from sketchtree.foliage.populate import populate
from sketchtree.geometry.radii import PipeRadii
from sketchtree.mrf.lift import lift
from sketchtree.parameters import GENERIC, Habit
from sketchtree.propagate.generations import Propagate
from sketchtree.roots import SLENDER, STOUT, is_root, root_depth, with_roots, without_roots
from sketchtree.similarity import Similarity
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.reading import sketch_graph
from sketchtree.skeleton import Kind

OAK = Path(__file__).resolve().parents[1] / "examples" / "oak.svg"
ENDS = np.array([(-0.30, -0.09), (-0.16, -0.12), (-0.02, -0.20), (0.08, -0.12), (0.22, -0.10), (0.35, -0.10)])  # of H


def rooted(ends=ENDS, side=True):
    """The oak's graph with straight roots of four segments each, and a side root on the first."""
    graph = sketch_graph(read_sketch(OAK))
    base, height = int(np.flatnonzero(graph.is_base)[0]), graph.height
    rows: list = []

    def limb(parent, points):
        name = len(graph.limb_id) + len({r[2] for r in rows})
        for point in points:
            rows.append((parent, point, name))
            parent = len(graph) + len(rows) - 1

    for end in np.atleast_2d(ends):
        limb(base, [graph.xy[base] + end * height * s for s in (0.25, 0.5, 0.75, 1.0)])
    if side:
        limb(len(graph) + 1, [graph.xy[base] + np.array([-0.2, -0.2]) * height])
    count, more = len(rows), len({r[2] for r in rows})
    return graph, graph.replace(
        parent=np.r_[graph.parent, [r[0] for r in rows]],
        xy=np.r_[graph.xy, [r[1] for r in rows]],
        limb=np.r_[graph.limb, [r[2] for r in rows]],
        stroke=np.r_[graph.stroke, np.zeros(count, int)],
        tree=np.r_[graph.tree, np.zeros(count, int)],
        width=np.r_[graph.width, np.full(count, np.nan)],
        joined=np.r_[graph.joined, np.zeros(count, bool)],
        root=np.r_[graph.root, np.ones(count, bool)],
        curve_start=np.r_[graph.curve_start, np.full(count, graph.curve_start[-1])],
        limb_id=np.r_[graph.limb_id, 10**6 + np.arange(more)],
    )


def standing(graph):
    tree = lift(graph, root_depth(graph), Similarity(0.01, (0.0, 0.0, 0.0)))
    return PipeRadii(Habit())(tree, key=random.key(0))


def test_above_the_ground_the_graph_is_as_if_no_root_were_drawn():
    bare, whole = rooted()
    above = whole.above_ground()
    for name in ("parent", "xy", "limb", "curve_points", "curve_start", "limb_id", "width"):
        np.testing.assert_array_equal(getattr(above, name), getattr(bare, name))
    assert whole.height == bare.height
    assert bare.above_ground() is bare


def test_roots_must_stand_after_all_other_rows():
    _, whole = rooted()
    with pytest.raises(AssertionError, match="roots stand after"):
        whole.replace(root=whole.root[::-1])


def test_depth_is_zero_above_the_ground_and_runs_to_both_sides_below():
    _, whole = rooted()
    depth = root_depth(whole)
    assert (depth[~whole.root] == 0).all()
    assert depth.min() < -0.05 * whole.height and depth.max() > 0.05 * whole.height
    widest = np.abs(whole.xy[whole.root] - whole.xy[0])[:, 0].max()
    assert np.hypot(depth, whole.xy[:, 0] - whole.xy[0, 0])[whole.root].max() < 1.5 * widest


def test_no_two_roots_of_a_stem_run_the_same_way():
    _, whole = rooted(np.delete(ENDS, 2, axis=0), side=False)  # without the tap root
    depth = root_depth(whole)
    tips = np.flatnonzero(whole.root)[3::4]
    azimuth = np.sort(np.arctan2(depth[tips], whole.xy[tips, 0] - whole.xy[0, 0]))
    assert np.diff(np.r_[azimuth, azimuth[0] + 2 * np.pi]).min() > np.radians(15)


def test_a_tap_root_stays_in_the_page():
    _, whole = rooted(np.array([(-0.3, -0.1), (0.01, -0.4), (0.3, -0.1)]), side=False)
    depth = root_depth(whole)
    tap = np.flatnonzero(whole.root)[4:8]
    np.testing.assert_array_equal(depth[tap], 0.0)


def test_one_root_alone_has_a_depth():
    _, whole = rooted(np.array([(0.2, -0.1)]), side=False)
    assert np.isfinite(root_depth(whole)).all()


def test_the_projection_of_roots_is_kept():
    _, whole = rooted()
    tree = standing(whole)
    np.testing.assert_array_equal(tree.tip[:, :2], 0.01 * whole.xy)
    assert (tree.kind[whole.root] == Kind.ROOT).all() and (tree.kind[~whole.root] == Kind.DRAWN).all()


def test_roots_taper_and_none_is_stouter_than_its_stem_allows():
    _, whole = rooted()
    tree = standing(whole)
    rows = np.flatnonzero(is_root(tree))
    assert (tree.radius[rows] <= tree.radius[tree.parent[rows]]).all()
    first = rows[~is_root(tree)[tree.parent[rows]]]
    assert (tree.radius[first] <= STOUT * tree.radius[0]).all() and len(first) == len(ENDS)
    assert tree.radius[rows].min() < (SLENDER + 0.1) * tree.radius[0]


def test_roots_change_no_radius_above_the_ground():
    bare, whole = rooted()
    np.testing.assert_array_equal(standing(whole).radius[: len(bare)], standing(bare).radius)


def test_a_drawn_width_of_a_root_counts():
    _, whole = rooted()
    drawn = np.full(len(whole), np.nan)
    row = int(np.flatnonzero(whole.root)[0])
    drawn[row] = 0.05
    tree = lift(whole, root_depth(whole), Similarity(0.01, (0.0, 0.0, 0.0)))
    assert PipeRadii(Habit(), drawn)(tree, key=random.key(0)).radius[row] == 0.05


def test_growth_and_leaves_leave_roots_alone():
    bare, whole = rooted()
    tree = standing(whole)
    grown = Propagate(Habit(), GENERIC, generations=2).run(tree, key=random.key(1))
    plain = Propagate(Habit(), GENERIC, generations=2).run(standing(bare), key=random.key(1))
    rows = grown.drawn_row[whole.root]
    np.testing.assert_array_equal(grown.skeleton.tip[rows], tree.tip[whole.root])
    np.testing.assert_array_equal(grown.skeleton.tip[: len(plain.skeleton)], plain.skeleton.tip)
    assert len(grown.skeleton) == len(plain.skeleton) + int(whole.root.sum()) == len(grown.generation)
    assert (grown.skeleton.tip[grown.drawn_row] == tree.tip).all()
    leaves = populate(grown.skeleton, Habit(), key=random.key(2))
    assert len(leaves) and not is_root(grown.skeleton)[leaves.segment].any()


def test_roots_come_off_and_go_back_on():
    _, whole = rooted()
    tree = standing(whole)
    above, rows = without_roots(tree)
    again = with_roots(above, tree, np.arange(len(tree)))
    assert len(above) == len(rows) == int(np.sum(~whole.root))
    for name in ("parent", "tip", "radius", "limb", "kind", "curve_start"):
        np.testing.assert_array_equal(getattr(again, name), getattr(tree, name))
