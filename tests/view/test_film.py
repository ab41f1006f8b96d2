"""How do pictures become a film?"""

import subprocess
import weakref
from collections.abc import Sequence

import numpy as np
import pytest
from PIL import Image

from sketchtree.errors import ExportError, OptionError
from sketchtree.view import film
from sketchtree.view.film import FILMS, check_film, check_length, durations, write_film

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


def test_the_last_picture_stays(tmp_path):
    assert durations(7, 1.0, 0.5) == [140, 150, 140, 140, 140, 150, 640]
    write_film(tmp_path / "t.gif", PICTURES, 1.2, hold=2.0)
    with Image.open(tmp_path / "t.gif") as made:
        made.seek(5)
        assert made.info["duration"] == 2200


def test_a_gif_shows_one_palette_and_only_what_has_changed(tmp_path):
    still = np.tile(np.linspace(0, 255, 64, dtype=np.uint8)[:, None, None], (1, 64, 3))
    moving = [still.copy() for _ in range(5)]
    for k, picture in enumerate(moving):
        picture[10 + k, 20:30] = (250, 40, 30)
    write_film(tmp_path / "t.gif", [Image.fromarray(picture) for picture in moving], 1.0)
    with Image.open(tmp_path / "t.gif") as made:
        first = np.asarray(made.convert("RGB")).astype(int)
        for k in range(1, 5):
            made.seek(k)
            assert made.tile == [] or made.tile[0][1][1] >= 9  # what is written begins at the row that changed
            now = np.asarray(made.convert("RGB")).astype(int)
            rest = np.ones((64, 64), bool)
            rest[10:16, 20:30] = False
            np.testing.assert_array_equal(now[rest], first[rest])  # nothing flickers
            assert np.abs(now[10 + k, 25] - (250, 40, 30)).max() < 20
    whole = len((tmp_path / "t.gif").read_bytes())
    write_film(tmp_path / "one.gif", [Image.fromarray(moving[0])] * 2, 1.0)
    assert whole < 1.5 * len((tmp_path / "one.gif").read_bytes())


def test_pictures_that_are_alike_are_one_that_stays_longer(tmp_path):
    write_film(tmp_path / "t.gif", [PICTURES[0]] * 3, 0.6)
    with Image.open(tmp_path / "t.gif") as made:
        assert getattr(made, "n_frames", 1) == 1 and made.info["duration"] == 600


def test_smooth_skies_show_no_bands_and_are_close(tmp_path):
    ramp = np.linspace(0.6, 0.9, 128)[:, None, None] * [190, 215, 240]
    pictures = [Image.fromarray(np.round(np.tile(ramp, (1, 96, 1))).astype(np.uint8))] * 2
    write_film(tmp_path / "t.gif", pictures, 1.0)
    with Image.open(tmp_path / "t.gif") as made:
        shown = np.asarray(made.convert("RGB")).astype(float)
    assert np.abs(shown - ramp).max() < 12 and np.abs(shown.mean(axis=1) - ramp[:, 0]).max() < 4


def test_pictures_are_asked_for_one_at_a_time(tmp_path):
    import sys

    class Lazy(list):
        def __getitem__(self, k):
            return PICTURES[k].copy()

    write_film(tmp_path / "t.gif", Lazy(PICTURES), 1.0)
    write_film(tmp_path / "u.gif", PICTURES, 1.0)
    assert (tmp_path / "t.gif").read_bytes() == (tmp_path / "u.gif").read_bytes() and sys.getsizeof(Lazy()) > 0


@pytest.mark.skipif(film.encoder() is None, reason="no ffmpeg with H.264 is here")
def test_an_mp4_is_h264_in_yuv420p_with_even_sides_and_begins_with_its_index(tmp_path):
    write_film(tmp_path / "t.mp4", PICTURES, 1.0, hold=0.5)
    data = (tmp_path / "t.mp4").read_bytes()
    assert data[4:8] == b"ftyp" and b"avc1" in data and data.index(b"moov") < data.index(b"mdat")
    said = subprocess.run([film.encoder(), "-hide_banner", "-i", str(tmp_path / "t.mp4")], capture_output=True, text=True).stderr
    assert "h264" in said and "yuv420p" in said and "32x20" in said and "Duration: 00:00:01.50" in said
    write_film(tmp_path / "u.mp4", PICTURES, 1.0, hold=0.5)
    assert (tmp_path / "u.mp4").read_bytes() == data


def test_an_ffmpeg_without_h264_is_passed_over(tmp_path, monkeypatch):
    monkeypatch.setattr(film, "_programs", lambda: iter(("poor", "rich")))
    monkeypatch.setattr(film, "_has_h264", lambda program: program == "rich")
    assert film.encoder() == "rich"
    monkeypatch.setattr(film, "_has_h264", lambda program: False)
    with pytest.raises(ExportError, match=r"t.mp4: the ffmpeg that was found has no H.264 \(libx264\). Install one, `pip install 'sketchtree\[video\]'`, or ask for a .gif"):
        check_film(tmp_path / "t.mp4")


@pytest.mark.skipif(film.encoder() is None, reason="no ffmpeg with H.264 is here")
def test_what_ffmpeg_says_is_told(tmp_path, monkeypatch):
    with pytest.raises(ExportError, match="ffmpeg made no film: .*Ask for a .gif, .webp or .apng."):
        write_film(tmp_path / "t.mp4", [Image.new("RGB", (1, 1))] * 2, 1.0)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("given", "said"), [
    ((1, 6), "A film of 1 frames can't be made. Ask for 2 to 720."),
    ((721, 6), "A film of 721 frames can't be made. Ask for 2 to 720."),
    ((72, 0), "A film of 0 seconds can't be made. Ask for 0.1 to 600."),
    ((72, float("nan")), "A film of nan seconds can't be made. Ask for 0.1 to 600."),
    ((72, 6, -1), "The last picture of a film can't stay for -1 seconds. Ask for 0 to 600."),
])  # fmt: skip
def test_lengths_that_no_film_can_have_are_refused(given, said):
    with pytest.raises(OptionError) as refused:
        check_length(*given)
    assert str(refused.value) == said


def test_other_extensions_are_refused(tmp_path):
    with pytest.raises(ExportError, match="`.avi` files are not written"):
        check_film(tmp_path / "t.avi")


class Reel(Sequence):
    """Pictures that are made when they are asked for; `most` of them were there at once."""

    def __init__(self, count: int = 12):
        self.count, self.there, self.most = count, 0, 0

    def __len__(self) -> int:
        return self.count

    def __getitem__(self, k: int) -> Image.Image:
        made = Image.new("RGB", (33, 20), (10 * k, 255 - 10 * k, 60))
        self.there += 1
        self.most = max(self.most, self.there)
        weakref.finalize(made, self._gone)
        return made

    def _gone(self) -> None:
        self.there -= 1


@pytest.mark.parametrize("suffix", [suffix for suffix in FILMS if suffix != ".mp4"])
def test_few_pictures_are_in_memory_at_once_however_many_there_are(tmp_path, suffix):
    reel = Reel()
    write_film(tmp_path / f"t{suffix}", reel, 1.2)
    assert reel.most <= (8 if suffix == ".gif" else 3)  # a palette is found from eight
    with Image.open(tmp_path / f"t{suffix}") as made:
        assert made.n_frames == 12


def test_an_apng_shows_the_very_pictures_and_of_each_only_what_has_changed(tmp_path):
    grain = np.random.default_rng(0).integers(0, 255, (64, 64, 3), dtype=np.uint8)
    moving = [grain.copy() for _ in range(5)]
    for k, picture in enumerate(moving):
        picture[10 + k // 2, 20:30] = (250, 40, 30)  # each is shown twice
    write_film(tmp_path / "t.apng", [Image.fromarray(picture) for picture in moving], 1.0, hold=70.0)
    with Image.open(tmp_path / "t.apng") as made:
        assert made.n_frames == 3
        for k, time in enumerate((400, 400, 70_200)):
            made.seek(k)
            assert np.array_equal(np.asarray(made.convert("RGB")), moving[2 * k]) and made.info["duration"] == pytest.approx(time)
    assert (tmp_path / "t.apng").stat().st_size < 1.2 * 64 * 64 * 3


def test_a_film_of_pictures_that_are_all_alike_is_one_that_stays(tmp_path):
    write_film(tmp_path / "t.apng", [PICTURES[0]] * 3, 0.9)
    with Image.open(tmp_path / "t.apng") as made:
        assert np.array_equal(np.asarray(made.convert("RGB")), np.asarray(PICTURES[0]))
