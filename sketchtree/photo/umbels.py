"""How do flowers stand on the twigs of a photo's tree in blossom? In clusters, here many and there none.

Ours. Leaves stand along every twig; a cherry's or an apple's flowers stand in umbels, a few on each short shoot, and shoots that bear come in patches: where light and last year's fruit
have let them. A shoot bears where a smooth random field is high, which is drawn in space, and differs a little by limb and by shoot:

    f(x) = √(2 / K) Σ cos(2π w·x / λ + φ) + LIMB n_limb + OWN n_shoot,  the BEARING highest        w: unit, all ways    λ: WAVES leaf lengths    n: standard normal

Shoots are of all lengths, short ones most often, and lean all ways; their umbels look all ways about them and are of different sizes.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Array, Bool, Float, Int, Key

from sketchtree import keys
from sketchtree.foliage.buds import SUNK, Buds, around, stem_nodes
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.models import leaf_model
from sketchtree.foliage.populate import leafy_wood
from sketchtree.foliage.twigs import Twigs
from sketchtree.foliage.wear import Wear, wear_of
from sketchtree.keys import numpy_generator, stage_key
from sketchtree.limb_ids import child_limb_id
from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton

BEARING = 0.5  # of the shoots
WAVES = (3.0, 12.0)  # umbel lengths: the least patch is a few umbels, the greatest a spray of twigs
MORE = 0.65  # of the places on its twigs that may bear more where the photo shows foliage that is open
LIMB, OWN = 0.4, 0.5  # of what the field varies by
UMBELS = (2, 5)  # on a shoot
SHORTEST, LONGEST = 0.15, 1.5  # umbel lengths, of a shoot; half are shorter than a third of the way between them
LEANS = (25.0, 115.0)  # degrees between a twig and a shoot
SIZES = (0.65, 1.25)  # of an umbel
_COUNT = 32  # waves
_ASTRAY = 0.9  # of an umbel's direction, at random
_APART = 0.25  # umbel lengths between the umbels of a shoot, along it
_OUTWARD, _UNEVEN = 0.4, 0.5  # of the light's direction (`foliage.populate`): out of the crown, and at random
_UP = np.array([0.0, 1.0, 0.0])
_FIELD, _TURN, _LEAN, _LENGTH, _NUMBER, _SIZE, _TINT, _AWAY, _FACE = 40, 41, 42, 43, 44, 45, 46, 47, 51  # the draws of a shoot and of an umbel


@dataclass(frozen=True, eq=False)
class Patches:
    """Where shoots bear."""

    wave: Float[np.ndarray, "wave 3"]  # radians a metre
    phase: Float[np.ndarray, " wave"]
    key: Key[Array, ""]

    @classmethod
    def of(cls, length: float, key: Key[Array, ""]) -> "Patches":
        """For umbels of a length, metres."""
        draw = numpy_generator(stage_key(key, "patches"))
        way = _unit(draw.normal(size=(_COUNT, 3)))
        long = length * np.exp(draw.uniform(*np.log(WAVES), _COUNT))
        return cls(2 * np.pi * way / long[:, None], draw.uniform(0, 2 * np.pi, _COUNT), key)

    def field(self, place: Float[np.ndarray, "place 3"], limb: Int[np.ndarray, " place"]) -> Float[np.ndarray, " place"]:
        """How readily shoots bear at places on limbs (their ids)."""
        waves = np.cos((place.astype(np.float32) @ self.wave.T.astype(np.float32)) + self.phase.astype(np.float32)).sum(axis=1)
        return np.sqrt(2 / _COUNT) * waves + LIMB * keys.normal(self.key, limb, _FIELD)

    def bearing(self, field: Float[np.ndarray, " place"], own: Float[np.ndarray, " place"], share: float = BEARING) -> Bool[np.ndarray, " place"]:
        """Which places bear; `own`: a standard normal number of each."""
        field = field + OWN * own
        return field >= np.quantile(field, 1 - share) if len(field) else np.zeros(0, bool)


@dataclass(frozen=True, eq=False)
class Flowering:
    """The flowers of one tree."""

    tree: TreeSkeleton
    habit: Habit
    wear: Wear
    patches: Patches
    key: Key[Array, ""]

    @classmethod
    def of(cls, tree: TreeSkeleton, habit: Habit, model: str, *, size: float, key: Key[Array, ""]) -> "Flowering":
        """Umbels of a length, metres, on a tree without roots."""
        wear = replace(wear_of(habit, model), size=size)
        return cls(tree, habit, wear, Patches.of(size, key), key)

    def __call__(self, place: Float[np.ndarray, "place 3"], segment: Int[np.ndarray, " place"], draw: np.random.Generator) -> Bool[np.ndarray, " place"]:
        """Which places on segments may bear more."""
        return self.patches.bearing(self.patches.field(place, self.tree.limb[segment]), draw.normal(size=len(place)), MORE)

    def umbels(self, wood: Twigs, count: int) -> Leaves:
        """About so many on the leafy part of the tree's `wood`."""
        leafy, size = leafy_wood(wood, self.tree, self.habit, self.wear), self.wear.size
        way = float(leafy.length.sum())
        if way == 0:
            return Leaves.none(self.wear.model.name)
        nodes = stem_nodes(leafy, self.tree.limb, replace(self.wear, spacing=way * BEARING * 0.5 * sum(UMBELS) / max(count, 1)), self.key)
        field = self.patches.field(nodes.foot, self.tree.limb[nodes.segment])
        nodes = nodes.select(self.patches.bearing(field, keys.normal(self.key, nodes.id, _FIELD)))
        outward = around(2 * np.pi * keys.uniform(self.key, nodes.id, _TURN), nodes.side, nodes.tangent)
        lean = np.radians(LEANS[0] + (LEANS[1] - LEANS[0]) * keys.uniform(self.key, nodes.id, _LEAN))[:, None]
        start, ahead = nodes.foot + SUNK * nodes.radius[:, None] * outward, np.cos(lean) * nodes.tangent + np.sin(lean) * outward
        return self._on(nodes, start, ahead, size * stalk(keys.uniform(self.key, nodes.id, _LENGTH)))

    def _on(self, nodes: Buds, start, ahead, long) -> Leaves:
        """The umbels of shoots that start at nodes and are so long."""
        size, number = self.wear.size, UMBELS[0] + (keys.uniform(self.key, nodes.id, _NUMBER) * (UMBELS[1] - UMBELS[0] + 1)).astype(np.int64)
        of = np.repeat(np.arange(len(nodes)), number)
        rank = np.arange(len(of)) - np.repeat(np.cumsum(number) - number, number)
        ids = child_limb_id(nodes.id[of], rank)
        position = start[of] + np.maximum(long[of] - _APART * size * rank, 0.0)[:, None] * ahead[of]
        direction = astray(ahead[of], self._noise(ids, _AWAY), self.wear.model.droop)
        axis = self.tree.tip[self.tree.is_base].mean(axis=0)
        light = _UP + _OUTWARD * _unit((position - axis) * [1.0, 0.0, 1.0]) + _UNEVEN * self._noise(ids, _FACE)
        sizes = size * (SIZES[0] + (SIZES[1] - SIZES[0]) * keys.uniform(self.key, ids, _SIZE))
        shoot = np.stack([start, start + long[:, None] * ahead], axis=1)
        return Leaves(self.wear.model.name, position, direction, across(light, direction), sizes, keys.uniform(self.key, ids, _TINT), nodes.segment[of], shoot)

    def _noise(self, ids: Int[np.ndarray, " umbel"], draw: int) -> Float[np.ndarray, "umbel 3"]:
        """Standard normal numbers."""
        return np.stack([keys.normal(self.key, ids, draw + axis) for axis in range(3)], axis=1)


def across(light: Float[np.ndarray, "umbel 3"], direction: Float[np.ndarray, "umbel 3"]) -> Float[np.ndarray, "umbel 3"]:
    """Of the light's direction, what is perpendicular to the umbels'."""
    return _unit(light - np.einsum("ij,ij->i", light, direction)[:, None] * direction)


def stalk(share: Float[np.ndarray, " shoot"]) -> Float[np.ndarray, " shoot"]:
    """How long a shoot is, umbel lengths, from its share of all, 0-1."""
    return SHORTEST + (LONGEST - SHORTEST) * share**1.6


def astray(ahead: Float[np.ndarray, "umbel 3"], noise: Float[np.ndarray, "umbel 3"], droop: float) -> Float[np.ndarray, "umbel 3"]:
    """Directions about a shoot's, of flowers that hang as their model does; `noise`: standard normal numbers."""
    return _unit(ahead + _ASTRAY * noise - droop * _UP)


def on_own_shoots(one: Leaves, long: Float[np.ndarray, " umbel"], draw: np.random.Generator) -> Leaves:
    """Umbels that stand on wood, each moved to the end of a shoot so long, metres, of its own size and direction there."""
    end = one.position + long[:, None] * one.direction
    direction = astray(one.direction, draw.normal(size=(len(one), 3)), leaf_model(one.model).droop)
    return replace(one, position=end, direction=direction, normal=across(one.normal, direction), size=one.size * draw.uniform(*SIZES, len(one)), shoot=np.stack([one.position, end], axis=1))


def _unit(vector):
    return vector / np.maximum(np.linalg.norm(vector, axis=1, keepdims=True), 1e-12)
