"""The drawn factor graph shows every variable and every factor of the kinds that were asked for, in a file that opens."""

import io
import xml.etree.ElementTree as ET
from collections import Counter

import numpy as np
import pytest
from PIL import Image, ImageFont
from scipy.spatial.distance import pdist

from sketchtree.errors import ExportError, OptionError
from sketchtree.mrf.blocks import EQUATION, blocks
from sketchtree.mrf.explain import Explanation
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.overlay.as_png import scene_png
from sketchtree.overlay.factor_layout import placed, pushed_apart
from sketchtree.overlay.factor_legend import BEHIND, COLOUR, FRONT, INK
from sketchtree.overlay.factors import MOST_FOR_THETA, USUAL, depth_colours, draw_factor_graph, factor_scene
from sketchtree.overlay.lettering import lettered
from sketchtree.overlay.marks import Placing
from sketchtree.overlay.scene import Disc, Path, Words
from tests.mrf.drawings import lone_stroke, random_tree, shrub, sketch, small_tree

KEYS = 1  # squares a kind has in the legend


@pytest.fixture(scope="module")
def graph():
    return factor_graph(small_tree())


def pulling(graph, **pull):
    force = {kind: np.full(graph.limb_count, value) for kind, value in pull.items()}
    return Explanation(graph, dict.fromkeys(force, 0.0), force)


def circles(scene, graph):
    """The variables' discs, in the order of the segments."""
    found = [m for m in scene.marks if isinstance(m, Disc) and m.colour == INK and m.width == 1.4]
    return found[: int((~graph.is_base).sum())]


def squares(scene):
    """How many squares there are of each colour."""
    return Counter(m.fill for m in scene.marks if isinstance(m, Path) and m.closed and len(m.points) == 4)


def texts(scene):
    return [m.text for m in scene.marks if isinstance(m, Words)]


@pytest.mark.parametrize("drawing", [small_tree, shrub, lone_stroke, lambda: random_tree(1, 20)])
def test_every_factor_of_every_kind_has_a_square_and_every_segment_a_circle(drawing):
    graph = factor_graph(drawing())
    scene = factor_scene(graph, kinds=EQUATION)
    every = blocks(graph)
    for kind in EQUATION:
        assert squares(scene)[COLOUR[kind]] == KEYS + len(every.get(kind, ())), kind
    assert len(circles(scene, graph)) == int((~graph.is_base).sum())


def test_left_alone_it_draws_the_usual_kinds_and_no_competition(graph):
    scene = factor_scene(graph)
    assert {kind for kind in EQUATION if COLOUR[kind] in squares(scene)} == set(USUAL)
    assert "competition" not in USUAL


def test_edges_lead_from_every_factor_to_what_it_looks_at(graph):
    scene = factor_scene(graph, kinds=["siblings"])
    lines = [m for m in scene.marks if isinstance(m, Path) and m.colour == COLOUR["siblings"] and not m.closed]
    assert len(lines) == 2 * len(graph.sibling)
    at = {(round(c.x, 6), round(c.y, 6)) for c in circles(scene, graph)}
    assert all(tuple(np.round(line.points[1], 6).tolist()) in at for line in lines)


def test_a_base_is_no_variable():
    graph = factor_graph(sketch([-1, 0, 0, 1], [[0, 0], [0, 50], [30, 40], [0, 100]], [0, 0, 1, 0]))
    assert blocks(graph)["lateral"].rows.tolist() == [[2, 0]], "a limb that grows from the ground"
    lines = [m for m in factor_scene(graph, kinds=["lateral"]).marks if isinstance(m, Path) and m.opacity == 0.55]
    assert len(lines) == 1


def test_depths_behind_the_page_are_blue_and_in_front_orange(graph):
    assert depth_colours(np.array([-2.0, 0.0, 2.0])) == [BEHIND, "#ffffff", FRONT]
    depth = np.where(graph.limb == 1, 5.0, -5.0)
    fill = [c.fill for c in circles(factor_scene(graph, depth=depth), graph)]
    assert fill == [FRONT if limb == 1 else BEHIND for limb in graph.limb[1:]]


def test_a_label_is_drawn_only_where_the_reader_joined_two_strokes(graph):
    def diamonds(g):
        return [m for m in factor_scene(g).marks if isinstance(m, Path) and m.closed and m.colour == INK]

    joined = factor_graph(small_tree().replace(joined=np.arange(11) == 3))
    assert (len(diamonds(graph)), len(diamonds(joined))) == (0, 1 + KEYS)
    assert "1 label, apical or lateral" in texts(factor_scene(joined))


def test_theta_is_one_node_a_kind_and_left_out_of_large_drawings(graph):
    assert [t for t in texts(factor_scene(graph)) if t.startswith("Θ ")] == ["Θ length", "Θ divergence", "Θ bend"]
    large = factor_graph(random_tree(2, 20))
    assert int((~large.is_base).sum()) > MOST_FOR_THETA
    assert not [t for t in texts(factor_scene(large)) if t.startswith("Θ")]


def test_the_legend_tells_kind_count_and_equation(graph):
    words = texts(factor_scene(graph))
    for kind in USUAL:
        k = words.index(kind)
        assert words[k + 1 : k + 3] == [str(len(blocks(graph)[kind])), EQUATION[kind]]
    empty = texts(factor_scene(factor_graph(lone_stroke())))
    assert empty[empty.index("crown") + 1] == "0"


@pytest.mark.parametrize("limbs", [5, 30])
def test_no_node_hides_another(limbs):
    graph = factor_graph(random_tree(3, limbs))
    shown = {kind: block for kind, block in blocks(graph).items() if kind in USUAL}
    nodes = placed(graph, shown, Placing(graph.xy.min(0), graph.xy.max(0), 0.0, 0.0, 1000.0), np.zeros((0, 2)))
    points = np.concatenate([nodes.variable[~graph.is_base], *nodes.factor.values()])
    assert np.mean(pdist(points) < 1.6 * nodes.radius) < 1e-4, "squares are 1.6 radii wide"


def test_points_on_one_place_are_pushed_apart():
    points = pushed_apart(np.zeros((7, 2)), np.zeros((1, 2)), 10.0)
    assert pdist(np.concatenate([points, np.zeros((1, 2))])).min() > 9.0
    assert np.abs(points).max() < 25.0


def test_arrows_point_down_to_the_left_towards_the_viewer(graph):
    def heads(force):
        scene = factor_scene(graph, kinds=["crown"], pull=pulling(graph, crown=force))
        return [m.points[0] - m.points[1:].mean(0) for m in scene.marks if isinstance(m, Path) and len(m.points) == 3 and m.fill == COLOUR["crown"]]

    assert len(heads(2.0)) == graph.limb_count
    assert all(x < 0 < y for x, y in heads(2.0))
    assert all(y < 0 < x for x, y in heads(-2.0))
    assert heads(0.0) == []


def test_the_legend_tells_the_longest_arrow_and_a_factor_of_one_s_own(graph):
    scene = factor_scene(graph, kinds=["crown", "wall"], pull=pulling(graph, crown=1.0, wall=-3.25))
    assert "away from him; the longest: 3.2 nats/rad" in texts(scene)
    assert texts(scene)[texts(scene).index("wall") + 1] == "one's own"


@pytest.mark.parametrize("name", ["f.svg", "f.png"])
def test_the_file_opens(graph, tmp_path, name):
    path = draw_factor_graph(graph, tmp_path / name, depth=np.arange(11.0), pull=pulling(graph, crown=1.0))
    scene = factor_scene(graph, depth=np.arange(11.0), pull=pulling(graph, crown=1.0))
    if name.endswith("svg"):
        root = ET.parse(path).getroot()
        assert (root.get("width"), root.get("height")) == (str(scene.width), str(scene.height))
        assert len(root) == 2 + len(scene.marks)
        assert EQUATION["lateral"] in [element.text for element in root]
    else:
        with Image.open(path) as image:
            assert image.size == (scene.width, scene.height)


def test_every_mark_lies_in_the_picture(graph):
    for kinds in (None, EQUATION):
        scene = factor_scene(graph, kinds=kinds, pull=pulling(graph, **dict.fromkeys(EQUATION, 1.0)), drawn_letters=True)
        for mark in scene.marks:
            points = mark.points if isinstance(mark, Path) else np.array([[mark.x, mark.y]])
            assert (points >= 0).all() and (points <= (scene.width, scene.height)).all()


def test_the_same_graph_gives_the_same_bytes(graph):
    assert scene_png(factor_scene(graph)) == scene_png(factor_scene(graph))


def test_the_png_s_font_has_every_letter_that_is_left_to_it(graph):
    scene = factor_scene(graph, kinds=EQUATION, drawn_letters=True)
    font = ImageFont.load_default(15)
    blank = font.getmask("\N{REPLACEMENT CHARACTER}")
    for letter in sorted(set("".join(texts(scene)))):
        mask = font.getmask(letter)
        assert letter == " " or (mask.size, bytes(mask)) != (blank.size, bytes(blank)), letter


def test_an_index_is_set_low_and_small_but_a_name_keeps_its_underscore():
    marks = lettered(Words(0.0, 0.0, "log m_o", 10.0))
    assert [(m.text, m.size < 10, m.y > 0) for m in marks] == [("log", False, False), ("m", False, False), ("o", True, True)]
    assert [m.text for m in lettered(Words(0.0, 0.0, "limb_length", 10.0))] == ["limb_length"]


def test_a_kind_that_does_not_exist_is_named_with_those_that_do(graph):
    with pytest.raises(OptionError, match="There is no kind of factor `gravity`. Use some of solid_angle, lateral, .*, crown."):
        factor_scene(graph, kinds=["crown", "gravity"])
    with pytest.raises(OptionError, match="`crowns`"):
        factor_scene(graph, kinds="crowns")


def test_depths_of_another_drawing_are_refused(graph):
    with pytest.raises(OptionError, match=r"`depth` has the shape \(3,\). Give 11 depths"):
        factor_scene(graph, depth=np.zeros(3))


def test_what_can_t_be_written_is_told(graph, tmp_path):
    with pytest.raises(ExportError, match="the folder .*nowhere does not exist"):
        draw_factor_graph(graph, tmp_path / "nowhere" / "f.png")
    with pytest.raises(ExportError, match="This version writes .svg, .png here"):
        draw_factor_graph(graph, tmp_path / "f.pdf")
    assert list(tmp_path.iterdir()) == []


def test_a_png_of_a_hundred_segments_is_no_hairball_in_its_size(tmp_path):
    image = Image.open(io.BytesIO(scene_png(factor_scene(factor_graph(random_tree(5, 45))))))
    assert max(image.size) < 1800
