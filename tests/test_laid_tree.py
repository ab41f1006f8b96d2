"""The tree that stands in the points behind a drawing: the same in the studio, of a project, and as strokes."""

import json

import numpy as np
import pytest

import sketchtree as st
from sketchtree.clouds.files.write_cloud import write_cloud
from sketchtree.commands.app import run
from sketchtree.drawn_tree import draw_out
from sketchtree.editing.document import Document
from sketchtree.editing.edits import Edits
from sketchtree.editing.laid_cloud import CloudChoices, laid
from sketchtree.editing.project import laid_cloud
from sketchtree.editing.settled import MEASURED
from sketchtree.errors import SketchError
from sketchtree.export.skeletons.hdf5 import write_undrawn
from sketchtree.laid_tree import Laid, as_strokes, read_laid, tree_of
from sketchtree.limb_ids import stroke_limb_id
from sketchtree.options import ReadingOptions
from sketchtree.sketch.files.project import holds_cloud, holds_traced
from tests.studio.scanned_stick import LIMBS, stick


@pytest.fixture(scope="module")
def cloud():
    return stick()


@pytest.fixture(scope="module")
def traced(cloud):
    return tree_of(Laid(cloud), None, key=st.root_key(0))


def test_the_traced_tree_is_as_high_as_its_points_metres(cloud, traced):
    assert traced.skeleton.height == pytest.approx(cloud.height, rel=0.03)


def test_another_height_stretches_the_points(cloud):
    twice = Laid(cloud, ReadingOptions(height=2 * cloud.height))
    assert twice.stretch == pytest.approx(2) and twice.scale == pytest.approx(2 / cloud.unit)


def test_its_stoutest_limbs_become_strokes_as_wide_as_the_wood_where_they_lie_on_the_page(cloud, traced):
    strokes, settled = as_strokes(traced, Laid(cloud))
    trunk = next(iter(strokes.values()))
    assert trunk.id == "trunk" and trunk.wood and trunk.width == pytest.approx(2 * 0.15 * cloud.unit, rel=0.2)
    tips = np.array([[*stroke.points[-1], settled.limbs[stroke_limb_id(name)].depth[-1]] for name, stroke in strokes.items()]) / cloud.unit
    for _, tip, _ in LIMBS:
        assert np.linalg.norm(tips - tip, axis=1).min() < 0.2
    assert settled.asked == MEASURED


def test_each_stroke_stands_on_one_before_it(cloud, traced):
    strokes, settled = as_strokes(traced, Laid(cloud))
    before = {None}
    for name in strokes:
        assert settled.limbs[stroke_limb_id(name)].parent in before
        before.add(stroke_limb_id(name))


def test_drawn_from_them_the_limbs_stay_where_the_points_are(cloud, traced):
    strokes, settled = as_strokes(traced, Laid(cloud))
    drawn = draw_out(st.Sketch(tuple(strokes.values())), key=st.root_key(0), options=ReadingOptions(template="none"), edits=Edits(), settled=settled, cloud=cloud)
    assert not drawn.touched
    assert drawn.similarity.scale == pytest.approx(1 / cloud.unit)
    near = np.linalg.norm(drawn.skeleton.tip[:, None] - cloud.cloud.xyz[None, ::5], axis=2).min(axis=1)
    assert near.max() < 0.35


def project(tmp_path, cloud, **choices):
    path = tmp_path / "scan.sketchtree"
    write_undrawn(path, Document(cloud=cloud), options={"points": vars(CloudChoices(**choices)), "template": "auto"})
    return path


def test_a_project_keeps_the_points(tmp_path, cloud):
    path = project(tmp_path, cloud, traced=True)
    assert holds_cloud(path) and holds_traced(path)
    assert laid_cloud(path) == cloud


def test_a_project_whose_tree_is_traced_is_traced_again(tmp_path, cloud):
    assert read_laid(project(tmp_path, cloud, traced=True)).cloud == cloud
    assert read_laid(project(tmp_path, cloud, traced=False)) is None


def test_points_that_are_damaged_are_said_to_be(tmp_path, cloud):
    import h5py

    path = project(tmp_path, cloud)
    with h5py.File(path, "a") as file:
        del file["cloud"].attrs["unit"]
    with pytest.raises(SketchError, match=r"^The points behind the drawing of scan.sketchtree can't be read \(.*unit.*\). Open an older copy of it.$"):
        laid_cloud(path)


def test_build_traces_a_project_and_says_so(tmp_path, cloud, capsys):
    path = project(tmp_path, cloud, traced=True)
    assert run(["build", str(path), "-o", str(tmp_path / "tree.swc"), "--report", str(tmp_path / "tree.json"), "--quiet"]) == 0
    assert json.loads((tmp_path / "tree.json").read_text())["cloud"]["points"] == len(cloud)
    assert run(["infer", str(path), "-o", str(tmp_path / "x.swc")]) == 2
    told = capsys.readouterr().err
    assert "The tree of scan.sketchtree is traced in the points behind its drawing, and `infer` reads drawings. `sketchtree build scan.sketchtree -o TREE.glb` makes its tree." in told


def test_build_takes_points_that_a_drawing_was_drawn_over(tmp_path, cloud, traced, capsys):
    drawing, points = tmp_path / "drawn.json", tmp_path / "scan.ply"
    strokes, _ = as_strokes(traced, Laid(cloud))
    st.write_sketch_json(st.Sketch(tuple(strokes.values())[:3]), drawing)
    write_cloud(cloud.cloud, points)
    assert run(["build", str(drawing), "-o", str(tmp_path / "t.sketchtree"), "--points", str(points), "--template", "none", "--method", "elevation", "--quiet"]) == 0
    assert len(laid_cloud(tmp_path / "t.sketchtree")) == len(cloud)
    assert run(["build", str(drawing), "-o", str(tmp_path / "t.swc"), "--tree", "2"]) == 2
    assert "`--tree 2` says which tree of a point cloud, and none is given. Add `--points CLOUD`, or leave it out." in capsys.readouterr().err
