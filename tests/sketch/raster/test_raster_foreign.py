"""Pictures that are no drawing, damaged files and files without measure: one clear sentence and a way out."""

import struct
import time
import tracemalloc
import zlib

import numpy as np
import pytest
import sheets
from PIL import Image
from scipy.ndimage import gaussian_filter

from sketchtree.commands.app import run
from sketchtree.errors import SketchError
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.raster.reader import read_raster

RNG = np.random.default_rng(5)
GREY = sheets.image_of(sheets.cover(), paper=0.95, tone=0.1)


def grey(tones) -> Image.Image:
    return Image.fromarray(np.clip(np.round(tones), 0, 255).astype(np.uint8))


def photo() -> Image.Image:
    """Tones everywhere, soft and hard edges, the noise of a sensor."""
    y, x = np.mgrid[:400, :500] / 400
    sky = 200 - 60 * y
    hills = np.where(y > 0.6 + 0.1 * np.sin(5 * x), 90 + 40 * np.sin(20 * x) * np.cos(13 * y), sky)
    leaves = gaussian_filter(RNG.normal(size=(400, 500)), 2.5) * 160
    tree = np.hypot(x - 0.6, y - 0.45) < 0.3
    return grey(np.where(tree, 90 + leaves, hills) + 5 * RNG.normal(size=(400, 500)))


def text() -> Image.Image:
    page = np.full((500, 400), 255.0)
    for row in range(30, 470, 16):
        for col in range(30, 370, 9):
            left = col + RNG.integers(0, 3)
            page[row : row + 9, left : left + 2] = 0
            page[row + RNG.integers(0, 8), left : left + 6] = 0
    return grey(page)


def dusty() -> Image.Image:
    page = np.full((300, 300), 255.0)
    for y, x in np.random.default_rng(1).integers(5, 295, (40, 2)):
        page[y : y + 2, x : x + 2] = 0
    return grey(page)


NO_DRAWING = {
    "a photograph": (photo, "looks like a photograph"),
    "a blank page": (lambda: Image.new("L", (400, 300), 255), "the page is blank"),
    "a blank page of grey paper with grain": (lambda: grey(180 + 5 * RNG.normal(size=(300, 400))), "the page is blank"),
    "a black page": (lambda: Image.new("L", (400, 300), 0), "dark all over"),
    "a black page with a white frame": (lambda: grey(np.pad(np.zeros((280, 380)), 10, constant_values=255)), "dark all over"),
    "noise": (lambda: grey(RNG.integers(0, 256, (300, 400))), "photograph"),
    "noise of one colour each": (lambda: Image.fromarray(RNG.integers(0, 256, (300, 400, 3)).astype(np.uint8)), "photograph"),
    "one pixel": (lambda: Image.new("L", (1, 1), 0), "1 × 1"),
    "a line of pixels": (lambda: Image.new("L", (3000, 2), 255), "3000 × 2"),
    "a strip": (lambda: Image.new("L", (3000, 10), 255), "the page is blank"),
    "nothing but alpha": (lambda: Image.new("RGBA", (200, 200), (0, 0, 0, 0)), "the page is blank"),
    "specks": (dusty, "specks"),
    "a page of text": (text, "short marks and no long line"),
}


@pytest.mark.parametrize("what", NO_DRAWING)
def test_what_is_no_drawing_is_refused_with_a_reason_and_a_remedy(what):
    make, reason = NO_DRAWING[what]
    with pytest.raises(SketchError, match="sheet.png") as caught:
        sheets.read(make())
    assert reason in str(caught.value) and caught.value.remedy


def test_a_very_long_strip_with_a_line_is_read():
    line = np.array([(20.0, 5.0), (2980.0, 5.0)])
    sketch = sheets.read(sheets.cover([line], 2.0, (3000, 10)))
    assert len(sketch) == 1 and sheets.apart(sketch, [line]) < 2


def chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png_bomb(width: int, height: int) -> bytes:
    """A white PNG of one bit a pixel: some kB of file for any number of pixels."""
    packer = zlib.compressobj(9)
    row = b"\0" + b"\xff" * ((width + 7) // 8)
    rows = b"".join(packer.compress(row * 500) for _ in range(height // 500)) + packer.flush()
    head = struct.pack(">IIBBBBB", width, height, 1, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", rows) + chunk(b"IEND", b"")


def tiff_header(width: int, height: int) -> bytes:
    """A TIFF that claims a size and holds nothing."""
    tags = [(256, 4, 1, width), (257, 4, 1, height), (258, 3, 1, 8), (259, 3, 1, 1), (262, 3, 1, 1), (273, 4, 1, 8), (277, 3, 1, 1), (278, 4, 1, height), (279, 4, 1, 2**31 - 1)]
    return b"II*\0" + struct.pack("<IH", 8, len(tags)) + b"".join(struct.pack("<HHII", *tag) for tag in tags) + struct.pack("<I", 0)


def bmp_header(width: int, height: int) -> bytes:
    return b"BM" + struct.pack("<IHHI", 100, 0, 0, 54) + struct.pack("<IiiHHIIiiII", 40, width, height, 1, 24, 0, 0, 0, 0, 0, 0) + bytes(46)


TOO_LARGE = {
    "PNG of 500 megapixels": lambda: png_bomb(25_000, 20_000),
    "TIFF that claims 10⁹ pixels": lambda: tiff_header(40_000, 25_000),
    "TIFF that claims 10¹⁸ pixels": lambda: tiff_header(2**31 - 1, 2**31 - 1),
    "BMP that claims 10⁹ pixels": lambda: bmp_header(40_000, 25_000),
}


@pytest.mark.parametrize("what", TOO_LARGE)
def test_a_picture_beyond_the_limit_is_refused_before_it_is_decoded(what):
    data = TOO_LARGE[what]()
    assert len(data) < 2e6
    tracemalloc.start()
    began = time.perf_counter()
    with pytest.raises(SketchError, match=r"at most 200 megapixels are read") as caught:
        read_raster(data, "huge.png")
    assert time.perf_counter() - began < 1.0 and tracemalloc.get_traced_memory()[1] < 20e6
    tracemalloc.stop()
    assert "--max-megapixels" in caught.value.remedy


def test_the_limit_can_be_lifted_and_lowered():
    with pytest.raises(SketchError, match=r"300 × 360 pixels \(0\.108 megapixels\); at most 0\.1 megapixels"):
        sheets.read(GREY, max_megapixels=0.1)
    assert len(sheets.read(GREY, max_megapixels=0.108)) == 4


def test_a_limit_lifted_on_the_command_line_lets_a_large_picture_through(tmp_path, capfd):
    (tmp_path / "huge.png").write_bytes(png_bomb(5_000, 4_000))
    command = ["inspect", str(tmp_path / "huge.png"), "-o", str(tmp_path / "o.png"), "--quiet"]
    assert run([*command, "--max-megapixels", "10"]) == 2
    assert "20 megapixels" in capfd.readouterr().err
    assert run([*command, "--max-megapixels", "20"]) == 2
    assert "the page is blank" in capfd.readouterr().err


KINDS = {"PNG": {}, "JPEG": {}, "WEBP": {}, "TIFF": {"compression": "tiff_lzw"}, "GIF": {}, "BMP": {}}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("part", [0.02, 0.1, 0.5, 0.9])
def test_a_truncated_file_is_named_as_damaged(kind, part):
    data = sheets.file_of(GREY, kind, **KINDS[kind])
    with pytest.raises(SketchError, match=r"sheet\.png (is damaged|is no picture)") as caught:
        read_raster(data[: max(16, int(part * len(data)))], "sheet.png")
    assert caught.value.remedy


@pytest.mark.parametrize("kind", KINDS)
def test_flipped_bytes_end_in_a_sketch_or_an_error_that_names_the_file(kind):
    data = sheets.file_of(GREY.resize((60, 72)), kind, **KINDS[kind])
    rng = np.random.default_rng(8)
    for _ in range(60):
        broken = bytearray(data)
        for at in rng.integers(0, len(broken), 3):
            broken[at] = rng.integers(0, 256)
        try:
            read_raster(bytes(broken), "sheet.png", max_megapixels=2)
        except SketchError as error:
            assert "sheet.png" in str(error) and error.remedy


@pytest.mark.parametrize(("name", "kind"), [("drawing.jpg", "PNG"), ("drawing.png", "JPEG"), ("drawing.svg", "PNG"), ("drawing", "TIFF")])
def test_a_wrong_extension_is_remarked_on_and_the_picture_read(tmp_path, name, kind):
    (tmp_path / name).write_bytes(sheets.file_of(GREY, kind))
    sketch = read_sketch(tmp_path / name)
    assert len(sketch) == 4
    assert any("is named like" in warning for warning in sketch.warnings) == ("." in name)


BROKEN = {
    "empty.png": b"",
    "text.png": b"Dear all, please find the tree attached.",
    "head.png": b"\x89PNG\r\n\x1a\n",
    "head.jpg": b"\xff\xd8\xff\xe0\0\x10JFIF",
    "cut.png": sheets.file_of(GREY)[:900],
    "cut.jpg": sheets.file_of(GREY, "JPEG")[:2000],
    "huge.tif": tiff_header(2**31 - 1, 2**31 - 1),
    "huge.png": png_bomb(25_000, 20_000),
    "blank.png": sheets.file_of(Image.new("L", (50, 50), 255)),
    "dot.png": sheets.file_of(Image.new("L", (1, 1), 0)),
}


@pytest.mark.parametrize("name", BROKEN)
def test_on_the_command_line_one_paragraph_and_status_2(tmp_path, name, capfd):
    (tmp_path / name).write_bytes(BROKEN[name])
    assert run(["inspect", str(tmp_path / name), "-o", str(tmp_path / "o.png"), "--quiet"]) == 2
    said = capfd.readouterr().err.strip()
    assert name in said and "\n\n" not in said and "Traceback" not in said
    assert not (tmp_path / "o.png").exists()


def test_more_lines_than_the_limit_are_refused_and_the_option_named():
    with pytest.raises(SketchError, match="holds 4 lines; at most 3 are read") as caught:
        sheets.read(GREY, max_strokes=3)
    assert "--max-strokes" in caught.value.remedy


def test_progress_is_told_and_only_grows():
    told = []
    sheets.read(GREY, progress=told.append)
    assert told == sorted(told) and told[-1] == 1.0 and len(told) > 2
