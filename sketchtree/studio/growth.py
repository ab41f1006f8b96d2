"""How does a page get the growth of the tree? As an animated GLB, or as files to keep, made aside by a process of its own, which ends when nobody has asked for a while.

    asked → (the same as last time: at once) → made → page          a page that hangs up, or asks for another, stops what is being made

The tree of a drawing is made by that process of its document. One of a photo stands in the process that grew it; it is fetched from there, once for all ways to grow.
"""

import asyncio
from collections.abc import Awaitable, Callable, Hashable
from dataclasses import dataclass
from functools import partial
from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from sketchtree.editing.document import Document
from sketchtree.errors import SketchError
from sketchtree.studio import messages
from sketchtree.studio.engine import Tell, untold
from sketchtree.studio.hand import Hand

FILMS = (".mp4", ".gif")  # kinds of film
MOVING = (".glb", ".gltf", ".usdz", ".usd", ".usda", ".usdc")  # and of files that move
_PATIENCE = 6.0  # seconds in which what is stopped ends by itself, before its process is ended: another one begins slowly, and this one gives way to all others
_FORGETS = 180.0  # seconds without a wish, after which the process and the last growth go
_FIELDS = ("strokes", "edits", "settled", "cloud", "reading", "tree", "seed")  # of a document, that its tree hangs on
_FETCHED = 0.4  # of the work, that fetching a tree from the process that grew it is


class Ageing(msgspec.Struct, forbid_unknown_fields=True, frozen=True, kw_only=True):
    """How the tree is to grow (`sketchtree.growth.plan`)."""

    mode: Literal["age", "full", "scale"] = "full"
    bend: Annotated[float, Meta(ge=-60, le=60)] = 0.0  # degrees; above 0 branches rise, below 0 they hang


class Growing(Ageing):
    """What a page asks for."""

    tree: Literal["drawn", "photo"] = "drawn"  # photo: the one of the photo under the page, by its strokes or by its scribbles
    id: messages.Id | None = None  # how far it is, is told under this one (`messages.Making`)

    @property
    def ageing(self) -> Ageing:
        """How it grows."""
        return Ageing(mode=self.mode, bend=self.bend)


class Grown(Ageing):
    """What a file of the growth is to be."""

    seconds: Annotated[float, Meta(ge=0.1, le=60)] = 10.0  # that it takes
    lod: Annotated[int, Meta(ge=0, le=3)] = 0  # level of detail


class Held:
    """Something to know a tree by. `key` may have addresses of what `of` holds, which stay true for as long as this is there."""

    def __init__(self, key: Hashable, of: object):
        self._key, self._of = key, of

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Held) and self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)


@dataclass(frozen=True, eq=False)
class Whose:
    """The tree that is to grow: that of a drawing, or one that stands in another process."""

    key: Held
    of: Document | Callable[[Tell], Awaitable[bytes]]  # the latter fetches it (`making.growth.Standing`)

    @classmethod
    def drawn(cls, document: Document) -> "Whose":
        """That of a drawing. Raises SketchError where there is none."""
        if not document.drawn.strokes:
            raise SketchError("There is no tree that could grow.", remedy="Draw a trunk first.")
        parts = [getattr(document, name) for name in _FIELDS]
        return cls(Held((*map(id, parts[:4]), *parts[4:]), document), document.drawn)  # documents are immutable: large parts that are the same object are the same


class Ager:
    """Makes one growth at a time; the last one for a page is kept."""

    def __init__(self, hand: Callable[[], Hand]):
        self._make_hand, self._hand = hand, None
        self._turn = asyncio.Lock()
        self._last: tuple[tuple, bytes] | None = None
        self._stands: tuple[Held, int, str] | None = None  # whose tree lies before which process, and the name it goes by
        self._names = 0
        self._loop = asyncio.get_running_loop()
        self._forget: asyncio.TimerHandle | None = None

    async def made(self, whose: Whose, ageing: Ageing, tell: Tell = untold) -> bytes:
        """The bytes of the GLB. Raises SketchTreeError; cancelled, its making ends."""
        asked = whose.key, ageing
        async with self._turn:
            if self._last is None or self._last[0] != asked:
                self._last = None
                self._last = asked, await self._ask("age", whose, (ageing.mode, ageing.bend), tell)
            self._used()
            return self._last[1]

    async def files(self, whose: Whose, name: str, grown: Grown, tell: Tell = untold, *, film: bool = False) -> dict[str, bytes]:
        """Files to keep, by name: animated, or a film. Raises SketchTreeError; cancelled, its making ends."""
        async with self._turn:
            return await self._ask("film" if film else "moving", whose, (name, grown.mode, grown.bend, grown.seconds, grown.lod), tell)

    def end(self) -> None:
        """End the process, and forget."""
        if self._forget is not None:
            self._forget.cancel()
            self._forget = None
        self._last = self._stands = None
        if self._hand is not None:
            self._hand.end()

    async def _ask(self, kind: str, whose: Whose, how: tuple, tell: Tell):
        self._used()
        self._hand = self._hand or self._make_hand()
        low = 0.0 if isinstance(whose.of, Document) else _FETCHED
        of = whose.of if isinstance(whose.of, Document) else await self._fetched(whose, lambda stage, done: tell(stage, low * done))
        work = asyncio.ensure_future(self._hand.made(kind, of, *how, hears=lambda value: tell(value[1], low + (1 - low) * value[2])))
        try:
            return await work
        except asyncio.CancelledError:
            self._loop.call_later(_PATIENCE, partial(self._make_sure, self._hand.newest))
            raise
        finally:
            self._used()

    async def _fetched(self, whose: Whose, tell: Tell) -> str:
        """The name that a tree of another process goes by in this one."""
        self._hand.ready()
        if self._stands is None or self._stands[:2] != (whose.key, self._hand.begun):
            self._stands = None
            standing = await whose.of(tell)
            self._names += 1
            name = f"tree {self._names}"
            await self._hand.made("stand", name, standing)
            self._stands = whose.key, self._hand.begun, name
        return self._stands[2]

    def _make_sure(self, number: int) -> None:
        """A job that does not end when it should is ended with its process, unless another was asked for since: that waits for it."""
        if self._hand.waits_for(number) and not self._turn.locked():
            self._hand.end()

    def _used(self) -> None:
        if self._forget is not None:
            self._forget.cancel()
        self._forget = self._loop.call_later(_FORGETS, self._gone)

    def _gone(self) -> None:
        if self._turn.locked():
            self._used()
        else:
            self.end()
