"""What waits to be sent to one page? A page that reads slowly gets the newest of each kind, never a growing heap.

`Changed` messages each say what is different, so none may be left out: where too many wait, one with everything takes their place. A `Tree` frame holds
only what is new; where one gives way to a newer one, the page gets the whole tree instead of both. That is asked for aside, so that nothing else waits for
it; frames that come meanwhile are sent after it, unless they are older.
"""

import asyncio
from collections.abc import Awaitable, Callable, Hashable

import msgspec

from sketchtree.errors import SketchTreeError
from sketchtree.studio import messages

MOST = 4096  # `Changed` messages that wait, and
MOST_BYTES = 8_000_000  # bytes of them
_TROUBLES = 16

_WHOLE, _ALL, _TREE, _GLANCE, _PHOTO = "whole", "all", "tree", "glance", "photo"  # the whole drawing, the whole tree, what is new of the tree, a glance, a photo's tree
_STALE = None  # in the place of a frame: the page needs the whole tree


class _Head(msgspec.Struct):
    """What must be known of a frame."""

    type: str
    phase: str = ""
    revision: int = 0


class Outbox:
    """Filled by `put`, emptied by `next`, both on the event loop."""

    def __init__(self, whole: Callable[[], messages.Changed], frame: Callable[[], Awaitable[bytes | None]]):
        self._whole, self._frame = whole, frame
        self._waiting: dict[Hashable, bytes | str | int | None] = {}
        self._changes: list[tuple[int, str]] = []  # since, text
        self._size = 0
        self._told = 0  # revision of the last whole message
        self._troubles = 0
        self._some = asyncio.Event()
        self._asking: asyncio.Task | None = None  # for the whole tree

    def __len__(self) -> int:
        return len(self._waiting) + len(self._changes)

    def put(self, event: messages.Event | bytes) -> None:
        """An event is to be sent; bytes are a binary frame."""
        self.put_encoded(event, event if isinstance(event, bytes) else encode(event))

    def put_encoded(self, event: messages.Event | bytes, said: bytes | str) -> None:
        """The same of an event that is encoded already, for many pages."""
        if isinstance(event, bytes):
            self._put_frame(said)
        elif isinstance(event, messages.Changed):
            self._put_change(event.since, said)
        elif isinstance(event, messages.Trouble):
            self._troubles += 1
            self._waiting.pop(("trouble", self._troubles - _TROUBLES), None)
            self._waiting["trouble", self._troubles] = said
        elif isinstance(event, messages.Making):
            self._newest(("making", event.id), said)
        else:
            self._newest(type(event), said)
        self._some.set()

    def everything(self) -> None:
        """The page knows nothing, or too little: it is to get the whole drawing and the whole tree."""
        self._changes.clear()
        self._size = 0
        self._newest(_WHOLE, None)
        self._newest(_TREE, _STALE)
        self._some.set()

    def close(self) -> None:
        """The page is gone."""
        if self._asking is not None:
            self._asking.cancel()

    async def next(self) -> bytes | str:
        """What is to be sent now; waits until there is something."""
        while True:
            await self._some.wait()
            said = self._taken()
            if said is not None:
                return said

    def _taken(self) -> bytes | str | None:
        if _WHOLE in self._waiting:
            return self._taken_whole()
        if self._changes:
            since, said = self._changes.pop(0)
            self._size -= len(said)
            return said if since >= self._told else None
        key = next((key for key in self._waiting if key != _TREE or self._asking is None), None)
        if key is None:
            self._some.clear()
            return None
        said = self._waiting.pop(key)
        if key == _TREE and said is _STALE:
            self._asking = asyncio.get_running_loop().create_task(self._ask())
        return said

    async def _ask(self) -> None:
        """The whole tree goes before what came while it was asked for; what is older than it goes."""
        try:
            frame = await self._frame()
        except SketchTreeError:
            frame = None
        came = self._waiting.pop(_TREE, b"")
        if frame is not None:
            self._newest(_ALL, frame)
        if came is _STALE or came and (frame is None or head_of(came).revision > head_of(frame).revision):
            self._newest(_TREE, came)
        self._asking = None
        self._some.set()

    def _taken_whole(self) -> str:
        del self._waiting[_WHOLE]
        self._changes.clear()
        self._size = 0
        event = self._whole()
        self._told = event.revision
        return encode(event)

    def _put_change(self, since: int, said: str) -> None:
        if _WHOLE in self._waiting:
            return
        self._changes.append((since, said))
        self._size += len(said)
        if len(self._changes) > MOST or (self._size > MOST_BYTES and len(self._changes) > 1):
            self._changes.clear()
            self._size = 0
            self._newest(_WHOLE, None)

    def _put_frame(self, frame: bytes) -> None:
        head = head_of(frame)
        if head.type != "tree":
            self._newest(head.type, frame)
        elif head.phase == "photo":
            self._newest(_PHOTO, frame)
        elif head.phase == "glance":
            self._newest(_GLANCE, frame)
        else:
            self._waiting.pop(_GLANCE, None)
            self._newest(_TREE, _STALE if _TREE in self._waiting else frame)  # pages that wait for the whole tree wait for it once more

    def _newest(self, key: Hashable, said) -> None:
        self._waiting.pop(key, None)
        self._waiting[key] = said


def encode(event: messages.Event) -> str:
    """An event as text."""
    return msgspec.json.encode(event).decode()


def head_of(frame: bytes) -> _Head:
    """The head of a binary frame (`messages`)."""
    return msgspec.json.decode(memoryview(frame)[4 : 4 + int.from_bytes(frame[:4], "little")], type=_Head)
