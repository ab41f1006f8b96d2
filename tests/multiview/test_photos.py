"""Photos become views: undistorted, of the wanted size, what an alpha channel masks unseen."""

import numpy as np
import pytest
from PIL import Image, ImageFilter
from ring import camera_at, rendered

from sketchtree.errors import ViewsError
from sketchtree.multiview.lenses import Lens
from sketchtree.multiview.photos import blurred, photo_files, views_of

CAMERA = camera_at(0.0, size=(60, 40))


def saved(path, rgb, **options):
    Image.fromarray(np.round(255 * rgb).astype(np.uint8)).save(path, **options)
    return path


def test_photos_lie_in_the_folder_or_in_its_images(tmp_path):
    (tmp_path / "images").mkdir()
    for name in ("b.JPG", "a.png", ".hidden.png", "notes.txt"):
        (tmp_path / "images" / name).write_bytes(b"")
    assert [file.name for file in photo_files(tmp_path)] == ["a.png", "b.JPG"]


@pytest.mark.parametrize(("count", "named"), [(0, "no photos"), (1, "one photo")])
def test_too_few_are_named(tmp_path, count, named):
    (tmp_path / "images").mkdir()
    for k in range(count):
        (tmp_path / "images" / f"{k}.png").write_bytes(b"")
    with pytest.raises(ViewsError) as error:
        photo_files(tmp_path)
    assert str(error.value) == f"{tmp_path} has {named}. Give a folder of photos of one plant from many sides (.jpg .jpeg .png .tif .tiff .webp .bmp), 20 or more."


def test_a_view_is_no_larger_than_wanted_and_shows_the_same(tmp_path):
    file = saved(tmp_path / "a.png", rendered(CAMERA)[0])
    (view,) = views_of(iter([(file, CAMERA, Lens())]), 30)
    assert view.camera.size == (30, 20) and view.rgb.shape == (20, 30, 3) and view.rgb.dtype == np.float32
    np.testing.assert_allclose(view.camera.project(np.array([[0.0, 0.5, 0.0]]))[0], [[15, 10]])
    assert view.seen.all() and view.grey.shape == (20, 30)


def test_what_is_transparent_is_unseen(tmp_path):
    rgba = np.dstack([rendered(CAMERA)[0], np.ones((40, 60))])
    rgba[:10, :, 3] = 0
    (view,) = views_of(iter([(saved(tmp_path / "a.png", rgba), CAMERA, Lens())]), 60)
    assert not view.seen[:10].any() and view.seen[10:].all()


def test_a_photo_on_its_side_is_turned_as_its_exif_says(tmp_path):
    exif = Image.Exif()
    exif[0x0112] = 6  # to be turned to the right
    upright = rendered(CAMERA)[0]
    file = saved(tmp_path / "a.png", np.rot90(upright, 1), exif=exif)
    (view,) = views_of(iter([(file, CAMERA, Lens())]), 60)
    np.testing.assert_allclose(view.rgb, upright, atol=1 / 255)


def test_a_photo_of_another_shape_than_its_camera_is_named(tmp_path):
    file = saved(tmp_path / "a.png", np.zeros((50, 50, 3)))
    with pytest.raises(ViewsError) as error:
        list(views_of(iter([(file, CAMERA, Lens())]), 60))
    assert str(error.value) == "Photo a.png: it has 50 × 50 pixels, its camera 60 × 40. Give the photo that the pose is of, not cropped or turned."
    assert error.value.photo == "a.png"


def test_a_file_that_is_no_photo_is_named(tmp_path):
    (tmp_path / "a.png").write_bytes(b"no")
    with pytest.raises(ViewsError, match=r"^Photo a.png: it can't be read \(.*\). Save it again as JPEG or PNG, or take it out of the folder.$"):
        list(views_of(iter([(tmp_path / "a.png", CAMERA, Lens())]), 60))


def test_blurred_photos_are_told(tmp_path):
    files = [saved(tmp_path / f"{k}.png", rendered(camera_at(9.0 * k, size=(80, 80)))[0]) for k in range(4)]
    Image.open(files[2]).filter(ImageFilter.GaussianBlur(4)).save(files[2])
    assert blurred(files) == ["2.png"]


def test_black_bars_are_unseen(tmp_path):
    rgb = 0.1 + 0.9 * rendered(CAMERA)[0]
    rgb[:, :7] = 0.01
    (view,) = views_of(iter([(saved(tmp_path / "a.png", rgb), CAMERA, Lens())]), 60)
    assert not view.seen[:, :8].any() and view.seen[:, 8:].all()
