"""How long does every stage take, and which one is running?"""

import time
from collections.abc import Callable
from dataclasses import dataclass, field


@dataclass
class Watch:
    """Seconds of every stage; tells `on_stage` when one begins."""

    on_stage: Callable[[str], None] = lambda stage: None
    seconds: dict[str, float] = field(default_factory=dict)

    def __call__(self, stage: str):
        self.on_stage(stage)
        return _Lap(self, stage)


class _Lap:
    def __init__(self, watch: Watch, stage: str):
        self._watch, self._stage = watch, stage

    def __enter__(self):
        self._began = time.perf_counter()

    def __exit__(self, *_):
        lap = time.perf_counter() - self._began
        self._watch.seconds[self._stage] = self._watch.seconds.get(self._stage, 0.0) + lap
