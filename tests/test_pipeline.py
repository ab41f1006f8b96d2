"""The whole way, held to what must be true of any tree it makes."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

import sketchtree as st
from sketchtree.foliage.populate import populate
from sketchtree.page import drawn_radius, page_to_world
from sketchtree.sketch.strokes import Stroke

ROOT = Path(__file__).resolve().parents[1]
EXAMPLES = sorted(path for path in (ROOT / "examples").iterdir() if path.suffix in (".svg", ".json"))
KEY = st.root_key(0)


@pytest.fixture(scope="module")
def templates():
    return st.Database.open()


@pytest.fixture(scope="module")
def apple(templates):
    return st.sketch_to_tree(ROOT / "examples" / "apple.json", templates, key=KEY)


def test_there_are_at_least_five_examples():
    assert len(EXAMPLES) >= 5


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_every_example_becomes_a_whole_tree_with_the_drawing_in_it(path, templates):
    reading = st.ReadingOptions(method="okabe")
    tree = st.sketch_to_tree(path, templates, key=KEY, reading=reading, tree=st.TreeOptions(generations=2))
    graph, skeleton = tree.drawn.graph, tree.skeleton
    assert skeleton.segment_count > graph.segment_count and len(tree.leaves) > 100
    drawn = tree.drawn.similarity.to_sketch(skeleton.tip[skeleton.kind == st.Kind.DRAWN])[:, :2]
    gap = np.linalg.norm(graph.xy[:, None] - drawn[None], axis=2).min(axis=1)
    assert gap.max() <= 1e-6 * graph.height
    for mesh in tree.meshes:
        assert np.isfinite(mesh.position).all() and np.isfinite(mesh.normal).all() and np.isfinite(mesh.uv).all()
        assert mesh.triangle.min() >= 0 and mesh.triangle.max() < len(mesh.position)


def surface_points(mesh: st.Mesh, step: float) -> np.ndarray:
    """Points along every edge of a mesh, at most `step` metres apart."""
    edge = np.concatenate([mesh.triangle[:, [0, 1]], mesh.triangle[:, [1, 2]]])
    start, end = mesh.position[edge[:, 0]], mesh.position[edge[:, 1]]
    count = np.maximum(1, np.ceil(np.linalg.norm(end - start, axis=1) / step).astype(int))
    row = np.repeat(np.arange(len(edge)), count)
    share = (np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)) / count[row]
    return start[row] + share[:, None] * (end - start)[row]


def test_no_leaf_stands_away_from_the_wood(apple):
    wood = cKDTree(np.concatenate([surface_points(mesh, 0.01) for mesh in apple.meshes if mesh.name.startswith("wood")]))
    stem = apple.leaves.shoot  # a short shoot starts on the wood and bears leaves along it
    share = np.linspace(0, 1, 21)[None, :, None]
    along = (stem[:, :1] * (1 - share) + stem[:, 1:] * share).reshape(-1, 3)
    foot = apple.leaves.position
    gap, _ = wood.query(foot[:: max(1, len(foot) // 3000)])
    on_shoot, _ = cKDTree(along).query(foot[:: max(1, len(foot) // 3000)])
    assert np.minimum(gap, on_shoot).max() < 0.03
    root, _ = wood.query(stem[:, 0])
    assert root.max() < 0.03


def test_changing_the_leaves_never_moves_a_branch(apple, templates):
    other = st.complete(apple.drawn, templates, key=KEY, options=st.TreeOptions(leaf="maple", season="autumn"))
    np.testing.assert_array_equal(other.skeleton.tip, apple.skeleton.tip)
    np.testing.assert_array_equal(other.skeleton.radius, apple.skeleton.radius)


def test_bare_trees_have_no_leaves(apple, templates):
    bare = st.complete(apple.drawn, templates, key=KEY, options=st.TreeOptions(season="bare"))
    assert len(bare.leaves) == 0 and [mesh.name for mesh in bare.meshes if mesh.name.startswith("leaf")] == []


def test_an_evergreen_keeps_its_needles_in_the_bare_season_and_none_strips_it(apple, templates):
    green = st.complete(apple.drawn, templates, key=KEY, options=st.TreeOptions(season="bare", leaf="spruce"))
    assert len(green.leaves) > 100 and green.meshes[-1].name == "leaf"
    stripped = st.complete(apple.drawn, templates, key=KEY, options=st.TreeOptions(leaf="none"))
    assert len(stripped.leaves) == 0 and all(mesh.name.startswith("wood") for mesh in stripped.meshes)


def test_spring_shows_blossoms_beside_the_young_leaves(apple, templates):
    spring = st.complete(apple.drawn, templates, key=KEY, options=st.TreeOptions(season="spring", leaf="apple"))
    assert [mesh.name for mesh in spring.meshes][-2:] == ["leaf", "leaf_blossom"]
    assert spring.blossom.model == "apple_blossom" and apple.blossom is None


def test_the_side_view_is_no_fan(apple):
    tip = apple.skeleton.tip
    assert np.ptp(tip[:, 2]) > 0.5 * np.ptp(tip[:, 0])


def test_a_template_can_be_forced_or_left_out(templates):
    path = ROOT / "examples" / "curvy.svg"
    named = st.draw_out(path, templates, key=KEY, options=st.ReadingOptions(template="silver_birch", method="flat"))
    assert named.exemplar.name == "silver_birch" and len(named.matches) == len(templates.names)
    none = st.draw_out(path, key=KEY, options=st.ReadingOptions(template="none", method="flat"))
    assert none.exemplar is None and none.matches == []


def shaken(sketch, rng):
    """The same drawing by a shaky hand: doubled points, a repeated stroke, small gaps, overshoots, another order."""
    size = max(np.ptp(np.concatenate([stroke.points for stroke in sketch.strokes]), axis=0))
    strokes = []
    for stroke in sketch.strokes:
        points = np.repeat(stroke.points, 2, axis=0)
        if stroke.kind == "branch" and rng.random() < 0.5:
            points = points + rng.uniform(-0.004, 0.004, 2) * size
        strokes.append(dataclasses.replace(stroke, points=points, pressure=None, time=None))
    strokes.append(dataclasses.replace(strokes[1], id="again"))
    rng.shuffle(strokes)
    return dataclasses.replace(sketch, strokes=tuple(strokes))


@pytest.mark.parametrize("name", ["oak.svg", "spruce.svg"])
def test_a_shaky_hand_draws_the_same_tree(name):
    sketch = st.read_sketch(ROOT / "examples" / name)
    steady, shaky = st.sketch_graph(sketch), st.sketch_graph(shaken(sketch, np.random.default_rng(3)))
    assert abs(len(shaky.limb_id) - len(steady.limb_id)) <= 2

    def parents(graph):
        names = np.array([sketch.strokes[1].id if name == "again" else name for name in graph.stroke_ids])
        stroke = names[graph.stroke]
        first = graph.limb_first[graph.limb_parent >= 0]
        return {stroke[row]: stroke[graph.parent[row]] for row in first}

    before, after = parents(steady), parents(shaky)
    same = [after.get(child) == parent for child, parent in before.items()]
    assert all(same)


def test_pen_widths_say_which_branch_is_thicker_not_how_thick_the_trunk_is():
    sketch = st.read_sketch(ROOT / "examples" / "oak_50.svg")
    graph = st.sketch_graph(sketch)
    habit = st.Habit(height=10.0, trunk_ratio=0.03)
    radius = drawn_radius(sketch, graph, page_to_world(graph, 10.0), habit)
    known = ~np.isnan(radius)
    assert 0.2 < np.nanmax(radius) < 0.5 and np.nanmin(radius) < 0.06
    order = np.argsort(graph.width[known])
    assert (np.diff(radius[known][order]) >= -1e-12).all()


def test_a_width_of_nothing_says_nothing():
    graph = st.sketch_graph(st.read_sketch(ROOT / "examples" / "oak_50.svg"))
    width = graph.width.copy()
    width[[3, 7]] = 0.0
    sketch = st.read_sketch(ROOT / "examples" / "oak_50.svg")
    radius = drawn_radius(sketch, graph.replace(width=width), page_to_world(graph, 10.0), st.Habit(height=10.0, trunk_ratio=0.03))
    assert np.isnan(radius[[3, 7]]).all() and np.isfinite(np.delete(radius, [3, 7])).sum() > 50


@pytest.mark.parametrize(("half", "expected"), [(2.5, 2.5), (10.0, 0.05 * 60)])
def test_a_trunk_drawn_by_its_two_edges_is_as_thick_as_drawn_but_no_barrel(half, expected):
    edges = [np.array([[50.0 - half, 0.0], [50.0 - half, 60.0]]), np.array([[50.0 + half, 0.0], [50.0 + half, 60.0]])]
    angle = np.linspace(0, 2 * np.pi, 60)
    crown = np.column_stack([50 + 45 * np.cos(angle), 100 + 45 * np.sin(angle)])
    strokes = [Stroke(f"s{k}", points) for k, points in enumerate([*edges, crown])]
    drawn = st.draw_out(st.Sketch(tuple(strokes)), key=KEY, options=st.ReadingOptions(method="flat"))
    assert drawn.graph.width_is_wood and len(drawn.graph.crown) == 1
    np.testing.assert_allclose(np.nanmax(drawn.radius) / drawn.similarity.scale, expected, rtol=0.1)


def test_a_lone_stroke_is_a_tree_too(templates):
    sketch = st.Sketch((Stroke("s", np.array([[0.0, 0.0], [2.0, 50.0], [0.0, 100.0]])),))
    tree = st.sketch_to_tree(sketch, templates, key=KEY)
    assert np.ptp(tree.drawn.skeleton.tip[:, 2]) == 0
    assert tree.skeleton.segment_count > tree.drawn.graph.segment_count


def test_leaves_can_be_put_on_drawn_branches_alone(apple):
    assert len(populate(apple.drawn.skeleton, apple.drawn.habit, key=KEY)) > 50
