"""A photo file is read as it looks, or refused by name (`photo/read_photo`)."""

import struct
import zlib

import numpy as np
import pytest
from PIL import Image, ImageCms, TiffImagePlugin

from sketchtree.errors import SketchError
from sketchtree.photo.read_photo import as_photo, read_photo


@pytest.fixture
def scene():
    """Grass under a sky, 40 × 30, a red block in its top left corner."""
    rgb = np.zeros((30, 40, 3), np.uint8)
    rgb[:20], rgb[20:] = (110, 160, 230), (80, 140, 40)
    rgb[:8, :10] = (200, 30, 20)
    return rgb


def near(found, expected, within):
    return np.abs(found.astype(int) - expected.astype(int)).max() <= within


def test_a_colour_png_is_read_exactly(scene, tmp_path):
    Image.fromarray(scene).save(tmp_path / "p.png")
    photo = read_photo(tmp_path / "p.png")
    assert (photo.rgb == scene).all() and photo.alpha is None and photo.name == "p.png" and photo.warnings == ()
    assert (photo.width, photo.height) == (40, 30) and not photo.is_grey


@pytest.mark.parametrize("kind", ["jpg", "webp", "bmp", "tif", "gif"])
def test_every_kind_of_picture_shows_its_colours(kind, scene, tmp_path):
    Image.fromarray(scene).save(tmp_path / f"p.{kind}")
    assert near(read_photo(tmp_path / f"p.{kind}").rgb[14:18, 20:38], scene[14:18, 20:38], 12)


@pytest.mark.parametrize("orientation", range(1, 9))
def test_exif_orientation_is_obeyed(orientation, scene, tmp_path):
    back = {2: Image.FLIP_LEFT_RIGHT, 3: Image.ROTATE_180, 4: Image.FLIP_TOP_BOTTOM, 5: Image.TRANSPOSE, 6: Image.ROTATE_90, 7: Image.TRANSVERSE, 8: Image.ROTATE_270}
    image = Image.fromarray(scene)
    if orientation in back:
        image = image.transpose(back[orientation])
    exif = Image.Exif()
    exif[0x0112] = orientation
    image.save(tmp_path / "p.jpg", exif=exif, quality=95, subsampling=0)
    assert near(read_photo(tmp_path / "p.jpg").rgb[2:6, 2:8], scene[2:6, 2:8], 14)


def test_cmyk_shows_its_inks(scene, tmp_path):
    Image.fromarray(scene).convert("CMYK").save(tmp_path / "p.jpg", quality=95)
    assert near(read_photo(tmp_path / "p.jpg").rgb[14:18, 20:38], scene[14:18, 20:38], 14)


def test_sixteen_bit_grey_is_scaled_not_cut(tmp_path):
    tones = np.tile(np.linspace(0, 65535, 40).astype(np.uint16), (30, 1))
    Image.fromarray(tones).save(tmp_path / "p.png")
    photo = read_photo(tmp_path / "p.png")
    assert photo.is_grey and near(photo.rgb[..., 0], np.rint(tones / 257), 1)


def sixteen_bit_png(rgb):
    """A PNG with sixteen bits a channel, written out by hand: Pillow writes none."""
    rows = b"".join(b"\0" + row.astype(">u2").tobytes() for row in rgb.astype(np.uint16) * 257)
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))  # noqa: E731
    head = struct.pack(">IIBBBBB", rgb.shape[1], rgb.shape[0], 16, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def test_sixteen_bit_colour_keeps_its_colours(scene, tmp_path):
    (tmp_path / "p.png").write_bytes(sixteen_bit_png(scene))
    assert near(read_photo(tmp_path / "p.png").rgb, scene, 1)


def test_palette_pictures_show_their_colours(scene, tmp_path):
    Image.fromarray(scene).quantize(8).save(tmp_path / "p.png")
    assert near(read_photo(tmp_path / "p.png").rgb, scene, 2)


def test_alpha_is_kept_and_white_shows_through(scene, tmp_path):
    alpha = np.full((30, 40), 255, np.uint8)
    alpha[:, 20:] = 0
    Image.fromarray(np.dstack([scene, alpha])).save(tmp_path / "p.png")
    photo = read_photo(tmp_path / "p.png")
    assert (photo.alpha == alpha).all() and (photo.rgb[:, 20:] == 255).all() and (photo.rgb[:, :20] == scene[:, :20]).all()


def test_full_alpha_is_none(scene, tmp_path):
    Image.fromarray(np.dstack([scene, np.full((30, 40), 255, np.uint8)])).save(tmp_path / "p.png")
    assert read_photo(tmp_path / "p.png").alpha is None


def test_grey_with_alpha_stays_grey(tmp_path):
    tones = np.tile(np.arange(40, dtype=np.uint8) * 6, (30, 1))
    Image.merge("LA", [Image.fromarray(tones)] * 2).save(tmp_path / "p.png")
    photo = read_photo(tmp_path / "p.png")
    assert photo.is_grey and (photo.alpha == tones).all() and photo.rgb[0, 0, 0] == 255


def test_a_palette_picture_with_a_transparent_colour_has_alpha(scene, tmp_path):
    image = Image.fromarray(scene).quantize(4)
    image.save(tmp_path / "p.png", transparency=image.getpixel((2, 2)))
    photo = read_photo(tmp_path / "p.png")
    assert photo.alpha is not None and photo.alpha[2, 2] == 0 and photo.alpha[25, 25] == 255


def test_of_several_frames_the_first_is_read_and_said(scene, tmp_path):
    frames = [Image.fromarray(scene), Image.fromarray(255 - scene)]
    frames[0].save(tmp_path / "p.gif", save_all=True, append_images=frames[1:])
    photo = read_photo(tmp_path / "p.gif")
    assert near(photo.rgb, scene, 8) and photo.warnings == ("p.gif has 2 pages or frames; only the first was read.",)


def test_an_embedded_profile_is_turned_to_srgb(tmp_path):
    lab = ImageCms.createProfile("LAB")
    srgb = ImageCms.createProfile("sRGB")
    green = Image.new("RGB", (40, 30), (60, 150, 40))
    ImageCms.profileToProfile(green, srgb, lab, outputMode="LAB").save(tmp_path / "p.tif")
    assert near(read_photo(tmp_path / "p.tif").rgb, np.asarray(green), 4)
    green.save(tmp_path / "q.png", icc_profile=ImageCms.ImageCmsProfile(srgb).tobytes())
    assert near(read_photo(tmp_path / "q.png").rgb, np.asarray(green), 1)


def test_a_spoilt_profile_is_passed_by_and_said(scene, tmp_path):
    Image.fromarray(scene).save(tmp_path / "p.png", icc_profile=b"no profile at all")
    photo = read_photo(tmp_path / "p.png")
    assert (photo.rgb == scene).all() and photo.warnings == ("p.png: its colour profile can't be used; its colours were taken for sRGB.",)


def refused(path, **limits):
    with pytest.raises(SketchError) as error:
        read_photo(path, **limits)
    return str(error.value)


@pytest.mark.parametrize("size", [(1, 1), (1, 400), (15, 400)])
def test_a_picture_of_one_pixel_shows_no_tree(size, tmp_path):
    Image.new("RGB", size).save(tmp_path / "p.png")
    assert refused(tmp_path / "p.png") == f"p.png has {size[0]} × {size[1]} pixels, too few to show a tree. Give the picture in its full size."


def test_a_hundred_megapixels_are_refused_before_they_are_decoded(tmp_path):
    Image.new("1", (10_000, 10_000)).save(tmp_path / "p.png")
    assert refused(tmp_path / "p.png") == (
        "p.png has 10000 × 10000 pixels (100 megapixels); at most 64 megapixels are read. Scale the picture down, or raise the limit with --max-megapixels."
    )


def test_a_raised_limit_reads_a_larger_picture(tmp_path):
    Image.new("L", (300, 200), 90).save(tmp_path / "p.png")
    assert "at most 0.05 megapixels" in refused(tmp_path / "p.png", max_megapixels=0.05)
    assert read_photo(tmp_path / "p.png", max_megapixels=0.06).width == 300


def test_a_file_over_the_limit_of_bytes_is_refused(scene, tmp_path):
    Image.fromarray(scene).save(tmp_path / "p.bmp")
    assert "the limit is 0.001 MB" in refused(tmp_path / "p.bmp", max_mb=0.001)


@pytest.mark.parametrize("kind", ["png", "jpg", "webp", "tif", "gif"])
def test_a_truncated_file_is_damaged(kind, tmp_path):
    noise = np.random.default_rng(3).integers(0, 255, (120, 120, 3), np.uint8)
    Image.fromarray(noise).save(tmp_path / f"p.{kind}")
    whole = (tmp_path / f"p.{kind}").read_bytes()
    (tmp_path / f"p.{kind}").write_bytes(whole[: len(whole) // 2])
    assert refused(tmp_path / f"p.{kind}") == f"p.{kind} is damaged: its picture can't be decoded. Export the picture again as PNG or JPEG."


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"", "p.jpg is empty. Save the photo again."),
        (b"not a picture", "p.jpg is no picture that can be read. Export the picture again as PNG or JPEG."),
        (b"<svg xmlns='http://www.w3.org/2000/svg'/>", "p.jpg is no picture that can be read. Export the picture again as PNG or JPEG."),
        (b"\0\0\0\x18ftypheic", "p.jpg is a HEIC or AVIF picture, which can't be read. Export the picture again as PNG or JPEG."),
        (b"%PDF-1.7", "p.jpg is a PDF, which can't be read. Export the picture again as PNG or JPEG."),
    ],
)
def test_what_is_no_picture_is_said(data, says, tmp_path):
    (tmp_path / "p.jpg").write_bytes(data)
    assert refused(tmp_path / "p.jpg") == says


def test_a_missing_file_and_a_folder_are_said(tmp_path):
    assert refused(tmp_path / "none.png").startswith("There is no file ")
    assert "is a folder" in refused(tmp_path)


def test_a_transparent_picture_is_refused(tmp_path):
    Image.new("RGBA", (40, 40), (9, 9, 9, 0)).save(tmp_path / "p.png")
    assert refused(tmp_path / "p.png") == "p.png is transparent everywhere. Export the picture again as PNG or JPEG."


def test_pixels_in_memory_are_a_photo(scene):
    assert (as_photo(scene).rgb == scene).all()
    assert as_photo(scene[..., 0]).is_grey


@pytest.mark.parametrize(("name", "dng"), [("p.nef", False), ("p.dng", True), ("p.tif", True)])
def test_a_raw_file_is_refused_instead_of_its_thumbnail(scene, tmp_path, name, dng):
    tags = TiffImagePlugin.ImageFileDirectory_v2()
    if dng:
        tags[50706], tags.tagtype[50706] = b"\x01\x04\x00\x00", 1
    Image.fromarray(scene).save(tmp_path / name, "TIFF", tiffinfo=tags)
    with pytest.raises(SketchError, match="is a camera's raw file"):
        read_photo(tmp_path / name)


def test_a_folder_is_no_photo(tmp_path):
    with pytest.raises(SketchError, match="is a folder, not a photo"):
        read_photo(tmp_path)


def test_pixels_in_memory_are_two_by_two_at_least():
    with pytest.raises(SketchError, match="photo has 1 × 5 pixels; 2 × 2 are the least. Give a larger photo."):
        as_photo(np.zeros((5, 1, 3), np.uint8))
