"""When the tree of scribbles is made: a moment after the last of them, never twice alike, and it goes when it is taken otherwise."""

import asyncio

import numpy as np
import pytest
from aside_scene import AsideScene, no_pauses_of, played_in

from sketchtree.editing.document import Document, Underlay
from sketchtree.errors import SketchError
from sketchtree.sketch.strokes import Stroke, StrokeKind
from sketchtree.studio import messages, trunker as making
from sketchtree.studio.laid_photo import LaidPhoto
from sketchtree.studio.trunker import Trunker
from sketchtree.trunk.wanted import TrunkChoices

ONE = {"a": Stroke("a", np.array([(1.0, 1.0), (1.0, 9.0)]), StrokeKind.FOREGROUND, labelled=True, width=2.0)}
TWO = ONE | {"b": Stroke("b", np.array([(5.0, 1.0), (5.0, 9.0)]), StrokeKind.BACKGROUND, labelled=True, width=2.0)}
UNDER = Underlay(b"\x89PNG" + bytes(40), 0.0, 0.0, 10.0, 10.0, photo=True)


def drawn(strokes, on: bool = True) -> Document:
    return Document(strokes, underlay=UNDER, trunk=TrunkChoices(on=on))


@pytest.fixture(autouse=True)
def no_pauses(monkeypatch):
    no_pauses_of(monkeypatch, making)


class Scene(AsideScene):
    """A trunker, and all that it told."""

    def __init__(self):
        super().__init__(lambda hand, *more: Trunker(hand, LaidPhoto(), *more), "trunk")

    async def answer(self, frame=b"frame"):
        number, _, answer = self.hand.jobs("trunk")[-1]
        if isinstance(frame, Exception):
            answer.set_exception(frame)
        else:
            self.maker.heard(number, ("event", messages.Matte(revision=self.revision, png=frame.decode())))
            answer.set_result((frame, {}))
        await self.rest()


def played(of):
    played_in(Scene, of)


def test_it_is_made_once_and_shown():
    async def play(scene):
        await scene.draw(drawn(TWO))
        await scene.answer()
        assert scene.states == ["waits", "grows", "ready"] and [one.event for one in scene.told if one.of_photo] == [b"frame"]
        await scene.draw(drawn(TWO))
        assert scene.made == 1 and scene.states[-1] == "ready"

    played(play)


def test_the_newest_wins_and_what_comes_of_an_older_one_is_not_told():
    async def play(scene):
        await scene.draw(drawn(ONE))
        await scene.draw(drawn(TWO))
        assert (scene.made, scene.hand.stops) == (2, 1)
        scene.hand.jobs("trunk")[0][2].set_result((b"old", {}))
        scene.maker.heard(scene.hand.jobs("trunk")[0][0], ("event", messages.Matte(revision=1, png="old")))
        await scene.answer(b"new")
        assert [one.event for one in scene.told if one.of_photo] == [b"new"] and [one.png for one in scene.all(messages.Matte)] == ["new"]

    played(play)


def test_undone_at_once_what_lies_over_the_photo_is_that_of_the_tree_shown():
    async def play(scene):
        await scene.draw(drawn(ONE))
        await scene.answer(b"one")
        await scene.draw(drawn(TWO))
        scene.maker.heard(scene.hand.jobs("trunk")[-1][0], ("event", messages.Matte(revision=2, png="two")))
        await scene.draw(drawn(ONE))
        assert [(one.revision, one.png) for one in scene.all(messages.Matte)] == [(1, "one"), (2, "two"), (3, "one")]
        assert scene.made == 2 and scene.states[-1] == "ready"

    played(play)


def test_what_can_not_be_made_says_why_and_is_not_tried_again():
    async def play(scene):
        await scene.draw(drawn(ONE))
        await scene.answer(SketchError("It has no background line.", remedy="Draw one."))
        assert (scene.states[-1], scene.all(messages.Trunks)[-1].remark) == ("failed", "It has no background line. Draw one.")
        await scene.draw(drawn(ONE))
        assert scene.made == 1
        await scene.draw(drawn(ONE), at_once=True)
        assert scene.made == 2

    played(play)


def test_what_is_stopped_is_not_made_until_it_is_asked_for():
    async def play(scene):
        await scene.draw(drawn(TWO))
        scene.maker.stop()
        await scene.draw(drawn(TWO))
        assert (scene.made, scene.states[-1]) == (1, "stopped")
        await scene.draw(drawn(TWO), at_once=True)
        assert scene.made == 2

    played(play)


def test_a_matte_that_does_not_stop_ends_with_its_process_and_the_newer_scribbles_are_asked_again(monkeypatch):
    monkeypatch.setattr(making, "_PATIENCE", 0.02)

    async def play(scene):
        await scene.draw(drawn(ONE))
        begun = scene.hand.begun
        await scene.draw(drawn(TWO))
        await asyncio.sleep(0.05)
        assert scene.hand.begun == begun + 1 and scene.made == 3
        assert scene.hand.jobs("trunk")[-1][1][1].strokes == tuple(TWO.values())
        await scene.answer(b"two")
        assert [one.event for one in scene.told if one.of_photo] == [b"two"]

    played(play)


def test_a_matte_that_ends_in_time_keeps_its_process(monkeypatch):
    monkeypatch.setattr(making, "_PATIENCE", 0.02)

    async def play(scene):
        await scene.draw(drawn(ONE))
        begun = scene.hand.begun
        scene.hand.stop = lambda: scene.hand.jobs("trunk")[0][2].set_result(None)
        await scene.draw(drawn(TWO))
        await asyncio.sleep(0.05)
        assert scene.hand.begun == begun and scene.made == 2

    played(play)


def test_files_and_growth_of_what_no_scribble_tells_are_refused():
    async def play(scene):
        with pytest.raises(SketchError) as refused:
            await scene.maker.files(drawn(TWO, on=False), "tree.glb", {})
        assert str(refused.value) == "No scribbles tell a tree yet. Draw along its trunk, and beside it."
        assert scene.maker.whose(drawn(TWO)).key == scene.maker.whose(drawn(TWO)).key != scene.maker.whose(drawn(ONE)).key

    played(play)


def test_it_goes_when_the_tree_is_taken_otherwise_and_nothing_is_told_of_a_plain_drawing():
    async def play(scene):
        await scene.draw(drawn(TWO, on=False))
        await scene.draw(Document(ONE))
        assert scene.told == [] and scene.hand.asked == {}
        await scene.draw(drawn(TWO))
        await scene.draw(drawn(TWO, on=False))
        assert scene.all(messages.Matte)[-1].png == "" and scene.all(messages.Trunks)[-1].state == scene.states[-1] == "none"

    played(play)
