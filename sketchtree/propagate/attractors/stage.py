"""The stage: a skeleton in, one that fills the foliage out (Tan et al. 2008, §3.1-3.2). For a tree of a photo, or a drawn one with a crown.

Each tree of the skeleton grows to a target of its own. What was given stays: its rows are split where something new grows on them, and none is moved. New rows are of kind PROPAGATED,
with `subtree.RATIO` times the radius of the limb that bears them (`geometry.radii.PipeRadii` may redo them) and ids from that limb's.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Array, Key

from sketchtree.errors import OptionError
from sketchtree.propagate.attractors.assemble import assembled
from sketchtree.propagate.attractors.attractors import Attractors
from sketchtree.propagate.attractors.engine import Engine
from sketchtree.propagate.attractors.library import library_of
from sketchtree.propagate.attractors.state import Course, State
from sketchtree.propagate.attractors.target import Target
from sketchtree.propagate.attractors.wanted import Wanted
from sketchtree.propagate.attractors.wood import Wood
from sketchtree.propagate.generations import Propagation
from sketchtree.propagate.space.space import Space
from sketchtree.roots import is_root, with_roots, without_roots
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_joined import joined

LEAF = 0.0125  # of the tree's height, its crown included: how long a leaf is where nobody says


@dataclass(frozen=True, eq=False)
class Grown:
    """How one tree grew: all that a person would plot."""

    image: Attractors  # on the page
    space: Attractors  # in 3D
    course: Course
    leaf_length: float  # metres
    ended: str  # stalled | iterations | filled | max_segments
    library: tuple[str, ...]  # names of the subtrees it was grown with


@dataclass(frozen=True, eq=False)
class Attraction(Propagation):
    """A tree and how it came about; `pipeline.finish` takes it as any propagation."""

    grown: Mapping[int, Grown] = field(default_factory=dict)  # by the number in the column `tree`


@dataclass(frozen=True)
class Attract(Wanted):
    """The stage. `targets`: where foliage was seen, of one tree, or of several by their numbers in the column `tree`; a tree without one stays as it is."""

    targets: Target | Mapping[int, Target] = field(default_factory=dict)

    def __call__(self, tree: TreeSkeleton, *, key: Key[Array, ""]) -> TreeSkeleton:
        return self.run(tree, key=key).skeleton

    def run(self, tree: TreeSkeleton, *, key: Key[Array, ""], pulse: Callable[[], None] = lambda: None) -> Attraction:
        """As the call, with all that is known of how it grew. `pulse` is called before every iteration; what it raises ends the growth."""
        above, kept = without_roots(tree)
        names = np.unique(above.tree).tolist()
        targets = self._targets(names)
        parts, generation, drawn, grown, warnings, rows = [], [], np.zeros(len(tree), np.int64), {}, [], 0
        for name in names:
            mine = above.tree == name
            part = above if len(names) == 1 else above.select(mine)
            whole, its, row = part, np.zeros(len(part), np.int64), np.arange(len(part))
            if name in targets:
                wood = Wood.of(part)
                grown[name] = self._grown(wood, part, targets[name], key, pulse)
                whole, its, row = assembled(part, wood)
                warnings += _warnings(wood, grown[name])
            drawn[kept[mine]] = rows + row
            parts.append(whole), generation.append(its)
            rows += len(whole)
        skeleton = joined(parts) if parts else tree
        drawn[is_root(tree)] = rows + np.arange(len(tree) - len(kept))
        generation = np.concatenate([*generation, np.zeros(len(tree) - len(kept), np.int64)]).astype(np.int64)
        spaces = {name: Space((targets[name].closed(one.leaf_length),)) for name, one in grown.items()}
        return Attraction(
            with_roots(skeleton, tree, drawn) if parts else tree, generation, drawn, int(generation.max(initial=0)), _ended(grown), tuple(dict.fromkeys(warnings)),
            space=next(iter(spaces.values()), Space()), spaces=spaces, grown=grown,
        )  # fmt: skip

    def _targets(self, names: list[int]) -> Mapping[int, Target]:
        """The target of every tree that has one."""
        if isinstance(self.targets, Target):
            if len(names) > 1:
                raise OptionError(f"There is one target for {len(names)} trees.", remedy="Give one for each, by the tree's number.")
            return {name: self.targets for name in names}
        return self.targets

    def _grown(self, wood: Wood, tree: TreeSkeleton, target: Target, key, pulse) -> Grown:
        """One tree grows; its limbs are added to the wood."""
        height = max(tree.height, target.highest - float(tree.tip[tree.is_base, 1].min()))
        leaf = self.leaf_length or LEAF * height
        library = library_of(wood, self.library)
        state = State(wood, target, self, leaf, key)
        ended = Engine(state, library).run(pulse)
        return Grown(state.image, state.space, state.course, leaf, ended, tuple(one.name for one in library.subtrees))


def attract(tree: TreeSkeleton, targets, *, key: Key[Array, ""], **wanted) -> Attraction:
    """Grow a tree to where foliage was seen. Options as in `Wanted`."""
    return Attract(targets=targets, **wanted).run(tree, key=key)


def _ended(grown: Mapping[int, Grown]) -> str:
    """What ended the growth, in the words of `Propagation`."""
    return "max_segments" if any(one.ended == "max_segments" for one in grown.values()) else "generations"


def _warnings(wood: Wood, grown: Grown) -> list[str]:
    """What the user should know."""
    if len(wood) == wood.given:
        return ["Nothing grew: no limb comes near the foliage. Draw a limb into it, or the crown around the limbs."]
    if grown.ended == "max_segments":
        return [f"Growth stopped at {grown.course.segments[-1]} new segments. Raise max_segments, or give a larger leaf_length."]
    return []
