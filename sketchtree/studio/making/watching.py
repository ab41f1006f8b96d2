"""How does a job tell how far it is, and end when it is not wanted any more?"""

from collections.abc import Callable

from sketchtree.watch import Watch


class Stopped(Exception):
    """A newer document came, or there is nothing to hurry about."""


def watching(tell: Callable[[str, float], None], stopped: Callable[[], bool]) -> Watch:
    """A watch that tells which stage runs, and ends the job when a newer one came."""
    now = {"stage": ""}

    def stage(name: str) -> None:
        if stopped():
            raise Stopped
        now["stage"] = name
        tell(name, 0.0)

    def part(done: float) -> None:
        if stopped():
            raise Stopped
        tell(now["stage"], done)

    return Watch(stage, part)
