"""What is stopped stays stopped, whenever that is said; and whoever waits is told."""

import asyncio
import json
import random

import pytest
from acting_hands import ActingHand

from sketchtree.editing.document import Document
from sketchtree.sketch.strokes import Stroke
from sketchtree.studio import crew, messages
from sketchtree.studio.crew import Crew

DOCUMENT = Document({"a": Stroke("a", [[0, 0], [0, 10]])})


class Watched:
    """A crew of played processes, and what it told."""

    def __init__(self, monkeypatch, seed: int = 0):
        monkeypatch.setattr(crew, "Hand", ActingHand)
        monkeypatch.setattr(ActingHand, "chance", random.Random(seed))
        self.crew, self.states, self.trees, self.troubles = Crew(), [], [], []
        self.crew.on_outcome = self._told

    def _told(self, outcome) -> None:
        event = outcome.event
        if isinstance(event, messages.Working):
            self.states.append(event.state)
        elif isinstance(event, messages.Trouble):
            self.troubles.append(event)
        elif isinstance(event, bytes):
            head = json.loads(event[4 : 4 + int.from_bytes(event[:4], "little")])
            self.trees.append((head["phase"], head["revision"]))

    async def made(self, revision: int, document: Document = DOCUMENT) -> None:
        self.crew.make(revision, document)
        await self.rest()

    async def rest(self) -> None:
        for _ in range(100):
            await asyncio.sleep(0)


@pytest.mark.parametrize("ticks", range(24))
def test_work_that_is_stopped_at_any_time_ends_and_its_last_word_is_that_it_rests(ticks, monkeypatch):
    async def test():
        for seed in range(12):
            watched = Watched(monkeypatch, seed)
            await watched.crew.start()
            await watched.made(1)
            asked, ask = [], watched.crew._hands["full"].ask
            watched.crew._hands["full"].ask = lambda kind, *arguments, asked=asked, ask=ask: (asked.append(kind), ask(kind, *arguments))[1]
            watched.crew.make(2, DOCUMENT.replace(seed=2))
            for _ in range(ticks):
                await asyncio.sleep(0)
            before = len(asked)
            watched.crew.cancel()
            await watched.rest()
            assert watched.states[-1] == "idle" and len(asked) == before, "the whole tree was begun after it was stopped"
            await watched.made(3)
            assert watched.states[-1] == "idle" and watched.trees[-1] == ("full", 3)
            await watched.crew.stop()

    asyncio.run(test())


def test_drawings_that_come_at_once_are_one_job_of_the_last(monkeypatch):
    async def test():
        watched = Watched(monkeypatch)
        await watched.crew.start()
        await watched.made(1)
        asked, ask = [], watched.crew._hands["full"].ask
        watched.crew._hands["full"].ask = lambda kind, *arguments: (asked.append((kind, arguments[0])), ask(kind, *arguments))[1]
        for revision in (2, 3, 4):
            watched.crew.make(revision, DOCUMENT.replace(seed=revision))
        await watched.rest()
        assert asked == [("full", 4)] and watched.states[-1] == "idle" and watched.trees[-1] == ("full", 4)
        await watched.crew.stop()

    asyncio.run(test())


def test_a_fault_where_the_tree_is_told_is_said_and_nobody_waits_for_ever(monkeypatch, capsys):
    async def test():
        watched = Watched(monkeypatch)
        await watched.crew.start()
        told = watched.crew.on_outcome

        def failing(outcome):
            if isinstance(outcome.event, bytes):
                raise RuntimeError("cannot tell")
            told(outcome)

        watched.crew.on_outcome = failing
        await watched.made(1)
        assert watched.states[-1] == "error" and watched.troubles[-1].about == "program"
        watched.crew.on_outcome = told
        await watched.made(2)
        assert watched.states[-1] == "idle" and watched.trees == [("full", 2)]
        await watched.crew.stop()

    asyncio.run(test())
    assert "cannot tell" in capsys.readouterr().err


@pytest.mark.parametrize("role", ["quick", "full", "side"])
def test_a_process_that_ends_is_named_in_the_terminal(role, monkeypatch, capsys):
    async def test():
        watched = Watched(monkeypatch)
        await watched.crew.start()
        await watched.made(1)
        ActingHand.all[role].kill()
        await watched.rest()
        assert watched.states[-1] == "idle"
        await watched.crew.stop()

    asyncio.run(test())
    assert capsys.readouterr().err == f"A process of the studio ended ({role}). It is begun again when it is needed; nothing of the drawing is lost.\n"
