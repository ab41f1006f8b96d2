"""One process that makes trees: jobs come in, outcomes go out.

A job is (number, kind, pickled arguments), an outcome (number, what, value): "event" (an event or a frame, with what is settled), "done" (the answer), "trouble" (a SketchTreeError),
"stopped", "fault" (a fault of ours, as text). Of kinds in `NEWEST` only the newest job matters: an older one that waits is dropped, one that runs ends at its next step.
Any job ends at its next step, or is never begun, once it is dropped. `LAST` wait for all others: what the tree wears goes before pictures of what it might wear. `KNOWN` wait for nothing: they ask of the tree that is made already, and
are answered on a thread of their own while the next one is being made.
The pipe is private to the two processes. Arguments are unpickled, which imports what they are made of, where the jobs are done: imports on two threads at once
may see a module that is half there.
"""

import os
import pickle
import queue
import signal
import threading
import time
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from multiprocessing.connection import Connection
from pathlib import Path

from sketchtree.errors import SketchTreeError

NEWEST = ("full", "quick", "ghost", "glance", "alternatives", "trace", "tint", "grow", "trunk", "points")
LAST = ("picture",)
KNOWN = ("find", "frame")

_REST = 0.4  # seconds without a job, after which what nobody waits for goes on
_NICE = {"quick": 0, "photo": 0, "foliage": 2, "grow": 3, "trunk": 3, "points": 3, "full": 4, "age": 4, "side": 8, "film": 9}  # what a pen waits for goes before what a tree waits for, and that before pictures; the tree of a photo stands in the place of the full one


class Desk:
    """The worker's side of the pipe."""

    def __init__(self, pipe: Connection, gone: Callable[[], None] = lambda: os._exit(0)):
        """`gone`: what is done when the server is."""
        self.pipe, self.jobs, self.known, self.gone = pipe, queue.PriorityQueue(), queue.SimpleQueue(), gone
        self._saying = threading.Lock()
        self.newest: dict[str, int] = {}
        self._idle_since: float | None = float("-inf")  # None: a job is being done
        self.ended = -1  # jobs up to this number are to stop
        self.dropped: set[int] = set()  # jobs that are not wanted
        threading.Thread(target=self._listen, daemon=True).start()

    def _listen(self) -> None:
        try:
            while True:
                number, kind, arguments = self.pipe.recv()
                if kind == "stop":
                    self.ended = number
                    continue
                if kind == "drop":
                    self.dropped.add(number)
                    continue
                self.newest[kind] = number
                (self.known if kind in KNOWN else self.jobs).put((kind in LAST, number, kind, arguments))
        except (EOFError, OSError):
            self.gone()

    def stopped(self, number: int, kind: str) -> bool:
        """Is the job not wanted any more?"""
        return number in self.dropped or kind in NEWEST and (number <= self.ended or number < self.newest[kind])

    @contextmanager
    def working(self) -> Iterator[None]:
        """While a job is done."""
        self._idle_since = None
        try:
            yield
        finally:
            self._idle_since = time.monotonic()

    def rests(self) -> None:
        """Returns when there has been nothing to do for a while."""
        while (since := self._idle_since) is None or not self.jobs.empty() or time.monotonic() - since < _REST:
            time.sleep(_REST / 8)

    def say(self, number: int, what: str, value: object = None) -> None:
        """An outcome."""
        try:
            with self._saying:
                self.pipe.send((number, what, value))
        except (BrokenPipeError, OSError):
            self.gone()


def main(pipe: Connection, database: str | None, role: str) -> None:
    """Work until the pipe closes, as one of the crew: quick, full, side, photo, foliage, grow, trunk, points, age or film."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if hasattr(os, "nice"):
        os.nice(_NICE[role])
    desk = Desk(pipe)
    from sketchtree.studio.making.jobs import Jobs

    jobs = Jobs(None if database is None else Path(database), desk, quick=role == "quick")
    if role in ("photo", "foliage"):
        jobs.photo_answers.get_ready(leaves=role == "foliage")
    elif role == "grow":
        jobs.growth  # noqa: B018 - what it needs is imported before there is another thread
    elif role == "trunk":
        jobs.trunk_bench  # noqa: B018 - as there
    elif role == "points":
        jobs.cloud_bench  # noqa: B018 - as there
    elif role in ("age", "film"):
        jobs.growths  # noqa: B018 - as there
    elif role != "side":
        jobs.import_all()  # before there is another thread
    threading.Thread(target=_answer, args=(jobs, desk), daemon=True).start()
    if role == "quick":
        jobs.warming.begin()
    while True:
        _, number, kind, arguments = desk.jobs.get()
        if desk.stopped(number, kind):
            desk.say(number, "stopped")
            continue
        with desk.working():
            _do(jobs, desk, number, kind, arguments)
        if role == "full" and kind == "full":
            jobs.warming.begin()  # after the first tree, which somebody waits for


def _answer(jobs, desk: Desk) -> None:
    """What is asked of the tree that is made already."""
    while True:
        _, number, kind, arguments = desk.known.get()
        _do(jobs, desk, number, kind, arguments)


def _do(jobs, desk: Desk, number: int, kind: str, arguments: bytes) -> None:
    from sketchtree.studio.making.watching import Stopped

    try:
        desk.say(number, "done", jobs.do(number, kind, pickle.loads(arguments)))
    except Stopped:
        desk.say(number, "stopped")
    except SketchTreeError as error:
        stroke = getattr(error, "stroke", None)
        desk.say(number, "trouble", (error.message, error.remedy, None if stroke is None else str(stroke)))
    except Exception:  # noqa: BLE001 - whatever it is, the studio lives on and says so
        desk.say(number, "fault", traceback.format_exc())
