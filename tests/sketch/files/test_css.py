from xml.etree import ElementTree

import pytest

from sketchtree.sketch.files.css import Cascade

PATH = '<path id="p" class="a b" data-x="1" {}/>'
BARE = PATH.format("")


def styled(sheet, body=BARE, inherited=None):
    """(computed style of #p, warnings), the styles of its ancestors inherited in turn."""
    root = ElementTree.fromstring(f"<svg><style>{sheet}</style>{body}</svg>")
    cascade = Cascade(root)
    chain = _chain(root, "p")
    style = inherited or {}
    for element in chain:
        style = cascade.style(element, style)
    return style, cascade.warnings


def _chain(element, wanted):
    if element.get("id") == wanted:
        return [element]
    for child in element:
        below = _chain(child, wanted)
        if below:
            return [element, *below]
    return []


def width(sheet, body=BARE):
    return styled(sheet, body)[0].get("stroke-width")


@pytest.mark.parametrize(
    "selector",
    ["path", "*", ".a", ".a.b", "#p", "g path", "g > path", "svg path", "[data-x]", "[data-x='1']", "path:first-child", ":nth-child(1)", "g > :last-child",
     ":not(line)", "path:only-child", "line, path", "g:not(.none) path", ":is(path, line)", "PATH.a, path.b"],
)  # fmt: skip
def test_these_selectors_match(selector):
    assert width(f"{selector}{{stroke-width:7}}", f"<g>{PATH.format('')}</g>") == "7"


@pytest.mark.parametrize("selector", [".c", "#q", "line path", "path:nth-child(2)", "path::before", "path:hover", ":unknown-thing", "path[", "a + path"])
def test_these_selectors_do_not(selector):
    assert width(f"{selector}{{stroke-width:7}}", f"<g>{PATH.format('')}</g>") is None


def test_a_rule_one_does_not_know_leaves_the_others():
    assert width("@font-face{src:url(x)} path:fancy(3){stroke-width:1} @charset 'x'; path{stroke-width:2} }} .a{stroke-width:3}") == "2"
    assert width("path{stroke-width:2} .a{broken; stroke-width:3; also broken}") == "3"


@pytest.mark.parametrize(
    "media, holds",
    [
        ("screen", True),
        ("all", True),
        ("only screen", True),
        ("print", False),
        ("not print", True),
        ("not screen", False),
        ("print, screen", True),
        ("(min-width: 40em)", True),
        ("(prefers-color-scheme: dark)", False),
        ("screen and (prefers-color-scheme:dark)", False),
        ("(prefers-color-scheme: light)", True),
    ],
)
def test_media_queries_are_those_of_a_bright_screen(media, holds):
    assert (width(f"@media {media}{{path{{stroke-width:5}}}}") == "5") == holds
    root = ElementTree.fromstring(f'<svg><style media="{media}">path{{stroke-width:5}}</style><path id="p"/></svg>')
    assert (Cascade(root).style(root[1], {}).get("stroke-width") == "5") == holds


def test_a_sheet_in_another_language_is_not_css():
    root = ElementTree.fromstring('<svg><style type="text/less">path{stroke-width:5}</style><path id="p"/></svg>')
    assert Cascade(root).style(root[1], {}) == {}


def test_important_wins_over_the_style_attribute_and_the_later_of_two():
    sheet = "path{stroke-width:1 !important} .a{stroke-width:2 ! important}"
    assert width(sheet, PATH.format('style="stroke-width:3"')) == "2"
    assert width(sheet, PATH.format('style="stroke-width:3!important"')) == "3"


def test_inherited_properties_pass_down_and_the_others_do_not():
    style, _ = styled("svg{stroke:red;opacity:.5;stroke-width:4;clip-path:url(#a)}")
    assert style == {"stroke": "red", "stroke-width": "4"}


def test_keywords_inherit_initial_and_unset():
    body = f'<g style="stroke:red;opacity:.5">{PATH.format("style=%s")}</g>'
    assert styled("", body.replace("%s", '"opacity:inherit"'))[0] == {"stroke": "red", "opacity": ".5"}
    assert styled("", body.replace("%s", '"stroke:initial"'))[0] == {}
    assert styled("", body.replace("%s", '"stroke:unset;opacity:unset"'))[0] == {"stroke": "red"}


def test_variables_are_put_in_inherited_and_fall_back():
    assert width("svg{--w:3px} path{stroke-width:var(--w)}") == "3px"
    assert width("path{stroke-width:var(--w, 4px)}") == "4px"
    assert width("svg{--w:3px} path{--w:5px;stroke-width: var( --w , 4px)}") == "5px"
    assert width("svg{--w:var(--v);--v:6} path{stroke-width:var(--w)}") == "6"
    assert width("path{stroke-width:var(--w, var(--v, 2))}") == "2"
    assert styled("svg{--c:10} path{stroke:rgb(var(--c), 0, 0)}")[0]["stroke"] == "rgb(10, 0, 0)"


def test_variables_that_are_missing_or_never_end_say_nothing():
    assert width("svg{stroke-width:2} path{stroke-width:var(--none)}") == "2"
    assert width("path{--w:var(--w);stroke-width:var(--w)}") is None
    bomb = "".join(f"--v{k}:var(--v{k - 1}) var(--v{k - 1}) var(--v{k - 1});" for k in range(1, 40))
    assert width(f"path{{--v0:3;{bomb}stroke-width:var(--v39)}}") is None


def test_the_style_attribute_is_read_with_comments_strings_and_escapes():
    assert width("", PATH.format('style="/* a:b; */ stroke-width : 3 ; ;fill:none"')) == "3"
    assert width("", PATH.format("style=\"-inkscape-font-specification:'Sans; Bold';stroke-width:3\"")) == "3"
    assert width("", PATH.format('style="STROKE-WIDTH:3"')) == "3"
    assert width("", PATH.format('style="stroke-width:3;{stroke-width:9}"')) == "3"


def test_an_import_is_not_fetched_but_told():
    assert styled("@import url('http://example.org/a.css');")[1] == ["A style sheet of another file was left out; lines may look other than drawn."]


@pytest.mark.parametrize(
    "rule, why",
    [
        ("path:fancy(3)", "its selector is not understood"),
        ("@supports (display: grid)", "at-rules of its kind are not read"),
        ("@layer ink", "at-rules of its kind are not read"),
        ("svg:has(path)", "selectors that look inside are not read"),
    ],
)
def test_rules_that_are_not_read_are_told(rule, why):
    inner = "path{stroke-width:2}" if rule[0] == "@" else "stroke-width:2"
    style, warnings = styled(f"{rule}{{{inner}}} .a{{stroke:red}}")
    assert style == {"stroke": "red"} and warnings == [f"The style rule '{rule}' was left out: {why}."]


def test_a_rule_inside_a_rule_is_told_and_the_outer_one_holds():
    style, warnings = styled(".a{stroke:red; .b{stroke:none}}")
    assert style == {"stroke": "red"} and warnings == ["The style rule '.b' was left out: rules inside rules are not read."]


def test_rules_that_say_nothing_of_strokes_are_not_told():
    assert styled("path:fancy(3){cursor:pointer} @font-face{src:url(x)} @keyframes a{from{stroke:none}} path::before{stroke:red}")[1] == []


def test_fonts_embedded_in_a_sheet_do_not_count():
    assert width("@font-face{src:url(data:font/woff2;base64," + "QUJD" * 500_000 + ")} path{stroke-width:3}") == "3"


def test_rules_without_end_for_the_same_elements_are_left_out_and_told():
    crowd = "<line/>" * 50_000 + PATH.format("")
    style, warnings = styled("path{stroke-width:1}" * 150 + ".a{fill:red}", crowd)
    assert style == {"stroke-width": "1", "fill": "red"}
    assert warnings == ["The style rule 'path' (and 49 more of them) was left out: more than 100 others are for the same elements."]


def test_rules_that_compare_too_many_elements_are_left_out_and_told():
    crowd = "<line/>" * 2001 + PATH.format("")
    style, warnings = styled("line ~ path{stroke-width:1} path:nth-of-type(1){stroke-width:2} [data-x~='1']{fill:red}", crowd)
    assert style == {"fill": "red"}
    assert warnings == ["The style rule 'line ~ path' (and 1 more of them) was left out: it compares too many elements with each other."]
    assert width("line ~ path{stroke-width:1}", "<line/>" + PATH.format("")) == "1"
