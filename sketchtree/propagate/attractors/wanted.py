"""How is a tree to grow to its attractors? Every choice of one run, with its unit and range."""

from dataclasses import dataclass

import numpy as np

from sketchtree.errors import OptionError
from sketchtree.propagate.attractors.library import NAMES

ITERATIONS = 100  # the paper's, about
MOST_ITERATIONS = 10_000
_KNOWN = {"depth": ("volume", "joints"), "axis": ("crown", "trunk"), "candidates": ("need", "radius")}


@dataclass(frozen=True)
class Wanted:
    """How a tree grows to where foliage was seen. Raises OptionError for a value out of range. `PAPER` has the choices of Tan et al. 2008."""

    library: tuple[str, ...] = NAMES  # some of visible | I | II
    iterations: int = ITERATIONS  # 0-10000, at most
    replacements: int = 3  # branches replaced in one iteration, at most; 1: the paper's
    alternate: bool = True  # image and 3D attractors by turns; False: image attractors alone (Tan et al. 2008, Figure 6a)
    depth: str = "volume"  # joints: attractors in 3D are joints turned by 90° (the paper's) | volume: they fill the foliage revolved
    axis: str = "crown"  # turned about the crown's middle, or about the trunk (the paper's)
    leaf_length: float | None = None  # metres; None: `LEAF` of the tree's height
    candidates: str = "need"  # which branches may be replaced next: where attractors are far (need) or thick ones (radius, the paper's)
    rise: float = 0.15  # how much new branches bow to the light, ≥ 0; 0: not at all (the paper's)
    apart: float = 0.15  # of its length: a new branch keeps so far from others, beyond its foot
    thrift: float = 0.3  # metres of energy that a metre of wood must gain, ≥ 0: else a limb near which little is far is replaced till it is a broom; 0: none (the paper's)
    dense: bool = True  # wood ends where half of what is round it for a leaf's length is foliage; False: anywhere in the foliage, its gaps closed (the paper's)
    boughs: bool = True  # to parts of the crown that are far from all wood a bough grows first; with attractors in 3D that fill the foliage, and only where these drive
    twigs: bool = True  # what is still farther than a leaf is long grows twigs in the end
    along: bool = True  # so do limbs that were given, where foliage near them has no twig yet for its leaves
    in_space: int = 2500  # attractors in 3D, about, of `volume`
    max_segments: int = 60_000  # straight pieces grown, at most
    first_rank: int = 1 << 20  # ranks of limbs grown start there, so that the ids of other stages' limbs are others

    def __post_init__(self):
        if not 0 <= self.iterations <= MOST_ITERATIONS:
            raise OptionError(f"iterations is {self.iterations}, but must lie between 0 and {MOST_ITERATIONS}.", remedy="About 100 fill a crown.")
        for name, known in _KNOWN.items():
            if getattr(self, name) not in known:
                raise OptionError(f"{name} is {getattr(self, name)!r}, but must be {' or '.join(known)}.", remedy=f"{known[0]} is what is taken by default.")
        for name in ("replacements", "in_space", "max_segments"):
            if getattr(self, name) < 1:
                raise OptionError(f"{name} is {getattr(self, name)}, but must be 1 or more.", remedy="Give a positive number.")
        if self.leaf_length is not None and not (np.isfinite(self.leaf_length) and self.leaf_length > 0):
            raise OptionError(f"leaf_length is {self.leaf_length:g}, but must be above zero.", remedy="Give metres, or nothing: then it goes by the tree's height.")
        if not (np.isfinite([self.rise, self.apart]).all() and min(self.rise, self.apart) >= 0):
            raise OptionError(f"rise is {self.rise:g} and apart {self.apart:g}, but neither may be below zero.", remedy="0 switches either off.")
        if not (np.isfinite(self.thrift) and self.thrift >= 0):
            raise OptionError(f"thrift is {self.thrift:g}, but may not be below zero.", remedy="0 switches it off.")


PAPER = {"candidates": "radius", "replacements": 1, "depth": "joints", "axis": "trunk", "rise": 0.0, "thrift": 0.0, "dense": False, "boughs": False, "twigs": False}
