"""When is the tree in the points behind the drawing traced? Once it is asked for, aside, in a process of its own; other leaves or another season trace nothing anew.

    "trace it", options → a pause → traced → pages     the newest wins; one that is the same as that shown is not made again

What is shown stays until the next is there, and goes when the tree is that of the strokes again.
"""

import asyncio
from collections.abc import Callable, Coroutine, Mapping

from sketchtree.editing.document import Document
from sketchtree.errors import SketchError, SketchTreeError
from sketchtree.studio import messages
from sketchtree.studio.engine import Outcome, Tell, untold
from sketchtree.studio.growth import Held, Whose
from sketchtree.studio.hand import Ended, Hand
from sketchtree.studio.making.cloud_asked import CloudWish
from sketchtree.studio.one_job import OneJob

_REST = 0.4  # seconds without a change before it is made
_PAUSE = 0.2  # seconds between two tellings of how far it is
_PATIENCE = 6.0  # seconds in which what is stopped ends by itself, before its process is ended: ways through points have no pulse
_NO_TREE = SketchError("No tree is traced in the points.", remedy="Trace it first.")


class CloudTracer:
    """`tell` is given outcomes for the pages; `run` does work aside."""

    def __init__(self, hand: Hand, tell: Callable[[Outcome], None], run: Callable[[Coroutine], None]):
        self._hand, self._outcome, self._run = hand, tell, run
        self._loop = asyncio.get_running_loop()
        self._now: tuple[int, CloudWish] | None = None  # the newest drawing; None: its tree is another's
        self._job = OneJob(hand, self._begin, _PATIENCE)
        self._done: tuple[CloudWish, str, str] | None = None  # what is not to be made again: its state, and why
        self._told_at = 0.0
        self.textures: Mapping[tuple[str, str], bytes] = {}  # by material and map: those that only the tree that is shown has

    def make(self, revision: int, document: Document, *, at_once: bool = False) -> None:
        """The drawing is this now; `at_once`: without a pause, even if it was stopped."""
        wish = CloudWish.of(document)
        if wish is None:
            self._nothing(revision)
            return
        self._now = revision, wish
        if at_once:
            self._done = None
        if self._job.made is not None and self._job.made[0].key == wish.key:
            self._job.works(wish, self._job.made[1])
            return
        self._job.halt()
        if self._done is not None and self._done[0].key == wish.key:
            self._tell(*self._done[1:])
            return
        self._tell("waits")
        self._job.later(0.0 if at_once else _REST)

    def stop(self) -> None:
        """What is made, or is to be, is not wanted."""
        if self._now is not None and self._job.goes_on:
            self._job.halt()
            self._done = self._now[1], "stopped", ""
            self._tell("stopped")

    def end(self) -> None:
        """End the process."""
        self._job.clear()
        self._hand.end()

    async def files(self, document: Document, name: str, options: dict, tell: Tell = untold) -> dict[str, bytes]:
        """The files that the tree becomes. Raises SketchTreeError; cancelled, its making ends."""
        return await self._hand.made("points_files", self._wish(document), name, options, hears=lambda value: tell(*value[1:]))

    def whose(self, document: Document) -> Whose:
        """The tree of a drawing, as one that is to grow. Raises SketchTreeError."""
        wish = self._wish(document)

        async def fetched(tell: Tell) -> bytes:
            return await self._hand.made("points_standing", wish, hears=lambda value: tell(*value[1:]))

        return Whose(Held(("points", wish.key), wish), fetched)

    async def taken_over(self, document: Document) -> Document:
        """The drawing of the traced limbs, in place of the strokes; the points stay behind it. Raises SketchTreeError."""
        strokes, settled = await self._hand.made("points_strokes", self._wish(document))
        return document.replace(strokes=strokes, settled=settled, points=document.points.drawn)

    def _wish(self, document: Document) -> CloudWish:
        wish = CloudWish.of(document)
        if wish is None:
            raise _NO_TREE
        return wish

    def heard(self, number: int, value: tuple) -> None:
        """The process tells how far it is."""
        if self._job.is_of(number) and self._now is not None and self._loop.time() - self._told_at >= _PAUSE:
            self._told_at = self._loop.time()
            self._say(state="grows", stage=value[1], done=min(max(float(value[2]), 0.0), 1.0))

    def _begin(self) -> None:
        revision, wish = self._now
        number, answer = self._hand.ask("points", revision, wish)
        self._job.works(wish, number)
        self._tell("grows")
        self._run(self._made(revision, number, answer))

    async def _made(self, revision: int, number: int, answer: asyncio.Future) -> None:
        found, why = None, ""
        try:
            found = await answer
        except Ended:
            why = "The process that traces it ended. Trace it again."
        except SketchTreeError as error:
            why = f"{error.message} {error.remedy}"
        if not self._job.is_of(number) or not (found or why):
            return
        self._done = self._job.done(), "failed" if why else "ready", why
        if found:
            frame, self.textures = found
            self._outcome(Outcome(revision, frame, of_photo=True))
        self._tell(*self._done[1:])

    def _nothing(self, revision: int) -> None:
        """The tree is not the one in the points."""
        self._job.halt()
        if self._now is not None:
            self._now = self._done = None
            self._outcome(Outcome(revision, messages.Growing(revision=revision, state="none")))

    def _tell(self, state: str, remark: str = "") -> None:
        self._say(state=state, remark=remark, done=1.0 if state == "ready" else 0.0)

    def _say(self, **fields) -> None:
        self._outcome(Outcome(self._now[0], messages.Growing(revision=self._now[0], **fields)))
