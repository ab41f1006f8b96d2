"""What a worker does first."""

import asyncio
import multiprocessing
import subprocess
import sys

from sketchtree.studio.hand import Hand
from sketchtree.studio.making.worker import Desk


def test_what_the_tree_wears_goes_before_pictures_of_what_it_might_wear():
    async def answered_in_order():
        hand, order = Hand("side", None, lambda number, value: None), []
        try:
            asked = {name: hand.ask("picture", "template", name)[1] for name in ("english_oak", "silver_birch", "scots_pine", "no such")}
            asked["texture"] = hand.ask("texture", "no such", "color")[1]
            for name, answer in asked.items():
                answer.add_done_callback(lambda _, name=name: order.append(name))
            await asyncio.wait(asked.values(), timeout=120)
        finally:
            hand.end()
        return order

    order = asyncio.run(answered_in_order())
    assert len(order) == 5 and order.index("texture") <= 1  # one picture may have been begun


def test_what_the_server_keeps_between_two_jobs_imports_nothing_of_what_makes_trees():
    said = "import sys, sketchtree.studio.making.basis, sketchtree.studio.crew; print('jax' in sys.modules, 'scipy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", said], capture_output=True, text=True, check=True).stdout == "False False\n"


def test_one_job_can_be_dropped_without_those_round_it():
    ours, theirs = multiprocessing.Pipe()
    desk = Desk(theirs, gone=lambda: None)
    for job in ((1, "trunk", b""), (2, "trunk_files", b""), (3, "film", b""), (2, "drop", b""), (4, "full", b"")):
        ours.send(job)
    waiting = [desk.jobs.get(timeout=60)[1:3] for _ in range(4)]
    assert waiting == [(1, "trunk"), (2, "trunk_files"), (3, "film"), (4, "full")]
    assert [desk.stopped(number, kind) for number, kind in waiting] == [False, True, False, False]


def test_the_thread_that_listens_unpickles_no_argument():
    ours, theirs = multiprocessing.Pipe()
    desk = Desk(theirs, gone=lambda: None)  # the usual way would end the tests, as if all were well
    ours.send((1, "full", b"no pickle"))
    assert desk.jobs.get(timeout=60) == (False, 1, "full", b"no pickle")
