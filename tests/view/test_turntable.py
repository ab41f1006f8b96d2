"""What does a tree look like from all sides?"""

import shutil

import numpy as np
import pytest
from PIL import Image

from sketchtree.view.picture import frame_camera
from sketchtree.view.turntable import FILMS, _whirled, write_film

PICTURES = [Image.new("RGB", (33, 20), (10 * k, 255 - 10 * k, 60)) for k in range(6)]


@pytest.mark.parametrize("suffix", [suffix for suffix in FILMS if suffix != ".mp4"])
def test_a_film_holds_every_picture_and_runs_for_ever(tmp_path, suffix):
    path = tmp_path / f"t{suffix}"
    write_film(path, PICTURES, 1.2)
    with Image.open(path) as film:
        assert film.n_frames == 6 and film.size == (33, 20) and film.info.get("loop", 0) == 0
        film.seek(5)
        assert np.abs(np.asarray(film.convert("RGB"))[10, 16].astype(int) - [50, 205, 60]).max() < 12
        assert film.info["duration"] == pytest.approx(200)


def test_the_same_pictures_make_the_same_bytes(tmp_path):
    for name in ("a.gif", "b.gif"):
        write_film(tmp_path / name, PICTURES, 1.0)
    assert (tmp_path / "a.gif").read_bytes() == (tmp_path / "b.gif").read_bytes()


def test_ffmpeg_makes_an_mp4_with_even_sides(tmp_path):
    if shutil.which("ffmpeg") is None:
        pytest.skip("ffmpeg is not installed")
    write_film(tmp_path / "t.mp4", PICTURES, 1.0)
    assert (tmp_path / "t.mp4").read_bytes()[4:8] == b"ftyp"


def test_the_camera_keeps_its_distance_all_the_way_round():
    points = np.random.default_rng(0).normal(size=(500, 3)) * [3, 2, 1] + [0, 4, 0]
    hull = _whirled(points)
    cameras = np.array([frame_camera(hull, 15.0 * k, 6.0, 1.0) for k in range(24)])
    distance = np.linalg.norm(cameras[:, :3] - cameras[:, 3:6], axis=1)
    assert np.ptp(distance) < 1e-6 * distance.mean() and np.ptp(cameras[:, 1]) < 1e-6 * distance.mean()


def test_the_circles_hold_the_tree_in_every_turn():
    points = np.random.default_rng(1).normal(size=(300, 3))
    hull = _whirled(points)
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    assert hull[:, 1].min() <= points[:, 1].min() + 1e-9 and hull[:, 1].max() >= points[:, 1].max() - 1e-9
    assert np.hypot(*(hull - middle)[:, [0, 2]].T).max() >= np.hypot(*(points - middle)[:, [0, 2]].T).max() - 1e-9
