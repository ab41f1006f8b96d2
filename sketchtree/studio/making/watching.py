"""How does a job tell how far it is, and end when it is not wanted any more?"""

from collections.abc import Callable, Mapping

from sketchtree.watch import Pulse, Watch


class Stopped(Exception):
    """A newer document came, or there is nothing to hurry about."""


USUAL = {"read": 0.05, "match": 0.1, "infer": 0.3, "propagate": 0.6, "foliage": 0.7, "mesh": 0.97, "export": 1.0}
"""How much of a job is done at the end of each stage, of a large tree."""
PHOTO = {"read": 0.1, "match": 0.15, "infer": 0.3, "propagate": 0.8, "foliage": 0.9, "mesh": 0.99, "export": 1.0}
"""The same of the tree in a photo."""
SCRIBBLED = {"read": 0.5, "match": 0.52, "infer": 0.55, "propagate": 0.65, "foliage": 0.75, "mesh": 0.99, "export": 1.0}
"""The same of a tree that scribbles tell, whose matte takes longest."""
TRACED = {"read": 0.1, "infer": 0.6, "propagate": 0.7, "foliage": 0.8, "mesh": 0.99, "export": 1.0}
"""The same of a tree that is traced in points."""
AGED = {"read": 0.02, "match": 0.03, "infer": 0.2, "propagate": 0.28, "foliage": 0.32, "mesh": 0.45, "grow": 0.9, "export": 1.0}
"""The same of a tree that grows."""
FILMED = {"read": 0.005, "match": 0.01, "infer": 0.02, "propagate": 0.03, "foliage": 0.035, "mesh": 0.05, "grow": 0.1, "film": 1.0}
"""The same of a film of it."""
_STEP = 0.04  # of what is left of a part, that one pulse of it is worth


def watching(tell: Callable[[str, float], None], stopped: Callable[[], bool], upto: Mapping[str, float] = USUAL) -> Watch:
    """A watch that tells which stage runs, and how much of a job is done (`upto`: at the end of each stage), and ends the job when a newer one came."""
    now, at = "", 0.0  # the stage; how much of the job is done, which only rises

    def stage(name: str) -> None:
        nonlocal now
        now = name
        part(0.0)

    def part(done: float) -> None:
        nonlocal at
        if stopped():
            raise Stopped
        low, high = _between(now, upto)
        at = max(at, low + (high - low) * min(max(done, 0.0), 1.0))
        tell(now, at)

    return Watch(stage, part)


def _between(stage: str, upto: Mapping[str, float]) -> tuple[float, float]:
    """How much of a job is done at the beginning and at the end of a stage."""
    names = list(upto)
    if stage not in upto:
        return 0.0, 1.0
    place = names.index(stage)
    return upto[names[place - 1]] if place else 0.0, upto[stage]


def pulses(watch: Watch, low: float, high: float, *, step: float = _STEP) -> Pulse:
    """A pulse of a part of a stage, of which nobody knows how many there will be: each goes a little of the way that is left."""
    left = 1.0

    def pulse() -> None:
        nonlocal left
        watch.on_part(high - (high - low) * left)
        left *= 1.0 - step

    return pulse
