"""`sketchtree views` from the shell."""

import json
import shutil
import sys
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from PIL import Image

sys.path.insert(0, str(Path(__file__).parents[1] / "multiview"))
import written_poses
from ring import camera_at, rendered

from sketchtree.clouds.files.read_cloud import read_cloud
from sketchtree.commands.app import run


@pytest.fixture(scope="module")
def masks(tmp_path_factory):
    """Silhouettes of a trunk and a limb from thirteen sides, and where they were seen from."""
    place = tmp_path_factory.mktemp("views")
    cameras = [camera_at(27.7 * k, size=(120, 120)) for k in range(13)]
    (place / "masks").mkdir()
    for k, camera in enumerate(cameras, 1):
        there = rendered(camera)[1] > 0
        Image.fromarray(np.repeat(np.uint8(255 * there)[..., None], 3, axis=2)).save(place / "masks" / f"photo {k}.png")
    written_poses.transforms(place / "transforms.json", cameras)
    return place


def test_photos_become_a_tree_with_their_points_and_a_report(masks, tmp_path):
    out, cloud, report = tmp_path / "t.glb", tmp_path / "c.ply", tmp_path / "r.json"
    asked = ["views", str(masks / "masks"), "--poses", str(masks / "transforms.json"), "-o", str(out), "--cloud", str(cloud), "--report", str(report), "--height", "5", "--quiet"]
    assert run(asked) == 0
    told = json.loads(report.read_text(encoding="utf-8"))
    jsonschema.validate(told, json.loads((Path(__file__).parents[2] / "sketchtree" / "report.schema.json").read_text(encoding="utf-8")))
    assert told["command"] == "views" and len(told["views"]["placed"]) == 13 and "carve" in told["views"]["seconds"]
    assert read_cloud(cloud).height == pytest.approx(5.0, abs=0.01)
    assert told["height"] == pytest.approx(5.0, abs=0.4) and told["options"]["engine"] == "auto"
    assert told["options"]["pixel"] == 0  # masks: a hull has no thin twigs to go on
    assert out.stat().st_size > 5_000


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (["--poses", "nowhere.json"], "nowhere.json"),
        (["--height", "-1"], "A height of -1 m is none. Give metres above 0, or leave it out."),
        (["--cloud", "points.xyz"], "points.xyz"),
        (["--engine", "cuda"], "'cuda' is not one of 'auto', 'numba', 'jax'."),
    ],
)
def test_bad_choices_are_one_paragraph(masks, tmp_path, capfd, more, message):
    assert run(["views", str(masks / "masks"), "-o", str(tmp_path / "t.glb"), *more]) == 2
    told = capfd.readouterr().err
    assert message in told and "Traceback" not in told
    assert not (tmp_path / "t.glb").exists()


@pytest.mark.parametrize(
    ("folder", "message"),
    [
        ("nowhere", "There is no folder {}. Check the path."),
        ("masks/photo 1.png", "{} is a file, not a folder. Give a folder of photos of one plant from many sides (.jpg .jpeg .png .tif .tiff .webp .bmp), 20 or more."),
    ],
)
def test_what_is_no_folder_of_photos_is_named(masks, tmp_path, capfd, folder, message):
    assert run(["views", str(masks / folder), "-o", str(tmp_path / "t.glb")]) == 2
    told = capfd.readouterr().err
    assert told.endswith(f"sketchtree: {message.format(masks / folder)}\n") and not (tmp_path / "t.glb").exists()


def test_a_photo_that_is_cut_off_is_named_and_nothing_is_written(masks, tmp_path, capfd):
    shutil.copytree(masks / "masks", tmp_path / "photos")
    (tmp_path / "photos" / "photo 3.png").write_bytes(b"\x89PNG\r\n\x1a\n and no more")
    asked = ["views", str(tmp_path / "photos"), "--poses", str(masks / "transforms.json"), "-o", str(tmp_path / "t.glb"), "--cloud", str(tmp_path / "c.ply"), "--quiet"]
    assert run(asked) == 2
    told = capfd.readouterr().err
    assert told.startswith("sketchtree: Photo photo 3.png: it can't be read (") and told.endswith("). Save it again as JPEG or PNG, or take it out of the folder.\n")
    assert not (tmp_path / "t.glb").exists() and not (tmp_path / "c.ply").exists()


@pytest.mark.parametrize("output", ["masks/photo 1.png", "transforms.json"])
def test_neither_photos_nor_poses_are_written_over(masks, capfd, output):
    assert run(["views", str(masks / "masks"), "--poses", str(masks / "transforms.json"), "-o", str(masks / output)]) == 2
    assert f"`-o {masks / output}` would overwrite what the plant is made of. Give it another name." in capfd.readouterr().err
