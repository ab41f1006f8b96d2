"""What grows beside an obstacle, segment by segment against the triangles of the mesh."""

import dataclasses
import re

import numpy as np
import pytest
from tests.propagate.space.solids import ball, box, meets, wall
from tests.propagate.worlds import HABIT, THETA, circle, drawn_tree

from sketchtree import keys
from sketchtree.propagate.generations import Propagate, propagate
from sketchtree.propagate.space.surface import winding
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.stage import SkeletonStage

KEY = keys.root_key(0)
COLUMNS = ("parent", "tip", "radius", "order", "limb", "stroke", "tree", "kind", "curve_points", "curve_start")
CROWN = (circle(points=180),)
FINE = dataclasses.replace(HABIT, lateral_spacing=0.25, twig_length=0.12, max_order=6)
MESHES = {
    "a ball": (ball((1.3, 6.7, 0), 1.1),),
    "a box": (box((0.7, 5, -4), (6, 9, 4)),),
    "a wall": (wall(0.8),),
    "two": (ball((1.3, 6.7, 0), 0.8), wall(-0.7)),
}


def grown(tree=None, key=KEY, habit=FINE, **wanted):
    return propagate(drawn_tree() if tree is None else tree, habit, THETA, key=key, **wanted)


def same(one, two):
    return all(np.array_equal(getattr(one, name), getattr(two, name)) for name in COLUMNS)


def new(tree):
    """(start, end) of every segment that was not drawn."""
    rows = (tree.kind == Kind.PROPAGATED) & ~tree.is_base
    return tree.start[rows], tree.tip[rows]


def within(point, mesh):
    """Which points lie inside a closed mesh; those outside its box don't."""
    found = ((point > mesh.bounds[0]) & (point < mesh.bounds[1])).all(axis=1)
    found[found] = np.abs(winding(point[found], np.asarray(mesh.triangles))) > 0.5
    return found


@pytest.mark.parametrize("crown", [(), CROWN])
@pytest.mark.parametrize("name", MESHES)
def test_no_new_segment_meets_the_mesh(name, crown):
    free, result = grown(crown=crown), grown(crown=crown, obstacles=MESHES[name])
    for mesh in MESHES[name]:
        assert meets(*new(free.skeleton), mesh).sum() > 0
        assert not meets(*new(result.skeleton), mesh).any()
        assert not mesh.is_watertight or not within(new(result.skeleton)[1], mesh).any()


@pytest.mark.parametrize("wanted", [{"fill": True}, {"generations": 2.5}, {"density": 2.0}])
def test_nor_does_what_fills_the_crown_or_grows_by_part(wanted):
    mesh = MESHES["a wall"][0]
    assert not meets(*new(grown(crown=CROWN, obstacles=(mesh,), **wanted).skeleton), mesh).any()


@pytest.mark.parametrize("x", [-0.5, 0.6, 1.5])
def test_leaders_into_an_empty_crown_go_round_or_end(x):
    trunk = drawn_tree(limbs=0, height=2.5)
    mesh = ball((x, 5.2, 0.1), 0.9)
    result = grown(trunk, crown=CROWN, obstacles=(mesh,))
    assert len(result.skeleton) > 300 and not meets(*new(result.skeleton), mesh).any()


def test_nothing_new_shows_within_a_region_of_the_page():
    region = np.array([[0.9, 2], [4, 2], [4, 6.5], [0.9, 6.5]], float)
    start, end = new(grown(crown=CROWN, regions=(region,)).skeleton)
    start_free, end_free = new(grown(crown=CROWN).skeleton)

    def shows(a, b):
        at = a[:, None] + np.linspace(0, 1, 9)[:, None] * (b - a)[:, None]
        return ((at[..., :2] > region.min(axis=0)) & (at[..., :2] < region.max(axis=0))).all(axis=2).any(axis=1)

    assert shows(start_free, end_free).sum() > 10
    assert not shows(start, end).any()


def test_branches_near_a_wall_run_along_it():
    """The mean angle between headings and the way into the wall grows."""
    mesh = wall(1.1)

    def angle(result):
        start, end = new(result.skeleton)
        near = (start[:, 0] < 1.1) & (start[:, 0] > 0.3)
        way = (end - start)[near]
        return np.degrees(np.arccos(way[:, 0] / np.linalg.norm(way, axis=1)))

    assert angle(grown(obstacles=(mesh,))).mean() > angle(grown()).mean() + 5


@pytest.mark.parametrize("crown", [(), CROWN])
def test_what_is_out_of_reach_leaves_the_tree_as_it_was(crown):
    far = ball((100, 5, 0), 2.0)
    far.metadata["name"] = "far.glb"
    result = grown(crown=crown, obstacles=(far,), regions=(circle(x=-90.0),))
    assert same(result.skeleton, grown(crown=crown).skeleton)
    assert result.warnings == (
        "The obstacle far.glb is out of the tree's reach and changes nothing. If it should stand by the tree: its file "
        "counts in metres, y up, and the root is its origin.",
    )


def test_the_same_key_gives_the_same_tree():
    one, two = (grown(obstacles=MESHES["two"]) for _ in range(2))
    assert same(one.skeleton, two.skeleton)
    assert not same(one.skeleton, grown(obstacles=MESHES["two"], key=keys.root_key(1)).skeleton)


def test_it_is_a_stage_with_obstacles_too():
    stage = Propagate(HABIT, THETA, obstacles=MESHES["a ball"], regions=(circle(x=3.5, radius=1.0),))
    assert isinstance(stage, SkeletonStage)
    assert same(stage(drawn_tree(), key=KEY), stage.run(drawn_tree(), key=KEY).skeleton)


def test_what_was_drawn_stays_and_bears_nothing_inside():
    tree, mesh = drawn_tree(), box((0.8, 3, -4), (6, 9, 4))
    result = grown(tree, obstacles=(mesh,))
    grown_tree, rows = result.skeleton, result.drawn_row
    np.testing.assert_array_equal(grown_tree.tip[rows], tree.tip)
    inside = within(grown_tree.tip, mesh)
    children = (grown_tree.kind == Kind.PROPAGATED) & ~grown_tree.is_base
    assert inside[grown_tree.kind == Kind.DRAWN].sum() > 3
    assert not inside[grown_tree.parent[children]].any()
    (warning,) = result.warnings
    assert re.sub(r"0\.\d\d m", "0.10 m", warning) == (
        "3 drawn branches come nearer than 0.10 m to an obstacle, or into it. "
        "What was drawn stays as it is; nothing grows on from where it is so near."
    )


def test_one_branch_is_warned_of_as_one():
    tree = drawn_tree()
    tip = np.flatnonzero(tree.order == 1)[1]
    warnings = grown(tree, obstacles=(ball(tree.tip[tip], 0.2),)).warnings
    assert len(warnings) == 1 and warnings[0].startswith("1 drawn branch comes nearer than ")


def test_a_tree_all_inside_only_keeps_what_was_drawn():
    tree, mesh = drawn_tree(), box((-8, 1.0, -8), (8, 12, 8))
    result = grown(tree, obstacles=(mesh,))
    assert isinstance(result.skeleton, TreeSkeleton) and len(result.warnings) == 1
    assert not within(new(result.skeleton)[0], mesh).any()
