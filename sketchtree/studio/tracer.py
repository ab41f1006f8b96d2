"""Which limbs show in the photo under the page? Asked at each stroke, of processes of its own, so that they are there before the tree is.

    stroke → limbs traced → pages                 ≤ 100 ms; the newest wins
           → a crown that is new → its foliage, found by a second process → limbs traced again, now apart from leaves → pages, and its tint

The processes begin when a photo is first there. They keep it; should the first end, it is begun again and told what it knew.
"""

from collections.abc import Callable, Coroutine, Mapping
from dataclasses import replace

from sketchtree.editing.document import Document
from sketchtree.errors import SketchError, SketchTreeError
from sketchtree.sketch.strokes import StrokeKind
from sketchtree.studio import messages
from sketchtree.studio.grower import Seen
from sketchtree.studio.hand import Hand
from sketchtree.studio.ids import fitting
from sketchtree.studio.laid_photo import LaidPhoto, unheard
from sketchtree.studio.making.photo_asked import KEPT, Asked, is_mark, is_photo

_NOTHING = "No stroke marks a limb in the photo."
_STOPPED = "Stopped looking for the foliage. The next stroke looks again."
_FAINT = 0.5  # how strong the photo is, at most, below limbs that were taken over


class Tracer:
    """`hand` traces, `other` finds foliage; `tell` is given what pages are to know, `seen` what is known once nothing is looked for; `run` does work aside."""

    def __init__(
        self, hand: Hand, other: Hand, laid: LaidPhoto, tell: Callable[[int, messages.Event], None], seen: Callable[[Seen], None], run: Callable[[Coroutine], None]
    ):
        self._hand, self._other, self._laid, self._tell, self._seen, self._run = hand, other, laid, tell, seen, run
        self._asked: tuple[int, Asked] | None = None  # what the page shows now: revision, and what is to be traced; None: nothing
        self._picture = ""  # digest of the photo of which this is known:
        self._foliage: dict[str, bytes] = {}  # of crowns, by name: for a process that is begun again
        self._reasons: dict[str, str] = {}  # why crowns have none
        self._finds = self._given_up = False  # foliage is being looked for; it is not wanted any more
        self._limbs: list[messages.TracedTree] = []  # traced last
        self._tinted: tuple[str, ...] = ()  # crowns whose foliage the pages have
        self._is_on = False

    def make(self, revision: int, document: Document) -> None:
        """The drawing is this now."""
        if not is_photo(document.underlay):
            self._asked = None
            if self._is_on:
                self._is_on, self._tinted = False, ()
                self._tell(revision, messages.Traced(revision=revision, trees=[], remark=""))
                self._tell(revision, messages.Foliage(revision=revision, png=""))
            return
        self._asked = revision, self._lay(document)
        self._is_on = True
        self._run(self._trace(revision))

    async def taken_over(self, document: Document) -> Document:
        """The drawing in which the traced limbs stand for the strokes that mark them. Raises SketchTreeError."""
        limbs = await self._answer("limbs", document)
        if not limbs:
            raise SketchError(_NOTHING, remedy="Draw along the trunk, from its foot.")
        rest = {name: stroke for name, stroke in document.strokes.items() if not (is_mark(stroke) and stroke.kind == StrokeKind.BRANCH)}
        strokes = rest | {stroke.id if stroke.id not in rest else f"{stroke.id}'": stroke for stroke in limbs}
        strokes = {name: stroke if stroke.id == name else replace(stroke, id=name) for name, stroke in strokes.items()}
        faint = replace(document.underlay, photo=False, opacity=min(document.underlay.opacity, _FAINT))
        return fitting(document.replace(strokes=strokes, underlay=faint))

    async def as_svg(self, document: Document) -> bytes:
        """The strokes that mark the photo, in its pixels. Raises SketchTreeError."""
        return await self._answer("svg", document)

    async def proposed(self, document: Document) -> tuple[Document, str]:
        """(the drawing with strokes that mark its photo's main tree, in place of those that do; what speaks against them). Raises SketchTreeError."""
        strokes, why = await self._answer("propose", document)
        rest = {name: stroke for name, stroke in document.strokes.items() if not is_mark(stroke)}
        return fitting(document.replace(strokes=rest | {one.id: one for one in (replace(stroke, id=_free(stroke.id, rest)) for stroke in strokes)})), why

    async def _answer(self, kind: str, document: Document):
        """What the process that has the photo says of a drawing. Raises SketchTreeError where there is no photo."""
        if not is_photo(document.underlay):
            raise SketchError("The picture under the page is only one to trace over.", remedy="Switch 'From photo' on first.")
        asked = self._lay(document)
        self._show(self._hand, asked)
        return await self._hand.ask(kind, asked)[1]

    def end(self) -> None:
        """End the processes."""
        self._hand.end()
        self._other.end()

    def cancel(self) -> None:
        """What is being traced and looked for is not wanted. The next stroke asks again."""
        self._hand.stop()
        if self._finds:
            self._given_up = True
            self._other.begin()  # nothing else ends it; another one is ready for the next crown

    def _lay(self, document: Document) -> Asked:
        """What is asked; the picture is at hand."""
        asked = self._laid.lay(document)
        if asked.picture != self._picture:
            self._picture, self._foliage, self._reasons = asked.picture, {}, {}
        return asked

    def _show(self, hand: Hand, asked: Asked) -> None:
        """The process has the photo, and what is known of it."""
        if self._laid.show(hand, asked) and hand is self._hand and self._foliage:
            unheard(hand.ask("learn", self._foliage)[1])

    async def _trace(self, revision: int) -> None:
        """The limbs of the newest drawing, and after them what became known of foliage."""
        if self._asked is None or self._asked[0] != revision:
            return
        asked = self._asked[1]
        self._show(self._hand, asked)
        try:
            answer = await self._hand.ask("trace", revision, asked)[1]
        except SketchTreeError as error:
            answer = messages.Traced(revision=revision, trees=[], remark=f"{error.message} {error.remedy}"), (), {}
        self._show(self._other, asked)  # a crown is soon to come
        if answer is None or self._asked is None or self._asked[0] != revision:
            return
        told, known, unknown = answer
        self._limbs = told.trees
        remark = told.remark or next((self._reasons[name] for name in unknown if name in self._reasons), "")
        waits = len(known) + len(unknown) <= KEPT and any(name not in self._reasons for name in unknown)
        self._tell(revision, messages.Traced(revision=revision, trees=told.trees, remark=remark, waits=waits))
        if not waits:
            self._seen(Seen(asked, {name: self._foliage[name] for name in known if name in self._foliage}, remark if unknown else ""))
        if waits and not self._finds:  # one after the other: what is wanted when it is found is asked for then
            self._finds = True
            self._run(self._find(asked, {name: crown for name, crown in unknown.items() if name not in self._reasons}))
        if known != self._tinted:
            await self._tint(revision, known)

    async def _tint(self, revision: int, names: tuple[str, ...]) -> None:
        try:
            event = await self._hand.ask("tint", revision, names)[1]
        except SketchTreeError:
            return
        if event is not None and self._asked is not None and self._asked[0] == revision:
            self._tinted = names
            self._tell(revision, event)

    async def _find(self, asked: Asked, wanted: dict[str, bytes]) -> None:
        """The foliage of crowns; then the limbs once more."""
        try:
            self._show(self._other, asked)
            found, reasons = await self._other.ask("foliage", wanted, asked.seed)[1]
        except SketchTreeError as error:
            found, reasons = {}, {} if self._given_up else dict.fromkeys(wanted, f"The foliage was not found. {error.message}")
        finally:
            self._finds = False
        if self._given_up:
            self._given_up = False
            if self._asked is not None:
                self._tell(self._asked[0], messages.Traced(revision=self._asked[0], trees=self._limbs, remark=_STOPPED))
            return
        if asked.picture == self._picture:
            self._reasons |= reasons
            self._foliage |= found
            for name in list(self._foliage)[:-KEPT]:
                del self._foliage[name]
            if found and self._hand.runs:
                unheard(self._hand.ask("learn", found)[1])
        if self._asked is not None:
            await self._trace(self._asked[0])


def _free(name: str, taken: Mapping[str, object]) -> str:
    """A name that is not taken."""
    while name in taken:
        name += "'"
    return name
