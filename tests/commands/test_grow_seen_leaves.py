"""A tree of points in leaf that is kept in a file and grown from it wears its leaves where they were seen, whether the file is a mesh or a project with its points."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path[:0] = [str(Path(__file__).parents[1] / "clouds"), str(Path(__file__).parents[1] / "clouds" / "leafy")]
from in_leaf import OUTER, REACH, in_leaf
from scipy.spatial import cKDTree

from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.files.write_cloud import write_cloud
from sketchtree.clouds.leafy.worn_before import worn_before
from sketchtree.clouds.prepared.prepare import prepare
from sketchtree.commands.app import run
from sketchtree.commands.traced import begun
from sketchtree.editing.document import Document
from sketchtree.editing.laid_cloud import CloudChoices, laid
from sketchtree.export.read import read_contents
from sketchtree.export.skeletons.hdf5 import write_undrawn
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.skeleton import TreeSkeleton


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("seen")
    write_cloud(PointCloud(in_leaf(0.07, 2)[0]), place / "scan.ply")
    assert run(["cloud", str(place / "scan.ply"), "-o", str(place / "tree.glb"), "--up", "y", "--leaf", "apple", "--no-inside", "--quiet"]) == 0
    return place


def leaves_of(path):
    """Corners of its leaves."""
    asset = read_contents(path).asset
    return asset.about, np.concatenate([part.merged().position for part in asset.parts if part.name.startswith("leaf")])


def test_a_mesh_file_says_that_its_leaves_were_seen(folder):
    assert leaves_of(folder / "tree.glb")[0]["leaves"] == "seen"


def test_grown_from_the_mesh_file_it_has_as_many_leaves_where_they_were(folder):
    assert run(["grow", str(folder / "tree.glb"), "-o", str(folder / "grown.glb"), "--time", "1", "--quiet"]) == 0
    _, before = leaves_of(folder / "tree.glb")
    about, after = leaves_of(folder / "grown.glb")
    assert about["leaves"] == "seen"
    assert len(after) == pytest.approx(len(before), rel=0.3)
    assert np.quantile(cKDTree(before).query(after)[0], 0.95) < 0.15


def test_a_project_with_its_points_grows_with_leaves_where_they_were_seen(folder):
    cloud = laid(prepare(PointCloud(in_leaf(0.07, 2)[0]), up="y"))
    path = folder / "scan.sketchtree"
    write_undrawn(path, Document(cloud=cloud), options={"points": vars(CloudChoices(traced=True)), "leaf": "apple"})
    grows, _ = begun(path, None, seed=0, seed_chosen=False, season_chosen=False, reading=ReadingOptions(template="none"), tree=TreeOptions())
    assert grows.dress.leaf == "apple"
    assert cKDTree(OUTER).query(grows.leafing.place)[0].max() < REACH + 0.3


def test_at_another_height_they_go_with_the_wood(folder):
    asset = read_contents(folder / "tree.glb").asset
    tree = read_contents(folder / "tree.glb").skeleton
    own, twice = worn_before(asset.parts, tree), worn_before(asset.parts, tree, 2 * tree.height)
    assert np.ptp(twice.place, axis=0) == pytest.approx(2 * np.ptp(own.place, axis=0))


def test_a_file_without_leaves_says_nothing_of_where_they_were():
    assert worn_before((), TreeSkeleton.from_columns(np.array([-1, 0]), np.array([[0, 0, 0], [0, 1.0, 0]]), np.full(2, 0.1))) is None
