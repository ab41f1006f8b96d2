"""Which subtrees may replace a branch? Those of the tree that was drawn, and predefined ones (Tan et al. 2008, §3.1).

    visible   every limb of the tree with what it bears, two generations deep; of those at most `MOST`, the one with most branches first and then
              whichever differs most from all that were taken
    I, II     the predefined ones (`predefined`)

A visible subtree is taken off the line of its limb as `wood` lays it along another: every branch in the frame of the limb where it grows, lengths over the limb's.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.axes import NULL
from sketchtree.errors import OptionError
from sketchtree.propagate.attractors.predefined import type_one, type_two
from sketchtree.propagate.attractors.subtree import PIECES, Sprouting, Subtree
from sketchtree.propagate.attractors.wood import Stretch, Wood

NAMES = ("visible", "I", "II")
MOST = 8  # visible subtrees (the paper's at most)
_BRANCHES = 10  # of a visible subtree at most, the longest
_LONGEST = 1.1  # times its limb: a longer branch is no part of a limb's subtree, but a limb that goes on
_LEAST = 0.05  # of its limb: a shorter one says nothing
_ALIKE = 0.12  # subtrees that differ by less count as one


@dataclass(frozen=True, eq=False)
class Library:
    """Several subtrees as one block of arrays, filled up to the largest with pieces that are not there."""

    subtrees: tuple[Subtree, ...]
    vector: Float[np.ndarray, "subtree piece 3"]
    share: Float[np.ndarray, "subtree piece"]
    along: Float[np.ndarray, "subtree piece"]
    there: Bool[np.ndarray, "subtree piece"]
    below: Float[np.ndarray, "subtree piece piece"]  # 1 where the second piece is the first one or bears it
    with_next: Bool[np.ndarray, "subtree piece"]  # is the first of its branch and goes on: a stump, without the next

    @classmethod
    def of(cls, subtrees) -> "Library":
        """The subtrees in the order given."""
        subtrees = tuple(subtrees)
        size, count = max(map(len, subtrees)), len(subtrees)
        library = cls(subtrees, np.zeros((count, size, 3)), np.zeros((count, size)), np.zeros((count, size)), np.zeros((count, size), bool),
                      np.zeros((count, size, size)), np.zeros((count, size), bool))  # fmt: skip
        for k, one in enumerate(subtrees):
            here = slice(0, len(one))
            library.vector[k, here], library.share[k, here], library.along[k, here], library.there[k, here] = one.vector, one.share, one.along, True
            for piece, above in enumerate(one.parent):
                library.below[k, piece] = library.below[k, above] if above != NULL else 0.0
                library.below[k, piece, piece] = 1.0
            first = np.r_[True, one.branch[1:] != one.branch[:-1]]
            library.with_next[k, here] = first & (np.bincount(one.branch)[one.branch] > 1)
        return library

    def __len__(self) -> int:
        return len(self.subtrees)

    def only(self, subtree: int) -> "Library":
        """One subtree of it, in a block as large."""
        blocks = (block[[subtree]] for block in (self.vector, self.share, self.along, self.there, self.below, self.with_next))
        return Library((self.subtrees[subtree],), *blocks)

    @cached_property
    def is_type_one(self) -> Bool[np.ndarray, " subtree"]:
        """Which grow at the end of the branch alone."""
        return np.array([one.is_type_one for one in self.subtrees])

    @cached_property
    def reach(self) -> float:
        """How far any of them comes from the middle of its supporting branch, which is 1 long."""
        return max(one.reach for one in self.subtrees)


def library_of(wood: Wood, names=NAMES) -> Library:
    """The subtrees that these names stand for. Where only visible ones are asked for and none is, the predefined ones of type II serve."""
    wrong = [name for name in names if name not in NAMES]
    if wrong or not names:
        raise OptionError(f"library is {', '.join(names) or 'empty'}, but must name some of {', '.join(NAMES)}.", remedy="'visible,I,II' takes all there are.")
    subtrees = [*(visible(wood) if "visible" in names else ()), *(type_one() if "I" in names else ()), *(type_two() if "II" in names else ())]
    return Library.of(subtrees or type_two())


def visible(wood: Wood, most: int = MOST) -> list[Subtree]:
    """The subtrees of the limbs of a tree, the most telling ones."""
    all_ = [one for number in range(wood.given) if (one := _subtree(wood, number)) is not None]
    all_.sort(key=lambda one: -one.branches)
    taken: list[Subtree] = all_[:1]
    while len(taken) < min(most, len(all_)):
        apart = [min(_difference(one, other) for other in taken) for one in all_]
        if max(apart) < _ALIKE:
            break
        taken.append(all_[int(np.argmax(apart))])
    return taken


def _subtree(wood: Wood, number: int) -> Subtree | None:
    """A limb and what it bears, if anything."""
    limb = wood.limbs[number]
    grown = Sprouting(f"limb {number}")
    found = sorted(_borne(wood, number), key=lambda child: -wood.limbs[child].length)[:_BRANCHES]
    found = [child for child in sorted(found, key=lambda child: wood.limbs[child].at) if _LEAST < wood.limbs[child].length / max(limb.length, 1e-300) <= _LONGEST]
    if not found:
        return None
    low = 0.5 * min(wood.limbs[child].at for child in found) if limb.parent == NULL else 0.0  # a clear bole is no part of a stem's subtree
    support = Stretch(number, low, limb.length, 0)
    for child in found:
        branch = wood.limbs[child]
        share = (branch.at - low) / support.length
        _, frame = wood.line(support, np.array(share))
        first = grown.chain(share, _vectors(branch) @ frame / support.length)
        for second in sorted(_borne(wood, child), key=lambda k: -wood.limbs[k].length)[:2]:
            twig = wood.limbs[second]
            piece = int(np.clip(np.rint(PIECES * twig.at / max(branch.length, 1e-300)) - 1, 0, PIECES - 1))
            if twig.length > _LEAST * support.length:
                grown.chain(share, _vectors(twig, 2) @ frame / support.length, on=first + piece)
    return grown.done()


def _borne(wood: Wood, number: int) -> list[int]:
    """Numbers of the given limbs that grow on a limb."""
    return [child for child in range(wood.given) if wood.limbs[child].parent == number]


def _vectors(limb, pieces: int = PIECES):
    """A limb as so many straight pieces, metres."""
    return np.diff(limb.place(np.linspace(0.0, limb.length, pieces + 1)), axis=0)


def _difference(one: Subtree, other: Subtree) -> float:
    """How different two subtrees are: of what a person would see, the root mean square."""
    return float(np.sqrt(np.mean((_look(one) - _look(other)) ** 2)))


def _look(one: Subtree):
    """Where its branches start, how many they are, how long, how steep, and how much to one side."""
    first = np.flatnonzero((one.parent == NULL))
    length = np.array([np.linalg.norm(one.vector[one.branch == one.branch[piece]].sum(axis=0)) for piece in first])
    whole = one.vector[first] / np.linalg.norm(one.vector[first], axis=1, keepdims=True)
    side = np.linalg.norm(whole[:, [0, 2]].mean(axis=0))
    return np.array([one.share[first].mean(), 0.1 * one.branches, length.mean(), np.arccos(np.clip(whole[:, 1], -1, 1)).mean(), side])
