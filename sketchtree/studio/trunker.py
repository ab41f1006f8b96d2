"""When is the tree of scribbles made? A moment after the last of them, aside, in a process of its own: no stroke waits for a matte.

    scribbles, options → a pause → matte → trunk → tree → pages     the newest wins; one that is the same as that shown is not made again

What is shown stays until the next is there, and goes when the tree is not taken from scribbles any more.
"""

from collections.abc import Callable, Coroutine

import msgspec

from sketchtree.editing.document import Document
from sketchtree.errors import SketchError
from sketchtree.studio import messages
from sketchtree.studio.engine import Outcome, Tell, untold
from sketchtree.studio.growth import Held, Whose
from sketchtree.studio.hand import Hand
from sketchtree.studio.laid_photo import LaidPhoto
from sketchtree.studio.made_aside import MadeAside
from sketchtree.studio.making.photo_asked import Asked
from sketchtree.studio.making.trunk_asked import TrunkWish

_REST = 0.6  # seconds without a change before it is made
_PAUSE = 0.2  # seconds between two tellings of how far it is
_PATIENCE = 6.0  # seconds in which what is stopped ends by itself, before its process is ended: a system of equations has no pulse
_NO_TREE = SketchError("No scribbles tell a tree yet.", remedy="Draw along its trunk, and beside it.")


class Trunker(MadeAside):
    """`tell` is given outcomes for the pages; `run` does work aside."""

    def __init__(self, hand: Hand, laid: LaidPhoto, tell: Callable[[Outcome], None], run: Callable[[Coroutine], None]):
        super().__init__(hand, tell, run, job="trunk", ended="The process that makes it ended. Make it again.", patience=_PATIENCE)
        self._laid = laid
        self._asked: Asked | None = None  # the photo that it lies on
        self._is_on = False
        self._over: dict[type, messages.Event] = {}  # what is laid over the photo: of the tree that is made, or was last
        self._shown: dict[type, messages.Event] = {}  # and of the tree that is shown

    def make(self, revision: int, document: Document, *, at_once: bool = False) -> None:
        """The drawing is this now; `at_once`: without a pause, even if it was stopped."""
        asked = self._laid.lay(document)
        wish = None if asked is None else TrunkWish.of(document, asked.picture)
        if wish is None:
            self._nothing(revision)
            return
        self._now, self._asked, self._is_on = (revision, wish), asked, True
        self._laid.show(self._hand, asked)
        self._wished(_REST, at_once=at_once)

    async def files(self, document: Document, name: str, options: dict, tell: Tell = untold) -> dict[str, bytes]:
        """The files that the tree of a drawing becomes, grown up. Raises SketchTreeError; cancelled, its making ends."""
        return await self._hand.made("trunk_files", self._wish(document), name, options, hears=_only(tell))

    def whose(self, document: Document) -> Whose:
        """The tree of a drawing, as one that is to grow. Raises SketchTreeError."""
        wish = self._wish(document)

        async def fetched(tell: Tell) -> bytes:
            return await self._hand.made("trunk_standing", self._wish(document), hears=_only(tell))

        return Whose(Held(("trunk", wish.key), wish), fetched)

    def _wish(self, document: Document) -> TrunkWish:
        """What is wanted of the process, which has the photo now."""
        asked = self._laid.lay(document)
        wish = None if asked is None else TrunkWish.of(document, asked.picture)
        if wish is None:
            raise _NO_TREE
        self._laid.show(self._hand, asked)
        return wish

    def heard(self, number: int, value: tuple) -> None:
        """The process tells what it found, and how far it is."""
        if not self._job.is_of(number) or self._now is None:
            return
        if value[0] == "event":
            self._over[type(value[1])] = value[1]
            self._outcome(Outcome(value[1].revision, value[1]))
        else:
            self._how_far(value, _PAUSE)

    def _before_asking(self) -> None:
        self._laid.show(self._hand, self._asked)

    def _before_showing(self) -> None:
        self._shown = dict(self._over)

    def _told_again(self) -> None:
        if self._done[1] == "ready":
            for event in self._shown.values():  # another may have been laid over it meanwhile
                self._outcome(Outcome(self._now[0], msgspec.structs.replace(event, revision=self._now[0])))

    def _nothing(self, revision: int) -> None:
        """The tree is not taken from scribbles."""
        self._job.halt()
        self._now = self._done = None
        self._over, self._shown = {}, {}
        if self._is_on:
            self._is_on = False
            for event in (messages.Matte(revision=revision, png=""), messages.Trunks(revision=revision, state="none"), messages.Growing(revision=revision, state="none")):
                self._outcome(Outcome(revision, event))

    def _tell(self, state: str, remark: str = "") -> None:
        """How far it is: `Trunks` for what is laid over the photo, unless that is there; `Growing` for the tree."""
        super()._tell(state, remark)
        over = {"waits": "waits", "grows": "works", "failed": "failed"}.get(state)
        if over is not None:
            self._outcome(Outcome(self._now[0], messages.Trunks(revision=self._now[0], state=over, remark=remark)))


def _only(tell: Tell) -> Callable[[tuple], None]:
    """How far a job is; what it found on the way is for those who look at the photo."""
    return lambda value: tell(*value[1:]) if value[0] == "working" else None
