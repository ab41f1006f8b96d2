"""Who makes the trees? Three processes, so that a stroke never waits for the whole tree, nor the whole tree for an export.

    quick    what was touched, in a hurry; the stroke in hand
    full     the whole tree, and its undrawn limbs when one is picked
    side     everything else: pictures, other readings, glances, files in and out

Each begins when it is first needed, and is begun again should it end. The newest request wins; a hurried answer goes before the full tree of the same revision.
"""

import asyncio
import dataclasses
import multiprocessing
import sys
import threading
import traceback
from collections.abc import Callable
from pathlib import Path

from sketchtree.editing.document import Document
from sketchtree.editing.settled import Settled
from sketchtree.errors import SketchTreeError
from sketchtree.studio import messages
from sketchtree.studio.engine import Outcome

_ROLES = ("quick", "full", "side")
_SMALL, _LINES = 1_000_000, (".svg", ".json", ".excalidraw", ".inkml")  # bytes, and kinds, of drawings that are read at once
_PAUSE = 0.1  # seconds between two tellings of how far a stage is


class Hand:
    """One process, as the event loop sees it."""

    def __init__(self, role: str, database: Path | None, tell: Callable[[int, object], None]):
        self.role, self._database, self._tell = role, database, tell
        self._loop = asyncio.get_running_loop()
        self._waiting: dict[int, asyncio.Future] = {}
        self._number, self._pipe, self._process = 0, None, None

    def begin(self) -> None:
        """Start the process."""
        context = multiprocessing.get_context("spawn")
        self._pipe, theirs = context.Pipe()
        from sketchtree.studio.making.worker import main

        self._process = context.Process(target=main, args=(theirs, None if self._database is None else str(self._database), self.role), daemon=True)
        self._process.start()
        theirs.close()
        threading.Thread(target=self._listen, args=(self._pipe,), daemon=True).start()

    @property
    def runs(self) -> bool:
        """Whether the process is there."""
        return self._process is not None and self._process.is_alive()

    def ready(self) -> None:
        """Start the process, unless it runs."""
        if not self.runs:
            self.begin()

    def ask(self, kind: str, *arguments: object) -> tuple[int, asyncio.Future]:
        """(the job's number, its answer to be). None is answered to a job that was stopped."""
        self.ready()
        self._number += 1
        answer = self._loop.create_future()
        self._waiting[self._number] = answer
        try:
            self._pipe.send((self._number, kind, arguments))
        except (BrokenPipeError, OSError):
            self._ended()
        return self._number, answer

    def stop(self) -> None:
        """Let what runs end, and drop what waits, of kinds of which the newest wins."""
        if self.runs:
            self._pipe.send((self._number, "stop", ()))

    def end(self) -> None:
        """End the process."""
        if self._process is not None:
            self._process.kill()
            self._process.join(2)

    def _listen(self, pipe) -> None:
        try:
            while True:
                number, what, value = pipe.recv()
                self._loop.call_soon_threadsafe(self._came, number, what, value)
        except (EOFError, OSError, RuntimeError):
            try:
                self._loop.call_soon_threadsafe(self._ended)
            except RuntimeError:
                pass  # the loop is closed: the studio ends

    def _came(self, number: int, what: str, value: object) -> None:
        if what == "event":
            self._tell(number, value)
            return
        answer = self._waiting.pop(number, None)
        if answer is None or answer.done():
            return
        if what == "trouble":
            message, remedy, stroke = value
            error = SketchTreeError(message, remedy=remedy)
            error.stroke = stroke
            answer.set_exception(error)
        elif what == "fault":
            print(value, file=sys.stderr)
            answer.set_exception(Fault("Something went wrong in the program.", remedy="Undo the last step; the terminal that runs the studio has the details."))
        else:
            answer.set_result(value if what == "done" else None)

    def _ended(self) -> None:
        """The process is gone; what was asked of it can be asked again."""
        waiting, self._waiting, self._process = self._waiting, {}, None
        for answer in waiting.values():
            if not answer.done():
                answer.set_exception(Fault("A process that makes the tree ended.", remedy="It is begun again with the next step."))


class Fault(SketchTreeError):
    """A fault of ours."""


class Crew:
    """The engine of the studio (`engine.Engine`)."""

    def __init__(self, database: Path | None = None):
        self.on_outcome: Callable[[Outcome], None] = lambda outcome: None
        self._database = database
        self._hands: dict[str, Hand] = {}
        self._tasks: set[asyncio.Task] = set()
        self._known: dict[str, str] = {}  # owner → digest of the chunk that the pages have
        self._basis = None
        self._revision, self._full_number, self._glancing = 0, 0, False
        self._told = (0.0, "")
        self._catalogue: messages.Welcome | None = None

    async def start(self) -> None:
        """Begin the processes."""
        self._loop = asyncio.get_running_loop()
        for role in _ROLES:
            self._hands[role] = Hand(role, self._database, self._event if role == "full" else lambda number, value: None)
        for role in ("side", "full"):  # the quick one begins when there is a tree to hurry after
            self._hands[role].begin()

    async def stop(self) -> None:
        """End all processes."""
        for task in self._tasks:
            task.cancel()
        for hand in self._hands.values():
            hand.end()

    def make(self, revision: int, document: Document) -> None:
        """As `Engine.make`."""
        self._revision, document = revision, document.replace(underlay=None)  # no tree hangs on the picture, which may be large
        self._hands["full"].stop()
        self._say(messages.Working(state="working", revision=revision, stage="read"))
        self._run(self._make(revision, document))

    async def _make(self, revision: int, document: Document) -> None:
        if not document.strokes:
            self._nothing(revision)
            return
        if self._hands["quick"].runs:
            document = await self._hurry(revision, document)
        if revision != self._revision:
            return
        self._full_number, answer = self._hands["full"].ask("full", revision, document, dict(self._known))
        try:
            found = await answer
        except SketchTreeError as error:
            self._trouble(revision, error)
            return
        if found is None or revision != self._revision:
            return
        frame, digests, basis = found
        self._known, self._basis = digests, basis
        self._hands["quick"].ready()
        self.on_outcome(Outcome(revision, frame, settled=basis.settled))
        self._say(messages.Working(state="idle", revision=revision))

    async def _hurry(self, revision: int, document: Document) -> Document:
        """What was touched, first; returns the document with what that settled for now: the full tree begins there."""
        _, answer = self._hands["quick"].ask("quick", revision, document, self._basis)
        try:
            found = await answer
        except SketchTreeError:
            return document  # the full tree says what is wrong
        if found is None or revision != self._revision:
            return document
        frame, digests, settled = found
        self._known |= digests
        if self._basis is not None:
            self._basis = dataclasses.replace(self._basis, owners=tuple(dict.fromkeys((*self._basis.owners, *digests))), settled=settled)
        self.on_outcome(Outcome(revision, frame))
        return document.replace(settled=dataclasses.replace(settled, manner=document.settled.manner))

    def refresh(self) -> None:
        """A page that joins asks for `frame` itself."""

    async def frame(self) -> bytes | None:
        """As `Engine.frame`."""
        if self._basis is None:
            return None
        return await self._hands["full"].ask("frame")[1]

    def ghost(self, revision: int, document: Document, stroke: messages.Stroke | None, hold: messages.Hold | None) -> None:
        """As `Engine.ghost`."""
        self._run(self._shown(revision, self._hands["quick"].ask("ghost", revision, document.replace(underlay=None), stroke, hold, self._basis)[1]))

    def glance(self, revision: int, document: Document | None) -> None:
        """As `Engine.glance`."""
        if document is None:
            self._hands["side"].stop()
            if self._glancing:
                self._run(self._back(revision))
        else:
            self._run(self._glance(revision, document))

    async def _glance(self, revision: int, document: Document) -> None:
        answer = self._hands["side"].ask("glance", revision, document.replace(underlay=None), {})[1]
        await self._shown(revision, answer, glance=True)

    async def _back(self, revision: int) -> None:
        """The tree itself again, after a glance."""
        self._glancing = False
        frame = await self.frame()
        if frame is not None and not self._glancing:
            self.on_outcome(Outcome(revision, frame))

    async def _shown(self, revision: int, answer: asyncio.Future, glance: bool = False) -> None:
        try:
            frame = await answer
        except SketchTreeError:
            return
        if frame is not None and revision == self._revision:
            self._glancing |= glance
            self.on_outcome(Outcome(revision, frame))

    async def alternatives(self, revision: int, document: Document) -> tuple[messages.Alternatives, list[Settled]]:
        """As `Engine.alternatives`."""
        found = await self._hands["side"].ask("alternatives", revision, document.replace(underlay=None))[1]
        return found if found is not None else (messages.Alternatives(revision=revision, readings=[]), [])

    def cancel(self) -> None:
        """As `Engine.cancel`."""
        for hand in self._hands.values():
            hand.stop()
        self._say(messages.Working(state="idle", revision=self._revision))

    async def find(self, document: Document, limb: int):
        """As `Engine.find`."""
        return await self._hands["full"].ask("find", limb)[1]

    async def read(self, data: bytes, name: str) -> Document:
        """As `Engine.read`. Small drawings of lines are read here, on a thread: they are there before any other process is."""
        if len(data) < _SMALL and Path(name).suffix.lower() in _LINES:
            from sketchtree.studio.making.documents import document_of

            return await asyncio.to_thread(document_of, data, name)
        return await self._hands["side"].ask("read", data, name)[1]

    async def export(self, document: Document, name: str, options: dict) -> dict[str, bytes]:
        """As `Engine.export`."""
        return await self._hands["side"].ask("export", document, name, options)[1]

    async def project(self, document: Document) -> bytes:
        """As `Engine.project`."""
        return await self._hands["side"].ask("project", document)[1]

    async def texture(self, key: str, kind: str) -> bytes | None:
        """As `Engine.texture`."""
        return await self._hands["side"].ask("texture", key, kind)[1]

    async def picture(self, what: str, name: str) -> bytes | None:
        """As `Engine.picture`."""
        return await self._hands["side"].ask("picture", what, name)[1]

    async def catalogue(self) -> messages.Welcome:
        """As `Engine.catalogue`."""
        if self._catalogue is None:
            self._catalogue = await self._hands["side"].ask("catalogue")[1]
        return self._catalogue

    def _nothing(self, revision: int) -> None:
        """There is no stroke: no tree."""
        from sketchtree.studio.making.frames import Arrays

        self._known, self._basis = {}, None
        head = messages.Tree(
            revision=revision, phase="full", scale=1.0, root=[0.0, 0.0], owners=[], chunks=[], cards=[], materials=[], limbs=[], segments=0, drawn=0, leaves=0,
            triangles=[0, 0], height=0.0, low=[0.0] * 3, high=[0.0] * 3, template=None, leaf=None, bark="", warnings=[], arrays=[],
        )  # fmt: skip
        self.on_outcome(Outcome(revision, Arrays().frame(head), settled=Settled()))
        self._say(messages.Working(state="idle", revision=revision))

    def _trouble(self, revision: int, error: SketchTreeError) -> None:
        if revision != self._revision:
            return
        about = "program" if isinstance(error, Fault) else "drawing"
        self.on_outcome(Outcome(revision, messages.Trouble(message=error.message, remedy=error.remedy, stroke=getattr(error, "stroke", None), about=about)))
        self._say(messages.Working(state="error", revision=revision))

    def _event(self, number: int, value: object) -> None:
        """What the full tree's worker tells on its way."""
        if number != self._full_number:
            return
        if value[0] == "event":
            self.on_outcome(Outcome(self._revision, value[1]))
            return
        _, stage, done = value
        now = self._loop.time()
        if stage != self._told[1] or now - self._told[0] >= _PAUSE:
            self._told = now, stage
            self._say(messages.Working(state="working", revision=self._revision, stage=stage, done=min(max(float(done), 0.0), 1.0)))

    def _say(self, event: messages.Event) -> None:
        self.on_outcome(Outcome(self._revision, event))

    def _run(self, work) -> None:
        task = self._loop.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._finished)

    def _finished(self, task: asyncio.Task) -> None:
        self._tasks.discard(task)
        if not task.cancelled() and task.exception() is not None:
            traceback.print_exception(task.exception(), file=sys.stderr)
