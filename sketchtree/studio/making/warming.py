"""When is what is slow only the first time made ready? Aside, one program after the other on one thread, in moments when nobody waits for anything else.

    points behind the drawing: their programs, those of small drawings first → those of every other drawing
"""

import threading
from collections.abc import Callable

from sketchtree.studio.making import warm

POINTS, PLAIN = "points", "plain"
_ORDER = {POINTS: warm.FOR_POINTS, PLAIN: warm.LIMBS}
_FIRST = (POINTS, warm.FOR_POINTS[0])


class Warming:
    """`quick`: the programs of hurried answers; `rests`: returns in a good moment; `make` does what `warm_up` does."""

    def __init__(self, quick: bool, rests: Callable[[], None], make: Callable[..., None] = warm.warm_up):
        self._quick, self._rests, self._make = quick, rests, make
        self._wanted: list[tuple[str, int]] = []  # kinds, and limbs, of the drawings whose programs are to come
        self._seen: set[tuple[str, int]] = set()  # that were wanted ever
        self._waits: list[Callable[[], None]] | None = []  # who is told when there is a program for points; None: there is one
        self._turn = threading.Lock()
        self._thread: threading.Thread | None = None

    def begin(self) -> None:
        """The programs of every drawing."""
        self._want(PLAIN)

    def for_points(self, ready: Callable[[], None]) -> None:
        """Those of drawings with points behind them, before all others; `ready` is called once the first is there."""
        with self._turn:
            there = self._waits is None
            if not there:
                self._waits.append(ready)
        if there:
            ready()
        self._want(POINTS)

    def _want(self, kind: str) -> None:
        with self._turn:
            fresh = [(kind, limbs) for limbs in _ORDER[kind] if (kind, limbs) not in self._seen]
            self._seen.update(fresh)
            self._wanted = sorted(self._wanted + fresh, key=lambda one: one[0] != POINTS)  # each kind in its own order
            if self._thread is None and self._wanted:
                self._thread = threading.Thread(target=self._run, daemon=True)
                self._thread.start()

    def _run(self) -> None:
        while True:
            self._rests()
            with self._turn:
                if not self._wanted:
                    self._thread = None
                    return
                kind, limbs = self._wanted.pop(0)
            self._make(self._quick, limbs, seen=kind == POINTS)
            if (kind, limbs) == _FIRST:
                with self._turn:
                    waits, self._waits = self._waits, None
                for ready in waits:
                    ready()
