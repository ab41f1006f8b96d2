"""What does this tree wear: which leaf, how large, how far apart, in which arrangement?

A tall tree has hundreds of thousands of leaves and is drawn with tens of thousands, so its blades are drawn
larger, within what the species can grow (ours; H the species' height):

    size = leaf size · min(max((H / 6 m)^0.35, 1), 1.5)
"""

from dataclasses import dataclass

import numpy as np

from sketchtree.errors import OptionError
from sketchtree.foliage.arrangement import GOLDEN_ANGLE, leaves_per_node
from sketchtree.foliage.models import LeafModel, leaf_model
from sketchtree.parameters import Habit

FREE = ("alternate", "opposite", "decussate", "whorled", "spiral")  # arrangements that may be asked for


@dataclass(frozen=True)
class Wear:
    """A leaf model with the spacing, size and arrangement that one tree gives it."""

    model: LeafModel
    arrangement: str
    size: float  # metres, of a blade or a whole tuft
    spacing: float  # metres between nodes, or between tufts
    phyllotaxis: float  # degrees
    whorl: int


def wear_of(habit: Habit, model: str | None = None, density: float = 1.0, scale: float = 1.0, arrangement: str | None = None) -> Wear:
    """The habit's own leaf, or another `model` in its own size, spacing and arrangement; `scale` times as large. `arrangement`: another one (`FREE`).
    Raises OptionError for an unknown leaf or arrangement."""
    worn = leaf_model(model or habit.leaf)
    if worn.name == habit.leaf:
        own, size, spacing = habit.leaf_arrangement, habit.leaf_size, habit.leaf_spacing
    else:
        own, size, spacing = worn.arrangement, worn.size, worn.spacing
    leaves_per_node(own)
    arrangement = own if arrangement is None else _free(arrangement, own, worn.name)
    turn = habit.phyllotaxis if arrangement == "spiral" == habit.leaf_arrangement else GOLDEN_ANGLE
    single = worn.is_blade and worn.needle == 1.0 and not worn.flower
    size *= enlargement(habit) if single and arrangement != "frond" else 1.0
    return Wear(worn, arrangement, scale * size / worn.needle, spacing * worn.bundle / density, turn, habit.whorl)


def _free(wanted: str, own: str, leaf: str) -> str:
    """An arrangement that is asked for, if these leaves may have another than their own."""
    if wanted not in FREE:
        raise OptionError(f"The leaf arrangement {wanted!r} can't be asked for.", remedy=f"Choose one of: {', '.join(FREE)}.")
    if own not in FREE:
        raise OptionError(f"Leaves of {leaf} are {own}: no other arrangement suits them.", remedy="Leave the arrangement out, or choose another leaf.")
    return wanted


def enlargement(habit: Habit) -> float:
    """How much larger than in life the blades of this species are drawn, 1 to 1.5."""
    return float(np.clip((habit.height / 6.0) ** 0.35, 1.0, 1.5))
