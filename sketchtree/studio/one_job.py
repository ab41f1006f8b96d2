"""How is one thing made in a process of its own, the newest that was wished? After a pause without a change; what is not wished any more ends, by itself or with its process.

    wish → a pause → begun (`begin`) → done          another wish, or none: halted
"""

import asyncio
from collections.abc import Callable
from functools import partial

from sketchtree.studio.hand import Hand


class OneJob:
    """The one job of a process. `begin` asks the process for what is wished now, and says so (`works`); `patience`: seconds in which what is halted ends by itself, before its process is ended."""

    def __init__(self, hand: Hand, begin: Callable[[], None], patience: float):
        self._hand, self._begin, self._patience = hand, begin, patience
        self._loop = asyncio.get_running_loop()
        self.made: tuple[object, int] | None = None  # what is being made, and the number of its job
        self._soon: asyncio.TimerHandle | None = None

    @property
    def goes_on(self) -> bool:
        """It is being made, or soon will be."""
        return self.made is not None or self._soon is not None

    def is_of(self, number: int) -> bool:
        """Is that the job that is wished now?"""
        return self.made is not None and self.made[1] == number

    def later(self, pause: float) -> None:
        """Begin after so many seconds."""
        self._soon = self._loop.call_later(pause, self._begin_now)

    def works(self, wish: object, number: int) -> None:
        """It has begun."""
        self.made = wish, number

    def done(self) -> object:
        """It has ended; what was wished."""
        (wish, _), self.made = self.made, None
        return wish

    def halt(self) -> None:
        """Nothing is made from now on."""
        self.clear()
        if self.made is not None:
            (_, number), self.made = self.made, None
            self._hand.stop()
            self._loop.call_later(self._patience, partial(self._make_sure, number))

    def clear(self) -> None:
        """Nothing begins by itself."""
        if self._soon is not None:
            self._soon.cancel()
            self._soon = None

    def _begin_now(self) -> None:
        self._soon = None
        self._begin()

    def _make_sure(self, number: int) -> None:
        """A job that does not end when it should is ended with its process; what was asked since is asked again."""
        if self._hand.waits_for(number):
            again, self.made = self.made is not None, None
            self._hand.begin()
            if again:
                self._begin()
