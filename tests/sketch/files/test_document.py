import gzip

import pytest

from sketchtree.errors import SketchError
from sketchtree.sketch.files.document import DEEPEST, LARGEST_GROWTH, decoded, local_name, parse_xml

SVG = "http://www.w3.org/2000/svg"
HEAD = '<svg xmlns="http://www.w3.org/2000/svg">'


def parsed(text):
    return parse_xml(text.encode(), "t.svg")


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "latin-1", "cp1252", "shift_jis", "koi8-r"])
def test_a_file_is_read_in_the_encoding_it_says(encoding):
    letter = {"shift_jis": "木", "koi8-r": "д"}.get(encoding, "é")
    text = f'<?xml version="1.0" encoding="{encoding}"?>\r\n{HEAD}\r\n<g id="{letter}"/></svg>'
    assert parse_xml(text.encode(encoding), "t.svg")[0].get("id") == letter


def test_a_wrong_or_missing_declaration_costs_letters_but_no_drawing():
    assert parse_xml(f'{HEAD}<g id="é"/></svg>'.encode("latin-1"), "t.svg")[0].get("id") == "é"
    assert parse_xml(f'<?xml version="1.0" encoding="utf-8"?>{HEAD}<g id="é"/></svg>'.encode("latin-1"), "t.svg")[0].get("id") == "\ufffd"
    assert parse_xml(f'<?xml version="1.0" encoding="UTF-16"?>{HEAD}<g/></svg>'.encode(), "t.svg")[0].tag.endswith("g")


@pytest.mark.parametrize("encoding", ["klingon", "punycode", "rot13", "zlib_codec", "unicode_escape"])
def test_an_encoding_that_is_none_is_named(encoding):
    with pytest.raises(SketchError, match=f"t.svg says that its text is in '{encoding}', which is no known encoding. Save it as UTF-8."):
        decoded(f'<?xml version="1.0" encoding="{encoding}"?><svg/>'.encode(), "t.svg")


def test_marks_spaces_and_padding_around_the_document_do_not_matter():
    assert parsed(f'\ufeff\n  <?xml version="1.0"?>{HEAD}</svg>\n\0\0').tag == f"{{{SVG}}}svg"
    assert parse_xml(gzip.compress(f"{HEAD}</svg>".encode()), "t.svgz").tag == f"{{{SVG}}}svg"


@pytest.mark.parametrize(
    "text, cause",
    [
        (HEAD + "\n<g>\n<path", "unclosed token in line 3"),
        (HEAD + "\n\n<g>", "no element found in line 3"),
        (HEAD + "</g>", "mismatched tag in line 1"),
        (HEAD + '<g id="a" id="a"/></svg>', "duplicate attribute in line 1"),
        (HEAD + "&nbsp;</svg>", "undefined entity in line 1"),
        (HEAD + "</svg><svg/>", "junk after document element in line 1"),
        (HEAD + "\x08</svg>", r"not well-formed \(invalid token\) in line 1"),
    ],
)
def test_a_damaged_file_is_named_with_its_line(text, cause):
    with pytest.raises(SketchError, match=rf"t.svg is not well-formed XML \({cause}\); it may be cut short. Export the drawing again"):
        parsed(text)


def test_an_empty_file_is_named():
    with pytest.raises(SketchError, match="t.svg is empty. Save the drawing again."):
        parse_xml(b"\xef\xbb\xbf \n", "t.svg")


def test_prefixes_are_namespaces_even_where_nobody_declared_them():
    root = parsed('<svg><g inkscape:label="a" xlink:href="#b" sodipodi:type="c" v:d="e"/></svg>')
    assert root[0].attrib == {
        "{http://www.inkscape.org/namespaces/inkscape}label": "a",
        "{http://www.w3.org/1999/xlink}href": "#b",
        "{sodipodi}type": "c",
        "{v}d": "e",
    }


def test_prefixes_hold_within_the_element_that_declares_them():
    root = parsed(f'<a:svg xmlns:a="{SVG}"><g xmlns:a="urn:x"><a:g/></g><a:g/></a:svg>')
    assert [local_name(element.tag) for element in root.iter()] == ["svg", "g", "", "g"]


def test_small_entities_are_put_in():
    text = '<!DOCTYPE svg [<!ENTITY ns "http://www.w3.org/2000/svg"><!ENTITY a "cr"><!ENTITY b "&a;own">]><svg xmlns="&ns;"><g id="&b;">&a;</g></svg>'
    root = parsed(text)
    assert root.tag == f"{{{SVG}}}svg" and root[0].get("id") == "crown" and root[0].text == "cr"


BOMBS = {
    "would swell": "".join(f'<!ENTITY e{k} "{f"&e{k - 1};" * 10}">' for k in range(1, 12)) + '<!ENTITY e0 "ha">',
    "would swell the document": f'<!ENTITY e11 "{"x" * (LARGEST_GROWTH // 2 + 1)}">',
    "refer to themselves": '<!ENTITY e11 "&a;"><!ENTITY a "&b;"><!ENTITY b "&a;">',
    "are more than 500": "".join(f'<!ENTITY e{k} "&e{k - 1};">' for k in range(1, 99_999)) + '<!ENTITY e0 "ha">',
}


@pytest.mark.parametrize("message", BOMBS)
def test_entity_bombs_are_refused_before_they_swell(message):
    with pytest.raises(SketchError, match=f"declares XML entities that {message}.*plain SVG, without a DOCTYPE"):
        parsed(f"<!DOCTYPE svg [{BOMBS[message]}]>{HEAD}<text>&e11;&e11;</text></svg>")


def test_many_references_to_one_entity_are_refused_too():
    with pytest.raises(SketchError, match="would swell the document"):
        parsed(f'<!DOCTYPE svg [<!ENTITY a "{"x" * 2000}">]>{HEAD}<g id="{"&a;" * 600}"/></svg>')


@pytest.mark.parametrize(
    "entity, message",
    [
        ('<!ENTITY a SYSTEM "file:///etc/hostname">', r"an entity of another file \(a\)"),
        ('<!ENTITY a PUBLIC "x" "http://example.org/a">', r"an entity of another file \(a\)"),
        ('<!ENTITY % p SYSTEM "http://example.org/x.dtd"> %p;', r"a parameter entity \(p\)"),
        ("<!ENTITY % p \"<!ENTITY a 'b'>\"> %p;", r"a parameter entity \(p\)"),
    ],
)
def test_entities_that_could_fetch_are_refused(entity, message):
    with pytest.raises(SketchError, match=f"t.svg declares {message}, which could fetch files"):
        parsed(f"<!DOCTYPE svg [{entity}]>{HEAD}<text>x</text></svg>")


def test_defaults_of_attribute_lists_do_not_multiply():
    text = f'<!DOCTYPE svg [<!ATTLIST g id CDATA "{"x" * 1000}">]>{HEAD}{"<g/>" * 10}</svg>'
    assert [g.attrib for g in parsed(text)] == [{}] * 10


def test_an_external_document_type_is_not_fetched():
    doctype = '<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">'
    assert len(parsed(f"{doctype}{HEAD}<g/></svg>")) == 1


def test_elements_nested_without_end_are_refused():
    with pytest.raises(SketchError, match=f"nests its groups more than {DEEPEST} deep"):
        parsed("<svg>" + "<g>" * 100_000)


def test_a_gzip_bomb_is_stopped_at_the_limit():
    with pytest.raises(SketchError, match=r"t.svgz unpacks to more than 0.5 MB; the limit is 0.5 MB.*--max-mb"):
        parse_xml(gzip.compress(b" " * 10**6), "t.svgz", max_mb=0.5)
