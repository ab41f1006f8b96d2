"""Every kind of picture file that shows the same drawing gives the same strokes."""

import io

import numpy as np
import pytest
import sheets
from PIL import Image

from sketchtree.sketch.strokes import StrokeKind

INK = sheets.cover()
GREY = sheets.image_of(INK, paper=0.95, tone=0.1)


def sixteen_bits() -> Image.Image:
    return Image.fromarray((np.asarray(GREY).astype(np.uint16) * 200 + 3000))


def on_alpha(mode: str, tone: int) -> Image.Image:
    """The ink alone, on nothing."""
    alpha = np.round(255 * INK).astype(np.uint8)
    return Image.fromarray(np.stack([np.full_like(alpha, tone), alpha], 2), "LA").convert(mode)


def palette() -> Image.Image:
    return GREY.convert("P", palette=Image.Palette.ADAPTIVE, colors=16)


def palette_with_hole() -> Image.Image:
    """Index 0 is see-through, and black where it is looked at all the same."""
    image = Image.fromarray((INK > 0.5).astype(np.uint8), "P")
    image.putpalette([0, 0, 0, 20, 20, 20])
    image.info["transparency"] = 0
    return image


def bilevel() -> Image.Image:
    return GREY.point(lambda tone: 255 * (tone > 128)).convert("1")


FILES = {
    "grey PNG": lambda: sheets.file_of(GREY),
    "colour PNG": lambda: sheets.file_of(GREY.convert("RGB")),
    "PNG with full alpha": lambda: sheets.file_of(GREY.convert("RGBA")),
    "black ink on nothing, LA": lambda: sheets.file_of(on_alpha("LA", 0)),
    "black ink on nothing, RGBA": lambda: sheets.file_of(on_alpha("RGBA", 10)),
    "white ink on nothing": lambda: sheets.file_of(on_alpha("RGBA", 255)),
    "palette PNG": lambda: sheets.file_of(palette()),
    "palette PNG with a hole": lambda: sheets.file_of(palette_with_hole(), transparency=0),
    "PNG of 1 bit": lambda: sheets.file_of(bilevel()),
    "PNG of 16 bits": lambda: sheets.file_of(sixteen_bits()),
    "JPEG": lambda: sheets.file_of(GREY, "JPEG", quality=85),
    "JPEG in CMYK": lambda: sheets.file_of(GREY.convert("CMYK"), "JPEG", quality=90),
    "WebP": lambda: sheets.file_of(GREY.convert("RGB"), "WEBP", quality=85),
    "WebP, lossless, on nothing": lambda: sheets.file_of(on_alpha("RGBA", 0), "WEBP", lossless=True),
    "TIFF of 1 bit": lambda: sheets.file_of(bilevel(), "TIFF", compression="group4"),
    "TIFF of 16 bits": lambda: sheets.file_of(sixteen_bits(), "TIFF"),
    "TIFF of 32-bit numbers": lambda: sheets.file_of(Image.fromarray(np.asarray(GREY, np.float32) / 255), "TIFF"),
    "TIFF in LZW": lambda: sheets.file_of(GREY, "TIFF", compression="tiff_lzw"),
    "TIFF in Lab": lambda: sheets.file_of(Image.merge("LAB", [GREY, *[Image.new("L", GREY.size, 128)] * 2]), "TIFF"),
    "GIF": lambda: sheets.file_of(palette(), "GIF"),
    "BMP": lambda: sheets.file_of(GREY, "BMP"),
    "BMP of 1 bit": lambda: sheets.file_of(bilevel(), "BMP"),
}


@pytest.mark.parametrize("kind", FILES)
def test_every_kind_of_file_gives_the_same_strokes(kind):
    sketch = sheets.read(FILES[kind]())
    assert len(sketch) == len(sheets.TREE) and sheets.apart(sketch) < 2.0
    assert [stroke.width for stroke in sketch.strokes] == pytest.approx([4.0] * 4, abs=0.5)
    assert sketch.page == (0.0, -360.0, 300.0, 0.0) and sketch.units == "px" and not sketch.warnings


@pytest.mark.parametrize("orientation", range(1, 9))
def test_a_phones_orientation_is_obeyed(orientation):
    undo = {2: "FLIP_LEFT_RIGHT", 3: "ROTATE_180", 4: "FLIP_TOP_BOTTOM", 5: "TRANSPOSE", 6: "ROTATE_90", 7: "TRANSVERSE", 8: "ROTATE_270"}
    stored = GREY if orientation == 1 else GREY.transpose(Image.Transpose[undo[orientation]])
    exif = Image.Exif()
    exif[0x0112] = orientation
    sketch = sheets.read(sheets.file_of(stored, "JPEG", exif=exif, quality=90))
    assert sketch.page == (0.0, -360.0, 300.0, 0.0) and sheets.apart(sketch) < 2.0


@pytest.mark.parametrize("kind", ["TIFF", "GIF", "WEBP", "PNG"])
def test_of_several_pages_the_first_is_read_and_a_warning_says_so(kind):
    others = [sheets.image_of(sheets.cover([[(x, 20), (280, 340)]])) for x in (20, 60)]
    pages = [image.convert("RGB") if kind == "WEBP" else image for image in (GREY, *others)]
    data = sheets.file_of(pages[0], kind, save_all=True, append_images=pages[1:])
    sketch = sheets.read(data)
    assert sheets.apart(sketch) < 2.0
    assert sketch.warnings == ("sheet.png has 3 pages or frames; only the first was read.",)


def test_a_pictures_resolution_does_not_move_its_points():
    assert sheets.apart(sheets.read(sheets.file_of(GREY, dpi=(300, 300)))) < 2.0


def test_colour_profiles_and_odd_metadata_are_no_hindrance():
    out = io.BytesIO()
    exif = Image.Exif()
    exif[0x0112] = 77  # no such orientation
    GREY.convert("RGB").save(out, "JPEG", exif=exif, icc_profile=b"no profile", comment=b"\xff\x00")
    assert sheets.apart(sheets.read(out.getvalue())) < 2.0


def test_every_stroke_is_a_branch_with_an_id_of_its_own_the_longest_first():
    sketch = sheets.read(INK)
    assert [stroke.id for stroke in sketch.strokes] == ["trace-1", "trace-2", "trace-3", "trace-4"]
    assert {stroke.kind for stroke in sketch.strokes} == {StrokeKind.BRANCH}
    length = [np.hypot(*np.diff(stroke.points, axis=0).T).sum() for stroke in sketch.strokes]
    assert length == sorted(length, reverse=True)
