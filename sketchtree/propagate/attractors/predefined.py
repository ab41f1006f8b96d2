"""Which subtrees are there without any drawing? Ours, from botany: how buds stand and which of them go on (Tan et al. 2008, Figure 4, shows others).

Type I, at the end: what a shoot does whose end bud is lost or goes on among others. Type II, along: lateral buds in alternate, spiral, opposite and whorled arrangement;
those nearest the tip are strongest but shorter than what is below them, which had more time.
"""

from functools import cache

import numpy as np

from sketchtree.propagate.attractors.subtree import Sprouting, Subtree

_SPIRAL = 137.5  # degrees between the azimuths of successive buds


@cache
def type_one() -> tuple[Subtree, ...]:
    """Subtrees whose branches grow at the end."""
    return _fork(), _uneven_fork(), _trident(), _spray()


@cache
def type_two() -> tuple[Subtree, ...]:
    """Subtrees whose branches grow along."""
    return _alternate(), _spiral(), _opposite(), _whorled()


def _fork() -> Subtree:
    """Both buds below a lost end bud go on (dichasium)."""
    tree = Sprouting("fork")
    for azimuth in (0.0, 180.0):
        first = tree.branch(1.0, 32.0, azimuth, 0.75, bow=0.4)
        tree.branch(1.0, 42.0, azimuth + 90.0, 0.32, on=first + 1, pieces=2)
    return tree.done()


def _uneven_fork() -> Subtree:
    """The upper bud leads on a little aside, the lower one follows (sympodium)."""
    tree = Sprouting("uneven fork")
    lead = tree.branch(1.0, 16.0, 0.0, 0.8, bow=0.6)
    tree.branch(1.0, 48.0, 180.0, 0.5, bow=0.4)
    tree.branch(1.0, 45.0, 120.0, 0.32, on=lead + 1, pieces=2)
    return tree.done()


def _trident() -> Subtree:
    """Three buds close together go on (false whorl)."""
    tree = Sprouting("trident")
    for azimuth, angle, length in ((0.0, 30.0, 0.7), (120.0, 40.0, 0.6), (240.0, 46.0, 0.5)):
        tree.branch(1.0, angle, azimuth, length, bow=0.4)
    return tree.done()


def _spray() -> Subtree:
    """A leader with side shoots."""
    tree = Sprouting("spray")
    lead = tree.branch(1.0, 8.0, 0.0, 0.75, bow=0.5)
    for piece, azimuth, length in ((0, 40.0, 0.45), (0, 220.0, 0.42), (1, 130.0, 0.34), (1, 310.0, 0.3)):
        tree.branch(1.0, 45.0, azimuth, length, on=lead + piece, pieces=2)
    return tree.done()


def _alternate() -> Subtree:
    """By turns on two sides (distichous: elm, beech, lime)."""
    tree = Sprouting("alternate")
    for k, share in enumerate(np.linspace(0.32, 0.9, 5)):
        first = tree.branch(share, 52.0 - 14.0 * share, 180.0 * (k % 2) + 12.0 * k, 0.62 - 0.38 * share)
        if k < 2:
            tree.branch(share, 44.0, 90.0, 0.22, on=first + 1, pieces=2)
    return tree.done()


def _spiral() -> Subtree:
    """137.5° from one to the next (oak, cherry, poplar)."""
    tree = Sprouting("spiral")
    for k, share in enumerate(np.linspace(0.26, 0.93, 6)):
        tree.branch(share, 56.0 - 16.0 * share, _SPIRAL * k, 0.58 - 0.34 * share)
    return tree.done()


def _opposite() -> Subtree:
    """In pairs, each across the one below (decussate: maple, ash, horse chestnut)."""
    tree = Sprouting("opposite")
    for k, share in enumerate((0.4, 0.62, 0.84)):
        for side in (0.0, 180.0):
            tree.branch(share, 50.0 - 8.0 * k, side + 90.0 * k, (0.52 - 0.28 * share) * (1.0 if side else 0.88))
    return tree.done()


def _whorled() -> Subtree:
    """Several at one height (spruce, pine)."""
    tree = Sprouting("whorled")
    for share, turn, length in ((0.42, 0.0, 0.44), (0.76, 45.0, 0.3)):
        for side in range(4):
            tree.branch(share, 58.0 - 14.0 * share, turn + 90.0 * side, length * (1.0 - 0.06 * side))
    return tree.done()
