"""How is the studio there at once? What was made at an earlier start is taken from the stock: pictures, the list of what there is to choose from, and the tree of a drawing
that is opened as it was.

Such a tree is the very answer that was given for the same drawing by the same program. It is shown first; the engine makes it again all the same, since it goes on from
there, and sends what should have come out differently. Pictures that have to be made wait for the first tree.
"""

import asyncio
import hashlib
import shutil
from collections.abc import Callable
from typing import Any

import msgspec

from sketchtree.editing.document import Document
from sketchtree.editing.settled import Settled
from sketchtree.studio import examples, journal_lines, messages
from sketchtree.studio.crew import Crew
from sketchtree.studio.engine import Outcome
from sketchtree.studio.kept_tree import KeptTree, is_whole
from sketchtree.studio.stock import Stock


class Stocked:
    """An engine (`engine.Engine`): a crew, and what it made before."""

    def __init__(self, crew: Crew, stock: Stock):
        self.on_outcome: Callable[[Outcome], None] = lambda outcome: None
        self._crew, self._stock = crew, stock
        crew.on_outcome = self._came
        self._document = Document()
        self._missed: tuple[int, str] | None = None  # revision and name of a tree that is to be kept once it is made
        self._shown: tuple[int, str, KeptTree] | None = None  # revision, name, and the kept tree that stands for one that is being made
        self._remarks: dict[type, messages.Event] = {}  # Read and Matches of the newest tree
        self._first = asyncio.Event()  # the first tree is there
        self._crew_has_it = asyncio.Event()  # the tree that is shown was made by the crew that runs
        self._puts: set[asyncio.Task] = set()
        for name in (
            "cancel", "refresh", "ghost", "glance", "alternatives", "read", "export", "project", "trace", "with_traced", "grow", "stop_growing", "grown", "marks", "proposed",
            "aged", "moving",
        ):  # fmt: skip
            setattr(self, name, getattr(crew, name))

    async def start(self) -> None:
        """As `Engine.start`."""
        await self._crew.start()

    async def stop(self) -> None:
        """As `Engine.stop`."""
        for task in self._puts:
            task.cancel()
        await self._crew.stop()

    def make(self, revision: int, document: Document) -> None:
        """As `Engine.make`. Of another drawing than before the stock is asked first."""
        before, self._document = self._document, document
        self._missed = self._shown = None
        self._crew_has_it.set()
        self._crew.make(revision, document)
        if not document.strokes or any(before.strokes.get(name) is stroke for name, stroke in document.strokes.items()) or document.tree.obstacle:
            return
        name = _tree_name(document)
        data = self._stock.get(name)
        kept = None if data is None else KeptTree.decoded(data)
        if kept is None:
            self._missed = revision, name
            return
        self._shown = revision, name, kept
        self._crew_has_it.clear()
        self._crew.has_shown(revision, kept.digests, kept.basis)
        for event in (*kept.remarks(revision), kept.framed(revision)):
            self._tell(Outcome(revision, event, settled=kept.basis.settled if isinstance(event, bytes) else None))
        self._tell(Outcome(revision, messages.Working(state="idle", revision=revision)))

    def _came(self, outcome: Outcome) -> None:
        """The crew has something to tell."""
        event, shown = outcome.event, self._shown
        if shown is not None and outcome.revision == shown[0] and isinstance(event, messages.Working) and event.state == "working":
            return  # the page has that tree
        if isinstance(event, messages.Read | messages.Matches):
            self._remarks[type(event)] = event
        if isinstance(event, messages.Trouble):
            self._crew_has_it.set()  # or never will
        if outcome.settled is not None and isinstance(event, bytes):
            self._made(outcome.revision, event)
        self._tell(outcome)

    def _tell(self, outcome: Outcome) -> None:
        if outcome.settled is not None or isinstance(outcome.event, messages.Trouble):
            self._first.set()
        self.on_outcome(outcome)

    def _made(self, revision: int, frame: bytes) -> None:
        """The crew made a whole tree."""
        digests, basis = self._crew.shown
        if self._shown is not None and self._shown[2].digests != digests:
            self._stock.drop(self._shown[1])  # what makes it has changed, in a way that nobody could know
        if self._missed is not None and self._missed[0] == revision and basis is not None and is_whole(frame):
            kept = KeptTree(dict(digests), basis, self._remarks.get(messages.Read), self._remarks.get(messages.Matches), frame)
            self._keep(self._missed[1], kept.encoded)
        self._shown = self._missed = None
        self._crew_has_it.set()

    def _keep(self, name: str, make: Callable[[], bytes]) -> None:
        task = asyncio.get_running_loop().create_task(asyncio.to_thread(lambda: self._stock.put(name, make())))
        self._puts.add(task)
        task.add_done_callback(self._puts.discard)

    async def frame(self) -> bytes | None:
        """As `Engine.frame`."""
        if self._shown is not None:
            return self._shown[2].framed(self._shown[0])
        return await self._crew.frame()

    async def find(self, document: Document, limb: int) -> Any:
        """As `Engine.find`."""
        await self._crew_has_it.wait()
        return await self._crew.find(document, limb)

    async def texture(self, key: str, kind: str) -> bytes | None:
        """As `Engine.texture`."""
        return await self._picture(f"texture {key} {kind}", lambda: self._crew.texture(key, kind))

    async def picture(self, what: str, name: str) -> bytes | None:
        """As `Engine.picture`."""

        async def made():
            await self._first.wait()
            return await self._crew.picture(what, name)

        return await self._picture(f"picture {what} {name} {_example_digest(name) if what == 'example' else ''}", made)

    async def catalogue(self) -> messages.Welcome:
        """As `Engine.catalogue`."""
        name = f"catalogue {' '.join(examples.names())} {shutil.which('ffmpeg')}"  # which films there are hangs on it
        data = await asyncio.to_thread(self._stock.get, name)
        if data is not None:
            try:
                return msgspec.json.decode(data, type=messages.Welcome)
            except msgspec.MsgspecError:
                pass
        made = await self._crew.catalogue()
        self._keep(name, lambda: msgspec.json.encode(made))
        return made

    async def _picture(self, name: str, make) -> bytes | None:
        data = await asyncio.to_thread(self._stock.get, name)
        if data is None:
            data = await make()
            if data is not None:
                self._keep(name, lambda: data)
        return data


def _tree_name(document: Document) -> str:
    """The same for drawings of which the same tree is made."""
    said = journal_lines.different(Document(), document.replace(underlay=None, name=""))
    line = journal_lines.encode(journal_lines.Begin(version=journal_lines.VERSION, document=said, saved=False, signature=None))
    return f"tree {hashlib.blake2b(line + repr(document.warnings).encode(), digest_size=20).hexdigest()}"


def _example_digest(name: str) -> str:
    return hashlib.blake2b(examples.data(name), digest_size=12).hexdigest() if name in examples.names() else ""
