"""What one file for other programs holds: a tree in one or more levels of detail, with what moves and what collides.

Writers (`export`) take an `Asset`; `detail` makes its levels, `rig` its joints and capsules.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float, Int

from sketchtree.geometry.instances import Instances
from sketchtree.geometry.mesh import Mesh
from sketchtree.skeleton import TreeSkeleton


@dataclass(frozen=True, eq=False)
class Level:
    """One level of detail: parts that are drawn together."""

    parts: tuple[Mesh | Instances, ...]  # wood first
    coverage: float = 0.0  # it serves while the tree fills at least this share of the screen's height; falls from level to level

    @property
    def triangle_count(self) -> int:
        """How many triangles it draws."""
        return sum(part.triangle_count for part in self.parts)


@dataclass(frozen=True, eq=False)
class Armature:
    """Bones that bend the main limbs; meshes name them in their columns JOINTS_0 and WEIGHTS_0. World frame, at rest.

    Requirements: a joint's parent stands before it; joint 0 is the one root.
    """

    name: tuple[str, ...]  # of each joint
    parent: Int[np.ndarray, " joint"]  # NULL for the root
    position: Float[np.ndarray, "joint 3"]  # metres
    rotation: Float[np.ndarray, "joint 4"]  # unit quaternion x y z w; the joint's +y runs along its limb
    length: Float[np.ndarray, " joint"]  # metres to the end of its bone

    def __len__(self) -> int:
        return len(self.parent)


@dataclass(frozen=True, eq=False)
class Keys:
    """How one property of joints changes with time: ragged by track, linear between keys (turns on the shorter arc), held before the first and after the last."""

    joint: Int[np.ndarray, " track"]  # that each track moves
    start: Int[np.ndarray, " track+1"]  # track i owns the keys start[i]:start[i + 1], one at least
    time: Float[np.ndarray, " key"]  # seconds, rising within a track
    value: Float[np.ndarray, "key channel"]

    def __len__(self) -> int:
        return len(self.joint)


@dataclass(frozen=True, eq=False)
class Morph:
    """How a mesh changes its shape with time: vertices stand at position + weight · offset, before joints move them; 0 at rest."""

    part: int  # which of the finest level's parts
    offset: Float[np.ndarray, "vertex 3"]  # metres
    time: Float[np.ndarray, " key"]  # seconds, rising
    weight: Float[np.ndarray, " key"]  # linear between keys


@dataclass(frozen=True, eq=False)
class Animation:
    """How the joints of an armature move. Values are relative to a joint's parent, as in glTF and USD; a joint without a track stays as at rest."""

    name: str
    seconds: float  # of the whole; the first key of all is at 0
    translation: Keys  # metres, 3 channels
    rotation: Keys  # unit quaternions x y z w
    scale: Keys  # along the joint's axes, 3 channels
    morphs: tuple[Morph, ...] = ()


@dataclass(frozen=True, eq=False)
class Capsules:
    """Round bars for collision: every point within `radius` of the line from `start` to `end`. Metres, world frame."""

    start: Float[np.ndarray, "capsule 3"]
    end: Float[np.ndarray, "capsule 3"]
    radius: Float[np.ndarray, " capsule"]
    joint: Int[np.ndarray, " capsule"]  # the bone it moves with; NULL: none

    def __len__(self) -> int:
        return len(self.radius)


@dataclass(frozen=True, eq=False)
class Asset:
    """One tree (or one forest) as a file holds it."""

    levels: tuple[Level, ...]  # finest first; one at least
    skeleton: TreeSkeleton | None = None
    name: str = "tree"  # of the root node
    armature: Armature | None = None
    capsules: Capsules | None = None
    animation: Animation | None = None  # of the armature's joints
    about: dict = field(default_factory=dict)  # JSON: seed, version, template, options …; no date, no path

    @classmethod
    def of(cls, parts: Sequence[Mesh | Instances], **rest) -> "Asset":
        """A single level of detail."""
        return cls((Level(tuple(parts)),), **rest)

    @property
    def parts(self) -> tuple[Mesh | Instances, ...]:
        """Those of the finest level."""
        return self.levels[0].parts
