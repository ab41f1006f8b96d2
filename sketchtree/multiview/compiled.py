"""How are loops over pixels made fast? Compiled by numba, without Python's lock, so that views are worked on in parallel.

Nothing compiled is kept for the next run: numba's cache does not notice that a function called from another file has changed, and compiling takes seconds where
depth maps take minutes.
"""

import os
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor

from sketchtree.errors import ViewsError
from sketchtree.watch import Pulse

try:
    from numba import njit
except ImportError:
    raise ViewsError("Depth from photos needs the package `numba`.", remedy="Install it: pip install 'sketchtree[multiview]'.") from None


def compiled(function: Callable) -> Callable:
    """The function, compiled when it is first called."""
    return njit(nogil=True, fastmath=True, error_model="numpy")(function)


def side_by_side(work: Callable, items: Iterable, pulse: Pulse, done: Callable[[float], None] = lambda share: None) -> list:
    """What `work` gives for every item, in their order, on all cores."""
    items = list(items)
    found = []
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        running = [pool.submit(work, item) for item in items]
        try:
            for k, one in enumerate(running):
                found.append(one.result())
                pulse()
                done((k + 1) / len(items))
        except BaseException:
            for one in running:
                one.cancel()
            raise
    return found
