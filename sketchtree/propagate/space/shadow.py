"""How much light reaches a place in the crown, and where is more?

Shadow propagation after Palubicki et al. 2009, §4.1: every leaf shades the voxels in a pyramid below it,

    Δs(q) = a b^(−q)     in the (2q + 1)² voxels q layers below, q ≥ 1

Nothing shades its own layer (the paper adds a back instead). Light falls as in Beer and Lambert's law, to which the
paper's C − s is the first order:

    light = e^(−s),   b = e^(h/R),   a = κ A / h² · Σ_q b^(−q) / Σ_q (2q + 1)² b^(−q)

    h   side of a voxel, metres        R   `reach`, metres down over which a shadow loses 1 − 1/e
    A   area of the leaf, m²           κ   `EXTINCTION`: leaves that lie as chance has it (Monsi & Saeki 1953)

a is such that under an endless even canopy of ρ m² of leaf a m³, s = κ ρ h / (b − 1) → κ ρ R, whatever the size of the voxels.

A pyramid's square grows by one voxel to each side from layer to layer, so the sum over all leaves needs no loop over them. With
E⁻ the leaves of the layers above, moved one voxel a layer to the left and 1/b weaker, and E⁺ the same to the right,

    E∓ ← b^(−1) shift∓(E∓ + leaves of the layer above)       s = a Σ_x (E⁻(x) − E⁺(x − 1))     (Σ_x: the running sum)

likewise in z: four such fields, one pass from the top layer down, linear in voxels.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float
from scipy.ndimage import map_coordinates

MOST_VOXELS = 4_000_000
EXTINCTION = 0.5  # κ
_GRAIN = 1e-6  # m²: leaf areas are counted in whole square millimetres, so that sums are the same in any order


@dataclass(frozen=True, eq=False)
class ShadowField:
    """Leaves in a box of voxels, and their shadow. Beyond the box it is as at the nearest voxel inside."""

    low: Float[np.ndarray, " 3"]  # corner of the first voxel, metres
    pitch: float  # h, metres
    reach: float  # R, metres
    leaves: Float[np.ndarray, "x y z"]  # in each voxel, mm²
    shadow: Float[np.ndarray, "x y z"]  # s at the middle of each voxel, ≥ 0

    @classmethod
    def empty(
        cls, low: Float[np.ndarray, " 3"], high: Float[np.ndarray, " 3"], *, pitch: float, reach: float, most: int = MOST_VOXELS
    ) -> "ShadowField":
        """No leaves yet, between two corners of a box (metres). `pitch` grows as it must for `most` voxels (≥ 1000)."""
        low, high = np.asarray(low, float), np.asarray(high, float)
        pitch = max(pitch, float(np.max(high - low)) / (most / 4))
        while np.prod(_shape(low, high, pitch)) > most:
            pitch *= 1.05
        nothing = np.zeros(_shape(low, high, pitch))
        return cls(low, pitch, reach, nothing, nothing)

    def with_leaves(self, point: Float[np.ndarray, "leaf 3"], area: Float[np.ndarray, " leaf"]) -> "ShadowField":
        """The same with more leaves, of these areas in m² (< 0 takes some away); those outside the box count at its rim."""
        voxel = np.clip(((point - self.low) / self.pitch).astype(np.int64), 0, np.array(self.leaves.shape) - 1)
        flat = np.ravel_multi_index(tuple(voxel.T), self.leaves.shape)
        more = np.bincount(flat, np.rint(np.asarray(area) / _GRAIN), minlength=self.leaves.size)
        leaves = self.leaves + more.reshape(self.leaves.shape)
        return replace(self, leaves=leaves, shadow=self._strength() * shadows(leaves, np.exp(-self.pitch / self.reach)))

    def shadow_at(self, point: Float[np.ndarray, "point 3"]) -> Float[np.ndarray, " point"]:
        """s at these points, between the middles of voxels trilinear."""
        at = (np.asarray(point) - self.low) / self.pitch - 0.5
        return map_coordinates(self.shadow, at.T, order=1, mode="nearest")

    def light_at(self, point: Float[np.ndarray, "point 3"]) -> Float[np.ndarray, " point"]:
        """Light at these points, 1 in the open to 0 in the dark."""
        return np.exp(-self.shadow_at(point))

    def gradient_at(self, point: Float[np.ndarray, "point 3"]) -> Float[np.ndarray, "point 3"]:
        """Directions to more light: −h ∇s, without unit, 1 long at most; 0 where it is equally light all round."""
        point = np.asarray(point, float)
        slope = np.zeros(point.shape)
        for axis in range(3):
            step = self.pitch * np.eye(3)[axis]
            slope[:, axis] = 0.5 * (self.shadow_at(point - step) - self.shadow_at(point + step))
        return slope / np.maximum(np.linalg.norm(slope, axis=1, keepdims=True), 1.0)

    def _strength(self) -> float:
        """a of a square millimetre of leaf."""
        x = np.exp(-self.pitch / self.reach)
        footprint = 4 * (1 + x) / (1 - x) ** 2 + 4 / (1 - x) + 1  # Σ (2q + 1)² x^q / Σ x^q over q ≥ 1
        return float(EXTINCTION * _GRAIN / self.pitch**2 / footprint)


def shadows(leaves: Float[np.ndarray, "x y z"], fade: float) -> Float[np.ndarray, "x y z"]:
    """For every voxel Σ_q fade^q · the leaves within q voxels to each side, q ≥ 1 layers above. y is up."""
    x, layers, z = leaves.shape
    found = np.zeros(leaves.shape, np.float32)
    corner = np.zeros((2, 2, x + 1, z + 1))
    for layer in range(layers - 2, -1, -1):
        corner[:, :, :x, :z] += leaves[:, layer + 1, :]
        corner = fade * _spread(corner)
        edge = corner[0, 0].copy()
        edge[1:] -= corner[1, 0, :-1]
        edge[:, 1:] -= corner[0, 1, :, :-1]
        edge[1:, 1:] += corner[1, 1, :-1, :-1]
        found[:, layer, :] = np.maximum(edge.cumsum(axis=0).cumsum(axis=1)[:x, :z], 0.0)
    return found


def _spread(corner):
    """The four fields moved one voxel outwards: what leaves the box on the left stays in its first voxel, on the right in a
    last one outside it."""
    moved = np.empty_like(corner)
    for along_x in (0, 1):
        for along_z in (0, 1):
            moved[along_x, along_z] = _moved(_moved(corner[along_x, along_z], along_x).T, along_z).T
    return moved


def _moved(field, right: int):
    out = np.empty_like(field)
    if right:
        out[0], out[1:-1], out[-1] = 0.0, field[:-2], field[-2] + field[-1]
    else:
        out[-1], out[1:-1], out[0] = 0.0, field[2:], field[0] + field[1]
    return out


def _shape(low, high, pitch: float):
    return tuple(int(count) for count in np.maximum(np.ceil((high - low) / pitch), 1.0))
