"""Pages are told while strokes over points would wait: from when a cloud is asked for until both processes have what they need."""

import asyncio
import contextlib

from talking import talking
from test_grower import IdleHand

from sketchtree.studio import crew as crewing
from sketchtree.studio import messages
from sketchtree.studio.crew import Crew
from sketchtree.studio.engine import Outcome


class Role(IdleHand):
    """A process of a crew that says what a test says."""

    def __init__(self, role, database, tell, ended=lambda: None):
        super().__init__()
        self.role, self.tell, self.ended, self.runs = role, tell, ended, False

    def ready(self):
        super().ready()
        self.runs = True

    def warm(self):
        ((number, _, _),) = self.jobs("expect_points")
        self.tell(number, ("warm",))


async def opened(monkeypatch) -> tuple[Crew, list[bool]]:
    """A crew that reads a cloud, and all it says of getting ready."""
    monkeypatch.setattr(crewing, "Hand", Role)
    crew, told = Crew(), []
    crew.on_outcome = lambda outcome: told.append(outcome.event.on) if isinstance(outcome.event, messages.Warming) else None
    await crew.start()
    with contextlib.suppress(TimeoutError):
        await asyncio.wait_for(crew.read(b"ply\n", "scan.ply"), 0.01)  # nobody answers
    return crew, told


def test_it_begins_with_the_file_before_its_points_are_read_and_ends_with_the_second_process(monkeypatch):
    async def test():
        crew, told = await opened(monkeypatch)
        assert told == [True]
        crew._hands["full"].warm()
        assert told == [True]
        crew._hands["quick"].warm()
        assert told == [True, False]
        await crew.stop()

    asyncio.run(test())


def test_a_process_that_ends_makes_nobody_wait(monkeypatch):
    async def test():
        crew, told = await opened(monkeypatch)
        crew._hands["full"].warm()
        crew._hands["quick"].ended()
        assert told == [True, False]
        await crew.stop()

    asyncio.run(test())


def test_a_page_that_joins_later_is_told_as_well():
    async def test():
        async with talking() as talk:
            talk.desk.on_outcome(Outcome(1, messages.Warming(on=True)))
            late = type(talk)(talk.session)
            await late.say(messages.Hello(version=messages.VERSION))
            assert late.last("warming") == {"type": "warming", "on": True}

    asyncio.run(test())
