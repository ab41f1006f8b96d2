"""A page of a session without a network: what it says is given to the session, what it is told is kept."""

import asyncio
import json
from contextlib import asynccontextmanager

from fake_engine import FakeEngine

from sketchtree.editing.document import Document
from sketchtree.studio import messages
from sketchtree.studio.session import Session


class Talk:
    """One page."""

    def __init__(self, session: Session):
        self.session, self.told = session, []
        self.page = session.join(self.told.append)

    async def say(self, *requests: messages.Request) -> None:
        """Say these, and hear all that comes of them."""
        for request in requests:
            await self.session.take(self.page, request)
        await self.hear()

    async def hear(self) -> None:
        await asyncio.gather(*(task for task in self.session.desk.tasks if task.get_name() == "file"), return_exceptions=True)
        await self.session.desk.scribe.rest()
        for _ in range(20):
            await asyncio.sleep(0)

    def all(self, kind: str) -> list[dict]:
        """Everything told of one kind, as the page decodes it."""
        events = [json.loads(one) for one in self.told if isinstance(one, str)]
        return [event for event in events if event["type"] == kind]

    def last(self, kind: str) -> dict:
        return self.all(kind)[-1]

    def strokes(self) -> list[str]:
        """Ids of the strokes that the page has, as its store keeps them (`page/src/store.ts`)."""
        known: dict[str, None] = {}
        for event in self.all("changed"):
            if event["since"] == 0:
                known = {}
            for name in event["gone"]:
                known.pop(name, None)
            known |= {stroke["id"]: None for stroke in event["put"]}
            if event["order"] is not None:
                known = {name: None for name in event["order"] if name in known}
        return list(known)


class Clock:
    """Stands still until it is set."""

    def __init__(self):
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


@asynccontextmanager
async def talking(document: Document | None = None, *, engine: FakeEngine | None = None, **options):
    """A session with one page that has said hello."""
    engine, clock = engine or FakeEngine(), Clock()
    begin = {name: options.pop(name) for name in ("journal", "recovered", "saved_as") if name in options}
    session = Session(engine, clock=clock, **options)
    session.begin(document, **begin)
    talk = Talk(session)
    talk.engine, talk.clock, talk.desk = engine, clock, session.desk
    await talk.say(messages.Hello(version=messages.VERSION))
    yield talk
    await session.end()


def stroke(name: str, *xy: float, **fields) -> messages.Stroke:
    return messages.Stroke(id=name, kind=fields.pop("kind", "branch"), xy=list(xy) or [0.0, 0.0, 10.0, -20.0], **fields)


def drawn(*names: str, gone: tuple[str, ...] = (), label: str = "branch") -> messages.Strokes:
    return messages.Strokes(label=label, put=[stroke(name) for name in names], gone=list(gone))
