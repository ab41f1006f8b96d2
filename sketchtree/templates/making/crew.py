"""Who makes the exemplars, or the trees of a batch? One process, several, or (`cluster`) other machines.

A crew takes orders, does its `work` on each, which is a function of an order, and gives futures. At most `window` orders are out at a time, so neither the client nor a scheduler
is flooded however many there are; blocks come back in the order in which they were asked for.
"""

import os
import signal
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing import get_context, parent_process
from multiprocessing.connection import wait
from typing import Protocol

from sketchtree.errors import TemplateError
from sketchtree.templates.making.journal import Journal
from sketchtree.templates.making.order import Block, Order, Refusal, make_block

AHEAD = 4  # orders out for each worker
KEPT = "finished exemplars are kept"


class WorkerLost(TemplateError):
    """A process was ended from outside."""


class Crew(Protocol):
    """Takes orders."""

    window: int  # orders that may be out at a time

    def submit(self, order: Order):
        """A future of the order's block."""

    def result(self, future) -> Block | Refusal:
        """The block, waited for."""

    def settle(self, future) -> Block | Refusal | None:
        """Of an order that is no longer wanted: its block if it is done or as good as done, else None and it is cancelled."""


class Alone:
    """This process."""

    window = 1

    def __init__(self, work: Callable):
        self._work = work

    def submit(self, order: Order) -> Order:
        return order

    def result(self, future: Order) -> Block | Refusal:
        return self._work(future)

    def settle(self, future: Order) -> None:
        return None


class Processes:
    """Several processes of this machine."""

    def __init__(self, pool: ProcessPoolExecutor, jobs: int, work: Callable, kept: str):
        self._pool, self.window, self._work, self._kept = pool, AHEAD * jobs, work, kept

    def submit(self, order: Order) -> Future:
        try:
            return self._pool.submit(self._work, order)
        except BrokenProcessPool as error:
            raise _died(self._kept) from error

    def result(self, future: Future) -> Block | Refusal:
        try:
            return future.result()
        except BrokenProcessPool as error:
            raise _died(self._kept) from error

    def settle(self, future: Future) -> Block | Refusal | None:
        return None if future.cancel() or future.exception() is not None else future.result()


@contextmanager
def processes(jobs: int, work: Callable | None = None, kept: str = KEPT, *, apart: bool = False) -> Iterator[Crew]:
    """A crew of `jobs` processes; of this one alone if it is one, unless that is to be `apart`.

    `work` makes exemplars unless another is given; `kept` says what a run that breaks off leaves."""
    work = work or make_block
    if jobs <= 1 and not apart:
        yield Alone(work)
        return
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn"), initializer=_begin) as pool:
        yield Processes(pool, jobs, work, kept)


def _begin() -> None:
    """A worker leaves Ctrl-C to its parent, else it would print a traceback, and ends when the parent has been killed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    wait([parent_process().sentinel])
    os._exit(1)


def in_turn(wanted: Iterable[Order], crew: Crew, journal: Journal) -> Iterator[tuple[Order, Block]]:
    """The block of every order, in order; from the journal where it has one, and into it when it is made."""
    out, rest = deque(), iter(wanted)
    try:
        while True:
            while len(out) < crew.window and (order := next(rest, None)) is not None:
                out.append((order, None if journal.has(order) else crew.submit(order)))
            if not out:
                return
            order, future = out[0]
            block = journal.take(order) if future is None else None
            if block is None:
                block = _accepted(crew.result(crew.submit(order) if future is None else future))
                journal.keep(order, block)
            out.popleft()
            yield order, block
    finally:
        for order, future in out:
            block = None if future is None else crew.settle(future)
            if isinstance(block, dict):
                journal.keep(order, block)


def _accepted(block: Block | Refusal) -> Block:
    if isinstance(block, Refusal):
        raise TemplateError(block.message, remedy=block.remedy)
    return block


def _died(kept: str) -> WorkerLost:
    return WorkerLost(
        "A process of the build was ended from outside, perhaps for want of memory.",
        remedy=f"Run the command again with fewer --jobs; {kept}.",
    )
