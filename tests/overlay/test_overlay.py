"""The overlay shows what was read: every limb, junction, base, role and doubt, in a file that opens."""

import io
import xml.etree.ElementTree as ET
from pathlib import Path as File

import numpy as np
import pytest
from PIL import Image

from sketchtree.overlay.as_png import scene_png
from sketchtree.overlay.as_svg import scene_svg
from sketchtree.overlay.colours import DOUBT, ORDER, ROLE, ROOT
from sketchtree.overlay.draw import LONG_SIDE, MARGIN, overlay
from sketchtree.overlay.legend import counts
from sketchtree.overlay.doubts import doubts
from sketchtree.overlay.scan import Scan, scan
from sketchtree.overlay.scene import Disc, Path, Words
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.graph import Attachment, Cut, Role
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.strokes import Sketch, Stroke

EXAMPLES = File(__file__).resolve().parents[2] / "examples"


@pytest.fixture(scope="module")
def oak():
    sketch = read_sketch(EXAMPLES / "oak.svg")
    return sketch, sketch_graph(sketch)


def limbs(scene):
    return [m for m in scene.marks if isinstance(m, Path) and m.colour in (*ORDER, ROOT) and m.opacity == 0.85]


def test_every_limb_is_drawn_in_the_colour_of_its_order(oak):
    sketch, graph = oak
    scene = overlay(sketch, graph, explained=False)
    assert len(limbs(scene)) == len(graph.limb_id)
    wanted = np.bincount(np.minimum(graph.limb_order, len(ORDER) - 1), minlength=len(ORDER))
    assert [sum(m.colour == colour for m in limbs(scene)) for colour in ORDER] == wanted.tolist()


def test_a_limb_lies_where_it_was_drawn(oak):
    sketch, graph = oak
    scene = overlay(sketch, graph, explained=False)
    shown = np.concatenate([m.points for m in limbs(scene)])
    scale = np.ptp(shown[:, 1]) / np.ptp(np.concatenate([graph.xy, graph.curve_points])[:, 1])
    assert np.ptp(shown[:, 0]) == pytest.approx(scale * np.ptp(np.concatenate([graph.xy, graph.curve_points])[:, 0]))
    base = next(m for m in scene.marks if isinstance(m, Disc) and m.radius == 8.0)
    assert base.y == pytest.approx(shown[:, 1].max(), abs=1e-6), "y points down in the picture"


def test_every_mark_lies_in_the_picture(oak):
    scene = overlay(*oak)
    for mark in scene.marks:
        points = mark.points if isinstance(mark, Path) else np.array([[mark.x, mark.y]])
        assert (points >= 0).all() and (points <= (scene.width, scene.height)).all()


def test_the_drawing_s_larger_side_has_the_size_asked_for(oak):
    scene = overlay(*oak, explained=False)
    assert max(scene.width, scene.height) == round(LONG_SIDE + 2 * MARGIN)
    assert max(overlay(*oak, long_side=200.0, explained=False).height, 0) <= 200 + 2 * MARGIN + 1


def test_both_files_open_and_have_the_scene_s_size(oak):
    scene = overlay(*oak)
    image = Image.open(io.BytesIO(scene_png(scene)))
    assert image.size == (scene.width, scene.height)
    colours = {image.getpixel((x, y)) for x in range(0, image.width, 7) for y in range(0, image.height, 7)}
    assert len(colours) > 10, "there is something to see"
    root = ET.fromstring(scene_svg(scene))
    assert root.get("width") == str(scene.width)
    assert len(list(root)) == 2 + len(scene.marks)


def test_the_same_reading_gives_the_same_bytes(oak):
    assert scene_png(overlay(*oak)) == scene_png(overlay(*oak))
    assert scene_svg(overlay(*oak)) == scene_svg(overlay(*oak))


def test_doubts_are_numbered_the_most_doubtful_first(oak):
    sketch, graph = oak
    point = tuple(graph.xy[5].tolist())
    sure = Attachment("a", "trunk", point, 0.0, 1.0, (("b", 5.0),), "a lateral")
    unsure = Attachment("limb-1", "trunk", point, 0.0, 1.0, (("top", 1.9),), "a lateral")
    most = Attachment("limb-2", "trunk", point, 0.0, 1.0, (("top", 1.1), ("limb-1", 1.2)), "a lateral")
    graph = graph.replace(attachments=(sure, unsure, most))
    assert [d.attachments[0].stroke for d in doubts(graph)] == ["limb-2", "limb-1"]
    words = [m for m in overlay(sketch, graph).marks if isinstance(m, Words) and m.colour == DOUBT and m.bold]
    assert [m.text for m in words[:3]] == ["1", "2", "Doubts: what it grows from, or may grow from"]
    text = " ".join(m.text for m in overlay(sketch, graph).marks if isinstance(m, Words))
    assert "1  limb-2: from trunk, or top (+0.1)" in text


def test_what_is_no_branch_has_its_role_s_colour_and_a_line_in_the_legend(oak):
    sketch, graph = oak
    extra = Stroke("shade", np.array([[0.0, 0.0], [50.0, -5.0], [100.0, 0.0]]), filled=True)
    sketch = Sketch((*sketch.strokes, extra), name=sketch.name)
    graph = graph.replace(
        roles=(Role("shade", "shadow", "flat, at the foot"),), ground=(np.array([[0.0, 0.0], [9.0, 0.0]]),), stroke_ids=(*graph.stroke_ids, "shade")
    )
    scene = overlay(sketch, graph)
    assert any(isinstance(m, Path) and m.colour == ROLE["shadow"] for m in scene.marks)
    text = [m.text for m in scene.marks if isinstance(m, Words)]
    assert "shadow: 1 stroke, left out" in text and "ground line" in text and "crown" in text


def test_where_the_page_cuts_the_tree_there_is_a_bar(oak):
    sketch, graph = oak
    bars = [m for m in overlay(sketch, graph.replace(cuts=(Cut("limb", (10.0, 10.0), "left"),))).marks if isinstance(m, Path) and m.width == 4.0 and m.colour == DOUBT]
    without = [m for m in overlay(sketch, graph).marks if isinstance(m, Path) and m.width == 4.0 and m.colour == DOUBT]
    assert len(bars) == len(without) + 1


def test_a_scan_lies_under_its_reading(oak):
    sketch, graph = oak
    scene = overlay(sketch, graph, underlay=Scan(np.zeros((60, 40, 3), np.uint8), 400.0, 600.0))
    left, top, width, height = scene.underlay.box
    assert width / height == pytest.approx(40 / 60)
    assert "data:image/jpeg;base64," in scene_svg(scene)
    assert scene_png(scene) != scene_png(overlay(sketch, graph))


def test_strange_names_do_not_break_the_file():
    strokes = (Stroke('<&"\x00>', np.array([[0.0, 0.0], [0.0, 100.0]])), Stroke("枝", np.array([[0.0, 50.0], [30.0, 80.0]])))
    sketch = Sketch(strokes, name="a & b <c>\x07.svg")
    scene = overlay(sketch, sketch_graph(sketch))
    ET.fromstring(scene_svg(scene))
    scene_png(scene)


def test_a_legend_that_is_too_long_says_how_much_it_leaves_out(oak):
    sketch, graph = oak
    scene = overlay(sketch, graph.replace(warnings=tuple(f"Note number {k} that goes on for more than a line or two." for k in range(80))))
    text = [m.text for m in scene.marks if isinstance(m, Words)]
    assert any(line.startswith("and ") and "more: see the report" in line for line in text)
    assert max(m.y for m in scene.marks if isinstance(m, Words)) <= scene.height


def test_a_single_vertical_stroke_has_a_picture():
    sketch = Sketch((Stroke("trunk", np.array([[0.0, 0.0], [0.0, 1.0]])),))
    scene = overlay(sketch, sketch_graph(sketch))
    assert scene.width > 100 and scene.height > 100
    assert counts(sketch_graph(sketch)) == "1 stroke, 1 tree, 1 limb, 1 segment, 0 doubts"


def test_strokes_with_one_role_are_one_doubt_in_words_of_their_own(oak):
    sketch, graph = oak
    names = tuple(stroke.id for stroke in sketch.strokes[1:3])
    roles = tuple(Role(name, "hatching", "short and parallel", (("branch", 0.4),)) for name in names)
    taken = tuple(Attachment(name, None, (0.0, 0.0), 0.0, 0.0, (("branch", 0.4),), "taken for hatching") for name in names)
    unsure = Attachment("limb-3", "trunk", tuple(graph.xy[5].tolist()), 0.0, 1.0, (("top", 1.9),), "a lateral")
    graph = graph.replace(attachments=(*taken, unsure), roles=roles)
    assert [doubt.words for doubt in doubts(graph)] == ["limb-3: from trunk, or top (+0.9)", f"{', '.join(names)}: taken for hatching, may be branch"]
    numbers = [m.text for m in overlay(sketch, graph).marks if isinstance(m, Words) and m.halo]
    assert numbers == ["1", "2", "2"], "a ring on every stroke, a number for the doubt"


def test_only_doubts_that_the_legend_lists_have_a_number(oak):
    sketch, graph = oak
    many = tuple(Attachment(f"s{k}", "trunk", tuple(graph.xy[5].tolist()), 0.0, 1.0, (("top", 1.0 + k / 200),), "a lateral") for k in range(150))
    scene = overlay(sketch, graph.replace(attachments=many))
    text = [m.text for m in scene.marks if isinstance(m, Words)]
    numbers = [m.text for m in scene.marks if isinstance(m, Words) and m.halo]
    assert 10 < len(numbers) < 150 and all(any(line.startswith(f"{number}  s") for line in text) for number in numbers)
    assert f"and {150 - len(numbers)} more: see the report's attachments" in text
    rings = [m for m in scene.marks if isinstance(m, Disc) and m.colour == DOUBT and m.fill is None]
    assert len(rings) == 150 + 1, "all of them a ring, and the key"
    assert not any(isinstance(m, Words) for m in overlay(sketch, graph.replace(attachments=many), explained=False).marks)


def test_marks_shrink_where_many_limbs_share_a_small_picture(oak):
    def junctions(scene):
        return {m.radius for m in scene.marks if isinstance(m, Disc) and m.fill == "#ffffff"}

    assert max(junctions(overlay(*oak, explained=False))) > max(junctions(overlay(*oak, explained=False, long_side=250.0)))


def test_numbers_have_a_halo_in_both_files(oak):
    sketch, graph = oak
    unsure = Attachment("limb-1", "trunk", tuple(graph.xy[5].tolist()), 0.0, 1.0, (("top", 1.9),), "a lateral")
    scene = overlay(sketch, graph.replace(attachments=(unsure,)))
    assert 'paint-order="stroke"' in scene_svg(scene)
    (number,) = [m for m in scene.marks if isinstance(m, Words) and m.halo]
    image = Image.open(io.BytesIO(scene_png(scene)))
    around = [image.getpixel((round(number.x) + dx, round(number.y) - dy)) for dx in range(-2, 12) for dy in range(-2, 14)]
    assert (255, 255, 255) in around, "white between the crown's green and the number"


def test_a_large_scan_is_shown_smaller_and_lies_where_its_strokes_do(tmp_path):
    Image.new("L", (3200, 1600), 255).save(tmp_path / "scan.png")
    strokes = (Stroke("a", np.array([[1600.0, -1600.0], [1600.0, -100.0]])),)
    sketch = Sketch(strokes, page=(0.0, -1600.0, 3200.0, 0.0))
    shown = scan(tmp_path / "scan.png", sketch)
    assert shown.pixels.shape == (800, 1600, 3)
    scene = overlay(sketch, sketch_graph(sketch), underlay=shown, explained=False)
    left, top, width, height = scene.underlay.box
    stem = next(m for m in limbs(scene) if m.colour == ORDER[0]).points
    assert -10 < left <= 0 and left + width >= scene.width and width < scene.width + 20, "only what is seen"
    assert top == pytest.approx(MARGIN) and height == pytest.approx(scene.height - 2 * MARGIN, abs=1)
    assert stem[:, 0].mean() == pytest.approx(scene.width / 2, abs=1)
    assert scan(tmp_path / "scan.png", Sketch(strokes)) is None, "a picture that carries its strokes has other units"
    assert scan(EXAMPLES / "oak.svg", sketch) is None
