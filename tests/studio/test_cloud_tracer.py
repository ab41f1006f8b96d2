"""When the tree in the points behind a drawing is traced: once it is asked for, never twice alike, and it goes when the tree is that of the strokes again."""

import numpy as np
import pytest
from aside_scene import AsideScene, no_pauses_of, played_in

from sketchtree.editing.document import Document
from sketchtree.editing.laid_cloud import CloudChoices, LaidCloud
from sketchtree.errors import SketchError
from sketchtree.options import TreeOptions
from sketchtree.sketch.strokes import Stroke
from sketchtree.studio import cloud_tracer as making
from sketchtree.studio.cloud_tracer import CloudTracer

CLOUD = LaidCloud(np.arange(30, dtype="<f4").tobytes(), False, 0.0, 0.0, 10.0)


def drawn(traced: bool = True, **fields) -> Document:
    return Document(cloud=CLOUD, points=CloudChoices(traced=traced), **fields)


@pytest.fixture(autouse=True)
def no_pauses(monkeypatch):
    no_pauses_of(monkeypatch, making)


class Scene(AsideScene):
    """A tracer, and all that it told."""

    def __init__(self):
        super().__init__(CloudTracer, "points")

    async def answer(self, frame=b"frame"):
        answer = self.hand.jobs("points")[-1][2]
        answer.set_exception(frame) if isinstance(frame, Exception) else answer.set_result((frame, {("bark", "color"): b"png"}))
        await self.rest()


def played(of):
    played_in(Scene, of)


def test_nothing_is_traced_before_it_is_asked_for():
    async def test(scene):
        await scene.draw(drawn(traced=False))
        await scene.draw(Document())
        assert scene.made == 0 and scene.told == []

    played(test)


def test_it_is_traced_and_shown_with_what_it_wears():
    async def test(scene):
        await scene.draw(drawn())
        await scene.answer()
        assert scene.states == ["waits", "grows", "ready"] and scene.frames == [b"frame"]
        assert scene.maker.textures == {("bark", "color"): b"png"}

    played(test)


def test_strokes_are_none_of_its_business_but_what_it_wears_is():
    async def test(scene):
        await scene.draw(drawn())
        await scene.answer()
        await scene.draw(drawn(strokes={"a": Stroke("a", np.array([(0.0, 0), (0, 9)]))}))
        assert scene.made == 1 and scene.states[-1] == "ready"
        await scene.draw(drawn(tree=TreeOptions(season="autumn")))
        assert scene.made == 2 and scene.states[-1] == "grows"

    played(test)


def test_it_goes_when_the_tree_is_that_of_the_strokes_again():
    async def test(scene):
        await scene.draw(drawn())
        await scene.answer()
        await scene.draw(drawn(traced=False))
        await scene.draw(drawn(traced=False))
        assert scene.states[-1] == "none" and scene.states.count("none") == 1

    played(test)


def test_what_went_wrong_is_said_and_not_tried_again_by_itself():
    async def test(scene):
        await scene.draw(drawn())
        await scene.answer(SketchError("Only 3 points of the cloud may be a tree.", remedy="Give a cloud with more points."))
        said = scene.told[-1].event
        assert (said.state, said.remark) == ("failed", "Only 3 points of the cloud may be a tree. Give a cloud with more points.")
        await scene.draw(drawn())
        assert scene.made == 1
        await scene.draw(drawn(), at_once=True)
        assert scene.made == 2

    played(test)


def test_a_stop_ends_it_until_it_is_asked_for_again():
    async def test(scene):
        await scene.draw(drawn())
        scene.maker.stop()
        await scene.draw(drawn())
        assert scene.states[-1] == "stopped" and scene.made == 1 and scene.frames == []

    played(test)


def test_files_of_a_tree_that_is_not_traced_are_refused():
    async def test(scene):
        with pytest.raises(SketchError, match="^No tree is traced in the points. Trace it first.$"):
            await scene.maker.files(drawn(traced=False), "tree.glb", {})

    played(test)
