"""What was done, in steps that can be taken back and done again, without limit.

Of every step only what it changed is kept, and where the depths had settled: taking it back gives the very tree that was there before.
"""

from collections.abc import Hashable
from dataclasses import dataclass

from sketchtree.editing.document import Document
from sketchtree.editing.settled import Settled
from sketchtree.studio.change import Change, apply, change, inverse

MERGED = 1.0  # seconds within which like steps become one


@dataclass(frozen=True, eq=False)
class _Way:
    """From one state to its neighbour in time."""

    label: str
    change: Change
    settled: Settled  # of the neighbour
    state: int  # number of the neighbour


class History:
    """One document through time. Each state has a number that no other ever has."""

    def __init__(self, document: Document):
        self.document = document
        self.state = 0
        self._last = 0
        self._back: list[_Way] = []
        self._on: list[_Way] = []
        self._alike: Hashable = None  # what steps like the last are known by
        self._when = 0.0  # of the last step

    @property
    def undo_label(self) -> str | None:
        """What undo would take back; None: nothing to undo."""
        return self._back[-1].label if self._back else None

    @property
    def redo_label(self) -> str | None:
        """What redo would do again; None: nothing to redo."""
        return self._on[-1].label if self._on else None

    def step(self, what: Change, label: str, *, now: float, alike: Hashable = None) -> bool:
        """A step is done. One of the same `alike` as the last, within a second of it, becomes one with it: then True is returned."""
        merges = alike is not None and alike == self._alike and bool(self._back) and not self._on and now - self._when <= MERGED
        self.put(what, label, merges=merges)
        self._alike, self._when = alike, now
        return merges

    def put(self, what: Change, label: str, *, merges: bool) -> None:
        """A step is done, by itself or as one with that before it."""
        document = apply(self.document, what)
        back, state, settled = inverse(what, self.document), self.state, self.document.settled
        if merges:
            last = self._back.pop()
            back, state, settled = change(document, apply(self.document, last.change)), last.state, last.settled
        self._back.append(_Way(label, back, settled, state))
        self._on.clear()
        self._last += 1
        self.document, self.state = document, self._last

    def states(self) -> tuple[list[int], list[int]]:
        """Numbers of the states that undo leads to, and redo; the nearest last."""
        return [way.state for way in self._back], [way.state for way in self._on]

    def part(self) -> None:
        """The next step is one by itself, however like the last it is."""
        self._alike = None

    def keep(self, document: Document) -> None:
        """The present state is so: no step."""
        self.document = document

    def undo(self) -> bool:
        """One step back; False: there is none."""
        return self._walk(self._back, self._on)

    def redo(self) -> bool:
        """One step on; False: there is none."""
        return self._walk(self._on, self._back)

    def _walk(self, ways: list[_Way], others: list[_Way]) -> bool:
        if not ways:
            return False
        way = ways.pop()
        there = apply(self.document, way.change).replace(settled=way.settled)
        others.append(_Way(way.label, inverse(way.change, self.document), self.document.settled, self.state))
        self.document, self.state = there, way.state
        self._alike = None
        return True
