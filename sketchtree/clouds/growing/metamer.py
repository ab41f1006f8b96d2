"""What does one internode bear, and which way does that look?

Guo et al. 2018, §5.1-5.2: a metamer is an internode of length l with a lateral bud at its end. From metamer to metamer the lateral's side turns by φ about the shoot,
v' = R_φ(v), which leaves the shoot's own direction as it is; the bud itself looks out of it by ψ, v' = R_ψ(v), at p' = p + v l.
"""

from dataclasses import dataclass, fields

import numpy as np
from jaxtyping import Float, Int

from sketchtree.clouds.growing.heading import unit


@dataclass(frozen=True, eq=False)
class Buds:
    """Buds that wait: apical ones at ends of shoots, lateral ones at nodes."""

    place: Float[np.ndarray, "bud 3"]
    heading: Float[np.ndarray, "bud 3"]  # unit
    side: Float[np.ndarray, "bud 3"]  # unit, across the heading: where the next lateral would be if it turned no further
    node: Int[np.ndarray, " bud"]  # row of the wood that it sits on
    thick: Float[np.ndarray, " bud"]  # metres, half the thickness that its wood will come to have
    length: Float[np.ndarray, " bud"]  # metres from its root, along the wood
    root: Int[np.ndarray, " bud"]  # row of the wood that it all began with

    def __len__(self) -> int:
        return len(self.node)

    def select(self, keep) -> "Buds":
        """Some of them."""
        return Buds(*(getattr(self, field.name)[keep] for field in fields(self)))

    @classmethod
    def joined(cls, several: list["Buds"]) -> "Buds":
        """All of several tables."""
        return cls(*(np.concatenate([getattr(buds, field.name) for buds in several]) for field in fields(cls)))


def seeds(root: Float[np.ndarray, "root 3"], thick: Float[np.ndarray, " root"], azimuth: Float[np.ndarray, " root"]) -> Buds:
    """Seed(p, v) → A(p, v): a bud at every root that looks upward. `azimuth`: radians, of its first lateral."""
    up = np.tile([0.0, 1.0, 0.0], (len(root), 1))
    side = np.stack([np.cos(azimuth), np.zeros(len(root)), np.sin(azimuth)], axis=1)
    return Buds(root.astype(float), up, side, np.arange(len(root)), thick, np.zeros(len(root)), np.arange(len(root)))


def rolled(side: Float[np.ndarray, "bud 3"], heading: Float[np.ndarray, "bud 3"], angle: Float[np.ndarray, " bud"]) -> Float[np.ndarray, "bud 3"]:
    """R_φ: the side turned about the heading, radians."""
    return np.cos(angle)[:, None] * side + np.sin(angle)[:, None] * np.cross(heading, side)


def branched(heading: Float[np.ndarray, "bud 3"], side: Float[np.ndarray, "bud 3"], angle: Float[np.ndarray, " bud"]) -> Float[np.ndarray, "bud 3"]:
    """R_ψ: out of the heading towards the side, radians."""
    return np.cos(angle)[:, None] * heading + np.sin(angle)[:, None] * side


def carried(side: Float[np.ndarray, "bud 3"], heading: Float[np.ndarray, "bud 3"]) -> Float[np.ndarray, "bud 3"]:
    """The side, across a heading that has changed."""
    across = side - np.einsum("bi,bi->b", side, heading)[:, None] * heading
    lost = np.linalg.norm(across, axis=1) < 1e-6
    other = np.cross(heading, np.where(np.abs(heading[:, :1]) < 0.9, [[1.0, 0.0, 0.0]], [[0.0, 0.0, 1.0]]))
    return unit(np.where(lost[:, None], other, across))
