"""One tree that is made aside (`studio.made_aside`), with a process that does what a test says, and all that was told."""

import asyncio

from test_grower import IdleHand

from sketchtree.editing.document import Document
from sketchtree.studio import messages


class AsideScene:
    """`make(hand, tell, run)` gives the maker; `job` is what it asks its process for."""

    def __init__(self, make, job: str):
        self.hand, self.told, self.revision, self.job = IdleHand(), [], 0, job
        self.maker = make(self.hand, self.told.append, lambda work: asyncio.get_running_loop().create_task(work))

    async def draw(self, document: Document, **more):
        self.revision += 1
        self.maker.make(self.revision, document, **more)
        await self.rest()

    async def rest(self):
        for _ in range(10):
            await asyncio.sleep(0.001)

    def all(self, kind):
        return [outcome.event for outcome in self.told if isinstance(outcome.event, kind)]

    @property
    def states(self):
        return [event.state for event in self.all(messages.Growing)]

    @property
    def frames(self):
        return [outcome.event for outcome in self.told if outcome.of_photo]

    @property
    def made(self):
        return len(self.hand.jobs(self.job))


def no_pauses_of(monkeypatch, making) -> None:
    """Its pauses are none, so that a test waits for nothing."""
    for name in ("_REST", "_PAUSE"):
        monkeypatch.setattr(making, name, 0.0)


def played_in(scene, of) -> None:
    """Play `of` in a scene that begins in a loop of its own."""

    async def run():
        await of(scene())

    asyncio.run(run())
