"""The tree as it grows: made aside, once for the same wish, and not any more when nobody wants it."""

import asyncio
import json

import numpy as np
import pytest
from fake_engine import FakeEngine
from running import running

from sketchtree.editing.document import Document
from sketchtree.errors import SketchError
from sketchtree.sketch.strokes import Stroke
from sketchtree.studio import growth
from sketchtree.studio.growth import Ageing, Ager

DRAWING = Document(strokes={"trunk": Stroke("trunk", np.array([[0.0, 0.0], [0.0, 9.0]]))})


class OneHand:
    """A process that answers when it is told to."""

    def __init__(self):
        self.asked, self.stops, self.ends = [], 0, 0

    def ask(self, kind, document, mode, bend):
        answer = asyncio.get_running_loop().create_future()
        self.asked.append(((kind, mode, bend), answer))
        return len(self.asked) - 1, answer

    def stop(self):
        self.stops += 1

    def end(self):
        self.ends += 1

    def waits_for(self, number):
        return number == len(self.asked) - 1


def play(scene):
    """The scene, with a hand and an ager."""

    async def run():
        hand = OneHand()
        ager = Ager(lambda: hand)
        try:
            await scene(hand, ager)
        finally:
            ager.end()

    asyncio.run(run())


async def begun(ager, document=DRAWING, **ageing):
    task = asyncio.create_task(ager.made(document, Ageing(**ageing)))
    await asyncio.sleep(0.001)
    return task


def test_the_same_growth_is_made_once():
    async def scene(hand, ager):
        task = await begun(ager, bend=5)
        hand.asked[0][1].set_result(b"glb")
        assert await task == b"glb" and hand.asked[0][0] == ("age", "full", 5.0)
        named = DRAWING.replace(name="another name")
        assert await ager.made(named, Ageing(bend=5)) == b"glb" and len(hand.asked) == 1

    play(scene)


def test_another_mode_or_drawing_is_made_anew():
    async def scene(hand, ager):
        for number, (document, mode) in enumerate([(DRAWING, "full"), (DRAWING, "age"), (DRAWING.replace(seed=3), "age")]):
            task = await begun(ager, document, mode=mode)
            assert len(hand.asked) == number + 1
            hand.asked[number][1].set_result(bytes([number]))
            assert await task == bytes([number])

    play(scene)


def test_what_is_not_wanted_any_more_ends_and_the_next_is_made():
    async def scene(hand, ager):
        task = await begun(ager)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task
        assert hand.stops == 1
        task = await begun(ager, mode="scale")
        hand.asked[1][1].set_result(b"next")
        assert await task == b"next"

    play(scene)


def test_a_making_that_does_not_stop_is_ended_with_its_process(monkeypatch):
    monkeypatch.setattr(growth, "_PATIENCE", 0.0)

    async def scene(hand, ager):
        task = await begun(ager)
        task.cancel()
        await asyncio.wait([task])
        await asyncio.sleep(0.01)
        assert hand.ends == 1

    play(scene)


def test_it_is_forgotten_when_nobody_asks_for_a_while(monkeypatch):
    monkeypatch.setattr(growth, "_FORGETS", 0.01)

    async def scene(hand, ager):
        task = await begun(ager)
        await asyncio.sleep(0.03)
        assert hand.ends == 0, "not while it is made"
        hand.asked[0][1].set_result(b"glb")
        await task
        await asyncio.sleep(0.05)
        assert hand.ends == 1
        await begun(ager)
        assert len(hand.asked) == 2

    play(scene)


def test_an_empty_page_has_no_growth():
    async def scene(hand, ager):
        with pytest.raises(SketchError, match="There is no tree that could grow.") as refused:
            await ager.made(Document(), Ageing())
        assert refused.value.remedy == "Draw a trunk first."

    play(scene)


@pytest.fixture
def own(tmp_path, monkeypatch):
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path / "shelf"))
    with running(tmp_path) as server:
        yield server


def test_a_page_gets_it_as_a_glb_of_a_revision(own):
    own.post("/upload?name=tree.svg", b"<svg/>")
    answer = own.post("/growth", json.dumps({"mode": "age", "bend": -12.5}))
    assert (answer.status_code, answer.content, answer.headers["content-type"]) == (200, b"age -12.5", "model/gltf-binary")
    assert int(answer.headers["x-revision"]) == 2


def test_a_tree_that_can_not_grow_says_why(own, monkeypatch):
    async def refuses(self, document, ageing):
        raise SketchError("There is no tree that could grow.", remedy="Draw a trunk first.")

    monkeypatch.setattr(FakeEngine, "aged", refuses)
    answer = own.post("/growth", "{}")
    assert (answer.status_code, answer.json()) == (422, {"message": "There is no tree that could grow.", "remedy": "Draw a trunk first."})


@pytest.mark.parametrize("said", ["", '{"mode": "x"}', '{"bend": 61}', '{"x": 1}', "[]"])
def test_a_wish_that_is_none_is_refused(own, said):
    answer = own.post("/growth", said)
    assert answer.status_code == 400 and answer.json()["message"].startswith("How the tree is to grow can't be read: ")


def test_a_growth_is_for_pages_of_the_studio_alone(own):
    assert own.post("/growth", "{}", Origin="http://evil.example").status_code == 403
