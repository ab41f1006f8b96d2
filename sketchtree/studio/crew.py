"""Who makes the trees? Three processes, so that a stroke never waits for the whole tree, nor the whole tree for an export.

    quick    what was touched, in a hurry; the stroke in hand
    full     the whole tree; meanwhile, of the last one, what pages that join need and the undrawn limb that is picked
    side     everything else: pictures, other readings, glances, files in and out

and, once a photo lies under the page, three more (`tracer`, `grower`). One more once a tree is taken from scribbles (`trunker`), one once it is traced in points (`cloud_tracer`), one more while somebody looks at the tree as it grows, and one while a film of that is made (`growth`).

Each begins when it is first needed, and is begun again should it end. The newest request wins; a hurried answer goes before the full tree of the same revision.
"""

import asyncio
import dataclasses
import sys
import traceback
from collections.abc import Callable
from functools import partial
from pathlib import Path

from sketchtree.editing.document import Document
from sketchtree.editing.settled import Settled
from sketchtree.errors import SeveralTrees, SketchTreeError
from sketchtree.studio import messages
from sketchtree.studio.cloud_files import is_cloud
from sketchtree.studio.cloud_tracer import CloudTracer
from sketchtree.studio.engine import Fault, Outcome, Tell, untold
from sketchtree.studio.grower import Grower
from sketchtree.studio.growth import FILMS, Ager, Growing, Grown, Whose
from sketchtree.studio.hand import Ended, Hand
from sketchtree.studio.laid_photo import LaidPhoto, unheard
from sketchtree.studio.making.basis import Basis
from sketchtree.studio.tracer import Tracer
from sketchtree.studio.trunker import Trunker

_ROLES = ("quick", "full", "side")
_SMALL, _LINES = 1_000_000, (".svg", ".json", ".excalidraw", ".inkml")  # bytes, and kinds, of drawings that are read at once
_AFTER_PAINT, _AFTER_TREE = 1.0, 4.0  # seconds to the beginning of the next process: from a tree that is there at once, while a page is painted; from one that was made
_MAKES = "makes"  # tasks that a tree comes of
_PAUSE = 0.1  # seconds between two tellings of how far a stage is


class Crew:
    """The engine of the studio (`engine.Engine`)."""

    def __init__(self, database: Path | None = None):
        self.on_outcome: Callable[[Outcome], None] = lambda outcome: None
        self._database = database
        self._hands: dict[str, Hand] = {}
        self._tasks: set[asyncio.Task] = set()
        self._hurrying, self._cancelled = False, False  # a hurried answer is under way; what was asked last is not wanted any more
        self._known: dict[str, str] = {}  # owner → digest of the chunk that every page has of the last full tree; hurried ones take theirs out
        self._basis, self._job = None, 0  # of the last full tree: what it was, and the number of its job
        self._revision, self._full_number, self._glancing = 0, 0, False
        self._document = Document()
        self._made, self._revived = -1, -1  # revisions: of the newest full tree, and of the last for which the process of full trees had to be begun again
        self._told = (0.0, "")
        self._catalogue: messages.Welcome | None = None
        self._whole_shown = -1  # the revision whose whole tree the pages have already
        self._expects: dict[str, int] = {}  # which process of each role was told of points behind the drawing
        self._cold: set[str] = set()  # roles that get ready for strokes over them
        self._soon: dict[str, asyncio.TimerHandle] = {}  # processes that begin in a while

    @property
    def shown(self) -> tuple[dict[str, str], Basis | None]:
        """(digest of every chunk that the pages have of the last full tree, what it was)."""
        return self._known, self._basis

    def has_shown(self, revision: int, digests: dict[str, str], basis: Basis) -> None:
        """The pages have the whole tree of this revision, which was asked for just now. It is made all the same, and what is different of it is sent."""
        self._whole_shown, self._known, self._basis = revision, dict(digests), basis
        self._later(_AFTER_PAINT, "quick")

    def _later(self, seconds: float, role: str) -> None:
        """Begin a process in a while, unless it was needed before."""
        if role not in self._soon:
            self._soon[role] = self._loop.call_later(seconds, self._hands[role].ready)

    async def start(self) -> None:
        """Begin the processes."""
        self._loop = asyncio.get_running_loop()
        for role in _ROLES:
            self._hands[role] = Hand(role, self._database, partial(self._event, role), partial(self._ended, role))
        photo = [Hand(role, self._database, lambda number, value: None, partial(self._ended, role)) for role in ("photo", "foliage")]
        grow = Hand("grow", self._database, lambda number, value: self._grower.heard(number, value), partial(self._ended, "grow"))
        laid = LaidPhoto()
        self._grower = Grower(grow, laid, lambda outcome: self.on_outcome(outcome), self._run)
        trunk = Hand("trunk", self._database, lambda number, value: self._trunker.heard(number, value), partial(self._ended, "trunk"))
        self._trunker = Trunker(trunk, laid, lambda outcome: self.on_outcome(outcome), self._run)
        points = Hand("points", self._database, lambda number, value: self._cloud.heard(number, value), partial(self._ended, "points"))
        self._cloud = CloudTracer(points, lambda outcome: self.on_outcome(outcome), self._run)
        self._tracer = Tracer(*photo, laid, lambda revision, event: self.on_outcome(Outcome(revision, event)), self._grower.seen, self._run)
        self._ager, self._filmer = (Ager(partial(Hand, role, self._database, lambda number, value: None, partial(self._ended, role))) for role in ("age", "film"))
        self._begun = 1
        self._empty: bytes | None = None  # the tree of a page without a stroke, if that was told last
        self._hands["full"].begin()  # the others once there is a tree, or when they are asked

    async def stop(self) -> None:
        """End all processes."""
        for task in self._tasks:
            task.cancel()
        for begin in self._soon.values():
            begin.cancel()
        for hand in self._hands.values():
            hand.end()
        self._tracer.end()
        self._grower.end()
        self._trunker.end()
        self._cloud.end()
        self._ager.end()
        self._filmer.end()

    def make(self, revision: int, document: Document) -> None:
        """As `Engine.make`."""
        self._revision, self._document, self._cancelled = revision, document.drawn, False
        self._hands["full"].stop()
        self._say(messages.Working(state="working", revision=revision, stage="read"))
        if document.cloud is not None:
            self._expect_points()
        if not self._hurrying:
            self._hurrying = True  # before the task begins: drawings that come at once have one
            self._run(self._make(), makes=True)

    def _expect_points(self) -> None:
        """Strokes over points come: each process is told once, and pages how long they would wait."""
        for role in ("full", "quick"):
            hand = self._hands[role]
            hand.ready()
            if self._expects.get(role) != hand.begun:
                self._expects[role] = hand.begun
                self._warms(role, True)
                unheard(hand.ask("expect_points")[1])

    def _warms(self, role: str, on: bool) -> None:
        before = bool(self._cold)
        self._cold = self._cold | {role} if on else self._cold - {role}
        if before != bool(self._cold):
            self._say(messages.Warming(on=not before))

    async def _make(self) -> None:
        """Hurried answers until one is of the newest drawing, then its whole tree. However many drawings come meanwhile, one at a time is made."""
        try:
            while True:
                revision, document = self._revision, self._document
                if document.strokes and self._hands["quick"].runs and revision != self._whole_shown:
                    document = await self._hurry(revision, document)
                if revision == self._revision:
                    break
        finally:
            self._hurrying = False
        if not document.strokes:
            self._nothing(revision)
        elif not self._cancelled:
            await self._whole(revision, document)

    async def _whole(self, revision: int, document: Document) -> None:
        hand = self._hands["full"]
        hand.ready()
        if hand.begun != self._begun:
            self._begun, self._known = hand.begun, {}  # pages that joined meanwhile had no tree from it
        number, answer = hand.ask("full", revision, document, dict(self._known), self._job)
        self._full_number = number
        try:
            found = await answer
        except Ended as error:
            if revision == self._revision and not self._cancelled and self._revive(revision, error):
                await self._whole(revision, document)
            return
        except SketchTreeError as error:
            self._trouble(revision, error)
            return
        if found is None or revision != self._revision:
            return
        frame, digests, basis = found
        self._known, self._basis, self._made, self._job = digests, basis, revision, number
        self.on_outcome(Outcome(revision, frame, settled=basis.settled))
        self._hands["quick"].ready()
        self._later(_AFTER_TREE, "side")
        self._say(messages.Working(state="idle", revision=revision))

    def _revive(self, revision: int, error: Ended) -> bool:
        """The process of full trees ended: once a revision it is begun again for it."""
        if self._revived == revision:
            self._trouble(revision, Ended(error.message, remedy="It ended twice at this step: undo it. Should that not help, save, and start the studio again."))
            return False
        self._revived = revision
        again = messages.Trouble(message=error.message, remedy="It is begun again by itself; nothing of the drawing is lost.", about="program")
        self.on_outcome(Outcome(revision, again))
        return True

    def _ended(self, role: str) -> None:
        """A process ended by itself: the terminal is told. The full one, if it had nothing to do: pages that join, and who picks a limb, need the tree that it knew."""
        print(f"A process of the studio ended ({role}). It is begun again when it is needed; nothing of the drawing is lost.", file=sys.stderr)
        self._warms(role, False)
        if role == "full" and self._made == self._revision and self._basis is not None and self._revive(self._revision, Ended("A process that makes the tree ended.", remedy="")):
            self._run(self._whole(self._revision, self._document.replace(settled=self._basis.settled)), makes=True)

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
        there = {str(limb) for limb in settled.limbs}  # pages drop the chunks of all others
        self._known = {owner: digest for owner, digest in self._known.items() if owner in there and owner not in digests}
        if self._basis is not None:
            owners = tuple(owner for owner in dict.fromkeys((*self._basis.owners, *digests)) if owner in there)
            self._basis = dataclasses.replace(self._basis, owners=owners, settled=settled)
        self.on_outcome(Outcome(revision, frame, rough=settled))
        if not document.settled.limbs:
            return document  # as a file that is opened: its tree is the one that `build` makes of it, whatever was shown before
        return document.replace(settled=dataclasses.replace(settled, manner=document.settled.manner))

    def refresh(self) -> None:
        """A page that joins asks for `frame` itself."""

    async def frame(self) -> bytes | None:
        """As `Engine.frame`."""
        frame, job = self._empty, None
        while self._basis is not None and job != self._job:  # a newer one may be made meanwhile
            job = self._job
            frame = await self._hands["full"].ask("frame", job)[1]
        return frame if self._basis is not None else self._empty

    def trace(self, revision: int, document: Document) -> None:
        """As `Engine.trace`."""
        self._tracer.make(revision, document)

    async def with_traced(self, document: Document) -> Document:
        """As `Engine.with_traced`."""
        return await (self._cloud if self._maker(document) is self._cloud else self._tracer).taken_over(document)

    async def proposed(self, document: Document) -> tuple[Document, str]:
        """As `Engine.proposed`."""
        return await self._tracer.proposed(document)

    def grow(self, revision: int, document: Document, *, at_once: bool = False) -> None:
        """As `Engine.grow`."""
        if at_once:
            self._tracer.make(revision, document)  # what was stopped looking for foliage looks again
        turn, none = self._maker(document), document.replace(underlay=None, cloud=None)
        for one in sorted((self._grower, self._trunker, self._cloud), key=lambda one: one is turn):  # those that have nothing to do say so first
            one.make(revision, document if one is turn else none, at_once=at_once)

    def stop_growing(self) -> None:
        """As `Engine.stop_growing`."""
        self._tracer.cancel()
        for one in (self._grower, self._trunker, self._cloud):
            one.stop()

    async def grown(self, document: Document, name: str, options: dict, tell: Tell = untold) -> dict[str, bytes]:
        """As `Engine.grown`."""
        return await self._maker(document).files(document, name, options, tell)

    def _maker(self, document: Document) -> Grower | Trunker | CloudTracer:
        """Who makes the tree that is not that of its strokes."""
        if document.cloud is not None and document.points.traced:
            return self._cloud
        return self._trunker if document.trunk.on else self._grower

    async def marks(self, document: Document) -> bytes:
        """As `Engine.marks`."""
        return await self._tracer.as_svg(document)

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
        try:
            frame = await self.frame()
        except Ended:
            return  # the tree is made again
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
        self._cancelled = True
        for hand in self._hands.values():
            hand.stop()
        self._tracer.cancel()
        for one in (self._grower, self._cloud):
            one.stop()
        self._say(messages.Working(state="idle", revision=self._revision))

    async def find(self, document: Document, limb: int):
        """As `Engine.find`."""
        return await self._hands["full"].ask("find", self._job, limb)[1]

    async def read(self, data: bytes, name: str, cloud: messages.CloudReading = messages.CloudReading()) -> Document:
        """As `Engine.read`. Small drawings of lines are read here, on a thread: they are there before any other process is."""
        if len(data) < _SMALL and Path(name).suffix.lower() in _LINES:
            from sketchtree.studio.making.documents import document_of

            return await asyncio.to_thread(document_of, data, name)
        if is_cloud(data, name):
            self._expect_points()
        found = await self._hands["side"].ask("read", data, name, cloud)[1]
        if not isinstance(found, Document):
            raise SeveralTrees(f"{len(found)} trees stand in {name}.", remedy="Choose one of them.", trees=found)
        return found

    async def export(self, document: Document, name: str, options: dict, tell: Tell = untold) -> dict[str, bytes]:
        """As `Engine.export`."""
        return await self._hands["side"].made("export", document, name, options, hears=lambda value: tell(*value[1:]))

    async def aged(self, document: Document, growing: Growing, tell: Tell = untold) -> bytes:
        """As `Engine.aged`."""
        return await self._ager.made(self._whose(document, growing.tree), growing.ageing, tell)

    async def moving(self, document: Document, name: str, tree: str, grown: Grown, tell: Tell = untold) -> dict[str, bytes]:
        """As `Engine.moving`. A film takes long: pages get their growths meanwhile."""
        film = name.endswith(FILMS)
        return await (self._filmer if film else self._ager).files(self._whose(document, tree), name, grown, tell, film=film)

    def _whose(self, document: Document, tree: str) -> Whose:
        return self._maker(document).whose(document) if tree == "photo" else Whose.drawn(document)

    async def project(self, document: Document) -> bytes:
        """As `Engine.project`."""
        return await self._surely("project", document)

    async def texture(self, key: str, kind: str) -> bytes | None:
        """As `Engine.texture`."""
        own = next(filter(None, (one.textures.get((key, kind)) for one in (self._grower, self._trunker, self._cloud))), None)
        return own if own is not None else await self._surely("texture", key, kind)

    async def picture(self, what: str, name: str) -> bytes | None:
        """As `Engine.picture`."""
        return await self._surely("picture", what, name)

    async def catalogue(self) -> messages.Welcome:
        """As `Engine.catalogue`."""
        if self._catalogue is None:
            self._catalogue = await self._surely("catalogue")
        return self._catalogue

    async def _surely(self, kind: str, *arguments: object):
        """Asked aside; once more, should the process end meanwhile."""
        try:
            return await self._hands["side"].ask(kind, *arguments)[1]
        except Ended:
            return await self._hands["side"].ask(kind, *arguments)[1]

    def _nothing(self, revision: int) -> None:
        """There is no stroke: no tree."""
        from sketchtree.studio.making.frames import Arrays

        self._known, self._basis = {}, None
        head = messages.Tree(
            revision=revision, phase="full", scale=1.0, root=[0.0, 0.0], owners=[], chunks=[], cards=[], materials=[], limbs=[], segments=0, drawn=0, leaves=0,
            triangles=[0, 0], height=0.0, low=[0.0] * 3, high=[0.0] * 3, template=None, leaf=None, bark="", warnings=[], arrays=[],
        )  # fmt: skip
        self._empty = Arrays().frame(head)
        self.on_outcome(Outcome(revision, self._empty, settled=Settled(template=self._document.settled.template)))
        self._say(messages.Working(state="idle", revision=revision))

    def _trouble(self, revision: int, error: SketchTreeError) -> None:
        if revision != self._revision:
            return
        about = "program" if isinstance(error, Fault) else "drawing"
        self.on_outcome(Outcome(revision, messages.Trouble(message=error.message, remedy=error.remedy, stroke=getattr(error, "stroke", None), about=about)))
        self._say(messages.Working(state="error", revision=revision))

    def _event(self, role: str, number: int, value: object) -> None:
        """What a worker tells on its way: the full tree's, how far it is."""
        if value[0] == "warm":
            self._warms(role, False)
            return
        if role != "full" or number != self._full_number:
            return
        if value[0] == "event":
            self.on_outcome(Outcome(self._revision, value[1]))
            return
        if self._cancelled:
            return  # it was said before the process heard of it
        _, stage, done = value
        now = self._loop.time()
        if stage != self._told[1] or now - self._told[0] >= _PAUSE:
            self._told = now, stage
            self._say(messages.Working(state="working", revision=self._revision, stage=stage, done=min(max(float(done), 0.0), 1.0)))

    def _say(self, event: messages.Event) -> None:
        self.on_outcome(Outcome(self._revision, event))

    def _run(self, work, *, makes: bool = False) -> None:
        task = self._loop.create_task(work, name=_MAKES if makes else None)
        self._tasks.add(task)
        task.add_done_callback(self._finished)

    def _finished(self, task: asyncio.Task) -> None:
        self._tasks.discard(task)
        if not task.cancelled() and task.exception() is not None:
            traceback.print_exception(task.exception(), file=sys.stderr)
            if task.get_name() == _MAKES:  # pages must not wait for what never comes
                self._trouble(self._revision, Fault.here())
