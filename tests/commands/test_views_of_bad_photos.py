"""What `sketchtree views` says of photos that are few, of something else, blurred, of several sizes, or that tell no focal length."""

import json
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageFilter

sys.path.insert(0, str(Path(__file__).parents[1] / "multiview"))
from ring import camera_at, painted_room, rendered

from sketchtree.commands.app import run
from sketchtree.multiview import depths
from sketchtree.multiview.sfm import ADVICE

SMALL = depths.Quality(longest=110, sources=4, shrinks=(2, 1), rounds=(3, 1))
CAMERAS = [camera_at(12.0 * k, size=(300, 300), height=0.5 + 0.15 * (k % 2)) for k in range(7)]


def in_a_room(camera):
    """The trunk and its limb in a painted cave."""
    rgb, depth = rendered(camera)
    return np.where((depth > 0)[..., None], rgb, painted_room(camera, ball=False))


def saved(path, rgb, changed=lambda photo: photo):
    path.parent.mkdir(exist_ok=True)
    changed(Image.fromarray(np.round(255 * np.asarray(rgb)).astype(np.uint8))).save(path)


def larger(photo):
    return photo.resize((420, 420), Image.Resampling.BICUBIC)


def blurred(photo):
    return photo.filter(ImageFilter.GaussianBlur(2))


def noise(size=300):
    return np.array(Image.fromarray(np.uint8(255 * np.random.default_rng(size).uniform(size=(size // 8, size // 8, 3)))).resize((size, size))) / 255.0


@pytest.fixture(scope="module")
def told(tmp_path_factory):
    """The report of photos of which the second is larger, the third blurred, and one is of something else; none has EXIF."""
    place = tmp_path_factory.mktemp("bad")
    for k, camera in enumerate(CAMERAS, 1):
        saved(place / "photos" / f"photo {k}.png", in_a_room(camera), {2: larger, 3: blurred}.get(k, lambda photo: photo))
    saved(place / "photos" / "stranger.png", noise())
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(depths, "PREVIEW", SMALL)
        assert run(["views", str(place / "photos"), "-o", str(place / "t.glb"), "--leaf", "none", "--report", str(place / "r.json"), "--quiet"]) == 0
    return json.loads((place / "r.json").read_text(encoding="utf-8"))


def test_photos_of_several_sizes_are_placed_together(told):
    assert [name for name in told["views"]["placed"] if name != "photo 3.png"] == [f"photo {k}.png" for k in (1, 2, 4, 5, 6, 7)]


def test_a_photo_of_something_else_is_left_out_and_that_is_told(told):
    assert "stranger.png" in told["views"]["left_out"]
    assert any(warning.startswith("Left out, since too little in them was found again: ") and "stranger.png" in warning for warning in told["warnings"])


def test_a_blurred_photo_is_told(told):
    assert "Less sharp than the others: photo 3.png." in told["warnings"]


def test_missing_exif_is_told(told):
    assert "8 photos don't tell their focal length (EXIF); it was found with the rest." in told["warnings"]


def test_that_nothing_tells_the_size_is_told(told):
    assert "Photos don't tell how large the plant is: it was made 10 m high. `--height METRES` says how high it is." in told["warnings"]


def refused(folder, tmp_path, capfd, message):
    assert run(["views", str(folder), "-o", str(tmp_path / "t.glb"), "--quiet"]) == 2
    written = capfd.readouterr().err
    assert " ".join(written.split()).endswith(message) and "Traceback" not in written
    assert not (tmp_path / "t.glb").exists()


def test_two_photos_are_refused(tmp_path, capfd):
    for k, camera in enumerate(CAMERAS[:2]):
        saved(tmp_path / "photos" / f"{k}.png", painted_room(camera))
    refused(tmp_path / "photos", tmp_path, capfd, f"There are only 2 photos. 4 are the least that can be placed. {ADVICE}")


def test_photos_of_many_things_are_refused(tmp_path, capfd):
    for k in range(5):
        saved(tmp_path / "photos" / f"{k}.png", noise(80 + k))
    refused(tmp_path / "photos", tmp_path, capfd, f"None of the 5 photos could be placed: too few of their details were found again in others. {ADVICE}")
