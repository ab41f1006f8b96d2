"""Cameras of other programs are read, whoever wrote them; what can't be read is named."""

import json

import numpy as np
import pytest
import written_poses
from PIL import Image
from ring import camera_at

from sketchtree.errors import ViewsError
from sketchtree.multiview.poses.colmap_models import matrix_and_lens
from sketchtree.multiview.poses.read_poses import read_poses

CAMERAS = [camera_at(20.0 * k, size=(40, 30), height=0.5 + 0.3 * k) for k in range(3)]
POINTS = np.array([[0.1, 0.2, 0.3], [-0.2, 0.7, 0.1]])


@pytest.fixture
def photos(tmp_path):
    folder = tmp_path / "photos"
    folder.mkdir()
    for k in (1, 2, 3):
        Image.new("RGB", (40, 30)).save(folder / f"photo {k}.jpg")
    return folder


def agree(poses):
    """The cameras are those that were written."""
    assert [photo.name for photo in poses.photos] == ["photo 1.jpg", "photo 2.jpg", "photo 3.jpg"]
    for photo, camera in zip(poses.photos, CAMERAS, strict=True):
        for name in ("matrix", "rotation", "centre"):
            np.testing.assert_allclose(getattr(photo.camera, name), getattr(camera, name), atol=1e-9)
        assert photo.camera.size == camera.size


@pytest.mark.parametrize("write", [written_poses.colmap_text, written_poses.colmap_binary])
@pytest.mark.parametrize("inside", ["", "sparse/0"])
def test_colmap_as_text_and_binary(tmp_path, photos, write, inside):
    write(tmp_path / "model" / inside, CAMERAS, POINTS)
    poses = read_poses(tmp_path / "model", photos)
    agree(poses)
    np.testing.assert_allclose(poses.points, POINTS)
    assert poses.error == 0.5 and poses.up is None
    np.testing.assert_array_equal(poses.photos[1].sees, [0, 1])


@pytest.mark.parametrize(
    ("model", "numbers", "radial", "tangential", "fisheye"),
    [
        ("SIMPLE_PINHOLE", [50, 20, 15], (), (0, 0), False),
        ("SIMPLE_RADIAL", [50, 20, 15, 0.1], (0.1,), (0, 0), False),
        ("RADIAL", [50, 20, 15, 0.1, 0.2], (0.1, 0.2), (0, 0), False),
        ("OPENCV", [50, 50, 20, 15, 0.1, 0.2, 0.3, 0.4], (0.1, 0.2), (0.3, 0.4), False),
        ("FULL_OPENCV", [50, 50, 20, 15, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8], (0.1, 0.2, 0.5, 0.6, 0.7, 0.8), (0.3, 0.4), False),
        ("OPENCV_FISHEYE", [50, 50, 20, 15, 0.1, 0.2, 0.3, 0.4], (0.1, 0.2, 0.3, 0.4), (0, 0), True),
        ("RADIAL_FISHEYE", [50, 20, 15, 0.1, 0.2], (0.1, 0.2), (0, 0), True),
    ],
)
def test_models_of_cameras(model, numbers, radial, tangential, fisheye):
    matrix, lens = matrix_and_lens(model, numbers)
    np.testing.assert_array_equal(matrix, [[50, 0, 20], [0, 50, 15], [0, 0, 1]])
    assert (lens.radial, lens.tangential, lens.fisheye) == (radial, tangential, fisheye)


def test_transforms_are_z_up_and_look_backwards(tmp_path, photos):
    written_poses.transforms(tmp_path / "transforms.json", CAMERAS)
    poses = read_poses(tmp_path / "transforms.json", photos)
    agree(poses)
    np.testing.assert_array_equal(poses.up, [0, 0, 1])
    assert poses.photos[0].lens.radial == (0.01, 0.0, 0.0)


def test_an_angle_of_view_is_a_focal_length(tmp_path, photos):
    frame = {"file_path": "photo 1.jpg", "transform_matrix": np.eye(4).tolist()}
    (tmp_path / "t.json").write_text(json.dumps({"camera_angle_x": 2 * np.arctan(0.5), "frames": [frame, frame | {"file_path": "photo 2"}]}))
    camera = read_poses(tmp_path / "t.json", photos).photos[0].camera
    np.testing.assert_allclose(camera.matrix, [[40, 0, 20], [0, 40, 15], [0, 0, 1]])
    np.testing.assert_array_equal(camera.ahead, [0, 0, -1])


def test_bundler_looks_backwards_and_leaves_out_what_it_could_not_place(tmp_path, photos):
    written_poses.bundler(tmp_path / "bundle.out", CAMERAS, POINTS)
    (tmp_path / "list.txt").write_text("lost.jpg\n" + "".join(f"./photo_{k}.jpg 0 700\n" for k in (1, 2, 3)))
    for k in (1, 2, 3):
        (photos / f"photo {k}.jpg").rename(photos / f"photo_{k}.jpg")
    poses = read_poses(tmp_path / "bundle.out", photos)
    for photo, camera in zip(poses.photos, CAMERAS, strict=True):
        np.testing.assert_allclose(photo.camera.project(POINTS)[0], camera.project(POINTS)[0])
        assert photo.lens.radial == (0.02, 0.0)
    assert [photo.sees.tolist() for photo in poses.photos] == [[0, 1], [0], [0]]


def refused(path, photos, message):
    with pytest.raises(ViewsError) as error:
        read_poses(path, photos)
    assert str(error.value) == message.format(path=path, folder=photos)


def test_what_is_no_file_of_poses_is_named(tmp_path, photos):
    refused(tmp_path / "nothing", photos, "There are no poses at {path}. Give a COLMAP folder, a transforms.json or a bundle.out.")
    refused(photos, photos, "{path} holds no COLMAP model. Give the folder with cameras, images and points3D (.txt or .bin).")
    (tmp_path / "poses.csv").write_text("")
    refused(tmp_path / "poses.csv", photos, "poses.csv is no file of poses. Give a COLMAP folder, a transforms.json or a bundle.out.")
    (tmp_path / "a.json").write_text('{"frames": []}')
    refused(tmp_path / "a.json", photos, "a.json is no transforms.json (no frames). Give a file with `frames`, each with `file_path` and `transform_matrix`.")
    (tmp_path / "b.out").write_text("# Bundle file v0.3\nx")
    refused(tmp_path / "b.out", photos, "b.out is no Bundler file (invalid literal for int() with base 10: 'x'). Give a bundle.out of version 0.3.")


def test_poses_that_lack_something_are_named(tmp_path, photos):
    frame = {"file_path": "photo 1.jpg", "transform_matrix": np.eye(4).tolist()}
    (tmp_path / "a.json").write_text(json.dumps({"frames": [frame]}))
    refused(tmp_path / "a.json", photos, "Photo photo 1.jpg: its frame lacks a `transform_matrix` of 4 × 4 or a focal length. Give `fl_x` (pixels) or `camera_angle_x` (radians).")
    (tmp_path / "b.json").write_text(json.dumps({"fl_x": 30, "frames": [frame]}))
    refused(tmp_path / "b.json", photos, "b.json places 1 photo(s). Depth needs two at least; give poses for more of them.")
    (tmp_path / "c.json").write_text(json.dumps({"fl_x": 30, "frames": [frame | {"file_path": "x/other.jpg"}]}))
    refused(tmp_path / "c.json", photos, "Photo x/other.jpg: it is named by the poses, but is not in the folder. Put it there, or leave its pose out.")
    written_poses.bundler(tmp_path / "bundle.out", CAMERAS, POINTS)
    refused(tmp_path / "bundle.out", photos, "bundle.out has 4 cameras, but there are 3 photos. Put Bundler's list.txt beside it.")


def test_photos_that_were_cropped_after_their_cameras_were_found_are_named(tmp_path, photos):
    frames = [{"file_path": f"photo {k}.jpg", "transform_matrix": np.eye(4).tolist()} for k in (1, 2, 3)]
    Image.new("RGB", (36, 30)).save(photos / "photo 2.jpg")
    whole = "Give the photo that the pose is of, not cropped or made smaller, or write `w` and `h` of the one that it was."
    (tmp_path / "a.json").write_text(json.dumps({"fl_x": 30, "frames": frames}))
    refused(tmp_path / "a.json", photos, f"Photo photo 2.jpg: it has 36 × 30 pixels, others of the same camera 40 × 30. {whole}")
    (tmp_path / "b.json").write_text(json.dumps({"fl_x": 30, "cx": 38, "cy": 15, "frames": frames}))
    refused(tmp_path / "b.json", photos, f"Photo photo 2.jpg: it has 36 × 30 pixels, the middle of its lens is at (38, 15). {whole}")
    (tmp_path / "own.json").write_text(json.dumps({"frames": [frame | {"fl_x": 30} for frame in frames]}))
    assert [photo.camera.size for photo in read_poses(tmp_path / "own.json", photos).photos] == [(40, 30), (36, 30), (40, 30)]


def test_a_colmap_model_that_lacks_something_is_named(tmp_path, photos):
    model = tmp_path / "model"
    written_poses.colmap_text(model, CAMERAS, POINTS, ("FOV", [1, 1, 1, 1, 1]))
    message = "COLMAP's camera model FOV is not read. Let COLMAP undistort the photos, or use one of: SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV, OPENCV_FISHEYE, FULL_OPENCV, "
    refused(model, photos, message + "SIMPLE_RADIAL_FISHEYE, RADIAL_FISHEYE.")
    written_poses.colmap_text(model, CAMERAS, POINTS, ("PINHOLE", [1, 1]))
    refused(model, photos, "A camera of COLMAP's model PINHOLE has 2 numbers, not 4. Export the cameras again.")
    written_poses.colmap_text(model, CAMERAS, POINTS)
    (model / "cameras.txt").write_text("9 PINHOLE 4 3 5 5 2 1")
    refused(model, photos, "Photo photo 1.jpg: its camera 1 is not in the COLMAP model. Export cameras and images together.")
    (model / "images.txt").unlink()
    refused(model, photos, "The COLMAP model has no images.txt. Put images.txt beside the other files of the model in {path}.")


def test_a_binary_model_cut_short_is_named(tmp_path, photos):
    written_poses.colmap_binary(tmp_path, CAMERAS, POINTS)
    whole = (tmp_path / "images.bin").read_bytes()
    (tmp_path / "images.bin").write_bytes(whole[:70])
    with pytest.raises(ViewsError, match=r"can't be read \(.*\). Export it from COLMAP again, as text or binary.$"):
        read_poses(tmp_path, photos)
