"""How does the event loop speak with one process that makes trees? It asks, and has an answer to come; a process that ends is begun again when it is asked next."""

import asyncio
import contextlib
import multiprocessing
import pickle
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from multiprocessing import resource_tracker
from pathlib import Path

from sketchtree.errors import SketchTreeError
from sketchtree.studio.engine import Fault


@contextlib.contextmanager
def _no_ctrl_c() -> Iterator[None]:
    """A process begun meanwhile never hears Ctrl-C at the terminal, not even while it starts: the studio ends it. The studio itself hears of it afterwards."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    resource_tracker.ensure_running()  # `start` would do so, and lift the block
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


class Ended(Fault):
    """A process ended before it had answered."""


class Hand:
    """One process, as the event loop sees it."""

    def __init__(self, role: str, database: Path | None, tell: Callable[[int, object], None], ended: Callable[[], None] = lambda: None):
        self.role, self._database, self._tell, self._on_end = role, database, tell, ended
        self._loop = asyncio.get_running_loop()
        self._waiting: dict[int, asyncio.Future] = {}
        self._hears: dict[int, Callable[[object], None]] = {}  # who is told what one job tells
        self._number, self._pipe, self._process = 0, None, None
        self.begun = 0  # how many times: another process knows nothing of what the one before had made

    def begin(self) -> None:
        """Start the process; one that runs is ended."""
        self.end()
        self._lose()
        self.begun += 1
        context = multiprocessing.get_context("spawn")
        self._pipe, theirs = context.Pipe()
        from sketchtree.studio.making.worker import main

        self._process = context.Process(target=main, args=(theirs, None if self._database is None else str(self._database), self.role), daemon=True)
        with _no_ctrl_c():
            self._process.start()
        theirs.close()
        threading.Thread(target=self._listen, args=(self._pipe,), daemon=True).start()

    @property
    def runs(self) -> bool:
        """Whether the process is there."""
        return self._process is not None and self._process.is_alive()

    def ready(self) -> None:
        """Start the process, unless it runs."""
        if not self.runs:
            self.begin()

    def ask(self, kind: str, *arguments: object) -> tuple[int, asyncio.Future]:
        """(the job's number, its answer to be). None is answered to a job that was stopped."""
        self.ready()
        self._number += 1
        answer = self._loop.create_future()
        self._waiting[self._number] = answer
        self._send(kind, arguments)
        return self._number, answer

    async def made(self, kind: str, *arguments: object, hears: Callable[[object], None] | None = None) -> object:
        """The answer to one job; `hears` is told what it tells on its way. Whoever does not want it any more cancels it: it ends at its next pulse, and nothing else does."""
        number, answer = self.ask(kind, *arguments)
        if hears is not None:
            self._hears[number] = hears
        try:
            return await answer
        except asyncio.CancelledError:
            self.drop(number)
            raise

    def drop(self, number: int) -> None:
        """This job is not wanted."""
        if self.runs and number in self._waiting:
            self._send("drop", (), number)

    @property
    def newest(self) -> int:
        """The number of the job that was asked last."""
        return self._number

    def waits_for(self, number: int) -> bool:
        """Is the answer to that job still to come?"""
        return number in self._waiting

    def stop(self) -> None:
        """Let what runs end, and drop what waits, of kinds of which the newest wins."""
        if self.runs:
            self._send("stop", ())

    def _send(self, kind: str, arguments: tuple, number: int | None = None) -> None:
        try:
            self._pipe.send((self._number if number is None else number, kind, pickle.dumps(arguments)))
        except OSError:  # it ended a moment ago
            self._ended(self._pipe)

    def end(self) -> None:
        """End the process."""
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.join(2)

    def _listen(self, pipe) -> None:
        try:
            while True:
                number, what, value = pipe.recv()
                self._loop.call_soon_threadsafe(self._came, number, what, value)
        except (EOFError, OSError, RuntimeError):
            try:
                self._loop.call_soon_threadsafe(self._ended, pipe)
            except RuntimeError:
                pass  # the loop is closed: the studio ends

    def _came(self, number: int, what: str, value: object) -> None:
        if what == "event":
            hears = self._hears.get(number)
            self._tell(number, value) if hears is None else hears(value)
            return
        answer = self._waiting.pop(number, None)
        self._hears.pop(number, None)
        if answer is None or answer.done():
            return
        if what == "trouble":
            message, remedy, stroke = value
            error = SketchTreeError(message, remedy=remedy)
            error.stroke = stroke
            answer.set_exception(error)
        elif what == "fault":
            print(value, file=sys.stderr)
            answer.set_exception(Fault.here())
        else:
            answer.set_result(value if what == "done" else None)

    def _ended(self, pipe) -> None:
        """The process at the other end is gone; another may have been begun since."""
        if pipe is self._pipe and self._process is not None:
            self._process = None
            self._lose()
            self._on_end()

    def _lose(self) -> None:
        """What was asked of a process that is gone can be asked again."""
        waiting, self._waiting, self._hears = self._waiting, {}, {}
        for answer in waiting.values():
            if not answer.done():
                answer.set_exception(Ended("A process that makes the tree ended.", remedy="It is begun again with the next step."))
