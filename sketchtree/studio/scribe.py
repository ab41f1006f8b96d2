"""How is a step in the journal before it is answered, and nobody waits? Lines that come while others are being written go to the disk with one flush.

Lines that could not be written, as on a full disk, are kept, and go before the next ones: a journal without them would not make sense. They are tried again
by themselves, until the disk takes them.
"""

import asyncio
from collections.abc import Callable

from sketchtree.studio.journal_lines import Line
from sketchtree.studio.recovery import Journal

FULL = 256  # steps that wait for the disk before those who make more are held up
AGAIN = 3.0  # seconds after which lines that could not be written are tried again


class Scribe:
    """Writes on another thread; tells on the event loop, in the order of the steps."""

    def __init__(self, journal: Journal | None, on_failure: Callable[[OSError | None], None]):
        """`on_failure` is told why lines can't be written, once, and None when they are."""
        self._journal = journal
        self._on_failure = on_failure
        self._waiting: list[tuple[tuple[Line, ...], Callable[[], None]]] = []
        self._task: asyncio.Task | None = None
        self._room = asyncio.Event()
        self._room.set()
        self._owed: list[Line] = []  # could not be written yet
        self._timer: asyncio.TimerHandle | None = None  # until they are tried again

    @property
    def journal(self) -> Journal | None:
        """Where it writes."""
        return self._journal

    def write(self, lines: tuple[Line, ...], then: Callable[[], None]) -> None:
        """`then` is called when the lines are on the disk, or could not be written."""
        if self._journal is None:
            then()
            return
        self._waiting.append((lines, then))
        if len(self._waiting) >= FULL:
            self._room.clear()
        if self._task is None or self._task.done():
            self._task = asyncio.get_running_loop().create_task(self._work())

    def after(self, do: Callable[[], None]) -> None:
        """`do` is called after all that was given before is written; at once where nothing waits."""
        if self._task is None or self._task.done():
            do()
        else:
            self.write((), do)

    async def room(self) -> None:
        """Wait until the disk keeps up."""
        await self._room.wait()

    async def rest(self) -> None:
        """Wait until all is written; what could not be is tried once more."""
        self._try_again()
        while self._task is not None and not self._task.done():
            await asyncio.shield(self._task)

    @property
    def owes(self) -> bool:
        """Are there lines that could not be written?"""
        return bool(self._owed)

    def turn_to(self, journal: Journal | None) -> None:
        """Write elsewhere from now on, and nothing of what could not be written: it is safe in another way. Called at rest."""
        if self._owed:
            self._owed = []
            self._on_failure(None)
        self._journal = journal

    def end(self) -> None:
        """Nothing is tried again."""
        if self._timer is not None:
            self._timer.cancel()

    def _try_again(self) -> None:
        if self._owed and (self._task is None or self._task.done()):
            self.write((), lambda: None)

    async def _work(self) -> None:
        while self._waiting:
            batch, self._waiting = self._waiting, []
            self._room.set()
            owed, lines = bool(self._owed), [*self._owed, *(line for lines, _ in batch for line in lines)]
            try:
                await asyncio.to_thread(self._journal.write, *lines)
                self._owed = []
                if owed:
                    self._on_failure(None)
            except OSError as error:
                self._owed = lines
                if not owed:
                    self._on_failure(error)
            for _, then in batch:
                then()
        if self._owed:
            self.end()
            self._timer = asyncio.get_running_loop().call_later(AGAIN, self._try_again)
