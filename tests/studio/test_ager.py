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
from sketchtree.studio.growth import Ageing, Ager, Grown, Held, Whose

DRAWING = Document(strokes={"trunk": Stroke("trunk", np.array([[0.0, 0.0], [0.0, 9.0]]))})


class OneHand:
    """A process that answers when it is told to."""

    def __init__(self):
        self.asked, self.stops, self.ends, self.begun, self.hears = [], 0, 0, 0, None

    async def made(self, *asked, hears=None):
        answer = asyncio.get_running_loop().create_future()
        self.asked.append((asked, answer))
        self.hears = hears
        try:
            return await answer
        except asyncio.CancelledError:
            self.stops += 1
            raise

    def ready(self):
        self.begun = self.begun or 1

    @property
    def newest(self):
        return len(self.asked) - 1

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
    task = asyncio.create_task(ager.made(Whose.drawn(document), Ageing(**ageing)))
    await asyncio.sleep(0.001)
    return task


def test_the_same_growth_is_made_once():
    async def scene(hand, ager):
        task = await begun(ager, bend=5)
        hand.asked[0][1].set_result(b"glb")
        (kind, document, *how), _ = hand.asked[0]
        assert await task == b"glb" and (kind, document.strokes, how) == ("age", DRAWING.strokes, ["full", 5.0])
        named = DRAWING.replace(name="another name")
        assert await ager.made(Whose.drawn(named), Ageing(bend=5)) == b"glb" and len(hand.asked) == 1

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


def test_a_tree_that_stands_elsewhere_is_fetched_once_for_all_ways_to_grow():
    async def scene(hand, ager):
        fetched = []

        async def fetch(tell):
            fetched.append(tell("propagate", 0.5))
            return b"standing"

        for number, mode in enumerate(("full", "age")):
            told = []
            whose = Whose(Held("elm", object()), fetch)
            task = asyncio.create_task(ager.made(whose, Ageing(mode=mode), lambda stage, done: told.append((stage, round(done, 3)))))
            await asyncio.sleep(0.001)
            if number == 0:
                assert hand.asked[-1][0] == ("stand", "tree 1", b"standing")
                hand.asked[-1][1].set_result(None)
                await asyncio.sleep(0.001)
            hand.hears(("working", "grow", 0.5))
            assert hand.asked[-1][0] == ("age", "tree 1", mode, 0.0)
            hand.asked[-1][1].set_result(b"glb")
            assert await task == b"glb" and told[-1] == ("grow", 0.7) and told[0] == (("propagate", 0.2), ("grow", 0.7))[number]
        assert len(fetched) == 1
        hand.begun += 1  # another process knows of nothing
        task = asyncio.create_task(ager.made(whose, Ageing(mode="scale")))
        await asyncio.sleep(0.001)
        assert len(fetched) == 2 and hand.asked[-1][0][0] == "stand"
        task.cancel()

    play(scene)


def test_trees_are_the_same_while_what_they_hang_on_is():
    one, same, other = Whose.drawn(DRAWING).key, Whose.drawn(DRAWING.replace(name="x")).key, Whose.drawn(DRAWING.replace(seed=3)).key
    assert one == same != other


def test_files_to_keep_are_made_each_time_and_the_growth_of_the_page_stays():
    async def scene(hand, ager):
        task = await begun(ager)
        hand.asked[0][1].set_result(b"glb")
        await task
        for film, kind in ((False, "moving"), (True, "film")):
            task = asyncio.create_task(ager.files(Whose.drawn(DRAWING), "oak.usd", Grown(mode="age", seconds=4.0, lod=2), film=film))
            await asyncio.sleep(0.001)
            (said, _, *how), answer = hand.asked[-1]
            assert (said, how) == (kind, ["oak.usd", "age", 0.0, 4.0, 2])
            answer.set_result({"oak.usd": b"usd"})
            assert await task == {"oak.usd": b"usd"}
        assert await ager.made(Whose.drawn(DRAWING), Ageing()) == b"glb" and len(hand.asked) == 3

    play(scene)


def test_an_empty_page_has_no_growth():
    async def scene(hand, ager):
        with pytest.raises(SketchError, match="There is no tree that could grow.") as refused:
            await ager.made(Whose.drawn(Document()), Ageing())
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
    assert (answer.status_code, answer.content, answer.headers["content-type"]) == (200, b"drawn age -12.5", "model/gltf-binary")
    assert int(answer.headers["x-revision"]) == 2


def test_a_tree_that_can_not_grow_says_why(own, monkeypatch):
    async def refuses(self, document, growing, tell):
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
