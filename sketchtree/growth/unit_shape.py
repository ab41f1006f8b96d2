"""Which shape has a unit where it is grafted on? Its pieces lean and swing as the tree's branches do."""

import numpy as np
from jaxtyping import Float

from sketchtree.axes import NULL
from sketchtree.growth.across import across, turned
from sketchtree.growth.across import unit as unit_length
from sketchtree.growth.feet import Chance, Feet
from sketchtree.growth.library import BranchUnit
from sketchtree.growth.manner import Spread

_LEAST_LEAN, _MOST_LEAN = np.radians(12.0), np.radians(100.0)
_SHARPEST = 1.3  # radians that a piece turns from the one before


def shape(
    feet: Feet, unit: BranchUnit, start: Float[np.ndarray, "foot 3"], turn: float, chance: Chance
) -> tuple[Float[np.ndarray, "foot piece 3"], Float[np.ndarray, "foot piece 3"]]:
    """(ways, tips) of a unit's pieces on every foot, whose places are `start`; all `turn` radians about the wood that bears them."""
    way, side = _foot(feet, turn, chance)
    ways, sides, tips = np.zeros((3, len(feet), len(unit), 3))
    for piece, above in enumerate(unit.parent):
        from_, before, beside = (start, way, side) if above == NULL else (tips[:, above], ways[:, above], sides[:, above])
        ways[:, piece], sides[:, piece] = _piece(before, beside, unit.lean[piece], unit.is_new[piece], feet.number, 20 + 4 * piece, chance)
        tips[:, piece] = from_ + (unit.length[piece] * feet.length)[:, None] * ways[:, piece]
    return ways, tips


def _foot(feet: Feet, turn: float, chance: Chance):
    """(which way a unit begins, the side it leans to)."""
    side = turned(feet.way, feet.across, np.full(len(feet), turn))
    lean = np.clip(chance.of(chance.manner.lean, feet.number, 6), _LEAST_LEAN, _MOST_LEAN)[:, None]
    way = np.where(feet.goes_on[:, None], feet.way, np.cos(lean) * feet.way + np.sin(lean) * side)
    return way, across(side, way)


def _piece(before, beside, lean: float, is_new: bool, number, draw: int, chance: Chance):
    """(the way of a piece after one that goes `before`, the side that its own leans to)."""
    manner = chance.manner
    swing = Spread(0.0, manner.swing.sd)
    ahead = lean * np.clip(chance.of(manner.lean, number, draw), 0.2, 1.6) + chance.of(swing, number, draw + 1)
    aside = chance.of(swing, number, draw + 2)
    ahead, aside = (np.tan(np.clip(angle, -_SHARPEST, _SHARPEST))[:, None] for angle in (ahead, aside))
    way = unit_length(before + ahead * beside + aside * np.cross(before, beside))
    side = across(beside, way)
    return way, turned(way, side, chance.of(manner.turn, number, draw + 3)) if is_new else side
