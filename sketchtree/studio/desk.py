"""What is being drawn, who looks at it, and what has been done to it? One document and its history.

Every step gets the next revision, goes into the journal, is told to all pages, and to the engine, which makes the tree.

    step → engine.make → outcomes → pages
         → journal → `Changed` → pages
"""

import asyncio
import errno
import time
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field

from sketchtree.editing.document import Document
from sketchtree.editing.laid_cloud import LaidCloud
from sketchtree.editing.settled import Settled
from sketchtree.errors import SketchTreeError
from sketchtree.studio import journal_lines, messages, wire
from sketchtree.studio.change import Change, change
from sketchtree.studio.engine import Engine, Fault, Outcome
from sketchtree.studio.folder import Folder, Signature
from sketchtree.studio.history import History
from sketchtree.studio.ledger import Ledger
from sketchtree.studio.outbox import Outbox, encode
from sketchtree.studio.recovery import Journal, Recovered
from sketchtree.studio.scribe import Scribe
from sketchtree.studio.settling import known_at_once, sharing

_KEPT = (messages.Working, messages.Warming, messages.Matches, messages.Read, messages.Alternatives, messages.Traced, messages.Foliage, messages.Matte, messages.Trunks, messages.Growing)  # the newest of each is told to pages that join later
_NO_TREE = frozenset({"underlay", "points", "name", "units", "page", "photo"})  # fields of a document that its tree does not hang on


@dataclass(eq=False)
class Page:
    """One page that is connected."""

    outbox: Outbox
    sender: asyncio.Task | None = None
    greeted: bool = False


@dataclass(eq=False)
class Files:
    """Where the drawing is kept, and what is known of the file."""

    folder: Folder | None = None
    signatures: dict[str, Signature | None] = field(default_factory=dict)  # of files as they were read or written here
    saved: dict[int, str] = field(default_factory=dict)  # state → name of the file that holds it


class Desk:
    """All methods are called on the event loop."""

    def __init__(self, engine: Engine, document: Document, *, folder: Folder | None = None, clock: Callable[[], float] = time.monotonic):
        self.engine = engine
        self.history = History(document)
        self.files = Files(folder)
        self.revision = 1
        self.recovered = False
        self.ready = asyncio.Event()  # the first drawing is there
        self.turn = asyncio.Lock()  # one request after the other changes the document; held for moments only
        self.filing = asyncio.Lock()  # one file after the other is read or written, aside
        self.other_readings: tuple[int, Document, list[Settled]] | None = None  # revision, document, settled: what `Pick` picks of
        self.tasks: set[asyncio.Task] = set()
        self.pending: dict[asyncio.Task, int] = {}  # of them, edits of limbs that are being looked for → the revision at which they were asked
        self.notes: list[messages.Trouble] = []  # told to every page that joins
        self.pictures: dict[str, bytes] = {}  # that were traced over, by digest
        self.clouds: dict[str, LaidCloud] = {}  # that were laid behind the drawing, likewise
        self._wrong: messages.Trouble | None = None  # why there is no tree of the drawing as it is
        self._unkept: messages.Trouble | None = None  # why steps are not in the journal
        self._clock = clock
        self._pages: set[Page] = set()
        self._kept: dict[type, messages.Event] = {}
        self._of_photo: bytes | None = None  # the frame of the photo's tree
        self._rough: Settled | None = None  # where the depths are for now, as pages show them
        self._settled_since = 1  # revision at which the settled depths were last set by a step
        self._came = asyncio.Event()  # an outcome, since `settles` looked last
        self.scribe, self.ledger = Scribe(None, self._cannot_keep), Ledger(self.history)
        engine.on_outcome = self.on_outcome

    # Beginning and end

    def begin(self, document: Document | None = None, *, journal: Journal | None = None, recovered: Recovered | None = None, saved_as: str | None = None) -> None:
        """The first drawing: a recovered one, else `document`; `saved_as` names the file that holds it. Pages that wait are answered from now on."""
        self.scribe = Scribe(journal, self._cannot_keep)
        if recovered is not None:
            self.history, self.recovered = recovered.history, True
            self.ledger = Ledger(self.history, begun=True)
            self.pictures.update(recovered.pictures)
            self.revision += 1
            if recovered.saved_state is not None and saved_as is not None:
                self.files.saved[recovered.saved_state] = saved_as
            if saved_as is not None:
                self.files.signatures[saved_as] = recovered.signature
        elif document is not None:
            self.history = History(document)
            if saved_as is not None:
                self.files.saved[0] = saved_as
        for note in journal.notes if journal is not None else ():
            self.notes.append(messages.Trouble(message=note, remedy="Nothing of it was deleted.", about="file"))
        self._remember_picture()
        self.ready.set()
        self.engine.trace(self.revision, self.document)
        self.engine.grow(self.revision, self.document)
        self.engine.make(self.revision, self.document)

    async def end(self) -> None:
        """All is written; the pages are let go."""
        for task in (*self.tasks, *(page.sender for page in self._pages if page.sender)):
            task.cancel()
        await self.scribe.rest()
        self.scribe.end()
        if self.scribe.journal is not None:
            self.scribe.journal.close()

    # What there is

    @property
    def document(self) -> Document:
        """The drawing now."""
        return self.history.document

    def with_limb(self, limb: int) -> Document | None:
        """The drawing, in which that limb has a depth: one drawn just now has that of its hurried tree. None: it is not drawn."""
        return known_at_once(self.document, limb, self._rough)

    @property
    def saved(self) -> bool:
        """Is it as in its file?"""
        return self.history.state in self.files.saved

    def whole(self) -> messages.Changed:
        """Everything, for a page that knows nothing."""
        return wire.whole(self.document, self.revision, **self._state())

    def answer(self, page: Page) -> None:
        """The page is told that nothing is different, after all that is on its way to it."""
        nothing = messages.Changed(since=self.revision, revision=self.revision, **self._state())
        self.scribe.write((), lambda: page.outbox.put(nothing))

    def _state(self) -> dict:
        return {"undo": self.history.undo_label, "redo": self.history.redo_label, "saved": self.saved}

    # Pages

    def leave(self, page: Page) -> None:
        """A page is gone."""
        self._pages.discard(page)
        page.outbox.close()
        if page.sender is not None:
            page.sender.cancel()

    def greet(self, page: Page) -> None:
        """The page gets everything now, and what becomes different from now on."""
        page.greeted = True
        self._pages.add(page)
        page.outbox.everything()
        for event in (*self._kept.values(), *self.notes, *filter(None, (self._wrong, self._unkept))):
            page.outbox.put(event)
        if self._of_photo is not None:
            page.outbox.put(self._of_photo)
        self.engine.refresh()

    def tell(self, event: messages.Event | bytes) -> None:
        """All pages get it."""
        if isinstance(event, _KEPT):
            self._kept[type(event)] = event
        if self._pages:
            said = event if isinstance(event, bytes) else encode(event)
            for page in self._pages:
                page.outbox.put_encoded(event, said)

    def trouble(self, page: Page | None, error: SketchTreeError, about: str | None = None) -> None:
        """One page, or all, are told what can't be done."""
        event = trouble_of(error, about)
        if page is None:
            self.tell(event)
        else:
            page.outbox.put(event)

    # Steps

    def step(self, document: Document, label: str, *, alike: Hashable = None, saved_as: str | None = None) -> bool:
        """A step is done; like steps in quick succession are one. `saved_as` names the file that holds the document. False: nothing is different."""
        return self.change(change(self.document, document), label, alike=alike, saved_as=saved_as)

    def change(self, what: Change, label: str, *, alike: Hashable = None, saved_as: str | None = None) -> bool:
        """The same, where it is known what becomes different."""
        if not what:
            return False
        before, state, begin = self.document, self.history.state, self._begin()
        merges = self.history.step(what, label, now=self._clock(), alike=alike)
        if saved_as is not None:
            self.files.saved[self.history.state] = saved_as
        self._went(what, (*begin, *self.ledger.step(before, what, self.document, label, state, merges=merges)))
        return True

    def remember(self, document: Document) -> None:
        """Something that is no step is so from now on; pages know it already."""
        lines = self.ledger.keep(self.document, document)
        self.history.keep(document)
        if lines:
            self.scribe.write(lines, lambda: None)

    def walk(self, *, on: bool) -> bool:
        """Undo, or redo; False: there is none."""
        before, state = self.document, self.history.state
        if (self.history.redo_label if on else self.history.undo_label) is None:
            return False
        begin = self._begin()
        self.history.redo() if on else self.history.undo()
        what = change(before, self.document)
        self._went(what, (*begin, *self.ledger.walk(before, what, self.document, state, self.history.state, on=on)))
        return True

    def is_in_file(self, document: Document, state: int, name: str, file: str) -> tuple[journal_lines.Line, ...]:
        """The document of that state is in that file of the folder, under that name. The journal begins anew, with these lines: what was done meanwhile, as one step."""
        if self.document.name == document.name:  # else another drawing was opened meanwhile
            self.history.keep(self.document.replace(name=name))
        self.history.part()
        self.files.saved = {other: own for other, own in self.files.saved.items() if own != file} | {state: file}
        self.ledger.forget()
        if self.history.state == state:
            return ()
        kept = document.replace(name=name)
        begin = self.ledger.begin(kept, True, self.files.signatures.get(file))
        return (*begin, *self.ledger.step(kept, change(kept, self.document), self.document, self.history.undo_label or "undo", state, merges=False))

    def _begin(self) -> tuple[journal_lines.Line, ...]:
        name = self.files.saved.get(self.history.state)
        return self.ledger.begin(self.document, name is not None, None if name is None else self.files.signatures.get(name))

    def _went(self, what: Change, lines: tuple[journal_lines.Line, ...]) -> None:
        """The document is another now."""
        document, since = self.document, self.revision
        self.revision += 1
        self._remember_picture()
        if "settled" in what.others:
            self._settled_since = self.revision
        told = wire.changed(what, document, since, self.revision, **self._state())
        self.scribe.write(lines, lambda: self.tell(told))
        redrawn = bool(what.put or what.gone or what.order is not None)
        if redrawn or what.others.keys() & {"underlay", "seed"}:
            self.engine.trace(self.revision, document)
        self.engine.grow(self.revision, document)
        if redrawn or what.others.keys() - _NO_TREE:
            self.engine.make(self.revision, document)

    # What comes of it

    def on_outcome(self, outcome: Outcome) -> None:
        """The engine has something to tell. Where the depths have come to is in the journal before a page shows it."""
        lines = ()
        if outcome.of_photo:
            self._of_photo = outcome.event
        elif isinstance(outcome.event, messages.Growing) and outcome.event.state == "none":
            self._of_photo = None
        if outcome.settled is not None and self._settled_since <= outcome.revision <= self.revision:
            lines = self._settle(outcome.settled)
        if outcome.rough is not None and outcome.revision == self.revision:
            self._rough = outcome.rough
        if isinstance(outcome.event, messages.Trouble) or outcome.settled is not None:
            self._wrong = outcome.event if isinstance(outcome.event, messages.Trouble) else None
        rests = isinstance(outcome.event, messages.Working) and outcome.event.state == "idle"
        if lines:
            self.scribe.write(lines, lambda: self._told(outcome.event))
        elif outcome.settled is not None:
            self.scribe.after(lambda: self._told(outcome.event))  # not before its step
        elif rests:
            self.scribe.after(lambda: self._rests(outcome.event))  # not before its tree
        else:
            self._told(outcome.event)

    def _rests(self, event: messages.Working) -> None:
        """Nothing is being worked at; unless somebody began anew meanwhile."""
        working = self._kept.get(messages.Working)
        if working is None or working.revision <= event.revision:
            self._told(event)

    def _told(self, event: messages.Event | bytes) -> None:
        self.tell(event)
        self._came.set()

    async def settles(self, wanted: Callable[[Document], bool], seconds: float) -> bool:
        """Wait until the document is as wanted by what the engine finds; False: the tree is made, or the time is over, and it is not."""
        until = self._clock() + seconds
        while not wanted(self.document):
            working = self._kept.get(messages.Working)
            if working is not None and working.revision >= self.revision and working.state != "working":
                return False
            self._came.clear()
            try:
                await asyncio.wait_for(self._came.wait(), until - self._clock())
            except TimeoutError:
                return False
        return True

    def _settle(self, settled: Settled) -> tuple[journal_lines.Line, ...]:
        """Keep where the depths have come to; what the journal is to be told of it."""
        before = self.document
        settled = sharing(settled, before.settled)
        if settled is before.settled:
            return ()
        self.history.keep(before.replace(settled=settled))
        return tuple(self.ledger.keep(before, self.document))

    def _remember_picture(self) -> None:
        if self.document.cloud is not None:
            self.clouds[self.document.cloud.digest] = self.document.cloud
        if self.document.underlay is not None:
            self.pictures[wire.digest(self.document.underlay.picture)] = self.document.underlay.picture

    def _cannot_keep(self, error: OSError | None) -> None:
        """Steps can't be kept; None: they can again, and all are."""
        if error is None:
            self._unkept = None
            self.tell(messages.Trouble(message="Steps are kept for recovery again.", remedy="None is missing.", about="program"))
            return
        why, full = (error.strerror or "it fails").lower(), error.errno in (errno.ENOSPC, errno.EDQUOT)
        remedy = "Free some space, and save the drawing." if full else f"Save the drawing. They are kept again once {self.scribe.journal.path.parent} can be written to."
        self._unkept = messages.Trouble(message=f"Steps can't be kept for recovery: {why}.", remedy=remedy, about="program")
        self.tell(self._unkept)


def trouble_of(error: SketchTreeError, about: str | None = None) -> messages.Trouble:
    """An error as the page is told."""
    stroke = getattr(error, "stroke", None)
    return messages.Trouble(message=error.message, remedy=error.remedy, stroke=None if stroke is None else str(stroke), about=about or ("program" if isinstance(error, Fault) else "drawing"))
