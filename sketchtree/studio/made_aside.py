"""How is one tree of a drawing made aside, in a process of its own, and told of? The newest wish wins; one that is the same as that shown, stopped or failed is not made again.

    wish → a pause → "grows", how far it is → a frame, "ready"          waits | grows | ready | failed | stopped

What `CloudTracer` and `Trunker` do alike; `OneJob` begins and halts.
"""

import asyncio
from collections.abc import Callable, Coroutine, Mapping

from sketchtree.errors import SketchTreeError
from sketchtree.studio import messages
from sketchtree.studio.engine import Outcome
from sketchtree.studio.hand import Ended, Hand
from sketchtree.studio.one_job import OneJob


class MadeAside:
    """`tell` is given outcomes for the pages; `run` does work aside. `job`: what the process is asked for; `ended`: what is told if it ends; `patience` as of `OneJob`."""

    def __init__(self, hand: Hand, tell: Callable[[Outcome], None], run: Callable[[Coroutine], None], *, job: str, ended: str, patience: float):
        self._hand, self._outcome, self._run = hand, tell, run
        self._asks, self._ended = job, ended
        self._loop = asyncio.get_running_loop()
        self._now: tuple | None = None  # the newest drawing: its revision, and what is wished, which has a `key`
        self._job = OneJob(hand, self._begin, patience)
        self._done: tuple[object, str, str] | None = None  # what is not to be made again: its state, and why
        self._told_at = 0.0
        self.textures: Mapping[tuple[str, str], bytes] = {}  # by material and map: those that only the tree that is shown has

    def stop(self) -> None:
        """What is made, or is to be, is not wanted."""
        if self._now is not None and self._job.goes_on:
            self._job.halt()
            self._done = self._now[1], "stopped", ""
            self._tell("stopped")

    def end(self) -> None:
        """End the process."""
        self._job.clear()
        self._hand.end()

    def _wished(self, rest: float, *, at_once: bool) -> None:
        """`_now` is wished, after `rest` seconds; `at_once`: without them, even if it was stopped."""
        _, wish = self._now
        if at_once:
            self._done = None
        if self._job.made is not None and self._job.made[0].key == wish.key:
            self._job.works(wish, self._job.made[1])
            return
        self._job.halt()
        if self._done is not None and self._done[0].key == wish.key:
            self._tell(*self._done[1:])
            self._told_again()
            return
        self._tell("waits")
        self._job.later(0.0 if at_once else rest)

    def _how_far(self, value: tuple, pause: float) -> None:
        """The process tells how far it is, which is passed on once in `pause` seconds."""
        if self._loop.time() - self._told_at >= pause:
            self._told_at = self._loop.time()
            self._say(state="grows", stage=value[1], done=min(max(float(value[2]), 0.0), 1.0))

    def _begin(self) -> None:
        revision, wish = self._now
        self._before_asking()
        number, answer = self._hand.ask(self._asks, revision, wish)
        self._job.works(wish, number)
        self._tell("grows")
        self._run(self._made(revision, number, answer))

    async def _made(self, revision: int, number: int, answer: asyncio.Future) -> None:
        found, why = None, ""
        try:
            found = await answer
        except Ended:
            why = self._ended
        except SketchTreeError as error:
            why = f"{error.message} {error.remedy}"
        if not self._job.is_of(number) or not (found or why):
            return
        self._done = self._job.done(), "failed" if why else "ready", why
        if found:
            frame, self.textures = found
            self._before_showing()
            self._outcome(Outcome(revision, frame, of_photo=True))
        self._tell(*self._done[1:])

    def _before_asking(self) -> None:
        """What the process must have first."""

    def _before_showing(self) -> None:
        """The tree has come."""

    def _told_again(self) -> None:
        """What was made before is wished again."""

    def _tell(self, state: str, remark: str = "") -> None:
        self._say(state=state, remark=remark, done=1.0 if state == "ready" else 0.0)

    def _say(self, **fields) -> None:
        self._outcome(Outcome(self._now[0], messages.Growing(revision=self._now[0], **fields)))
