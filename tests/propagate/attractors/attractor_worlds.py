"""Small trees and foliage for the tests of this room."""

import numpy as np
from tests.propagate.worlds import circle, drawn_tree

from sketchtree import keys
from sketchtree.propagate.attractors.library import Library, library_of
from sketchtree.propagate.attractors.target import Target
from sketchtree.propagate.attractors.wood import Limb, Wood
from sketchtree.axes import NULL

KEY = keys.root_key(0)
TARGET = Target.of_outlines([circle(0.2, 5.4, 3.2)], pixels=160)
QUICK = {"iterations": 6, "leaf_length": 0.25, "in_space": 300}


def tree():
    """A trunk with four limbs."""
    return drawn_tree(limbs=4)


def straight(points=((0.0, 1.0, 0.0), (0.0, 3.0, 0.0))) -> Wood:
    """One straight limb."""
    return Wood([Limb(7, NULL, 0.0, np.array(points), 1, 0.1, 0, rows=(0, 1), row_end=np.array([0.0, 2.0]))])


def predefined() -> Library:
    """All predefined subtrees."""
    return library_of(straight(), ("I", "II"))
