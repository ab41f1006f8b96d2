"""Who makes the exemplars if there is a cluster? The workers of a Dask scheduler.

Needs the package `distributed` (`pip install 'sketchtree[cluster]'`), here and, with SketchTree, on the workers; they
need no common disk. A worker with other sources than this program's refuses, so one database never comes
from two versions. The journal stays with the client.
"""

import logging
import time
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager

from sketchtree.errors import OptionError, TemplateError
from sketchtree.templates.making.crew import AHEAD, KEPT, Crew
from sketchtree.templates.making.fingerprint import fingerprint, same_program
from sketchtree.templates.making.order import Block, Order, Refusal, make_block

PATIENCE = 10.0  # seconds that a scheduler has to answer
WAIT = 60.0  # seconds that a worker has to turn up and answer
LOOK = 10.0  # seconds between two looks at how many workers there are


@contextmanager
def cluster(address: str, work: Callable | None = None, kept: str = KEPT) -> Iterator[Crew]:
    """A crew of all workers of the scheduler at `address`. `work` is called with the order and this program's fingerprint."""
    try:
        from distributed import Client, KilledWorker
    except ImportError as error:
        raise OptionError(
            "`--scheduler` needs the package distributed, which is not installed.",
            remedy="Install it with pip install 'sketchtree[cluster]', or use --jobs for the processors of this machine.",
        ) from error
    try:
        client = Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, TimeoutError, ValueError, TypeError, RuntimeError, ImportError) as error:
        raise OptionError(
            f"--scheduler {address}: no Dask scheduler answers there.",
            remedy="Give the address that `dask scheduler` prints, such as tcp://10.0.0.1:8786.",
        ) from error
    with _hushed(), client:
        crew = _Workers(client, address, (OSError, CancelledError, TimeoutError, KilledWorker), work or make_block, kept)
        crew.greet()
        yield crew


@contextmanager
def _hushed():
    """What distributed logs when a connection is lost, tracebacks, is ours to say in one paragraph."""
    loggers = [logging.getLogger(name) for name in logging.root.manager.loggerDict if name.partition(".")[0] == "distributed"]
    levels = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for logger, level in zip(loggers, levels, strict=True):
            logger.setLevel(level)


class _Workers:
    """All workers of a scheduler."""

    def __init__(self, client, address: str, lost: tuple[type, ...], work: Callable, kept: str):
        self._client, self._address, self._lost, self._work, self._kept = client, address, lost, work, kept
        self._program, self._window, self._looked = fingerprint(), AHEAD, 0.0

    @property
    def window(self) -> int:
        if time.monotonic() > self._looked + LOOK:
            self._looked = time.monotonic()
            self._window = AHEAD * max(1, sum(self._client.nthreads().values()))
        return self._window

    def greet(self) -> None:
        """Waits for a first worker and looks whether it has the program."""
        try:
            same = self._client.submit(same_program, self._program, pure=False).result(timeout=WAIT)
        except TimeoutError as error:
            raise TemplateError(
                f"--scheduler {self._address}: no worker answered within {WAIT:g} s.", remedy="Start one with `dask worker ADDRESS`."
            ) from error
        except (ImportError, AttributeError) as error:
            raise TemplateError(
                f"--scheduler {self._address}: its workers have no SketchTree ({error}).",
                remedy="Install this version on every worker, and restart them.",
            ) from error
        if not same:
            raise TemplateError(
                f"--scheduler {self._address}: a worker runs another SketchTree than this one.",
                remedy="Install the same version on the workers, and restart them.",
            )

    def submit(self, order: Order):
        return self._client.submit(self._work, order, self._program, pure=False, key=f"tree-{order.name}-{time.monotonic_ns()}")

    def result(self, future) -> Block | Refusal:
        try:
            return future.result()
        except self._lost as error:
            raise TemplateError(
                f"--scheduler {self._address}: the cluster was lost on the way ({type(error).__name__}).",
                remedy=f"Run the command again when it is back; {self._kept}.",
            ) from error

    def settle(self, future) -> Block | Refusal | None:
        try:
            if future.status == "finished":
                return future.result(timeout=5)
            future.cancel()
        except self._lost:
            pass
        return None
