"""A tree in chunks is the tree."""

import dataclasses
import tempfile
from pathlib import Path

import numpy as np
import pytest

from sketchtree import pipeline
from sketchtree.geometry.wood import wood_of
from sketchtree.keys import root_key, stage_key
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.skeleton import Kind
from sketchtree.sketch.strokes import Sketch, Stroke
from sketchtree.studio import messages
from sketchtree.studio.making.chunks import chunks_of, owners
from sketchtree.studio.making.frames import Arrays, opened
from sketchtree.studio.making.limb_table import limb_table

KEY = root_key(0)


def _line(name, *points):
    return Stroke(name, np.array(points, float))


@pytest.fixture(scope="module")
def tree():
    """(drawn, leafy tree) of a trunk and two limbs."""
    sketch = Sketch((_line("trunk", (0, 0), (0, 100)), _line("left", (0, 40), (-30, 80)), _line("right", (0, 50), (30, 85))))
    drawn = pipeline.draw_out(sketch, key=KEY, options=ReadingOptions(template="none"))
    options = TreeOptions(generations=2)
    return drawn, pipeline.leafy(pipeline.Grown(drawn, pipeline.grow(drawn, options, key=KEY), KEY, options))


def test_every_row_belongs_to_the_drawn_limb_it_grows_on(tree):
    drawn, leafy = tree
    owner, skeleton = owners(leafy.skeleton), leafy.skeleton
    assert set(owner.tolist()) == set(drawn.settled.limbs)
    for row in np.flatnonzero(skeleton.kind == Kind.PROPAGATED):
        at = row
        while skeleton.kind[at] == Kind.PROPAGATED:
            at = skeleton.parent[at]
        assert owner[row] == skeleton.limb[at]


def test_all_chunks_together_are_the_wood_of_the_whole(tree):
    _, leafy = tree
    whole = wood_of(leafy.skeleton, bark=leafy.dress.bark, habit=leafy.dress.habit, key=stage_key(KEY, "mesh"), wood="tubes")
    chunks = chunks_of(leafy, key=KEY)
    assert chunks.triangles[0] == sum(mesh.triangle_count for mesh in whole.meshes)

    def sorted_corners(parts):
        corners = np.concatenate([position[index].reshape(-1, 9) for position, index in parts]).astype(np.float32)
        return corners[np.lexsort(corners.T)]

    pieces = [(part.arrays["position"][1], part.arrays["index"][1]) for chunk in chunks.chunks for part in chunk.wood]
    np.testing.assert_allclose(sorted_corners(pieces), sorted_corners([(mesh.position, mesh.triangle) for mesh in whole.meshes]), atol=1e-5)


def test_all_leaves_are_in_one_chunk_each(tree):
    _, leafy = tree
    cards = [part for chunk in chunks_of(leafy, key=KEY).chunks for part in chunk.leaves if "stem" not in part.wears]
    assert sum(len(part.arrays["place"][1]) for part in cards) == len(leafy.leaves)


def test_vertices_know_their_limbs(tree):
    _, leafy = tree
    names = {str(limb) for limb in leafy.skeleton.limb.tolist()}
    for chunk in chunks_of(leafy, key=KEY).chunks:
        for part in chunk.wood:
            assert set(part.limbs) <= names and part.arrays["limb"][1].max() < len(part.limbs)


def test_only_some_chunks_are_those_of_the_whole(tree):
    drawn, leafy = tree
    one = min(drawn.settled.limbs)
    (alone,) = chunks_of(leafy, key=KEY, only=[one]).chunks
    (same,) = (chunk for chunk in chunks_of(leafy, key=KEY).chunks if chunk.owner == one)
    assert alone.digest() == same.digest()


def test_a_frame_is_opened_as_it_was_packed():
    arrays = Arrays()
    arrays.put("a/path", "f4", np.arange(6).reshape(2, 3))
    arrays.put("b", "u1", np.array([1, 2, 255]))
    arrays.put("c", "i2", np.array([[-3, 4]]))
    head, found = opened(arrays.frame(messages.Ghost(revision=3, radius=[0.5], arrays=[])))
    assert head.revision == 3 and [one.offset % 8 for one in head.arrays] == [0, 0, 0]
    np.testing.assert_array_equal(found["a/path"], [[0, 1, 2], [3, 4, 5]])
    assert found["b"].tolist() == [1, 2, 255] and found["c"].tolist() == [[-3, 4]]


def test_the_table_of_limbs_says_where_each_runs(tree):
    drawn, _ = tree
    rows = {row.strokes[0]: row for row in limb_table(drawn)}
    assert set(rows) == {"trunk", "left", "right"}
    left = rows["left"]
    path = np.array(left.path).reshape(-1, 3)
    assert left.parent == rows["trunk"].id and left.share[0] == 0 and left.share[-1] == 1 and len(left.share) == len(path) == len(left.sd)
    tip = drawn.skeleton.tip[np.flatnonzero(drawn.skeleton.limb == int(left.id))[-1]]
    np.testing.assert_allclose(path[-1], tip)


def test_the_package_has_what_the_page_shows():
    from sketchtree.studio.making.gallery import catalogue
    from sketchtree.studio.making.textures import Textures, thumbnail
    from sketchtree.templates.store.database import Database

    templates = Database.open()
    welcome = catalogue(templates)
    for choices, what in ((welcome.templates, "template"), (welcome.leaves, "leaf"), (welcome.barks, "bark")):
        assert choices and thumbnail(what, choices[0].name, templates).startswith(b"\x89PNG")
    assert thumbnail("leaf", "../secret", templates) is None
    assert Textures().png("wood_oak", "color").startswith(b"\x89PNG") and Textures().png("leaf_oak.autumn", "color") and Textures().png("x", "color") is None


def test_a_project_keeps_the_picture_and_the_options():
    from sketchtree.editing.document import Document, Underlay
    from sketchtree.options import options_as_dict
    from sketchtree.photo.wanted import PhotoOptions
    from sketchtree.studio.making.documents import document_of
    from sketchtree.tree_output import Made, write_output

    strokes = {name: _line(name, *points) for name, points in (("trunk", [(0, 0), (0, 100)]), ("left", [(0, 40), (-30, 80)]))}
    document = Document(strokes, reading=ReadingOptions(template="none"), tree=TreeOptions(generations=0, leaf="none", season="autumn"), seed=4)
    drawn = pipeline.draw_out(document.sketch, key=KEY, options=document.reading)
    model = pipeline.complete(drawn, key=KEY, options=document.tree)
    underlay = Underlay(b"\x89PNG...", 1.0, 2.0, 30.0, 40.0, 0.3, photo=True)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "tree.sketchtree"
        photo = PhotoOptions(library=("I", "visible"), leaf_size=2.0, foliage="paper")
        write_output(model, path, Made(4, options_as_dict(document.reading, document.tree, photo)), underlay=underlay)
        again = document_of(path.read_bytes(), path.name)
    assert again.underlay == underlay and again.seed == 4 and again.tree == document.tree and again.reading == document.reading and again.name == "tree"
    assert again.photo == photo
    assert len(again.settled) == len(drawn.settled) and list(again.strokes) == ["trunk", "left"]


def test_mesh_files_that_a_project_names_are_not_opened_and_that_is_said(tmp_path):
    from sketchtree.studio.making.documents import document_of
    from sketchtree.tree_output import Made, write_output

    drawn = pipeline.draw_out(Sketch((_line("trunk", (0, 0), (0, 100)),)), key=KEY, options=ReadingOptions(template="none"))
    model = pipeline.complete(drawn, key=KEY, options=TreeOptions(generations=0, leaf="none"))
    write_output(model, tmp_path / "tree.sketchtree", Made(0, {"obstacle": ["rock.obj"], "prune": ["y<4", "outside:hole.ply"], "wood": "tubes"}))
    again = document_of((tmp_path / "tree.sketchtree").read_bytes(), "tree.sketchtree")
    assert again.tree.prune == ("y<4",) and again.tree.obstacle == () and again.tree.wood == "tubes"
    assert again.sketch.warnings == tuple(
        f"The studio opens no file that a project names: the tree is made without {name}. `sketchtree build` takes it." for name in ("rock.obj", "outside:hole.ply")
    )
