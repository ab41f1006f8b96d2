"""The tree of scribbles on the photo under the page: the very tree that the project of the drawing tells."""

import dataclasses
import io

import numpy as np
import pytest
from PIL import Image

from sketchtree.editing.document import Document, Underlay
from sketchtree.errors import SketchError
from sketchtree.sketch.strokes import Stroke, StrokeKind
from sketchtree.studio import messages
from sketchtree.studio.making.frames import opened
from sketchtree.studio.making.photo_asked import Wish
from sketchtree.studio.making.trunk_asked import TrunkWish
from sketchtree.studio.making.trunk_bench import TrunkBench
from sketchtree.studio.wire import choose
from sketchtree.templates.store.database import Database
from sketchtree.trunk.wanted import TrunkChoices
from sketchtree.watch import Watch
from tests.trunk.painted_tree import SIZE, painted_tree

AT = (100.0, 50.0, 40.0, 50.0)
PICTURE = painted_tree()


def brush(kind: StrokeKind, line, width: float = 3.0) -> Stroke:
    """A scribble along pixels of the photo, on the page."""
    return Stroke(kind.value, np.array(line, float) * (0.5, -0.5) + AT[:2], kind, labelled=True, width=width / 2)


SAID = (brush(StrokeKind.FOREGROUND, [(40, 92), (40, 20)]), brush(StrokeKind.BACKGROUND, [(5, 60), (5, 95), (30, 96)]))


def drawn(*strokes: Stroke, **choices) -> Document:
    under = Underlay(PICTURE, *AT, photo=True)
    return Document({stroke.id: stroke for stroke in strokes}, underlay=under, trunk=TrunkChoices(**{"on": True, "levels": 1} | choices))


class Bench:
    """A bench, and what it told."""

    def __init__(self):
        self.bench, self.told = TrunkBench(Database.open()), []
        self.bench.bench.read("bare", PICTURE)

    def frame(self, document: Document):
        self.told = []
        return opened(self.bench.frame(3, TrunkWish.of(document, "bare"), self.told.append, Watch())[0])


@pytest.fixture(scope="module")
def bench():
    return Bench()


def test_the_matte_is_told_first_then_the_trunk_then_the_tree(bench):
    head, _ = bench.frame(drawn(*SAID))
    assert [type(one) for one in bench.told] == [messages.Matte, messages.Trunks] and {one.revision for one in (head, *bench.told)} == {3}
    assert head.phase == "photo" and head.segments > 50
    (limbs,), (ring,) = bench.told[1].trees, bench.told[1].vertices
    xy = np.array(limbs.xy).reshape(-1, 2)
    assert (np.array(limbs.parent) < np.arange(len(xy))).all() and limbs.parent.count(-1) == 1
    foot = xy[limbs.parent.index(-1)]
    assert np.abs(foot - (AT[0] + 20, -AT[1] + 48)).max() < 2 and np.abs(np.array(head.root) - foot).max() < 2  # page units, y down
    assert len(ring) % 2 == 0 and max(ring) <= 100  # pixels


def test_pages_are_told_the_contour_that_its_vertices_lie_on(bench):
    bench.frame(drawn(*SAID, levels=0))
    told = bench.told[1]
    (ring,), (vertices,), (parts,) = told.contour, told.vertices, told.parts
    line, points = np.array(ring).reshape(-1, 2), np.array(vertices).reshape(-1, 2)
    assert told.size == list(SIZE) and len(parts) == len(points) < len(line) < 200
    ends = np.roll(line, -1, axis=0) - line
    along = np.clip(((points[:, None] - line) * ends).sum(-1) / (ends**2).sum(-1), 0, 1)
    assert np.linalg.norm(points[:, None] - line - along[..., None] * ends, axis=-1).min(axis=1).max() < 0.5
    assert sum(parts) >= 3  # a tip, a limb to the left, one to the right


def test_the_matte_is_as_opaque_as_the_tree(bench):
    import base64

    bench.frame(drawn(*SAID, levels=0))
    alpha = np.asarray(Image.open(io.BytesIO(base64.b64decode(bench.told[0].png))))[..., 1]
    assert alpha.shape == SIZE[::-1] and alpha[70, 40] > 240 and alpha[70, 10] < 15


def test_only_other_scribbles_ask_for_another_matte(bench):
    bench.frame(drawn(*SAID, levels=0))
    before = bench.bench.matte
    painted = bench.frame(drawn(*SAID, brush(StrokeKind.MATTE_ERASE, [(34, 56), (10, 26)], 14.0), levels=0, vertices=20))
    assert bench.bench.matte is before
    assert painted[0].low[0] > bench.frame(drawn(*SAID, levels=0))[0].low[0]
    bench.frame(drawn(*SAID, brush(StrokeKind.BACKGROUND, [(75, 60), (75, 95)]), levels=0))
    assert bench.bench.matte is not before


def test_more_levels_are_more_branches(bench):
    assert bench.frame(drawn(*SAID, levels=0))[0].segments < bench.frame(drawn(*SAID, levels=2))[0].segments


def test_scribbles_of_one_side_tell_no_tree(bench):
    with pytest.raises(SketchError, match="has no background line. Draw a line beside the tree"):
        bench.frame(drawn(SAID[0]))
    with pytest.raises(SketchError, match="needs scribbles"):
        bench.frame(drawn())


def test_a_photo_grows_one_tree_only():
    crown = Stroke("crown", np.array([(110.0, 10.0), (130.0, 10.0), (120.0, 40.0)]), StrokeKind.CROWN, labelled=True, closed=True)
    limb = Stroke("limb", np.array([(120.0, 2.0), (120.0, 40.0)]), labelled=True)
    document = drawn(crown, limb, *SAID)
    assert TrunkWish.of(document, "bare") is not None and Wish.of(document, "bare") is None
    other = document.replace(trunk=TrunkChoices())
    assert TrunkWish.of(other, "bare") is None and Wish.of(other, "bare") is not None


def test_the_same_is_wanted_while_nothing_that_it_hangs_on_changes():
    document = drawn(*SAID)
    key = TrunkWish.of(document, "bare").key
    assert TrunkWish.of(document.replace(name="other"), "bare").key == key
    for other in (choose(document, {"season": "autumn"}), document.replace(trunk=dataclasses.replace(document.trunk, gap=9.0)), document.replace(seed=2)):
        assert TrunkWish.of(other, "bare").key != key
