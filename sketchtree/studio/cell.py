"""How does a cell of a notebook speak with a session? By messages of the widget, the same that go over the studio's WebSocket; pictures too, as there is no server.

    page → kernel   {say: request} · {fetch: number, path}      kernel → page   {say: event} · {frame: true} + bytes · {fetched: number} + bytes, or none

The session runs on a thread of its own, so that Python can wait for it while a cell runs. Engine processes are started when a page shows the widget, not before.
"""

import asyncio
import json
import re
import threading
from collections.abc import Callable
from typing import Any

import msgspec

from sketchtree.editing.document import Document
from sketchtree.studio import messages
from sketchtree.studio.desk import Page
from sketchtree.studio.doing import do
from sketchtree.studio.engine import Engine, Outcome
from sketchtree.studio.outbox import Outbox, encode
from sketchtree.studio.session import Session

_TEXTURE = re.compile(r"/texture/(?P<key>[\w.-]{1,120})/(?P<map>[a-z]{1,20})\.png")
_UNDERLAY = re.compile(r"/underlay/(?P<digest>[0-9a-f]{16,64})")
_CLOUD = re.compile(r"/cloud/(?P<digest>[0-9a-f]{16,64})")
_PATIENCE = 60.0  # seconds that Python waits for the session

Say = Callable[[dict, list[bytes]], None]


class LateEngine:
    """An engine that begins when a page shows its trees; until then it only keeps the newest drawing."""

    def __init__(self, engine: Engine):
        self.engine = engine
        self._awake = False
        self._newest: tuple[int, Document] | None = None

    def __getattr__(self, name: str) -> Any:
        return getattr(self.engine, name)

    @property
    def on_outcome(self) -> Callable[[Outcome], None]:
        """As `Engine.on_outcome`."""
        return self.engine.on_outcome

    @on_outcome.setter
    def on_outcome(self, told: Callable[[Outcome], None]) -> None:
        self.engine.on_outcome = told

    async def start(self) -> None:
        """As `Engine.start`; then the tree of the newest drawing is made."""
        await self.engine.start()
        self._awake = True
        if self._newest is not None:
            self.engine.trace(*self._newest)
            self.engine.grow(*self._newest)
            self.engine.make(*self._newest)

    def trace(self, revision: int, document: Document) -> None:
        """As `Engine.trace`; `make`, which comes after it, keeps the drawing until there is a page."""
        if self._awake:
            self.engine.trace(revision, document)

    def grow(self, revision: int, document: Document, *, at_once: bool = False) -> None:
        """As `Engine.grow`."""
        if self._awake:
            self.engine.grow(revision, document, at_once=at_once)

    def make(self, revision: int, document: Document) -> None:
        """As `Engine.make`."""
        if self._awake:
            self.engine.make(revision, document)
        else:
            self._newest = (revision, document)


class Cell:
    """One session and the page of its widget.

    `say` sends a message and its buffers to the page; `changed` is told every event that the page is told, as a dictionary. Both are called on the session's thread."""

    def __init__(self, make_engine: Callable[[], Engine], document: Document, say: Say, changed: Callable[[dict], None]):
        self._say, self._changed = say, changed
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._run, name="sketchtree-cell", daemon=True)
        self._thread.start()
        self._page: Page | None = None  # of the browser, from its first word
        self._session, self._own = self._do(self._begin(make_engine, document))

    @property
    def document(self) -> Document:
        """The drawing now."""
        return self._session.document

    @property
    def revision(self) -> int:
        """Rises with every step."""
        return self._session.revision

    def hear(self, content: Any) -> None:
        """A message of the page; what is none is answered with what is wrong with it."""
        asyncio.run_coroutine_threadsafe(self._hear(content), self._loop)

    def ask(self, request: messages.Request) -> None:
        """What Python asks, as a page would; returns when it is done. Raises SketchTreeError where it can't be."""
        self._do(do(self._session.desk, self._own, request))

    def end(self) -> None:
        """Away with session, engine and thread."""
        if not self._thread.is_alive():
            return
        self._do(self._end())
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join(_PATIENCE)

    # On the session's thread

    def _run(self) -> None:
        asyncio.set_event_loop(self._loop)
        self._loop.run_forever()
        self._loop.close()

    def _do(self, work) -> Any:
        return asyncio.run_coroutine_threadsafe(work, self._loop).result(_PATIENCE)

    async def _begin(self, make_engine: Callable[[], Engine], document: Document) -> tuple[Session, Page]:
        session = Session(LateEngine(make_engine()))
        session.begin(document)
        return session, Page(Outbox(session.desk.whole, session.desk.engine.frame), greeted=True)  # Python's own: it asks, and is told nothing

    async def _hear(self, content: Any) -> None:
        if isinstance(content, dict) and "fetch" in content:
            await self._fetch(content)
            return
        try:
            request = msgspec.convert(content["say"], messages.Request)
        except (msgspec.ValidationError, KeyError, TypeError) as error:
            self._tell(messages.Trouble(message=f"A message of the page can't be read: {error}.", remedy="Run the cell again.", about="message"))
            return
        if self._page is None:
            self._page = self._session.join(self._send)
            await self._session.desk.engine.start()
        await self._session.take(self._page, request)

    async def _fetch(self, content: dict) -> None:
        """A picture, by the path that it has in the studio."""
        path = str(content.get("path"))
        picture = None
        if found := _TEXTURE.fullmatch(path):
            picture = await self._session.desk.engine.texture(found["key"], found["map"])
        elif found := _UNDERLAY.fullmatch(path):
            picture = self._session.desk.pictures.get(found["digest"])
        elif (found := _CLOUD.fullmatch(path)) and (cloud := self._session.desk.clouds.get(found["digest"])):
            picture = cloud.points
        self._say({"fetched": content["fetch"]}, [] if picture is None else [picture])

    def _tell(self, event: messages.Event) -> None:
        self._send(encode(event))

    def _send(self, said: bytes | str) -> None:
        if isinstance(said, bytes):
            head = json.loads(said[4 : 4 + int.from_bytes(said[:4], "little")])
            self._say({"frame": True}, [said])
        else:
            head = json.loads(said)
            self._say({"say": head}, [])
        self._changed(head)

    async def _end(self) -> None:
        if self._page is not None:
            self._session.leave(self._page)
        await self._session.end()
        if self._page is not None:
            await self._session.desk.engine.stop()
