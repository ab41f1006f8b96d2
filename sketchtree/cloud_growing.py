"""What else does a tree give that grew toward points? Itself after every cycle of growth (Guo et al. 2018, Figure 12), and similar ones, by other figures, in the same points (Figure 13)."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Int

from sketchtree.cloud_tree import CloudTree, Found, growth, whole_tree
from sketchtree.clouds.growing.figures import Change
from sketchtree.errors import OptionError
from sketchtree.growth_tree import Worn
from sketchtree.watch import Watch


def cycles(tree: CloudTree, count: int) -> Int[np.ndarray, " tree"]:
    """So many cycles of its growth, from the first after which something stands to the last: where all its wood is as long as the square of an even time, so that it becomes higher evenly
    though the last twigs take many cycles. Some come several times where it grew in few."""
    grows = _grows(tree)
    first = next((cycle for cycle in range(1, grows.cycles) if grows.at(cycle).length.sum() > 0), grows.cycles)
    step = grows.wood.step()
    length = np.array([step[grows.wood.standing(cycle)].sum() for cycle in range(grows.cycles + 1)])
    most = np.maximum.accumulate(length)
    found = np.searchsorted(most, np.linspace(0.0, 1.0, count) ** 2 * most[-1])
    return np.clip(np.append(found[:-1], grows.cycles), first, grows.cycles)


def after(tree: CloudTree, cycle: int) -> Worn:
    """The tree after a cycle of its growth, finished as it is itself; after the last one that is the tree."""
    grows = _grows(tree)
    return tree.model if cycle >= grows.cycles else tree.finish(grows.at(cycle))[0]


@dataclass(frozen=True, eq=False)
class Variation:
    """A tree that differs from another in one figure."""

    change: Change
    tree: CloudTree


def variation(tree: CloudTree, change: Change, watch: Watch | None = None) -> Variation:
    """The tree that grows in the same points with another figure. Raises OptionError for one that its species can't have."""
    grows, watch = _grows(tree), watch or Watch()
    with watch("infer"):
        other = growth(tree.toward, tree.feet, tree.trunks, change.of(grows.species), tree.finish.key)
    found = Found(other.skeleton, tree.trunks, other.species, tree.leafy, None, other, tree.toward, tree.followed)
    return Variation(change, whole_tree(found, tree.prepared, tree.feet, tree.wanted, tree.finish, watch))


def _grows(tree: CloudTree):
    if tree.grows is None:
        raise OptionError("A traced tree is where its points are: it did not grow.", remedy="Make it by the method `grown`.")
    return tree.grows
