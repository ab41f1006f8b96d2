"""When is the tree in the points behind the drawing traced? Once it is asked for, aside, in a process of its own; other leaves or another season trace nothing anew.

    "trace it", options → a pause → traced → pages     the newest wins; one that is the same as that shown is not made again

What is shown stays until the next is there, and goes when the tree is that of the strokes again.
"""

from collections.abc import Callable, Coroutine

from sketchtree.editing.document import Document
from sketchtree.errors import SketchError
from sketchtree.studio import messages
from sketchtree.studio.engine import Outcome, Tell, untold
from sketchtree.studio.growth import Held, Whose
from sketchtree.studio.hand import Hand
from sketchtree.studio.made_aside import MadeAside
from sketchtree.studio.making.cloud_asked import CloudWish

_REST = 0.4  # seconds without a change before it is made
_PAUSE = 0.2  # seconds between two tellings of how far it is
_PATIENCE = 6.0  # seconds in which what is stopped ends by itself, before its process is ended: ways through points have no pulse
_NO_TREE = SketchError("No tree is traced in the points.", remedy="Trace it first.")


class CloudTracer(MadeAside):
    """`tell` is given outcomes for the pages; `run` does work aside."""

    def __init__(self, hand: Hand, tell: Callable[[Outcome], None], run: Callable[[Coroutine], None]):
        super().__init__(hand, tell, run, job="points", ended="The process that traces it ended. Trace it again.", patience=_PATIENCE)

    def make(self, revision: int, document: Document, *, at_once: bool = False) -> None:
        """The drawing is this now; `at_once`: without a pause, even if it was stopped."""
        wish = CloudWish.of(document)
        if wish is None:
            self._nothing(revision)
            return
        self._now = revision, wish
        self._wished(_REST, at_once=at_once)

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
        if self._job.is_of(number) and self._now is not None:
            self._how_far(value, _PAUSE)

    def _nothing(self, revision: int) -> None:
        """The tree is not the one in the points."""
        self._job.halt()
        if self._now is not None:
            self._now = self._done = None
            self._outcome(Outcome(revision, messages.Growing(revision=revision, state="none")))
