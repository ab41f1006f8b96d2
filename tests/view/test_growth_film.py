"""What does a tree look like while it grows?"""

from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from sketchtree.errors import ExportError, OptionError
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.view import growth_film as module
from sketchtree.view import picture
from sketchtree.view.growth_film import growth_film


class Sprout:
    """A dark board that grows to 2 m, and beside it a red leaf that is there in the second half."""

    def at(self, time: float):
        corners = np.array([[-0.3, 0, 0], [0.3, 0, 0], [0.3, 2, 0], [-0.3, 2, 0.0]])
        triangle = np.array([[0, 1, 2], [0, 2, 3]])
        wood = Mesh("wood", corners * [1, time, 1], np.tile([0.0, 0, 1], (4, 1)), corners[:, :2], triangle if time > 0 else triangle[:0], Material("wood", base_color=(0.05, 0.03, 0.02, 1)))
        leaf = replace(wood, name="leaf", position=corners * 0.4 + [0.8, 1.2, 0], triangle=triangle if time > 0.5 else triangle[:0], material=Material("leaf", base_color=(1, 0, 0, 1)))
        return wood, leaf


@pytest.fixture(scope="module")
def film(tmp_path_factory):
    """Five pictures, as arrays."""
    path = tmp_path_factory.mktemp("film") / "t.gif"
    drawn, reason = growth_film(Sprout(), path, size=(96, 96), frames=5, seconds=1.0, hold=0.5)
    if reason == picture.NO_OPENGL:
        pytest.skip(reason)
    assert drawn, reason
    with Image.open(path) as made:
        assert made.n_frames == 5
        shown = []
        for k in range(5):
            made.seek(k)
            shown.append(np.asarray(made.convert("RGB")).astype(int))
    return shown


def dark(shown):
    return shown.max(axis=2) < 110


def red(shown):
    return (shown[..., 0] > 110) & (shown[..., 1] < 70)


def test_it_begins_with_the_bare_ground_and_ends_with_the_whole_tree(film):
    assert not dark(film[0]).any() and not red(film[0]).any()
    assert dark(film[4]).sum() > 300 and red(film[4]).sum() > 30


def test_what_grows_rises_from_picture_to_picture(film):
    tops = [np.flatnonzero(dark(shown)[:, 30:60].any(axis=1)).min() for shown in film[1:]]
    assert all(np.diff(tops) < 0)


def test_a_leaf_comes_when_it_unfolds(film):
    assert [bool(red(shown).any()) for shown in film] == [False, False, False, True, True]


def test_a_leaf_that_is_shed_is_seen_as_long_as_it_is_there(tmp_path):
    class Shedding(Sprout):
        def at(self, time: float):
            wood, leaf = super().at(1.0)
            return wood, leaf if 0 < time < 1 else replace(leaf, triangle=leaf.triangle[:0])

    drawn, reason = growth_film(Shedding(), tmp_path / "t.apng", size=(96, 96), frames=3, seconds=1.0)
    if reason == picture.NO_OPENGL:
        pytest.skip(reason)
    assert drawn, reason
    with Image.open(tmp_path / "t.apng") as made:
        seen = []
        for k in range(3):
            made.seek(k)
            seen.append(bool(red(np.asarray(made.convert("RGB")).astype(int)).any()))
    assert seen == [False, True, False]


def test_nothing_is_cropped_and_the_foot_stays_where_it_is(film):
    feet = [np.flatnonzero(dark(shown).any(axis=1)).max() for shown in film[1:]]
    assert np.ptp(feet) <= 1
    there = dark(film[4]) | red(film[4])
    assert not (there[0].any() or there[-1].any() or there[:, 0].any() or there[:, -1].any())


def test_a_turning_camera_keeps_its_distance_and_ends_at_the_front():
    whole = Sprout().at(1.0)
    still, turning = (module._Scene(whole, [], (64, 64), turn) for turn in (0.0, 180.0))
    cameras = np.array([turning.changes(whole, time)["camera"] for time in (0.0, 0.3, 0.7, 1.0)])
    distance = np.linalg.norm(cameras[:, :3] - cameras[:, 3:6], axis=1)
    assert np.ptp(distance) < 1e-6 * distance.mean() and abs(cameras[3, 0]) < 0.1 and cameras[0, 2] < 0 < cameras[3, 2]
    np.testing.assert_array_equal(still.changes(whole, 0.0)["camera"], still.changes(whole, 1.0)["camera"])


def test_what_reaches_out_farther_before_the_end_is_in_the_picture():
    whole = Sprout().at(1.0)
    wide = [replace(whole[0], position=whole[0].position * [6, 1, 1])]
    near, far = (np.linalg.norm(module._Scene(whole, younger, (64, 64), 0.0).camera[:3]) for younger in ([], [wide]))
    assert far > 1.3 * near


def test_shade_is_read_from_the_same_grid_in_every_picture():
    scene = module._Scene(Sprout().at(1.0), [], (64, 64), 0.0)
    leafless = [scene.changes(Sprout().at(0.5), 0.5)["0.light"] for _ in range(2)]
    np.testing.assert_array_equal(*leafless)
    assert scene.changes(Sprout().at(0.0), 0.0)["ground"].min() > 250


def test_a_tree_of_nothing_is_no_film(tmp_path):
    class Nothing:
        def at(self, time):
            return ()

    assert growth_film(Nothing(), tmp_path / "t.gif") == (False, "No film was drawn: there is nothing to show.")


def test_a_picture_that_takes_too_long_ends_the_film(tmp_path, monkeypatch):
    monkeypatch.setattr(picture, "command", lambda *_: ["sleep", "60"])
    drawn, reason = growth_film(Sprout(), tmp_path / "t.gif", size=(64, 64), frames=3, timeout=0.2)
    assert (drawn, reason) == (False, "No film was drawn: a picture took longer than 0.2 s. Ask for a smaller one, or for fewer leaves.")
    assert list(tmp_path.iterdir()) == []


def test_whoever_is_told_how_much_is_done_can_end_it_and_no_file_is_left(tmp_path):
    told = []

    def part(done: float) -> None:
        told.append(done)
        if len(told) == 3:
            raise StopIteration

    with pytest.raises(StopIteration):
        growth_film(Sprout(), tmp_path / "t.gif", size=(64, 64), frames=4, part=part)
    assert told == sorted(told) and 0 <= told[0] < told[2] < 1 and not list(tmp_path.iterdir())


def test_without_opengl_the_reason_is_told(tmp_path, monkeypatch):
    monkeypatch.setattr(picture, "command", lambda *_: ["sh", "-c", "echo no OpenGL >&2; exit 1"])
    assert growth_film(Sprout(), tmp_path / "t.gif", size=(64, 64), frames=3) == (False, picture.NO_OPENGL)


@pytest.mark.parametrize(("name", "wanted", "said"), [
    ("t.avi", {}, "`.avi` files are not written"),
    ("t.gif", {"frames": 1}, "A film of 1 frames can't be made. Ask for 2 to 720."),
    ("t.gif", {"seconds": 0}, "A film of 0 seconds can't be made. Ask for 0.1 to 600."),
    ("t.gif", {"turn": float("nan")}, "A camera can't turn by nan degrees. Ask for -3600 to 3600."),
])  # fmt: skip
def test_wrong_choices_are_refused(tmp_path, name, wanted, said):
    with pytest.raises((ExportError, OptionError), match=said.replace(".", r"\.")):
        growth_film(Sprout(), tmp_path / name, **wanted)
