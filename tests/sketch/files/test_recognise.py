import io
import zipfile

import numpy as np
import pytest
from PIL import Image

from sketchtree.errors import SketchError
from sketchtree.sketch.files.recognise import EXCALIDRAW, INKML, QUICKDRAW, SKETCH, SVG, Unreadable, recognise
from sketchtree.sketch.formats import READABLE, read_sketch

TEXTS = {
    '<svg xmlns="http://www.w3.org/2000/svg"/>': SVG,
    '<?xml version="1.0"?><!-- <ink> --><!DOCTYPE svg [<!ENTITY a "<ink>">]>\n<svg/>': SVG,
    '<!DOCTYPE ink SYSTEM "a.dtd"><!-- <svg> --><?a <svg> ?><ink/>': INKML,
    "<!-- <ink>": SVG,
    "<s:svg/>": SVG,
    "<html/>": SVG,
    '<?xml version="1.0"?>\r\n<ink/>': INKML,
    '<i:ink xmlns:i="x">': INKML,
    '{"sketchtree": 1}': SKETCH,
    "[1]": SKETCH,
    ' {"type": "excalidraw/clipboard"}': EXCALIDRAW,
    '{"libraryItems": []}': EXCALIDRAW,
    '{"word": "tree", "drawing": []}': QUICKDRAW,
}
ENCODINGS = ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be"]


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("text", TEXTS)
def test_text_is_recognised_in_any_unicode_encoding(text, encoding):
    assert recognise(text.encode(encoding)) == TEXTS[text]


OTHERS = {
    b"%PDF-1.7": "a PDF",
    b"%!PS-Adobe-3.0 EPSF": "a PostScript",
    b"\xc5\xd0\xd3\xc6\x20": "a PostScript",
    b"8BPS\0\1": "a Photoshop file",
    b"gimp xcf v011": "a GIMP file",
    b"\x89HDF\r\n\x1a\n\0": "a SketchTree project",
    b"glTF\2\0": "a finished 3D model",
    b"RIFF\0\0\0\0AVI ": "a video or sound",
    b"\0\0\0\x18ftypheic\0": "a HEIC or AVIF picture",
    b"\0\0\0\x18ftypavif\0": "a HEIC or AVIF picture",
    b"\0\0\0\x18ftypmp42\0": "a video",
    b"\x1a\x45\xdf\xa3\x01": "a video",
    b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1": "an Office document",
    b"PK\x03\x04 damaged": "a packed archive",
    b'{"tldrawFileFormatVersion": 1}': "a tldraw drawing",
    b"---\n\nexcalidraw-plugin: parsed\n": "an Excalidraw note",
}


@pytest.mark.parametrize("data", OTHERS, ids=OTHERS.values())
def test_a_format_that_is_not_read_is_named_with_the_way_out(data, tmp_path):
    (tmp_path / "t.svg").write_bytes(data)
    with pytest.raises(SketchError, match=f"t.svg is {OTHERS[data]}.*, which can't be read. [A-Z].*\\.$"):
        read_sketch(tmp_path / "t.svg")


@pytest.mark.parametrize(
    ("inside", "body", "what"),
    [
        ("mimetype", "application/x-krita", "a Krita file"),
        ("mimetype", "image/openraster", "an OpenRaster file"),
        ("mimetype", "application/vnd.oasis.opendocument.graphics", "an OpenDocument file"),
        ("Document.archive", "", "a Procreate file"),
        ("[Content_Types].xml", "", "an Office document"),
        ("drawing/tree.svg", "", "a packed archive (zip)"),
    ],
)
def test_a_packed_document_is_named_by_what_is_in_it(inside, body, what):
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr(inside, body)
    found = recognise(packed.getvalue())
    assert isinstance(found, Unreadable) and found.what == what and found.remedy


@pytest.mark.parametrize("kind", ["PNG", "JPEG", "WebP", "TIFF", "GIF", "BMP"])
def test_pictures_are_recognised(kind):
    file = io.BytesIO()
    Image.fromarray(np.zeros((4, 4), np.uint8)).save(file, kind)
    assert recognise(file.getvalue()) == f"{kind} picture"


def test_every_kind_has_an_extension():
    assert {SVG, INKML, SKETCH, EXCALIDRAW, QUICKDRAW} < set(READABLE.values()) and len(set(READABLE.values())) == 11


def test_what_is_nothing_known_is_none():
    for data in (b"a tree, please", bytes(range(128, 256)), b"\0", b""):
        assert recognise(data) is None
