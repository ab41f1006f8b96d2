"""Which keys has a recipe, with which units, ranges and defaults? The fields of `[crown]` and of `[[limbs]]`.

A field's metadata is what `recipe` checks and what template_db/README.md lists. A `Profile` may be written as one
number or as `[[place, value], ...]`.
"""

import dataclasses
from dataclasses import dataclass, field

from sketchtree.templates.growing.profile import Profile


def _key(unit: str, low: float, high: float, meaning: str, default=dataclasses.MISSING):
    if isinstance(default, (int, float)) and not isinstance(default, bool):
        default = float(default)
    return field(default=default, metadata={"unit": unit, "low": low, "high": high, "meaning": meaning})


def _number(unit, low, high, meaning, default=dataclasses.MISSING) -> float:
    return _key(unit, low, high, meaning, default)


def _profile(unit, low, high, meaning, default=dataclasses.MISSING) -> Profile:
    if isinstance(default, (int, float)):
        default = Profile.constant(default)
    return _key(unit, low, high, meaning, default)


def _switch(meaning: str, default: bool) -> bool:
    return field(default=default, metadata={"unit": "bool", "meaning": meaning})


@dataclass(frozen=True)
class Crown:
    """`[crown]`: the whole tree."""

    height: float = _number("m", 0.3, 120, "height of the tree: the trunk's length follows from it")
    envelope: Profile = _profile("m", 0, 60, "crown radius over height / `height`; limbs stop where they leave it")
    outline_sd: float = _number("1", 0, 0.5, "sd of the log of the envelope's size, from limb to limb", 0.07)
    drift: Profile = _profile("m", -30, 30, "how far downwind the envelope's axis lies, over height / `height`", 0)
    stems: float = _number("count", 1, 40, "stems from the ground", 1)
    stem_ring: float = _number("m", 0, 10, "radius of the ring on which several stems stand", 0)
    stem_lean: Profile = _profile("deg", -90, 90, "lean of a stem from the vertical, outwards, over its rank 0-1", 0)
    levels: float = _number("count", 1, 8, "levels of limbs, the trunk counted", 3)
    wind: Profile = _profile("deg/m", 0, 180, "turn of every limb downwind, over height / `height`", 0)
    wind_shed: float = _number("1", 0, 1, "chance that a lateral straight into the wind has been shed; 0 across it", 0)
    downwind: float = _number("deg", 0, 360, "where the wind blows to: 0 right (+x), 90 towards the viewer (+z)", 0)


@dataclass(frozen=True)
class Limbs:
    """`[[limbs]]`: the limbs of one level, how they leave their parent and what they bear."""

    ratio: Profile = _profile("1", 0, 4, "length / parent's length, over place on the parent; level 0: / height")
    longest: float = _number("m", 0.01, 120, "no limb of this level is longer", 120)
    ratio_sd: float = _number("1", 0, 1, "sd of the log of the length", 0.12)
    angle: Profile = _profile("deg", 0, 180, "divergence from the parent, over place on the parent", 0)
    angle_sd: float = _number("deg", 0, 60, "sd of the divergence", 5)
    segment: float = _number("m", 0.01, 10, "length of one segment", 0.4)
    bend: float = _number("deg", 0, 60, "sd of the turn from one segment to the next", 4)
    tropism: Profile = _profile("deg/m", -720, 720, "turn towards the sky (> 0) or ground (< 0), over place on the limb", 0)
    rest: Profile | None = _profile("deg", -90, 90, "elevation that the tropism turns to instead, over place on the limb", None)
    sway: float = _number("deg", 0, 90, "amplitude of a sinuous limb's turns to either side", 0)
    sway_length: float = _number("m", 0.02, 50, "length of one such wave", 2)
    deflect: float = _number("deg", 0, 60, "turn away from a lateral where one is borne", 0)
    sympodial: float = _number("1", 0, 1, "chance at a node that the tip dies and a side shoot takes the lead", 0)
    relay_angle: float = _number("deg", 0, 90, "turn of the limb where a side shoot takes the lead", 30)
    clip: bool = _switch("stop at the crown's envelope", True)
    clearance: float = _number("m", 0, 5, "room a limb keeps from other limbs' wood; without it, it bends away or stops", 0)
    avoid: float = _number("deg", 0, 90, "how far it bends away, at most, in one segment; 0: it stops", 0)
    shed_short: float = _number("1", 0, 1, "a limb that ends before this share of its length has been shed", 0)
    broken: Profile = _profile("1", 0, 1, "chance that a limb has lost its end, over place on the parent", 0)
    broken_at: float = _number("1", 0.02, 1, "share of its length where it broke, give or take a third", 0.5)
    spacing: float = _number("m", 0.01, 20, "between nodes that bear laterals", 0.4)
    bare: float = _number("1", 0, 1, "share of the limb without laterals, from its base", 0)
    end: float = _number("1", 0, 1, "no laterals beyond this share of the limb", 1)
    whorl: float = _number("count", 1, 60, "laterals a node", 1)
    phyllotaxis: float = _number("deg", 0, 360, "azimuth from one node to the next", 137.5)
    azimuth_sd: float = _number("deg", 0, 180, "sd of a lateral's azimuth", 12)
    planar: bool = _switch("count azimuths from the horizontal, not from a random start", False)
    shed: Profile = _profile("1", 0, 1, "chance that a lateral has been shed, over place on the limb", 0)
    shed_below: float = _number("1", 0, 1, "chance that a lateral on the underside has been shed", 0)
    forks: Profile | None = _profile("count", 2, 8, "where the limb splits and into how many: [[place, limbs], ...]", None)
    fork_angle: float = _number("deg", 0, 120, "angle between the limb and a fork's branch", 40)
