"""How is a tree to grow to its attractors? Every choice of one run, with its unit and range."""

from dataclasses import dataclass

from sketchtree.errors import OptionError
from sketchtree.propagate.attractors.library import NAMES

ITERATIONS = 100  # the paper's, about
MOST_ITERATIONS = 10_000


@dataclass(frozen=True)
class Wanted:
    """How a tree grows to where foliage was seen. Raises OptionError for a value out of range."""

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
    twigs: bool = True  # what is still farther than a leaf is long grows twigs in the end
    in_space: int = 2500  # attractors in 3D, about, of `volume`
    max_segments: int = 60_000  # straight pieces grown, at most

    def __post_init__(self):
        if not 0 <= self.iterations <= MOST_ITERATIONS:
            raise OptionError(f"iterations is {self.iterations}, but must lie between 0 and {MOST_ITERATIONS}.", remedy="About 100 fill a crown.")
