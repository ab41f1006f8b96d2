"""When the tree in a photo grows: after a pause, never twice alike, and not any more once it is stopped."""

import asyncio
from contextlib import asynccontextmanager

import painted_photo as painted
import pytest

from sketchtree.errors import SketchError
from sketchtree.studio import grower as growing
from sketchtree.studio import messages
from sketchtree.studio.grower import Grower, Seen
from sketchtree.studio.laid_photo import LaidPhoto
from sketchtree.studio.wire import choose

PICTURE = b"\x89PNG" + bytes(40)
CROWN, TRUNK, LEFT = painted.mark("crown", painted.CROWN, crown=True), painted.mark("trunk", painted.TRUNK), painted.mark("left", painted.LEFT)


class IdleHand:
    """A process that answers when it is told to."""

    def __init__(self):
        self.begun, self.asked, self.stops = 0, {}, 0

    def ready(self):
        self.begun = self.begun or 1

    def begin(self):
        self.begun += 1
        for _, _, answer in self.asked.values():
            answer.cancel()

    def ask(self, kind, *arguments):
        answer = asyncio.get_running_loop().create_future()
        self.asked[len(self.asked)] = kind, arguments, answer
        return len(self.asked) - 1, answer

    async def made(self, kind, *arguments, hears=None):
        return await self.ask(kind, *arguments)[1]

    def stop(self):
        self.stops += 1

    def end(self):
        pass

    def waits_for(self, number):
        return not self.asked[number][2].done()

    def jobs(self, kind):
        return [(number, arguments, answer) for number, (its, arguments, answer) in self.asked.items() if its == kind]


class Scene:
    """A grower whose pauses are over at once, and all that it told."""

    def __init__(self):
        self.hand, self.laid, self.told = IdleHand(), LaidPhoto(), []
        self.tasks = []
        self.grower = Grower(self.hand, self.laid, self.told.append, lambda work: self.tasks.append(asyncio.get_running_loop().create_task(work)))
        self.revision = 0

    async def draw(self, *strokes, seen=True, remark="", **options):
        self.document = choose(painted.document(*strokes, picture=PICTURE), options)
        await self.go_on(seen=seen, remark=remark)

    async def go_on(self, *, seen=True, remark="", **more):
        self.revision += 1
        self.grower.make(self.revision, self.document, **more)
        if seen:
            self.grower.seen(Seen(self.laid.lay(self.document), {"crown": b"foliage"}, remark))
        await self.rest()

    async def rest(self):
        for _ in range(10):
            await asyncio.sleep(0.001)

    async def answer(self, frame=b"frame", textures=None):
        number, _, answer = self.hand.jobs("grow")[-1]
        answer.set_exception(frame) if isinstance(frame, Exception) else answer.set_result((frame, textures or {}))
        await self.rest()

    @property
    def states(self):
        return [outcome.event.state for outcome in self.told if isinstance(outcome.event, messages.Growing)]

    @property
    def frames(self):
        return [outcome.event for outcome in self.told if outcome.of_photo]

    @property
    def grown(self):
        """How many growths were begun."""
        return len(self.hand.jobs("grow"))


@pytest.fixture(autouse=True)
def no_pauses(monkeypatch):
    for name in ("_REST", "_PAUSE"):
        monkeypatch.setattr(growing, name, 0.0)
    monkeypatch.setattr(growing, "_PATIENCE", 100.0)


@asynccontextmanager
async def scene():
    yield Scene()


def test(*, of):
    async def run():
        async with scene() as made:
            await of(made)

    asyncio.run(run())


test.__test__ = False


def test_it_grows_once_crown_trunk_and_foliage_are_known():
    async def it(scene):
        await scene.draw(CROWN)
        await scene.draw(TRUNK)
        assert scene.states == [] and scene.grown == 0 and scene.hand.begun == 0
        await scene.draw(CROWN, TRUNK, seen=False)
        assert scene.states == ["waits"] and scene.grown == 0 and scene.hand.begun == 1
        await scene.go_on()
        assert scene.states == ["waits", "grows"] and scene.hand.jobs("photo")[0][1] == (scene.laid.digest, PICTURE)
        assert scene.hand.jobs("grow")[0][1][2] == {"crown": b"foliage"}
        await scene.answer(textures={("bark", "color"): b"brown"})
        assert scene.states[-1] == "ready" and scene.frames == [b"frame"] and scene.grower.textures == {("bark", "color"): b"brown"}

    test(of=it)


def test_what_is_as_it_was_is_not_grown_again():
    async def it(scene):
        await scene.draw(CROWN, TRUNK)
        await scene.go_on()
        assert scene.grown == 1
        await scene.answer()
        await scene.go_on()
        await scene.draw(CROWN, TRUNK, density=2.0)  # of the drawing's tree alone
        assert scene.grown == 1 and scene.states[-1] == "ready"
        await scene.draw(CROWN, TRUNK, leaf_size=2.0)
        assert scene.grown == 2

    test(of=it)


def test_another_stroke_ends_what_grows_and_the_tree_that_is_shown_stays_meanwhile():
    async def it(scene):
        await scene.draw(CROWN, TRUNK)
        await scene.answer()
        await scene.draw(CROWN, TRUNK, LEFT)
        await scene.draw(CROWN, LEFT, TRUNK)
        assert scene.grown == 3 and scene.hand.stops == 1 and "none" not in scene.states
        scene.hand.jobs("grow")[1][2].set_result((b"too late", {}))
        await scene.answer(b"newest")
        assert scene.frames == [b"frame", b"newest"]

    test(of=it)


def test_what_was_stopped_grows_again_when_asked_for_or_when_it_is_another():
    async def it(scene):
        await scene.draw(CROWN, TRUNK)
        scene.grower.stop()
        await scene.rest()
        assert scene.states[-1] == "stopped" and scene.hand.stops == 1
        await scene.go_on()
        assert scene.grown == 1 and scene.states[-1] == "stopped"
        await scene.go_on(at_once=True)
        assert scene.grown == 2 and scene.states[-1] == "grows"
        scene.grower.stop()
        await scene.draw(CROWN, TRUNK, LEFT)
        assert scene.grown == 3 and scene.states[-1] == "grows"

    test(of=it)


def test_a_growth_that_does_not_end_when_it_is_stopped_is_ended_with_its_process(monkeypatch):
    monkeypatch.setattr(growing, "_PATIENCE", 0.0)

    async def it(scene):
        await scene.draw(CROWN, TRUNK)
        assert scene.hand.begun == 1
        scene.grower.stop()
        await scene.rest()
        assert scene.hand.begun == 2 and scene.states[-1] == "stopped"
        await scene.draw(CROWN, LEFT)
        await scene.draw(CROWN, TRUNK, LEFT)
        assert scene.hand.begun == 3 and scene.states[-1] == "grows"
        await scene.answer(b"asked again")
        assert scene.frames == [b"asked again"]

    test(of=it)


def test_why_it_can_not_grow_is_said():
    async def it(scene):
        await scene.draw(CROWN, TRUNK, remark="There is no foliage inside it.")
        assert scene.grown == 0 and scene.told[-1].event.remark == "There is no foliage inside it."
        await scene.draw(CROWN, LEFT)
        await scene.answer(SketchError("No trunk.", remedy="Draw one."))
        assert scene.states[-1] == "failed" and scene.told[-1].event.remark == "No trunk. Draw one."

    test(of=it)


def test_without_a_crown_the_tree_is_gone():
    async def it(scene):
        await scene.draw(CROWN, TRUNK)
        await scene.answer()
        await scene.draw(TRUNK)
        assert scene.states[-1] == "none"
        with pytest.raises(SketchError, match="There is no tree in the photo yet."):
            await scene.grower.files(scene.document, "tree.glb", {})

    test(of=it)
