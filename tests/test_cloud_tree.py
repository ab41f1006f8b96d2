"""A point cloud in, the tree that stands in it out."""

import json
import sys
from pathlib import Path

import jsonschema
import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parent / "clouds"))
from scanned import LENGTH, bark

from sketchtree.cloud_report import cloud_report
from sketchtree.cloud_tree import CloudOptions, CloudSource, cloud_to_tree
from sketchtree.clouds.cloud import PointCloud
from sketchtree.errors import OptionError
from sketchtree.fidelity.scan_distance import mesh_to_scan, scan_to_mesh
from sketchtree.keys import root_key
from sketchtree.options import TreeOptions
from sketchtree.skeleton import Kind

KEY = root_key(0)


@pytest.fixture(scope="module")
def points():
    return bark(0.02, noise=0.002)


@pytest.fixture(scope="module")
def tree(points):
    return cloud_to_tree(PointCloud(points), key=KEY)


def test_its_surfaces_lie_where_the_points_are(tree):
    xyz = tree.prepared.cloud.xyz
    there, back = scan_to_mesh(xyz, tree.model.meshes), mesh_to_scan(tree.model.meshes, xyz, key=KEY)
    assert there.share < 0.005 and there.within(0.015) > 0.95
    assert back.share < 0.01


def test_it_has_the_length_and_the_thickness_of_the_true_one(tree):
    assert tree.skeleton.length.sum() == pytest.approx(LENGTH, rel=0.06)
    assert tree.trunks[0].root == pytest.approx(0.24, rel=0.1)
    assert tree.skeleton.radius[tree.skeleton.is_base][0] == pytest.approx(0.12, rel=0.15)


def test_it_stands_at_the_origin_and_was_observed(tree):
    base = tree.skeleton.tip[tree.skeleton.is_base]
    assert np.linalg.norm(base[0]) < 0.1
    assert (tree.skeleton.kind[: tree.seen] == int(Kind.OBSERVED)).all()


def test_a_cloud_with_z_up_gives_the_same_tree(points, tree):
    lying = np.stack([points[:, 0], -points[:, 2], points[:, 1]], axis=1)
    found = cloud_to_tree(PointCloud(lying), key=KEY)
    assert found.prepared.placement.up == "z"
    assert found.skeleton.height == pytest.approx(tree.skeleton.height, abs=0.02)


def test_a_tree_grows_toward_the_points_where_that_is_wanted(points):
    found = cloud_to_tree(PointCloud(points), key=KEY, wanted=CloudOptions(method="grown"), tree=TreeOptions(leaf="none"))
    assert (found.skeleton.kind == int(Kind.GROWN)).all()
    assert found.pieces is None
    assert found.skeleton.height == pytest.approx(4.1, abs=0.2)


def test_twigs_of_photos_go_on_beyond_their_points(points, tree):
    found = cloud_to_tree(PointCloud(points), key=KEY, wanted=CloudOptions(pixel=0.01))
    assert found.seen == tree.seen < len(found.skeleton)
    assert found.skeleton.length[: tree.seen] == pytest.approx(tree.skeleton.length[: tree.seen])
    assert (found.skeleton.kind[found.seen :] == int(Kind.GROWN)).all()


def _longer(found, placement):
    """A twig that the points don't show, half a metre off its highest tip, in the frame of the photos."""
    assert placement.to_file(found.tip).shape == found.tip.shape
    end = int(found.tip[:, 1].argmax())
    more = {"parent": np.array([end]), "tip": found.tip[[end]] + [[0.35, 0.35, 0.0]], "radius": np.array([0.004])}
    return found.append(more | {name: getattr(found, name)[[end]] for name in ("limb", "order", "tree", "kind")})


def test_twigs_that_photos_show_are_followed_there_and_not_reckoned(points, tree):
    found = cloud_to_tree(PointCloud(points), key=KEY, wanted=CloudOptions(pixel=0.01), follow=_longer)
    assert found.followed and (found.skeleton.kind == int(Kind.OBSERVED)).all() and found.seen == len(found.skeleton)
    assert found.skeleton.height == pytest.approx(tree.skeleton.height + 0.35, abs=0.01)
    assert found.skeleton.length.sum() == pytest.approx(tree.skeleton.length.sum() + 0.35 * 2**0.5, abs=0.05)


def test_a_bare_crown_that_photos_see_into_is_not_filled(points, monkeypatch):
    monkeypatch.setattr("sketchtree.cloud_tree.unseen_inside", lambda xyz: True)
    scanned, pictured = (cloud_to_tree(PointCloud(points), key=KEY, follow=follow).skeleton for follow in (None, lambda tree, placement: tree))
    assert (scanned.kind == int(Kind.GROWN)).any() and not (pictured.kind == int(Kind.GROWN)).any()


def test_a_tree_grows_toward_what_was_followed_too(points):
    wanted = CloudOptions(method="grown", pixel=0.01)
    plain, found = (cloud_to_tree(PointCloud(points), key=KEY, wanted=wanted, tree=TreeOptions(leaf="none"), follow=follow) for follow in (None, _longer))
    assert len(found.toward) > len(plain.toward) == len(points)
    assert found.skeleton.height > plain.skeleton.height + 0.1


def test_the_source_gives_the_skeleton(points, tree):
    assert CloudSource()(PointCloud(points), key=KEY).tip == pytest.approx(tree.skeleton.tip)


def test_the_report_keeps_the_schema(tree):
    schema = json.loads((Path(__file__).parents[1] / "sketchtree" / "report.schema.json").read_text(encoding="utf-8"))
    report = cloud_report(tree, command="cloud", seed=0, seconds={}, options={})
    jsonschema.validate(report, schema)
    assert report["cloud"]["feet"][0]["diameter"]["root"] == pytest.approx(0.24, rel=0.1)
    assert report["segments"]["stems"] == 1


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"method": "guessed"}, "There is no method called 'guessed'. Choose one of: traced, grown."),
        ({"points": 3}, "`--points 3` is out of range. Give 100 to 10,000,000."),
        ({"species": "beech"}, "No species 'beech' is known for growth toward points. Choose one of: "),
    ],
)
def test_choices_that_make_no_sense_are_refused(options, message):
    with pytest.raises(OptionError) as caught:
        CloudOptions(**options)
    assert str(caught.value).startswith(message)
