"""How does a page get the growth of the tree? As an animated GLB, made aside by a process of its own, which ends when nobody has asked for a while.

    asked → (the same as last time: at once) → made → page          a page that hangs up, or asks for another, stops what is being made
"""

import asyncio
from collections.abc import Callable
from functools import partial
from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from sketchtree.editing.document import Document
from sketchtree.errors import SketchError
from sketchtree.studio.hand import Hand

_PATIENCE = 6.0  # seconds in which what is stopped ends by itself, before its process is ended: another one begins slowly, and this one gives way to all others
_FORGETS = 180.0  # seconds without a wish, after which the process and the last growth go
_FIELDS = ("strokes", "edits", "settled", "reading", "tree", "seed")  # of a document, that its tree hangs on


class Ageing(msgspec.Struct, forbid_unknown_fields=True, frozen=True, kw_only=True):
    """How the tree is to grow (`sketchtree.growth.plan`)."""

    mode: Literal["age", "full", "scale"] = "full"
    bend: Annotated[float, Meta(ge=-60, le=60)] = 0.0  # degrees; above 0 branches rise, below 0 they hang


class Ager:
    """Makes one growth at a time; the last one is kept."""

    def __init__(self, hand: Callable[[], Hand]):
        self._make_hand, self._hand = hand, None
        self._turn = asyncio.Lock()
        self._last: tuple[tuple, bytes] | None = None
        self._loop = asyncio.get_running_loop()
        self._forget: asyncio.TimerHandle | None = None

    async def made(self, document: Document, ageing: Ageing) -> bytes:
        """The bytes of the GLB. Raises SketchTreeError; cancelled, its making ends."""
        if not document.strokes:
            raise SketchError("There is no tree that could grow.", remedy="Draw a trunk first.")
        asked = (*(getattr(document, name) for name in _FIELDS), ageing)
        async with self._turn:
            self._used()
            if self._last is None or not _same(self._last[0], asked):
                self._last = None
                self._last = asked, await self._ask(document, ageing)
            self._used()
            return self._last[1]

    def end(self) -> None:
        """End the process, and forget."""
        if self._forget is not None:
            self._forget.cancel()
            self._forget = None
        self._last = None
        if self._hand is not None:
            self._hand.end()

    async def _ask(self, document: Document, ageing: Ageing) -> bytes:
        self._hand = self._hand or self._make_hand()
        number, answer = self._hand.ask("age", document.replace(underlay=None), ageing.mode, ageing.bend)
        try:
            return await answer
        except asyncio.CancelledError:
            self._hand.stop()
            self._loop.call_later(_PATIENCE, partial(self._make_sure, number))
            raise

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


def _same(one: tuple, other: tuple) -> bool:
    """Documents are immutable: what is the same object is the same. Small parts are compared."""
    return all(a is b for a, b in zip(one[:3], other[:3], strict=True)) and one[3:] == other[3:]
