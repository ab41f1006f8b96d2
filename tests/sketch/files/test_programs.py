"""One little tree as each drawing program writes it gives the same strokes with the same names."""

from pathlib import Path

import numpy as np
import pytest
import shapely

from sketchtree.sketch.files.labels import role_named
from sketchtree.sketch.files.svg import read_svg
from sketchtree.sketch.strokes import StrokeKind

DATA = Path(__file__).resolve().parents[2] / "data" / "svg"
PROGRAMS = sorted(path.stem for path in DATA.glob("*.svg"))
LEFT_OUT = {
    "inkscape": "A hidden shape was left out.",
    "illustrator_cs": "A hidden shape was left out.",
    "figma": "2 shapes outside their clips were left out.",
    "concepts": "A hidden shape was left out.",
    "linearity": "A shape outside its clip was left out.",
    "excalidraw_export": "A text was left out.",
}
PAPER = {"figma", "excalidraw_export"}  # these paint a white page


def bezier(*points):
    t = np.linspace(0, 1, 200)[:, None]
    a, b, c, d = np.array(points, float)
    return (1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d


TRUNK = bezier((200, 380), (198, 320), (204, 260), (200, 200))
RIGHT = bezier((200, 260), (230, 230), (250, 210), (280, 190))
LEFT = bezier((201, 230), (170, 200), (150, 190), (120, 185))
CROWN = np.vstack([bezier((80, 190), (80, 90), (320, 90), (320, 190)), bezier((320, 190), (320, 250), (80, 250), (80, 190))])
GROUND = np.array([[50, 380], [350, 380]])


def drawn(program):
    return read_svg((DATA / f"{program}.svg").read_bytes(), f"{program}.svg")


def gap(stroke, curve):
    line = stroke.points[[0, 0]] if len(stroke.points) < 2 else stroke.points
    line = np.vstack([line, line[:1]]) if stroke.closed else line
    return shapely.hausdorff_distance(shapely.LineString(line), shapely.LineString(curve * (1, -1)), densify=0.05)


@pytest.mark.parametrize("program", PROGRAMS)
def test_the_same_lines_lie_at_the_same_places(program):
    strokes = drawn(program).strokes
    assert len(strokes) == 5
    for curve in (TRUNK, RIGHT, LEFT, CROWN, GROUND):
        assert min(gap(stroke, curve) for stroke in strokes) < (2.0 if program == "concepts" else 0.5)


@pytest.mark.parametrize("program", PROGRAMS)
def test_layers_name_branches_crown_and_ground(program):
    strokes = drawn(program).strokes
    nearest = [strokes[int(np.argmin([gap(s, curve) for s in strokes]))] for curve in (TRUNK, RIGHT, LEFT, CROWN, GROUND)]
    *limbs, crown, ground = nearest
    assert [s.kind for s in limbs] == [StrokeKind.BRANCH] * 3 and all(s.labelled for s in limbs)
    assert crown.kind is StrokeKind.CROWN and crown.labelled and crown.closed
    assert not ground.labelled and role_named(ground.layer, ground.id) == "ground"
    assert not any(s.filled for s in strokes)


@pytest.mark.parametrize("program", PROGRAMS)
def test_the_trunk_is_drawn_twice_as_wide_as_the_limbs(program):
    strokes = drawn(program).strokes
    width = [strokes[int(np.argmin([gap(s, curve) for s in strokes]))].width for curve in (TRUNK, RIGHT, LEFT)]
    assert width == pytest.approx([6, 3, 3])


@pytest.mark.parametrize("program", PROGRAMS)
def test_what_is_hidden_or_clipped_away_is_told_and_nothing_else(program):
    warnings = [w for w in drawn(program).warnings if "paper" not in w]
    assert warnings == ([LEFT_OUT[program]] if program in LEFT_OUT else [])
    assert (len(drawn(program).warnings) > len(warnings)) == (program in PAPER)


@pytest.mark.parametrize("program", PROGRAMS)
def test_the_page_is_the_view_box(program):
    assert drawn(program).page == (0.0, -400.0, 400.0, 0.0)


def test_a_power_stroke_is_the_line_that_was_drawn_with_its_widths():
    trunk = max(drawn("inkscape").strokes, key=lambda s: s.width)
    assert trunk.width == 6 and not trunk.filled and not trunk.closed
    assert trunk.pressure[[0, -1]] == pytest.approx([1, 1 / 3]) and (np.diff(trunk.pressure) < 0).all()


def test_escaped_and_spelt_out_names_are_layers():
    assert {s.layer for s in drawn("illustrator_cs").strokes} == {"branches_ink", "crown_outline", "ground"}
    assert {s.layer for s in drawn("coreldraw").strokes} == {"Branch lines", "Crown outline", "Ground"}
    assert {s.layer for s in drawn("affinity").strokes} == {"trunk and limbs", "Crown", "ground"}
    assert {s.layer for s in drawn("linearity").strokes} == {"branches", "Crown", "Ground"}
    assert {s.layer for s in drawn("illustrator_cc").strokes} == {"branch lines", "Twig", "tree canopy", "ground"}
