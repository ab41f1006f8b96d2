import pytest

from sketchtree.sketch.files.svg import read_svg

LINE = '<path d="M0 50H100" stroke="black" fill="none" {}/>'
BARE = LINE.format("")


def sketch_of(body, head='viewBox="0 0 100 100"'):
    text = f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" {head}>{body}</svg>'
    return read_svg(text.encode(), "t.svg")


def spans(body):
    """(from, to) along x of every stroke read."""
    return [(round(s.points[0, 0], 3), round(s.points[-1, 0], 3)) for s in sketch_of(body).strokes]


@pytest.mark.parametrize(
    "shape",
    [
        '<rect x="20" y="0" width="40" height="100"/>',
        '<path d="M20 0H60V100H20Z"/>',
        '<path d="M20 0H60V100H20Z" fill="none" stroke="none"/>',
        '<polygon points="20,0 60,0 60,100 20,100"/>',
        '<rect x="10" width="20" height="50" transform="scale(2)"/>',
        '<use href="#r"/>',
        '<use href="#s" x="20"/>',
        '<rect x="20" width="20" height="100"/><rect x="40" width="20" height="100"/>',
        '<circle cx="40" cy="50" r="20"/>',
        '<ellipse cx="40" cy="50" rx="20" ry="50"/>',
    ],
)
def test_a_line_is_cut_to_its_clip(shape):
    defs = f'<defs><rect id="r" x="20" width="40" height="100"/><rect id="s" width="40" height="100"/><clipPath id="c">{shape}</clipPath></defs>'
    ((first, last),) = spans(defs + LINE.format('clip-path="url(#c)"'))
    assert (first, last) == pytest.approx((20, 60), abs=0.05)


@pytest.mark.parametrize("how", ['clip-path="url(#c)"', 'style="clip-path:url(#c)"', "style='clip-path: url(\"#c\")'", 'class="k"'])
def test_a_clip_may_be_named_in_any_way(how):
    body = '<style>.k{clip-path:url(#c)}</style><clipPath id="c"><rect width="30" height="99"/></clipPath>'
    assert spans(body + f"<g {how}>{BARE}</g>") == [(0, 30)]


def test_a_clip_moves_with_the_element_it_clips():
    body = '<clipPath id="c"><rect width="30" height="99"/></clipPath>'
    assert spans(body + LINE.format('clip-path="url(#c)" transform="translate(7 0)"')) == [(7, 37)]
    assert spans(body + '<g transform="scale(2)">' + LINE.format('clip-path="url(#c)"') + "</g>") == [(0, 60)]


def test_a_clip_in_units_of_the_bounding_box_is_a_part_of_it():
    body = '<clipPath id="c" clipPathUnits="objectBoundingBox"><rect x=".25" width=".5" height="1"/></clipPath>'
    assert spans(body + '<g clip-path="url(#c)">' + BARE + '<path d="M0 0V100" stroke="red"/></g>') == [(25, 75)]


def test_nested_clips_show_what_all_of_them_show():
    body = '<clipPath id="a"><rect width="60" height="99"/></clipPath><clipPath id="b" clip-path="url(#d)"><rect x="20" width="99" height="99"/></clipPath><clipPath id="d"><rect width="50" height="99"/></clipPath>'
    assert spans(body + f'<g clip-path="url(#a)"><g clip-path="url(#b)">{BARE}</g></g>') == [(20, 50)]


def test_the_clip_rule_decides_whether_a_hole_shows():
    data = "M0 0H100V100H0Z M40 0H60V100H40Z"
    hole = f'<clipPath id="c"><path d="{data}" clip-rule="evenodd"/></clipPath>'
    assert spans(hole + LINE.format('clip-path="url(#c)"')) == [(0, 40), (60, 100)]
    assert spans(hole.replace("evenodd", "nonzero") + LINE.format('clip-path="url(#c)"')) == [(0, 100)]


def test_the_pieces_of_a_cut_stroke_are_named_after_it():
    body = '<clipPath id="c"><rect width="20" height="99"/><rect x="80" width="20" height="99"/></clipPath>'
    sketch = sketch_of(body + LINE.format('id="limb" clip-path="url(#c)"'))
    assert [s.id for s in sketch.strokes] == ["limb", "limb-2"]
    assert sketch.warnings == ("1 shape was cut where a clip or mask hides the rest.",)


def test_what_lies_outside_its_clip_is_left_out_and_counted():
    body = '<clipPath id="c"><rect width="20" height="20"/></clipPath><clipPath id="e"/>'
    sketch = sketch_of(body + LINE.format('clip-path="url(#c)"') * 2 + LINE.format('clip-path="url(#e)"') + BARE)
    assert len(sketch) == 1 and sketch.warnings == ("3 shapes outside their clips were left out.",)


def test_a_clip_around_all_changes_nothing():
    body = '<clipPath id="c"><rect x="-1" y="-1" width="200" height="200" rx="9"/></clipPath>'
    curve = '<path d="M10 50C20 10 70 10 90 50Z" stroke="red" fill="none"/>'
    plain, clipped = sketch_of(curve), sketch_of(f'{body}<g clip-path="url(#c)">{curve}</g>')
    assert clipped.strokes[0].points.tolist() == plain.strokes[0].points.tolist() and clipped.strokes[0].closed
    assert clipped.warnings == ()


@pytest.mark.parametrize("value", ["url(#none)", "none", "url(#t)", "url(#loop)"])
def test_a_clip_that_is_not_there_or_clips_itself_clips_nothing(value):
    body = '<g id="t"/><clipPath id="loop" clip-path="url(#loop)"><rect width="200" height="99"/></clipPath>'
    assert spans(body + LINE.format(f'clip-path="{value}"')) == [(0, 100)]


def test_a_clip_that_cannot_be_worked_out_is_told_and_shows_all():
    sketch = sketch_of('<clipPath id="c"><text>oak</text></clipPath>' + LINE.format('clip-path="url(#c)"') * 2)
    assert len(sketch) == 2
    assert sketch.warnings == ("The clip or mask 'c' holds text or a picture; what it hides was read too.",)
    (warning,) = sketch_of(LINE.format('clip-path="circle(40%)"')).warnings
    assert warning == "The clip or mask 'circle(40%)' is of a kind that is not read; what it hides was read too."


def test_a_painted_shape_is_cut_as_an_area():
    body = '<clipPath id="c"><rect width="50" height="100"/></clipPath><path d="M40 0H60V100H40Z" fill="brown" clip-path="url(#c)"/>'
    (stroke,) = sketch_of(body).strokes
    assert stroke.filled and stroke.closed and stroke.points[:, 0].max() == 50


def test_a_nested_svg_hides_what_lies_outside_it_unless_it_says_otherwise():
    inner = '<svg x="10" width="50" height="100" {}>' + BARE + "</svg>"
    assert spans(inner.format("")) == [(10, 60)]
    assert spans(inner.format('overflow="visible"')) == [(10, 110)]
    assert spans(inner.format('style="overflow:visible"')) == [(10, 110)]


def test_a_symbol_is_as_large_as_its_use_says():
    symbol = '<symbol id="s" viewBox="0 0 100 100"><path d="M0 50H100" stroke="black"/></symbol>'
    assert spans(symbol + '<use href="#s" x="5" width="40" height="40"/>') == [(5, 45)]
    assert spans(symbol + '<use href="#s" width="40" height="100" />') == [(0, 40)]


MASK = '<mask id="m" {}>{}</mask>'


@pytest.mark.parametrize(
    "attributes, shapes",
    [
        ("", '<rect x="20" width="40" height="100" fill="white"/>'),
        ('style="mask-type:alpha"', '<rect x="20" width="40" height="100" fill="black"/>'),
        ('style="mask-type:alpha"', '<g fill="#D9D9D9"><rect x="20" width="40" height="100"/></g>'),
        ("", '<rect width="100" height="100" fill="#fff"/><rect x="60" width="40" height="100"/><rect width="20" height="100" fill="rgb(0,0,0)"/>'),
        ("", '<path d="M40 0V100" stroke="white" stroke-width="40"/>'),
        ('maskUnits="userSpaceOnUse" x="20" y="0" width="40" height="100"', '<linearGradient id="fade"/><rect width="100" height="100" fill="url(#fade)"/>'),
        ('maskContentUnits="objectBoundingBox"', '<rect x=".2" y="-9" width=".4" height="99" fill="white"/>'),
    ],
)
def test_a_line_is_cut_to_the_bright_part_of_its_mask(attributes, shapes):
    body = MASK.format(attributes, shapes) + '<g mask="url(#m)">' + BARE + '<path d="M0 40V60" stroke="red"/></g>'
    assert (20, 60) in spans(body)


def test_a_mask_that_is_dark_hides_all():
    sketch = sketch_of(MASK.format("", '<rect width="100" height="100" fill="black"/>') + LINE.format('mask="url(#m)"'))
    assert len(sketch) == 0 and sketch.warnings == ("A shape outside its clip was left out.",)


def test_a_mask_with_a_picture_shows_all_and_is_told():
    sketch = sketch_of(MASK.format("", '<image href="a.png"/>') + LINE.format('mask="url(#m)"'))
    assert len(sketch) == 1 and "'m' holds text or a picture" in sketch.warnings[0]


def test_the_clip_of_a_clone_moves_with_its_x_and_y():
    clip = '<clipPath id="c"><rect x="20" width="40" height="100"/></clipPath><defs><path id="p" d="M0 50H100" stroke="black"/></defs>'
    assert spans(clip + '<use href="#p" x="10" clip-path="url(#c)"/>') == [(30, 70)]
    box = '<clipPath id="c" clipPathUnits="objectBoundingBox"><rect x=".2" y="-9" width=".4" height="99"/></clipPath><defs><path id="p" d="M0 50L100 51" stroke="black"/></defs>'
    assert spans(box + '<use href="#p" x="10" clip-path="url(#c)"/>') == [(30, 70)]
