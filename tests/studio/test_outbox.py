"""A page that reads slowly gets the newest of each kind; what tells differences is never left out."""

import asyncio
import json

import pytest
from fake_engine import frame

from sketchtree.errors import SketchTreeError
from sketchtree.studio import messages
from sketchtree.studio.outbox import MOST, Outbox


class Store:
    """What an outbox asks of the session."""

    def __init__(self):
        self.revision = 100
        self.frames = 0

    def whole(self):
        return messages.Changed(since=0, revision=self.revision)

    async def frame(self):
        self.frames += 1
        return frame(self.revision, size=80)


def all_of(outbox: Outbox) -> list:
    """Everything that waits, as it is sent."""

    async def take():
        sent = []
        while True:
            try:
                sent.append(await asyncio.wait_for(outbox.next(), 0.02))
            except TimeoutError:
                return sent

    return asyncio.run(take())


def _outbox() -> tuple[Outbox, Store]:
    store = Store()
    return Outbox(store.whole, store.frame), store


def _changed(revision: int) -> messages.Changed:
    return messages.Changed(since=revision - 1, revision=revision)


def test_the_newest_of_a_kind_is_sent():
    outbox, _ = _outbox()
    for k in range(1000):
        outbox.put(messages.Working(state="working", revision=k))
        outbox.put(messages.Matches(revision=k, used=None, ranked=[]))
    assert len(outbox) == 2
    assert [json.loads(one)["revision"] for one in all_of(outbox)] == [999, 999]


def test_changes_are_all_sent_in_order():
    outbox, _ = _outbox()
    for k in range(1, 20):
        outbox.put(_changed(k))
    assert [json.loads(one)["revision"] for one in all_of(outbox)] == list(range(1, 20))


def test_where_too_many_changes_wait_one_with_everything_takes_their_place():
    outbox, _ = _outbox()
    for k in range(1, MOST + 500):
        outbox.put(_changed(k))
        assert len(outbox) <= MOST + 1
    (only,) = all_of(outbox)
    assert json.loads(only)["since"] == 0 and json.loads(only)["revision"] == 100


def test_large_changes_are_counted_by_their_size():
    outbox, _ = _outbox()
    stroke = messages.Stroke(id="a", kind="branch", xy=[0.123456789] * 40_000)
    for k in range(1, 8):
        outbox.put(messages.Changed(since=k - 1, revision=k, put=[stroke] * 10))
    (only,) = all_of(outbox)
    assert json.loads(only)["since"] == 0


def test_a_change_that_is_in_the_whole_already_is_not_sent():
    outbox, store = _outbox()
    outbox.everything()
    asyncio.run(outbox.next())
    outbox.put(_changed(100))
    outbox.put(_changed(101))
    texts = [json.loads(one)["revision"] for one in all_of(outbox) if isinstance(one, str)]
    assert texts == [101]


def test_two_tree_frames_that_wait_become_the_whole_tree():
    outbox, store = _outbox()
    outbox.put(frame(1))
    outbox.put(frame(2))
    outbox.put(frame(3))
    assert all_of(outbox) == [frame(100, size=80)] and store.frames == 1


def test_one_tree_frame_that_waits_is_sent_as_it_is():
    outbox, store = _outbox()
    outbox.put(frame(1))
    assert all_of(outbox) == [frame(1)] and store.frames == 0


@pytest.mark.parametrize(("came", "then"), [((5,), [6]), ((6,), [6]), ((7,), [6, 7]), ((7, 8), [6, 9])])
def test_frames_that_come_while_the_whole_tree_is_asked_for_follow_it_unless_they_are_older(came, then):
    async def test():
        revisions = iter((6, 9))
        gate = asyncio.Event()

        async def slow():
            await gate.wait()
            return frame(next(revisions))

        outbox = Outbox(Store().whole, slow)
        outbox.everything()
        assert json.loads(await outbox.next())["since"] == 0
        asking = asyncio.ensure_future(outbox.next())
        await asyncio.sleep(0)
        for revision in came:
            outbox.put(frame(revision))
        outbox.put(messages.Working(state="idle", revision=1))
        assert json.loads(await asking)["type"] == "working"  # nothing else waits for the tree
        gate.set()
        assert [await outbox.next() for _ in then] == [frame(revision) for revision in then] and len(outbox) == 0

    asyncio.run(test())


def test_where_the_whole_tree_cannot_be_had_what_is_new_of_it_is_sent():
    async def test():
        gate = asyncio.Event()

        async def broken():
            await gate.wait()
            raise SketchTreeError("It ended.", remedy="Wait.")

        outbox = Outbox(Store().whole, broken)
        outbox.everything()
        await outbox.next()
        asking = asyncio.ensure_future(outbox.next())
        await asyncio.sleep(0)
        outbox.put(frame(1))
        gate.set()
        assert await asking == frame(1)

    asyncio.run(test())


def test_a_glance_and_a_ghost_do_not_take_the_trees_place():
    outbox, _ = _outbox()
    outbox.put(frame(1))
    outbox.put(frame(1, phase="glance"))
    outbox.put(frame(1, "ghost"))
    outbox.put(frame(2, "ghost"))
    assert all_of(outbox) == [frame(1), frame(1, phase="glance"), frame(2, "ghost")]


def test_troubles_are_all_told_up_to_the_newest_sixteen():
    outbox, _ = _outbox()
    for k in range(40):
        outbox.put(messages.Trouble(message=str(k), remedy=""))
    assert [json.loads(one)["message"] for one in all_of(outbox)] == [str(k) for k in range(24, 40)]
