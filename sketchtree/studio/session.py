"""How does anyone with a page of the studio talk to it, a browser or a cell of a notebook?

    session = Session(engine, folder=folder)
    session.begin(document)
    page = session.join(send)             `send` takes text, or a binary frame; it may return something to await
    await session.take(page, request)     `request` is decoded (`messages.Request`), the first a `Hello`
    session.leave(page)
    await session.end()

Nothing here knows of HTTP. All is called on one event loop; `session.document` is the drawing at any time.
"""

import asyncio
import time
import traceback
from collections.abc import Awaitable, Callable

from sketchtree.editing.document import Document
from sketchtree.errors import SketchTreeError
from sketchtree.studio import messages
from sketchtree.studio.desk import Desk, Page, trouble_of
from sketchtree.studio.doing import FAULT, do
from sketchtree.studio.engine import Engine
from sketchtree.studio.folder import Folder
from sketchtree.studio.outbox import Outbox
from sketchtree.studio.recovery import Journal, Recovered

Send = Callable[[bytes | str], Awaitable[None] | None]


class Session:
    """One drawing, and all pages that show it."""

    def __init__(self, engine: Engine, *, folder: Folder | None = None, clock: Callable[[], float] = time.monotonic):
        self.desk = Desk(engine, Document(), folder=folder, clock=clock)

    def begin(self, document: Document | None = None, *, journal: Journal | None = None, recovered: Recovered | None = None, saved_as: str | None = None) -> None:
        """The first drawing: a recovered one, else `document`, else an empty page; `saved_as` names the file of the folder that holds it. The tree is made."""
        self.desk.begin(document, journal=journal, recovered=recovered, saved_as=saved_as)

    @property
    def document(self) -> Document:
        """The drawing now."""
        return self.desk.document

    @property
    def revision(self) -> int:
        """Rises with every step."""
        return self.desk.revision

    def join(self, send: Send) -> Page:
        """A page connects; a slow one gets the newest of each kind. It is told nothing before its `Hello`."""
        page = Page(Outbox(self.desk.whole, self.desk.engine.frame))
        page.sender = asyncio.get_running_loop().create_task(_send_all(page.outbox, send))
        page.sender.add_done_callback(lambda task: task.cancelled() or self._lost(page, task))
        return page

    async def take(self, page: Page, request: messages.Request) -> None:
        """Do what a page asks; what can't be done is told to it as `Trouble`. Returns when the page may ask for more."""
        await self.desk.ready.wait()
        try:
            await do(self.desk, page, request)
        except SketchTreeError as error:
            page.outbox.put(trouble_of(error))
        except Exception as error:  # noqa: BLE001 - whatever it is, the page must not lose its line, and say the same again when it has another
            traceback.print_exception(error)
            page.outbox.put(FAULT)
        await self.desk.scribe.room()
        await asyncio.sleep(0)  # what there is to send goes first

    def leave(self, page: Page) -> None:
        """It is gone."""
        self.desk.leave(page)

    def _lost(self, page: Page, task: asyncio.Task) -> None:
        """Sending failed: its connection is gone, or what was to be sent can't be; whoever reads from it ends it, and the page comes back by another."""
        error = task.exception()
        if not isinstance(error, ConnectionError):
            traceback.print_exception(error)
        self.desk.leave(page)

    async def end(self) -> None:
        """All is written, and the pages are let go."""
        await self.desk.end()


async def _send_all(outbox: Outbox, send: Send) -> None:
    """Send whatever waits, until the page is gone."""
    while True:
        sent = send(await outbox.next())
        if sent is not None:
            await sent
