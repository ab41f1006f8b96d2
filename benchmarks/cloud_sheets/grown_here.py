"""What grows toward the points of a cloud, measured as the program measures it."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.clouds.growing.estimated import estimated
from sketchtree.clouds.growing.grown import Grown, grown
from sketchtree.clouds.growing.species import Species, species
from sketchtree.clouds.growing.wanted import Growing
from sketchtree.clouds.standing.feet import feet
from sketchtree.clouds.standing.stems import breast_height
from sketchtree.clouds.standing.trunk import trunk
from sketchtree.clouds.tracing.traced import traced
from sketchtree.keys import root_key


@dataclass(frozen=True, eq=False)
class Here:
    """Where a plant stands, and how it grows."""

    xyz: Float[np.ndarray, "point 3"]
    feet: list[Int[np.ndarray, "_"]]
    radius: Float[np.ndarray, " foot"] | None
    kind: Species

    def grows(self, wanted: Growing | None = None, kind: Species | None = None, seed: int = 0) -> Grown:
        """What grows there."""
        return grown(self.xyz, self.feet, kind or self.kind, key=root_key(seed), wanted=wanted, radius=self.radius)


def here(xyz: Float[np.ndarray, "point 3"], roots: int | None = None) -> Here:
    """Feet, thickness and figures, as `cloud_tree` finds them."""
    stands = feet(xyz, count="auto" if roots is None else roots)
    measured = [trunk(xyz[rows], breast_height(float(np.ptp(xyz[:, 1])))) for rows in stands.stems]
    radius = np.array([one.root / 2 for one in measured]) if all(measured) else None
    known = float(radius[0]) if radius is not None and len(radius) == 1 else None
    seen = traced(xyz, stands.rows, foot_radius=known)
    return Here(xyz, stands.rows, radius, estimated(xyz, species("broadleaf"), seen.skeleton, seen.gamma))
