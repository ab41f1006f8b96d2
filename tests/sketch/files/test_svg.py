import numpy as np
import pytest

from sketchtree.errors import SketchError
from sketchtree.sketch.files.svg import read_svg
from sketchtree.sketch.strokes import StrokeKind

LINE = '<path {} d="M1 2L3 4" stroke="black" fill="none"/>'


def strokes_of(body, head='viewBox="0 0 100 100"', **options):
    text = f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" {head}>{body}</svg>'
    return read_svg(text.encode(), "t.svg", **options).strokes


def only(body, **options):
    (stroke,) = strokes_of(body, **options)
    return stroke


def test_points_are_user_units_of_the_view_box_with_y_up():
    stroke = only(LINE.format(""), head='viewBox="-50 -50 100 100" width="500" height="500"')
    assert stroke.points.tolist() == [[1, -2], [3, -4]]


def test_a_css_transform_of_a_class_moves_its_group():
    body = f"<style>.plant{{transform:translate(125px, 190px);}}</style><g class='plant'>{LINE.format('')}</g>"
    assert only(body).points.tolist() == [[126, -192], [128, -194]]


def test_descendant_and_child_selectors_reach_the_stroke():
    body = f"<style>g.a path {{transform: translate(10px)}} g.a > path {{stroke-width: 7px}}</style><g class='a'>{LINE.format('')}</g>"
    stroke = only(body)
    assert stroke.points[0, 0] == 11 and stroke.width == 7


def test_specificity_the_style_attribute_and_important_decide_in_that_order():
    sheet = "<style>#a{stroke-width:3} path{stroke-width:2 !important} .b{stroke-width:1}</style>"
    assert only(sheet + LINE.format('id="a" class="b" style="stroke-width:9"')).width == 2
    assert only(sheet.replace("!important", "") + LINE.format('id="a" class="b"')).width == 3
    assert only(sheet.replace("!important", "") + LINE.format('id="a" style="stroke-width:9"')).width == 9


def test_a_rule_for_print_does_not_apply():
    assert only("<style>@media print{path{stroke-width:9}} @media screen{path{stroke-width:4}}</style>" + LINE.format("")).width == 4


def test_nested_transforms_multiply_and_scale_the_line_width():
    stroke = only('<g transform="translate(10 0)"><g transform="scale(2)">' + LINE.format("stroke-width='3'") + '</g></g>')
    assert stroke.points[0].tolist() == [12, -4] and stroke.width == pytest.approx(6)


def test_a_stroke_that_does_not_scale_keeps_its_width():
    assert only('<g transform="scale(2)">' + LINE.format("vector-effect='non-scaling-stroke'") + '</g>').width == 1


def test_transform_origin_in_the_fill_box_is_the_middle_of_the_shape():
    body = LINE.format("style='transform:rotate(180deg);transform-box:fill-box;transform-origin:center'")
    assert only(body).points == pytest.approx(np.array([[3, -4], [1, -2]]))


def test_use_draws_a_symbol_again_elsewhere():
    body = f'<defs><g id="twig">{LINE.format("")}</g></defs><use href="#twig" x="10"/><use xlink:href="#twig" y="5"/>'
    assert [s.points[0].tolist() for s in strokes_of(body)] == [[11, -2], [1, -7]]


def test_a_use_of_another_file_is_left_out_and_reported():
    text = b'<svg xmlns="http://www.w3.org/2000/svg"><use href="other.svg#a"/><path d="M0 0L1 1" stroke="red"/></svg>'
    sketch = read_svg(text, "t.svg")
    assert len(sketch) == 1 and "other.svg#a" in sketch.warnings[0]


def test_a_use_of_itself_ends():
    assert len(strokes_of(f'<g id="a"><use href="#a"/>{LINE.format("")}</g>')) == 1


def test_a_nested_svg_fits_its_view_box():
    body = f'<svg x="10" y="0" width="20" height="40" viewBox="0 0 10 10">{LINE.format("")}</svg>'
    assert only(body).points[0].tolist() == [12, -14]


@pytest.mark.parametrize(
    "attributes",
    [
        'display="none"',
        'style="display:none"',
        'visibility="hidden"',
        'opacity="0"',
        'style="stroke:none"',
        'stroke-opacity="0%"',
        'style="stroke:transparent"',
        'style="stroke:rgba(0,0,0,0)"',
        'style="stroke:#0000"',
        'stroke-width="0"',
    ],
)
def test_what_is_not_seen_is_no_stroke(attributes):
    assert strokes_of(f'<g stroke="black" fill="none"><path d="M1 2L3 4" {attributes}/></g>') == ()


@pytest.mark.parametrize("place", ["defs", "clipPath", "mask", "symbol", "marker", "pattern"])
def test_definitions_are_not_painted(place):
    assert strokes_of(f"<{place}>{LINE.format('')}</{place}>") == ()


def test_an_opaque_child_of_a_hidden_group_stays_hidden_but_a_visible_one_shows():
    assert strokes_of('<g opacity="0">' + LINE.format("opacity='1'") + '</g>') == ()
    assert len(strokes_of('<g visibility="hidden">' + LINE.format("visibility='visible'") + '</g>')) == 1


@pytest.mark.parametrize(
    "label", ['id="crown"', 'class="Crown"', 'inkscape:label="the crown 2"', 'data-name="CROWNS"']
)
def test_a_label_on_any_ancestor_makes_a_crown(label):
    stroke = only(f"<g {label}><g>{LINE.format('')}</g></g>")
    assert stroke.kind is StrokeKind.CROWN and stroke.labelled


def test_the_nearest_label_wins_and_part_of_a_word_is_none():
    assert only('<g id="crown">' + LINE.format("id='obstacle1'") + '</g>').kind is StrokeKind.OBSTACLE
    assert only(LINE.format('id="crowned"')).kind is StrokeKind.BRANCH


def test_ids_come_from_the_file_and_are_unique():
    twice = '<path id="a" d="M0 0L1 1M5 5L6 6" stroke="red"/>'
    assert [s.id for s in strokes_of(twice + LINE.format("") + LINE.format('id="a-2"'))] == ["a", "a-2", "stroke-2", "a-2-2"]


def test_a_shape_painted_without_a_stroke_is_filled_and_closed():
    stroke = only('<path d="M0 0L5 0L5 50Z" fill="brown"/>')
    assert stroke.filled and stroke.closed and stroke.width is None and len(stroke.points) == 3


def test_a_rectangle_over_the_whole_page_is_the_paper():
    text = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><rect width="10" height="10" fill="#fff"/><path d="M0 0L1 1" stroke="red"/></svg>'
    sketch = read_svg(text, "t.svg")
    assert len(sketch) == 1 and "taken for the paper" in sketch.warnings[0]


def test_a_curve_is_flattened_to_the_drawings_size():
    for scale in (1e-3, 1.0, 1e6):
        d = "M0 0C0 {0} {0} {0} {0} 0".format(100 * scale)
        assert 8 < len(only(f'<path d="{d}" stroke="red" fill="none"/>').points) < 60


def test_too_many_strokes_stop_the_reading():
    with pytest.raises(SketchError, match="more than 3 strokes.*--max-strokes"):
        strokes_of(LINE.format("") * 4, max_strokes=3)


def test_nesting_without_end_is_refused():
    with pytest.raises(SketchError, match="nests its groups more than 256 deep"):
        strokes_of("<g>" * 400 + LINE.format("") + "</g>" * 400)


def test_a_coordinate_that_is_no_number_names_the_stroke():
    with pytest.raises(SketchError, match="Stroke limb3: in t.svg, a coordinate is not a finite number") as error:
        strokes_of('<path id="limb3" d="M0 0L nan 4" stroke="red"/>')
    assert error.value.stroke == "limb3"
    with pytest.raises(SketchError, match="not a finite number"):
        strokes_of('<path id="limb3" d="M0 0L 1e999 4" stroke="red"/>')


def test_illustrators_namespace_entities_are_replaced():
    text = b'<!DOCTYPE svg [<!ENTITY ns_svg "http://www.w3.org/2000/svg">]><svg xmlns="&ns_svg;" viewBox="0 0 9 9"><path d="M0 0L1 1" stroke="red"/></svg>'
    assert len(read_svg(text, "t.svg")) == 1


def test_an_entity_bomb_is_refused():
    levels = "".join(f'<!ENTITY e{k} "{f"&e{k - 1};" * 10}">' for k in range(1, 10))
    bomb = f'<!DOCTYPE svg [<!ENTITY e0 "aaaaaaaaaa">{levels}]><svg xmlns="http://www.w3.org/2000/svg"><text>&e9;</text></svg>'
    with pytest.raises(SketchError, match="declares XML entities that would swell"):
        read_svg(bomb.encode(), "t.svg")
