"""How do several trees grow up together, and one tree towards the light?

In lockstep: before every generation the shared fields are made anew of all trees (`space.neighbours`, `space.light`), then each tree grows
one generation in what they say. No tree sees what another does in the same generation, and the fields ask nowhere which tree is first,
so the order in which trees are named changes nothing. Each tree has blocks, habit, crown and scale of its own, and grows in its
own frame: a tree that is out of the others' reach is to the last bit the tree that it is alone.

    1   generations up to the limit         2   rounds of filling, where crowns are hollow or it was asked for         3   generations again
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.propagate.fill import COARSE_GAP, GAP, HOLLOW_ROUNDS, LED_GAP, ROUNDS
from sketchtree.propagate.growing import Growing
from sketchtree.propagate.space.domain import Domain
from sketchtree.propagate.space.light import Canopy, Light, shadow_reach
from sketchtree.propagate.space.neighbours import Neighbours, Wood
from sketchtree.propagate.space.space import Space
from sketchtree.propagate.wanted import CROWN_GENERATIONS, Wanted
from sketchtree.skeleton import TreeSkeleton

_CLAIM_PIECES = 6  # of an open branch


@dataclass(frozen=True, eq=False)
class Member:
    """One tree of those that grow together."""

    tree: TreeSkeleton  # above the ground; one tree, in its own frame
    wanted: Wanted
    key: Key[Array, ""]
    place: Float[np.ndarray, " 3"] = field(default_factory=lambda: np.zeros(3))  # of its frame in the world, metres


class Together:
    """Trees while they grow together. A single one without light grows as `Growing` alone would."""

    def __init__(self, members: list[Member], pulse: Callable[[], None] = lambda: None):
        self.members, self.pulse = members, pulse
        self.growing = [Growing(member.tree, member.wanted, member.key) for member in members]
        self.alone = [growing.space for growing in self.growing]
        self.lit = any(member.wanted.light > 0 for member in members)
        self.wood = [_Grown(growing) for growing in self.growing]
        self.domains, self.neighbours = [], None
        if self.lit or len(members) > 1:
            self.domains = [Domain.of(g.drawn.tree, g.envelope, g.habit, g.scale) for g in self.growing]
        if len(members) > 1:
            gaps = np.array([growing.habit.twig_length for growing in self.growing])
            self.neighbours = Neighbours(self.domains, np.array([member.place for member in members], float), gaps)

    def complete(self) -> list[Growing]:
        """All trees, grown to their ends."""
        limits = [member.wanted.limit for member in self.members]
        self._run(limits)
        limits = [CROWN_GENERATIONS if m.wanted.generations is None else limit for m, limit in zip(self.members, limits, strict=True)]
        gaps = [() if growing.wanted.only is not None else _gaps(growing) for growing in self.growing]
        for round_ in range(max(map(len, gaps), default=0)):
            self.pulse()
            self._look_round()
            for growing, limit, gap in zip(self.growing, limits, gaps, strict=True):
                if round_ < len(gap):
                    growing.fill(round_, limit, gap[round_])
        self._run([limit if gap else growing.done for growing, limit, gap in zip(self.growing, limits, gaps, strict=True)])
        return self.growing

    def _run(self, limits: list[int]) -> None:
        """Generation after generation, each tree until its limit or until nothing of it is open."""
        going = list(zip(self.growing, limits, strict=True))
        while going := [(growing, limit) for growing, limit in going if growing.done < limit]:
            self.pulse()
            self._look_round()
            going = [(growing, limit) for growing, limit in going if growing.generation()]

    def _look_round(self) -> None:
        """Every tree's space as all trees make it now."""
        if not self.lit and self.neighbours is None:
            return
        territories = [None] * len(self.growing) if self.neighbours is None else self._territories()
        lights = self._lights() if self.lit else [None] * len(self.growing)
        for growing, alone, territory, light in zip(self.growing, self.alone, territories, lights, strict=True):
            guides = tuple(guide for guide in (territory, light) if guide is not None)
            space = Space((*alone.barriers, *(() if territory is None else (territory,))), (*alone.guides, *guides))
            if territory is None:
                growing.space = space
            else:
                growing.enter(space)
            if light is not None:
                open_ = growing.open
                growing.open = open_.select((open_.grown > 0) | light.opens(open_.origin, open_.limb, growing.key))

    def _territories(self):
        new = [grown.new_wood() for grown in self.wood]
        return self.neighbours.claimed(new, [_claim(growing.open) for growing in self.growing])

    def _lights(self) -> list[Light | None]:
        """The light about each tree that asks for it, as its own leaves and those of all others leave it."""
        reach = [shadow_reach(growing.envelope, growing.scale) for growing in self.growing]
        spacing = [growing.habit.lateral_spacing for growing in self.growing]
        canopies = [Canopy.of(g.leafy(), r, s) for g, r, s in zip(self.wood, reach, spacing, strict=True)]
        return [self._light(k, canopies, reach[k]) for k in range(len(self.members))]

    def _light(self, k: int, canopies: list[Canopy], reach: float) -> Light | None:
        strength, place = self.members[k].wanted.light, self.members[k].place
        if strength == 0:
            return None
        seen = [canopy.moved(other.place - place) if i != k else canopy for i, (canopy, other) in enumerate(zip(canopies, self.members, strict=True))]
        return Light.under(seen, self.domains[k], reach, strength)


class _Grown:
    """The nodes of one tree, taken up as it grows."""

    def __init__(self, growing: Growing):
        tree = growing.drawn.tree
        self.growing, self.taken = growing, 0
        self.tip, self.limbs = tree.tip, [tree.tip[tree.order > 0]]
        self.fresh = [(tree.start, tree.tip)]

    def take(self) -> None:
        """Take up the generations grown since."""
        for nodes, parent in self.growing.parts[self.taken :]:
            self.tip = np.concatenate([self.tip, nodes.tip])
            self.limbs.append(nodes.tip)
            self.fresh.append((self.tip[parent], nodes.tip))
        self.taken = len(self.growing.parts)

    def leafy(self) -> Float[np.ndarray, "node 3"]:
        """The nodes that leaves are about, metres: all but those of drawn trunks."""
        self.take()
        return np.concatenate(self.limbs)

    def new_wood(self) -> Wood:
        """What has grown since this was last asked; at first what was drawn."""
        self.take()
        found, self.fresh = self.fresh, [(np.zeros((0, 3)), np.zeros((0, 3)))]
        return Wood.along(*(np.concatenate(ends) for ends in zip(*found, strict=True)))


def _claim(open_) -> Wood:
    """What open branches would grow if they met nothing."""
    return Wood.along(open_.origin, open_.origin + open_.length[:, None] * open_.frame[:, :, 1], _CLAIM_PIECES)


def _gaps(growing: Growing) -> list[float]:
    """The gaps of the rounds of filling, in spacings of laterals."""
    fill = growing.wanted.fill
    gaps = HOLLOW_ROUNDS * [LED_GAP if growing.leaders else COARSE_GAP] if growing.is_hollow() else []
    return gaps[: 1 if fill else None] + (ROUNDS * [GAP] if fill else [])
