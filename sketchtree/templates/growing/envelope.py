"""Does a limb still grow inside the crown? A radius over height about an axis that may lie downwind.

Every limb has its own `reach`, the envelope's size relative to the recipe's: outlines are not turned on a lathe.
"""

from math import hypot

from sketchtree.templates.growing.headings import Vector
from sketchtree.templates.growing.tables import Crown


def inside(crown: Crown, way: Vector, reach: float, at: Vector) -> bool:
    """Is `at` within the envelope scaled by `reach`? `way`: unit vector downwind."""
    envelope = crown.envelope
    level = at[1] / (crown.height * reach)
    if len(envelope.knots) > 1 and not _base(crown) <= level <= envelope.knots[-1][0]:
        return False
    drift = crown.drift(level)
    return hypot(at[0] - drift * way[0], at[2] - drift * way[2]) <= reach * envelope(level)


def below(crown: Crown, reach: float, at: Vector) -> bool:
    """Is `at` under the crown, where a limb may still be on its way into it?"""
    return at[1] < _base(crown) * crown.height * reach


def _base(crown: Crown) -> float:
    """Height over `height` at which the envelope begins; one number is a column from the ground."""
    return crown.envelope.knots[0][0] if len(crown.envelope.knots) > 1 else 0.0
