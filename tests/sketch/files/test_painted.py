"""What a browser paints of a document, and what is told of the rest."""

import time

import numpy as np
import pytest

from sketchtree.errors import SketchError
from sketchtree.sketch.files.svg import read_svg
from sketchtree.sketch.strokes import StrokeKind

LINE = '<path {} d="M1 2L3 4" stroke="black" fill="none"/>'
BARE = LINE.format("")
NAMED = LINE.format("id='a'")
SPACES = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'


def sketch_of(body, head='viewBox="0 0 100 100"', **options):
    return read_svg(f"<svg {SPACES} {head}>{body}</svg>".encode(), "t.svg", **options)


def ids(body):
    return [stroke.id for stroke in sketch_of(body).strokes]


def only(body, **options):
    (stroke,) = sketch_of(body, **options).strokes
    return stroke


def test_a_switch_shows_its_first_fitting_child():
    def named(name, condition=""):
        return LINE.format(f"id='{name}' {condition}")

    german, english, extended = "systemLanguage='de'", "systemLanguage='fr, en-GB'", "requiredExtensions='urn:x'"
    assert ids(f"<switch>{named('a')}{named('b')}</switch>") == ["a"]
    assert ids(f"<switch>{named('a', german)}{named('b', english)}{named('c')}</switch>") == ["b"]
    assert ids(f"<switch><desc>x</desc>{named('a', extended)}{named('c')}</switch>") == ["c"]
    nothing = sketch_of(f"<switch>{named('a', german)}</switch>{named('b')}")
    assert [s.id for s in nothing.strokes] == ["b"] and nothing.warnings == ("A hidden shape was left out.",)


def test_what_is_left_out_is_counted_in_one_sentence():
    hidden = f'<g display="none">{BARE}<g>{BARE}</g><text>x</text></g><g opacity="0">{BARE}</g>'
    others = '<text>a</text><text>b<tspan>c</tspan></text><image href="a.png"/><foreignObject/><use href="#gone"/><path d="M0 0L1 1" fill="none"/>'
    assert sketch_of(hidden + others + BARE).warnings == (
        "3 hidden shapes, 2 texts, a picture, an embedded page, a clone of nothing and a shape without fill or stroke were left out.",
    )


def test_programs_own_unpainted_rectangles_and_definitions_are_not_counted():
    assert sketch_of(f'<defs>{BARE}<g display="none">{BARE}</g></defs><rect width="9" height="9" fill="none"/><title>x</title>{BARE}').warnings == ()


def test_other_files_are_told_once_each():
    warnings = sketch_of('<use href="a.svg#x"/><use href="a.svg#x"/><use href="b.svg"/>' + BARE).warnings
    assert warnings == (
        "A <use> of 'a.svg#x' (and 1 more of it) was left out: other files are not read.",
        "A <use> of 'b.svg' was left out: other files are not read.",
    )


def test_elements_of_other_vocabularies_are_not_painted():
    assert ids(f'<x:path xmlns:x="urn:x" d="M0 0L1 1" stroke="red"/><inkscape:path d="M0 0L1 1" stroke="red"/>{NAMED}') == ["a"]


def test_a_colour_of_the_page_is_drawn_all_the_same():
    assert only('<path d="M0 0L1 1" stroke="white" fill="none"/>').width == 1


def test_current_colour_is_the_colour_around_it():
    assert len(sketch_of('<g color="red"><path d="M0 0L1 1" stroke="currentColor" fill="none"/></g>')) == 1
    assert len(sketch_of('<g color="transparent"><path d="M0 0L1 1" stroke="currentColor" fill="none"/></g>')) == 0


def test_dashes_markers_and_path_length_leave_one_stroke():
    marked = LINE.format('stroke-dasharray="1 2" pathLength="3" marker-end="url(#m)" stroke-dashoffset="9"')
    assert only(f'<marker id="m">{BARE}</marker>{marked}').points.tolist() == [[1, -2], [3, -4]]


def test_geometry_may_stand_in_the_style():
    assert only("<style>path{d:path('M5 5L9 9')}</style><path stroke='red' d='M0 0L1 1'/>").points.tolist() == [[5, -5], [9, -9]]
    assert only('<rect style="x:5px;y:0;width:2px;height:3px" stroke="red" fill="none"/>').points[0].tolist() == [5, 0]


@pytest.mark.parametrize(
    "unit, size", [("", 2), ("px", 2), ("pt", 2 * 96 / 72), ("mm", 2 * 96 / 25.4), ("in", 192), ("%", 2), ("em", 32), ("Q", 2 * 96 / 101.6)]
)
def test_line_widths_have_units(unit, size):
    assert only(LINE.format(f'style="stroke-width:2{unit}"')).width == pytest.approx(size)


def test_a_shape_squeezed_flat_is_not_painted():
    assert len(sketch_of(f'<g transform="scale(1 0)">{BARE}</g>')) == 0


@pytest.mark.parametrize(
    "aspect, first",
    [("", (12, -14)), ("xMinYMin", (12, -4)), ("xMidYMax meet", (12, -24)), ("none", (12, -8)), ("xMinYMin slice", (14, -8)), ("xMaxYMin slice", (-6, -8))],
)
def test_a_nested_svg_is_fitted_as_it_asks(aspect, first):
    body = f'<svg x="10" width="20" height="40" overflow="visible" viewBox="0 0 10 10" preserveAspectRatio="{aspect}">{BARE}</svg>'
    assert tuple(only(body).points[0]) == pytest.approx(first)


@pytest.mark.parametrize(
    "head, page",
    [
        ('viewBox="-5 -6 10 20"', (-5.0, -14.0, 5.0, 6.0)),
        ('viewBox="0,0,10,20" width="99mm"', (0.0, -20.0, 10.0, 0.0)),
        ('width="10" height="20"', (0.0, -20.0, 10.0, 0.0)),
        ('width="1in" height="2in"', (0.0, -192.0, 96.0, 0.0)),
        ('width="100%" height="100%"', None),
        ('width="10"', None),
        ('width="1e999" height="wide"', None),
        ("", None),
    ],
)
def test_the_page_is_what_the_file_says(head, page):
    assert sketch_of(BARE, head=head).page == page


@pytest.mark.parametrize("size", ['width="0" height="9"', 'width="9" height="-1"'])
def test_a_page_of_no_size_is_refused(size):
    with pytest.raises(SketchError, match="t.svg has a page of no size .*Set the page's width and height"):
        sketch_of(BARE, head=size)


@pytest.mark.parametrize(
    "group, layer",
    [
        ('inkscape:label="Left side" id="layer3"', "Left side"),
        ('id="left_x0020_side"', "left side"),
        ('id="g123"', None),
        ('class="left"', None),
        ('data-name="Layer 1" id="Layer_1"', "Layer 1"),
        ('serif:id="left"', "left"),
    ],
)
def test_a_stroke_knows_the_name_of_its_innermost_layer(group, layer):
    assert only(f'<g id="tree"><g {group}>{NAMED}</g></g>').layer == (layer or "tree")


def test_a_name_that_says_something_is_not_hidden_by_one_inside_it_that_does_not():
    stroke = only(f'<g id="ground"><g id="tuft">{BARE}</g></g>')
    assert stroke.layer == "ground" and stroke.kind is StrokeKind.BRANCH and not stroke.labelled
    assert only(f'<g id="crown"><g id="shadow">{BARE}</g></g>').kind is StrokeKind.BRANCH


def test_a_title_names_its_group_or_shape_but_not_the_document():
    assert only(f"<g><title>crown</title>{BARE}</g>").kind is StrokeKind.CROWN
    assert only('<path d="M0 0L1 1" stroke="red"><title>cast shadow</title></path>').layer == "cast shadow"
    assert only(f"<title>a crown</title>{BARE}", head='id="crown" class="canopy"').kind is StrokeKind.BRANCH


def test_a_taper_stroke_is_the_line_under_it():
    effect = '<inkscape:path-effect effect="taper_stroke" id="e" stroke_width="5"/>'
    path = '<path d="M0 0L9 9L8 9Z" inkscape:original-d="M0 0L9 9" inkscape:path-effect="#e"/>'
    stroke = only(effect + path)
    assert stroke.points.tolist() == [[0, 0], [9, -9]] and stroke.width == 5 and not stroke.filled
    assert only(effect.replace("/>", ' is_visible="false"/>') + path).filled
    assert only(effect.replace("taper_stroke", "roughen") + path).filled


@pytest.mark.parametrize("points", ["", "a,b", "0,0 | 1,0", "0,nan", "0,1 | 2"])
def test_power_stroke_points_that_say_nothing_leave_the_width_open(points):
    effect = f'<inkscape:path-effect effect="powerstroke" id="e" offset_points="{points}"/>'
    stroke = only(effect + '<path d="M0 0L9 9L8 9Z" inkscape:original-d="M0 0L9 9" inkscape:path-effect="#e"/>')
    assert stroke.width is None and stroke.pressure is None


def test_clones_of_clones_without_end_are_refused_in_time():
    levels = "".join(f'<g id="l{k}">' + f'<use href="#l{k - 1}"/>' * 10 + "</g>" for k in range(1, 12))
    begun = time.process_time()
    with pytest.raises(SketchError, match="repeats them too often. Ungroup the drawing, unlink its clones"):
        sketch_of(f'<defs><g id="l0"/>{levels}</defs><use href="#l11"/>')
    with pytest.raises(SketchError, match="more than 20 strokes"):
        sketch_of(f'<defs><g id="l0">{BARE}</g>{levels}</defs><use href="#l11"/>', max_strokes=20)
    assert time.process_time() - begun < 30  # a hang is what this is about


def test_clones_in_a_ring_end():
    ring = '<g id="a"><use href="#b"/></g><g id="b"><use href="#c"/></g><g id="c"><use href="#a"/>' + BARE + "</g>"
    sketch = sketch_of(ring)
    assert len(sketch) == 3 and sketch.warnings == ("3 clones of what they lie in were left out.",)


def test_boxes_of_nested_groups_are_worked_out_once():
    style = 'style="transform-box:fill-box;transform-origin:center;transform:rotate(180deg)"'
    body = f"<g {style}>" * 40 + BARE + "</g>" * 40
    assert only(body).points == pytest.approx(np.array([[1, -2], [3, -4]]))


def test_too_many_pieces_of_one_path_are_too_many_strokes():
    with pytest.raises(SketchError, match="t.svg holds more than 5 strokes. Draw fewer strokes, or raise the limit with --max-strokes."):
        sketch_of(f'<path stroke="red" d="{"M0 0h1" * 6}"/>', max_strokes=5)


def test_strokes_inside_clips_do_not_count():
    assert len(sketch_of(f'<clipPath id="c">{BARE * 9}</clipPath><g clip-path="url(#d)">{BARE}</g>', max_strokes=1)) == 1


@pytest.mark.parametrize("sized", ['<svg width="100" height="40" viewBox="0 0 50 20">{}</svg>', '<symbol id="s" viewBox="0 0 50 20">{}</symbol><use href="#s" width="100" height="40"/>'])
def test_percentages_are_of_the_nearest_viewport(sized):
    line = only(sized.format('<line x1="10%" y1="50%" x2="90%" y2="100%" stroke="black" stroke-width="10%"/>'))
    assert line.points == pytest.approx(np.array([[10, -20], [90, -40]]))
    assert line.width == pytest.approx(2 * 0.1 * np.hypot(50, 20) / np.sqrt(2))


def test_letters_are_as_large_as_the_font_around():
    def ends(size, unit):
        return only(f'<g font-size="20"><g style="font-size:{size}"><line x2="1{unit}" stroke="black"/></g></g>').points[-1, 0]

    assert [ends("20px", "em"), ends("50%", "em"), ends("2em", "em"), ends("30", "ex")] == [20, 10, 40, 15]
    assert [ends("larger", "em"), ends("30", "rem")] == [20, 16]
    assert only('<line x2="1em" stroke="black"/>').points[-1, 0] == 16


@pytest.mark.parametrize("paint, shows", [("url(#here)", True), ("url('#here') none", True), ("url(#gone) red", True), ("url(#gone)", False), ("url(#gone) none", False),
                                          ("url(other.svg#here)", False)])  # fmt: skip
def test_a_line_of_a_gradient_shows_if_the_gradient_is_there_or_a_colour_stands_in(paint, shows):
    gradient = '<linearGradient id="here"><stop stop-color="red"/></linearGradient>'
    sketch = sketch_of(gradient + f'<path d="M0 0L9 9" fill="none" stroke="{paint}"/>')
    assert len(sketch) == shows and sketch.warnings == (() if shows else ("A shape without fill or stroke was left out.",))


def test_a_path_of_none_draws_nothing():
    assert ids('<path d="none" stroke="red"/>' + NAMED) == ["a"]


def test_a_closed_outline_that_is_turned_does_not_repeat_its_first_point():
    for shape in ('<rect x="3" y="7" width="50" height="20"', '<path d="M3 7H53V27H3L3 7Z"', '<polygon points="3,7 53,7 53,27 3,27"'):
        outline = only(f'{shape} transform="rotate(30) scale(1.7 .9)" fill="none" stroke="red"/>')
        assert outline.closed and len(outline.points) == 4


def test_a_symbol_is_painted_only_where_a_use_names_it():
    inner = f'<symbol id="inner">{LINE.format("id=%s" % repr("b"))}</symbol>'
    assert ids(f'<symbol id="outer">{inner}{NAMED}</symbol><use href="#outer"/>') == ["a"]
    assert ids(f'<symbol id="outer">{inner}{NAMED}<use href="#inner"/></symbol><use href="#outer"/>') == ["a", "b"]


@pytest.mark.parametrize(
    "body",
    [
        f'<g id="g">{NAMED}<use href="#g" x="5"/></g>',
        f'<g id="g">{NAMED}<g><use href="#g" x="5"/></g></g>',
        f'<g id="g">{NAMED}<use id="u" href="#g"/></g>',
    ],
)
def test_a_clone_of_what_it_lies_in_is_left_out_and_counted(body):
    sketch = sketch_of(body)
    assert [s.id for s in sketch.strokes] == ["a"] and sketch.warnings == ("A clone of what it lies in was left out.",)


def test_clones_that_lead_to_themselves_through_others_end():
    sketch = sketch_of(f'<g id="g">{NAMED}<use id="u" href="#g"/></g><use href="#u"/>')
    assert [s.id for s in sketch.strokes] == ["a", "a-2"] and sketch.warnings == ("2 clones of what they lie in were left out.",)


@pytest.mark.parametrize("paint", ["rgb(0 0 0 / 0)", "rgb(0 0 0/0%)", "hsla(9, 9%, 9%, 0)", "#12340000", "#1230", "color(display-p3 1 0 0 / 0)", "hwb(9 9% 9% / 0)", "TRANSPARENT"])
def test_a_clear_colour_does_not_show(paint):
    assert len(sketch_of(f'<path d="M0 0L9 9" fill="none" stroke="{paint}"/>')) == 0


@pytest.mark.parametrize("paint", ["rgb(0 0 0)", "rgb(0, 0, 0, .1)", "#000", "color(display-p3 1 0 0)", "color(srgb 0 0 0)", "oklch(0.4 0.2 0)", "#fff icc-color(a, 0, 0, 0)"])
def test_any_other_colour_shows(paint):
    assert len(sketch_of(f'<path d="M0 0L9 9" fill="none" stroke="{paint}"/>')) == 1


@pytest.mark.parametrize("head, width", [('viewBox="0 0 100 100"', 3), ('viewBox="0 0 100 100" width="1000" height="1000"', 0.3), ('viewBox="0 0 100 100" width="100%"', 3), ('width="50" height="50"', 3)])
def test_a_line_that_does_not_scale_is_as_wide_as_the_screen_paints_it(head, width):
    body = '<g transform="scale(7)"><path d="M0 0L9 9" fill="none" stroke="red" stroke-width="3" vector-effect="non-scaling-stroke"/></g>'
    assert sketch_of(body, head).strokes[0].width == pytest.approx(width)


def test_a_linked_style_sheet_is_told():
    text = f'<?xml version="1.0"?>\n<?xml-stylesheet href="tree.css" type="text/css"?><svg {SPACES} viewBox="0 0 9 9">{BARE}</svg>'
    for data in (text.encode(), text.encode("utf-16")):
        assert read_svg(data, "t.svg").warnings == ("A style sheet of another file was left out; lines may look other than drawn.",)


def test_remarks_without_end_are_counted():
    sketch = sketch_of("".join(f'<use href="a{k}.svg#x"/>' for k in range(500)) + BARE)
    assert len(sketch.warnings) == 20 and sketch.warnings[-1] == "481 more remarks like these were left away."
