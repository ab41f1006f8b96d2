"""Who builds the trees of a batch, and what if a process dies under one of them?

Trees are made in turn by the crews that make the exemplars. Where a process is ended from outside (a machine short of memory does so),
nobody knows which tree it was at: those that were out are then made one by one, each in a process of its own, until one ends its
process again. That one has failed; the others go on together.
"""

from collections.abc import Iterator, Sequence
from contextlib import closing

from sketchtree import batch_record
from sketchtree.batch import TreeOrder
from sketchtree.commands.batch_tree import make_tree
from sketchtree.templates.making.cluster import cluster
from sketchtree.templates.making.crew import AHEAD, WorkerLost, in_turn, processes

_KEPT = "finished trees are kept, and --resume goes on from them"
_LOST = (
    "The process that built it was ended from outside, perhaps for want of memory. "
    "Build it by itself, with a smaller --max-segments or more memory, or leave it out."
)


def made(wanted: Sequence[TreeOrder], jobs: int, scheduler: str | None, journal: batch_record.Journal) -> Iterator[tuple[TreeOrder, dict]]:
    """Every order with its row, in order. One process is this one, and ends with it."""
    if scheduler is not None:
        yield from _by(cluster(scheduler, make_tree, _KEPT), wanted, journal)
        return
    left = list(wanted)
    while left:
        done = 0
        try:
            for pair in _by(processes(min(jobs, len(wanted)), make_tree, _KEPT), left, journal):
                done += 1
                yield pair
        except WorkerLost:
            suspects = left[done : done + AHEAD * jobs]
            for order, row in _one_by_one(suspects, journal):
                done += 1
                yield order, row
        left = left[done:]


def _by(crew, wanted: Sequence[TreeOrder], journal: batch_record.Journal) -> Iterator[tuple[TreeOrder, dict]]:
    with crew as makers, closing(in_turn(wanted, makers, journal)) as rows:
        yield from rows


def _one_by_one(suspects: Sequence[TreeOrder], journal: batch_record.Journal) -> Iterator[tuple[TreeOrder, dict]]:
    """Each in a process of its own, up to the first that ends its process."""
    for order in suspects:
        try:
            yield from _by(processes(1, make_tree, _KEPT, apart=True), [order], journal)
        except WorkerLost:
            yield order, batch_record.row(order, batch_record.FAILED, error=_LOST)
            return
