import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

from sketchtree.errors import ExportError, OptionError
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.export.gltf import read_glb
from sketchtree.view import NO_OPENGL, REFUSED, VIEWS, picture, preview
from sketchtree.view.picture import frame_camera
from sketchtree.view.light import aligned, baked_light, ground_light, transmittance

UP = np.array([0.0, 1.0, 0.0])


def card(height=1.0, alpha=None):
    """An upright square, 2 m wide, standing on the ground and facing +z."""
    position = np.array([[-1, 0, 0], [1, 0, 0], [1, 2 * height, 0], [-1, 2 * height, 0]], float)
    texture = np.full((8, 8, 4), (60, 110, 40, 255), np.uint8)
    if alpha is not None:
        texture[:, 4:, 3] = alpha
    material = Material("leaf_card", texture, alpha_cutoff=None if alpha is None else 0.5, double_sided=True)
    uv = np.array([[0, 1], [1, 1], [1, 0], [0, 0]], float)
    return Mesh("leaf", position, np.tile([0.0, 0, 1], (4, 1)), uv, np.array([[0, 1, 2], [0, 2, 3]]), material)


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    """A tall opaque card and one whose right half is transparent, each filling a picture of its own."""
    folder, found = tmp_path_factory.mktemp("pictures"), {}
    for name, alpha in (("full", 255), ("half", 0)):
        drawn, reason = preview([card(2.0, alpha)], folder / f"{name}.png", size=(150, 200), view="front", ground=False)
        if not drawn:
            pytest.skip(reason)
        found[name] = Image.open(folder / f"{name}.png")
    return found


def is_green(pixels):
    red, green, blue = (pixels[..., k].astype(int) for k in range(3))
    return (green > red + 8) & (green > blue + 20)


def test_a_picture_is_written_in_the_size_asked_for(pictures):
    assert pictures["full"].size == (150, 200) and pictures["full"].format == "PNG"


def test_the_whole_tree_is_in_the_picture_with_a_margin(pictures):
    green = is_green(np.asarray(pictures["full"]))
    assert green.any() and not green[[0, 1, -2, -1]].any() and not green[:, [0, 1, -2, -1]].any()
    assert np.ptp(np.nonzero(green)[0]) > 150


def test_transparent_parts_of_a_leaf_are_not_drawn(pictures):
    full, half = (is_green(np.asarray(pictures[name])).sum() for name in ("full", "half"))
    assert 0.4 < half / full < 0.6


def test_a_glb_file_and_several_views_make_one_sheet(pictures, tmp_path):
    from sketchtree.export.gltf import write_glb

    write_glb(tmp_path / "card.glb", [card(alpha=0)])
    assert preview(tmp_path / "card.glb", tmp_path / "a.png", size=(80, 60), view=("front", "side", "top", "three-quarter")) == (True, "")
    with Image.open(tmp_path / "a.png") as sheet:
        assert sheet.size == (160, 120)
        assert is_green(np.asarray(sheet)[:60, :80]).any()


def test_a_crash_of_the_child_is_survived_and_says_what_to_install(monkeypatch, tmp_path):
    crash = "import os, signal; os.kill(os.getpid(), signal.SIGSEGV)"
    monkeypatch.setattr(picture, "command", lambda asked, drawn: [sys.executable, "-c", crash])
    assert preview([card()], tmp_path / "a.png") == (False, NO_OPENGL)
    assert not (tmp_path / "a.png").exists()


def test_the_advice_without_opengl_is_one_line():
    assert NO_OPENGL == (
        "No picture could be drawn: there is no OpenGL on this machine. Install Mesa's software renderer, "
        "for example `apt install libgl1 libegl1 libgl1-mesa-dri`."
    )


def test_refused_shaders_are_reported(monkeypatch, tmp_path):
    script = "import sys; open(sys.argv[1], 'wb').write(b'x'); sys.stderr.write('ERR| vtkShaderProgram: 0:1: error')"
    monkeypatch.setattr(picture, "command", lambda asked, drawn: [sys.executable, "-c", script, str(drawn)])
    assert preview([card()], tmp_path / "a.png") == (False, REFUSED)
    assert REFUSED == (
        "No picture could be drawn: this machine's OpenGL is too old for our shaders (3.2 is needed). "
        "Install a newer graphics driver or Mesa."
    )


def test_an_error_in_the_child_is_passed_on_in_one_line(monkeypatch, tmp_path):
    monkeypatch.setattr(picture, "command", lambda asked, drawn: [sys.executable, "-c", "raise MemoryError('too many leaves')"])
    assert preview([card()], tmp_path / "a.png") == (False, "No picture could be drawn: MemoryError: too many leaves.")


def test_a_child_that_says_nothing_is_named_by_its_status():
    silent = subprocess.CompletedProcess([], 3, "", "")
    assert picture.reason_of(silent) == "No picture could be drawn: the drawing process ended with status 3."


def test_a_child_that_hangs_is_ended(monkeypatch, tmp_path):
    monkeypatch.setattr(picture, "command", lambda asked, drawn: [sys.executable, "-c", "import time; time.sleep(60)"])
    drawn, reason = preview([card()], tmp_path / "a.png", timeout=0.5)
    assert (drawn, reason) == (False, "No picture was drawn: it took longer than 0.5 s. Ask for a smaller one, or for fewer leaves.")


def test_nothing_to_show_is_said(tmp_path):
    assert preview([], tmp_path / "a.png") == (False, "No picture was drawn: there is nothing to show.")


def test_an_unknown_view_is_refused_with_the_list(tmp_path):
    with pytest.raises(OptionError) as caught:
        preview([card()], tmp_path / "a.png", view="below")
    assert str(caught.value) == "There is no view called 'below'. Choose one of: front, side, back, top, three-quarter."


def test_what_is_no_glb_is_refused(tmp_path):
    (tmp_path / "a.glb").write_bytes(b"not a mesh")
    with pytest.raises(ExportError, match="is not a GLB file that can be shown. Give a .glb file with its textures inside."):
        preview(tmp_path / "a.glb", tmp_path / "a.png")


def test_a_folder_that_is_not_there_is_refused_before_drawing(tmp_path):
    with pytest.raises(ExportError, match="does not exist"):
        preview([card()], tmp_path / "none" / "a.png")


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(ExportError, match=r"can't be read: no such file or directory\. Check the path\."):
        preview(tmp_path / "none.glb", tmp_path / "a.png")


def test_reading_a_glb_gives_back_what_was_written(tmp_path):
    from sketchtree.export.gltf import write_glb

    mesh = card(alpha=0)
    write_glb(tmp_path / "card.glb", [mesh])
    (back,) = read_glb(tmp_path / "card.glb")
    assert back.name == "leaf" and back.material.name == "leaf_card" and back.material.alpha_cutoff == 0.5
    for name in ("position", "normal", "uv", "triangle"):
        assert np.allclose(getattr(back, name), getattr(mesh, name), atol=1e-6), name
    assert np.array_equal(back.material.base_color_texture, mesh.material.base_color_texture)


@pytest.mark.parametrize("angles", VIEWS.values())
@pytest.mark.parametrize("aspect", [0.5, 1.0, 2.0])
def test_the_camera_sees_every_point_and_touches_the_margin(angles, aspect):
    points = np.random.default_rng(0).normal(size=(500, 3)) * [1, 4, 2] + [30, 5, -20]
    camera = frame_camera(points, *angles, aspect)
    eye, target, up, field = camera[:3], camera[3:6], camera[6:9], camera[9]
    back = (eye - target) / np.linalg.norm(eye - target)
    right = np.cross(up, back)
    depth = (eye - points) @ back
    slope = np.tan(np.radians(field / 2))
    reach = np.maximum(np.abs((points - eye) @ right) / depth / slope / aspect, np.abs((points - eye) @ up) / depth / slope)
    assert depth.min() > 0 and 0.80 < reach.max() < 0.89


def test_beer_and_lamberts_law_holds_behind_a_layer():
    rng = np.random.default_rng(1)
    layer = np.column_stack([rng.uniform(0, 4, 400_000), np.full(400_000, 2.0), rng.uniform(0, 4, 400_000)])
    area = np.full(len(layer), 1.5 * 16 / len(layer))
    middle = np.array([[2.0, 0.0, 2.0], [2.0, 4.0, 2.0]])
    below, above = transmittance(middle, layer, area, UP)
    assert np.isclose(below, np.exp(-0.5 * 1.5), rtol=0.05) and above > 0.99


def test_baked_light_is_dark_within_a_crown_and_full_outside():
    rng = np.random.default_rng(2)
    crown = rng.normal(size=(20_000, 3))
    crown *= rng.uniform(0, 1, (len(crown), 1)) ** (1 / 3) / np.linalg.norm(crown, axis=1, keepdims=True)
    (light,) = baked_light([np.array([[0, 0, 0], [0, 1.3, 0]], float)], crown, np.full(len(crown), 5e-4), UP)
    depth = 0.5 * 5e-4 * len(crown) / (4 / 3 * np.pi)
    assert np.isclose(light[0, 0], np.exp(-depth), rtol=0.2) and light[1, 0] > 0.95 and light[1, 1] > light[0, 1]


def test_the_ground_is_darkest_in_the_suns_shadow():
    sun = np.array([0.6, 0.8, 0.0])
    blob = np.random.default_rng(3).normal(scale=0.2, size=(5000, 3)) + [0, 4, 0]
    light = ground_light(blob, np.full(len(blob), 2e-4), sun, reach=10.0, pixels=100)
    row, column = np.unravel_index(np.argmin(light), light.shape)
    assert abs((column + 0.5) / 5 - 10 + 3.0) < 0.5 and abs((row + 0.5) / 5 - 10) < 0.5
    assert light.max() > 0.99


@pytest.mark.parametrize("direction", [(0, 1, 0), (0, -1, 0), (1, 0, 0), (0.3, 0.5, -0.8)])
def test_aligned_axes_are_right_handed_and_orthonormal(direction):
    axes = aligned(np.array(direction, float))
    assert np.allclose(axes @ axes.T, np.eye(3)) and np.isclose(np.linalg.det(axes), 1)


def test_a_picture_costs_the_pixels_its_surfaces_cover():
    camera = np.array([0, 0, 10, 0, 0, 0, 0, 1, 0, 90.0])  # sees 20 m × 20 m at the origin
    one = picture.fragments(np.zeros((1, 3)), np.array([4.0]), camera, (200, 200))
    assert one == pytest.approx(0.5 * 4.0 / 400.0 * 200**2)
    assert picture.fragments(np.array([[0, 0, 20.0]]), np.array([4.0]), camera, (200, 200)) == 0  # behind the camera
    assert picture.fragments(np.array([[0, 0, 9.999]]), np.array([4.0]), camera, (200, 200)) == 200**2


def test_a_costly_picture_is_supersampled_less():
    assert [picture.affordable(2, cost) for cost in (0.0, 9e7, 2e8, 1e12)] == [2, 2, 1, 1]
