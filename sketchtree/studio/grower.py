"""When does the tree in the photo grow? Once what shows of it is known and nothing was changed for a moment; aside, in a process of its own, so that no stroke waits for it.

    strokes, options → a pause → grown → pages          the newest wins; one that is the same as that shown is not grown again
    stop             → not grown as it is now; the next change, or asking for it, begins anew

A tree that is shown stays while the next one grows, and goes when there is nothing to grow any more.
"""

import asyncio
from collections.abc import Callable, Coroutine, Mapping
from dataclasses import dataclass

from sketchtree.editing.document import Document
from sketchtree.errors import SketchError, SketchTreeError
from sketchtree.studio import messages
from sketchtree.studio.engine import Outcome, Tell, untold
from sketchtree.studio.growth import Held, Whose
from sketchtree.studio.hand import Ended, Hand
from sketchtree.studio.laid_photo import LaidPhoto
from sketchtree.studio.making.photo_asked import Asked, Wish
from sketchtree.studio.one_job import OneJob

_REST = 1.0  # seconds without a change before it grows
_PATIENCE = 1.5  # seconds in which what is stopped ends by itself, before its process is ended
_PAUSE = 0.2  # seconds between two tellings of how far it is
_NO_TREE = SketchError("There is no tree in the photo yet.", remedy="Outline its crown, and draw along its trunk.")


@dataclass(frozen=True, eq=False)
class Seen:
    """What is known of the photo for one drawing."""

    asked: Asked
    foliages: Mapping[str, bytes]  # of crowns, by name
    remark: str  # why a crown has none


class Grower:
    """`tell` is given outcomes for the pages; `run` does work aside."""

    def __init__(self, hand: Hand, laid: LaidPhoto, tell: Callable[[Outcome], None], run: Callable[[Coroutine], None]):
        self._hand, self._laid, self._outcome, self._run = hand, laid, tell, run
        self._loop = asyncio.get_running_loop()
        self._now: tuple[int, Wish] | None = None  # the newest drawing
        self._seen: Seen | None = None
        self._shown: Wish | None = None  # as pages have it
        self._job = OneJob(hand, self._begin, _PATIENCE)
        self._given_up: tuple[Wish, str, str] | None = None  # not to be grown again: its state, and why
        self._told: messages.Growing | None = None
        self.textures: Mapping[tuple[str, str], bytes] = {}  # by material and map: those that only the tree that is shown has
        self._told_at = 0.0

    def make(self, revision: int, document: Document, *, at_once: bool = False) -> None:
        """The drawing is this now; `at_once`: it is to grow without a pause, even if it was stopped."""
        asked = self._laid.lay(document)
        wish = None if asked is None else Wish.of(document, asked.picture)
        if wish is None:
            self._now = None
            self._nothing(revision)
            return
        self._now = revision, wish
        self._laid.show(self._hand, asked)  # it is there by the time the foliage is known
        if at_once:
            self._given_up = None
        self._go_on(0.0 if at_once else _REST)

    def seen(self, seen: Seen) -> None:
        """All is known of what shows in the photo, for a drawing."""
        self._seen = seen
        if self._now is not None and self._now[1].asked.key == seen.asked.key:
            self._go_on(_REST)

    def stop(self) -> None:
        """What grows, or is to, is not wanted."""
        waits = self._job.goes_on or self._told is not None and self._told.state == "waits"
        if self._now is not None and waits:
            self._given_up = self._now[1], "stopped", ""
            self._go_on(0.0)

    def end(self) -> None:
        """End the process."""
        self._job.clear()
        self._hand.end()

    async def files(self, document: Document, name: str, options: dict, tell: Tell = untold) -> dict[str, bytes]:
        """The files that the tree of a drawing becomes. Raises SketchTreeError; cancelled, its making ends."""
        wish, foliages = self._wish(document)
        return await self._hand.made("grown_files", wish, foliages, name, options, hears=lambda value: tell(*value[1:]))

    def whose(self, document: Document) -> Whose:
        """The tree of a drawing, as one that is to grow. Raises SketchTreeError."""
        wish, _ = self._wish(document)

        async def fetched(tell: Tell) -> bytes:
            return await self._hand.made("standing", *self._wish(document), hears=lambda value: tell(*value[1:]))

        return Whose(Held(("photo", wish.key), wish), fetched)

    def _wish(self, document: Document) -> tuple[Wish, dict[str, bytes]]:
        """(what is wanted of the process, which has the photo now; the foliage that is known)."""
        asked = self._laid.lay(document)
        wish = None if asked is None else Wish.of(document, asked.picture)
        if wish is None:
            raise _NO_TREE
        self._laid.show(self._hand, asked)
        return wish, dict(self._seen.foliages) if self._seen is not None and self._seen.asked.key == asked.key else {}

    def heard(self, number: int, value: tuple) -> None:
        """The process tells how far it is."""
        if not self._job.is_of(number) or self._now is None:
            return
        _, stage, done = value
        if self._loop.time() - self._told_at >= _PAUSE:
            self._tell("grows", stage=stage, done=min(max(float(done), 0.0), 1.0))

    def _go_on(self, pause: float) -> None:
        """Whatever is to be done for the newest drawing."""
        _, wish = self._now
        if self._job.made is not None and self._job.made[0].key == wish.key and self._given_up is None:
            self._job.works(wish, self._job.made[1])
            return
        self._job.halt()
        if self._shown is not None and self._shown.key == wish.key:
            self._given_up = None
            self._tell("ready", done=1.0)
        elif self._given_up is not None and self._given_up[0].key == wish.key:
            self._tell(self._given_up[1], remark=self._given_up[2])
        elif self._seen is None or self._seen.asked.key != wish.asked.key:
            self._tell("waits")
        elif self._seen.remark:
            self._tell("failed", remark=self._seen.remark)
        else:
            self._given_up = None
            self._tell("waits")
            self._job.later(pause)

    def _begin(self) -> None:
        revision, wish = self._now
        self._laid.show(self._hand, wish.asked)
        number, answer = self._hand.ask("grow", revision, wish, dict(self._seen.foliages))
        self._job.works(wish, number)
        self._tell("grows")
        self._run(self._grown(revision, number, answer))

    async def _grown(self, revision: int, number: int, answer: asyncio.Future) -> None:
        try:
            found, why = await answer, ""
        except Ended:
            found, why = None, "The process that grows it ended. Grow it again."
        except SketchTreeError as error:
            found, why = None, f"{error.message} {error.remedy}"
        if not self._job.is_of(number) or not (found or why):
            return
        wish = self._job.done()
        if why:
            self._given_up = wish, "failed", why
            self._tell("failed", remark=why)
            return
        frame, self.textures = found
        self._shown = wish
        self._outcome(Outcome(revision, frame, of_photo=True))
        self._tell("ready", done=1.0)

    def _nothing(self, revision: int) -> None:
        """There is no tree to grow."""
        self._job.halt()
        self._shown = self._given_up = None
        if self._told is not None and self._told.state != "none":
            self._say(messages.Growing(revision=revision, state="none"))

    def _tell(self, state: str, **more) -> None:
        self._say(messages.Growing(revision=self._now[0], state=state, **more))

    def _say(self, said: messages.Growing) -> None:
        if self._told is not None and (said.state, said.stage, said.done, said.remark) == (self._told.state, self._told.stage, self._told.done, self._told.remark):
            return
        self._told, self._told_at = said, self._loop.time()
        self._outcome(Outcome(said.revision, said))
