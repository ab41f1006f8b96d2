"""Which way is the light, and which buds get too little of it?

Palubicki et al. 2009, §4.1 and §5: leaves cast shadows s into voxels (`space.shadow`); shoots turn down the gradient of the shadow, and
buds in the shade stay shut. Once a generation the field is made of all nodes there are; within one it stands still.

    heading     d ← (d + η g_⊥) / |…|        g = −R ∇s, 1 long at most;  g_⊥ its part across d
    turn        η = min(`_TURN` · ℓ / spacing, `_MOST`) · light
    bud         opens with probability min(1, e^(−s) / `_ENOUGH`)^(`_STRICT` · light)

    light   0-1, the user's strength: 0 is off        ℓ   length of the step, metres
    R       reach of a shadow, `_REACH` of the crown's size, the mean of its three sides (geometric)

Many short steps turn as far as one long one, so twigs of many nodes follow the light and a limb's long steps are bounded. However few
nodes a tree has yet, its leaves are so many that in a crown evenly filled with them R holds `_LEAF_AREA` m² over every m²: a crown is but
a few R thick and its rim is light, so that amid it s is 1 to 2.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Bool, Float, Int, Key
from scipy.ndimage import map_coordinates

from sketchtree import keys
from sketchtree.errors import OptionError
from sketchtree.propagate.space.domain import Domain
from sketchtree.propagate.space.envelope import Envelope
from sketchtree.propagate.space.shadow import ShadowField

_TURN = 0.12  # radians a spacing of laterals, where the light is most uneven
_MOST = 0.35  # radians a step
_ENOUGH = 0.3  # light in which every bud opens
_STRICT = 1.2
_REACH = 0.17  # of the size of the crown
_SIZE = 0.7  # of the height: that of a crown nobody drew
_LEAF_AREA = 10.0  # m² a m²
_VOXELS = 120_000  # of the field, at most
_LOT = 40  # draw of a limb's bud


@dataclass(frozen=True, eq=False)
class Canopy:
    """The leaves of one tree, as far as it has grown."""

    point: Float[np.ndarray, "node 3"]  # metres
    area: float  # of each node's leaves, m²

    @classmethod
    def of(cls, point: Float[np.ndarray, "node 3"], reach: float, least: float) -> "Canopy":
        """Leaves at these nodes; `least` (metres) is how thick a crown is at least."""
        if len(point) == 0:
            return cls(point, 0.0)
        volume = 4 / 3 * np.pi * 5**1.5 * np.prod(np.maximum(np.std(point, axis=0), least))
        return cls(point, float(_LEAF_AREA * volume / reach / len(point)))

    def moved(self, by: Float[np.ndarray, " 3"]) -> "Canopy":
        """The same elsewhere, metres."""
        return Canopy(self.point + by, self.area)


@dataclass(frozen=True, eq=False)
class Light:
    """The light about one tree in one generation: a guide of its space."""

    strength: float  # 0-1
    spacing: float  # of laterals, metres
    field: ShadowField
    slope: Float[np.ndarray, "axis x y z"]  # −R ∇s at the middles of the voxels, without unit

    @classmethod
    def under(cls, canopies: list[Canopy], domain: Domain, reach: float, strength: float) -> "Light":
        """The light that these trees leave in a tree's box. Raises OptionError for a strength outside 0-1."""
        check_strength(strength)
        field = ShadowField.empty(domain.low, domain.high, pitch=0.25 * reach, reach=reach, most=_VOXELS)
        near = [one.point[domain.holds(one.point)] for one in canopies]
        area = np.repeat([one.area for one in canopies], [len(point) for point in near])
        field = field.with_leaves(np.concatenate(near), area)
        steps = [np.gradient(field.shadow, axis=axis) if n > 1 else np.zeros(field.shadow.shape) for axis, n in enumerate(field.shadow.shape)]
        return cls(strength, domain.spacing, field, -reach / field.pitch * np.stack(steps))

    def towards(self, point: Float[np.ndarray, "point 3"]) -> Float[np.ndarray, "point 3"]:
        """g at these points: the way to more light, 1 long at most."""
        at = ((point - self.field.low) / self.field.pitch - 0.5).T
        found = np.stack([map_coordinates(part, at, order=1, mode="nearest") for part in self.slope], axis=1)
        return found / np.maximum(np.linalg.norm(found, axis=1, keepdims=True), 1.0)

    def turned(
        self,
        start: Float[np.ndarray, "branch 3"],
        heading: Float[np.ndarray, "branch 3"],
        step: Float[np.ndarray, " branch"],
        limb: Int[np.ndarray, " branch"],
    ) -> Float[np.ndarray, "branch 3"]:
        """Headings a little more towards the light."""
        way = self.towards(start)
        across = way - np.einsum("bi,bi->b", way, heading)[:, None] * heading
        turn = self.strength * np.minimum(_TURN * step / self.spacing, _MOST)
        found = heading + turn[:, None] * across
        return found / np.linalg.norm(found, axis=1, keepdims=True)

    def opens(
        self, origin: Float[np.ndarray, "branch 3"], limb: Int[np.ndarray, " branch"], key: Key[Array, ""] | np.uint64
    ) -> Bool[np.ndarray, " branch"]:
        """Which buds at these places open, by lots of their limbs."""
        chance = np.minimum(self.field.light_at(origin) / _ENOUGH, 1.0) ** (_STRICT * self.strength)
        return keys.uniform(key, limb, _LOT) < chance


def check_strength(strength: float) -> None:
    """Raises OptionError for a strength of the light outside 0-1."""
    if not 0 <= strength <= 1:
        raise OptionError(f"light is {strength:g}, but must lie between 0 and 1.", remedy="0.5 turns twigs to the light; 0 is off.")


def shadow_reach(envelope: Envelope | None, height: float) -> float:
    """R of a tree with this crown, or of this height (metres) without one; metres."""
    if envelope is None:
        return _REACH * _SIZE * height
    low, high = envelope.bounds
    return _REACH * float(np.prod(np.maximum(high - low, 1e-3 * height)) ** (1 / 3))
