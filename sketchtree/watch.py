"""How long does every stage take, and which one is running?"""

import time
from collections.abc import Callable
from dataclasses import dataclass, field


Pulse = Callable[[], None]
"""Called now and then by a long work, a few times a second; what it raises ends the work."""


def no_pulse() -> None:
    """Nobody wants to end it."""


@dataclass
class Watch:
    """Seconds of every stage; tells `on_stage` when one begins, `on_part` how much of a long one is done (0-1)."""

    on_stage: Callable[[str], None] = lambda stage: None
    on_part: Callable[[float], None] = lambda done: None
    seconds: dict[str, float] = field(default_factory=dict)

    def __call__(self, stage: str):
        self.on_stage(stage)
        return _Lap(self, stage)


def shared(part: Callable[[float], None] | None, low: float, high: float) -> Callable[[float], None] | None:
    """A callback for one step of a longer work: its 0-1 becomes `low` to `high` of `part`."""
    return None if part is None else lambda done: part(low + (high - low) * min(max(done, 0.0), 1.0))


class _Lap:
    def __init__(self, watch: Watch, stage: str):
        self._watch, self._stage = watch, stage

    def __enter__(self):
        self._began = time.perf_counter()

    def __exit__(self, *_):
        lap = time.perf_counter() - self._began
        self._watch.seconds[self._stage] = self._watch.seconds.get(self._stage, 0.0) + lap
