"""Several trees that grow at the same time, as one: all joints in one armature, all meshes in one file. Each keeps its own clock from 0 to 1."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from sketchtree.animation.growing import Growing
from sketchtree.animation.wanted import LEAST_JOINTS, MOST_JOINTS
from sketchtree.asset import Animation, Armature, Asset, Keys
from sketchtree.axes import NULL
from sketchtree.errors import OptionError
from sketchtree.geometry.mesh import Mesh
from sketchtree.growth.plan import GrowthPlan
from sketchtree.levels.make import Model
from sketchtree.skeleton_joined import joined
from sketchtree.watch import Pulse, no_pulse


def growing_of(models: Sequence[Model], *, mode: str = "full", bend: float = 0.0, most_joints: int = MOST_JOINTS, pulse: Pulse = no_pulse) -> "Growing | Together":
    """One tree, or several that stand together, as they grow, moved by at most so many joints in all. Raises OptionError where there is none, or one that can't grow."""
    if not models:
        raise OptionError("There is no tree that could grow.", remedy="Give one.")
    plans = [GrowthPlan.of(model.skeleton, mode=mode, bend=bend) for model in models]
    each = [Growing.of(model, plan, most_joints=max(most_joints // len(models), LEAST_JOINTS), pulse=pulse) for model, plan in zip(models, plans, strict=True)]
    return each[0] if len(each) == 1 else Together(tuple(each))


@dataclass(frozen=True, eq=False)
class Together:
    """Trees that grow at the same time."""

    each: tuple[Growing, ...]

    def get_ready(self) -> None:
        """As `Growing.get_ready`."""
        for one in self.each:
            one.get_ready()

    def at(self, time: float) -> tuple[Mesh, ...]:
        """As `Growing.at`; meshes are named by their trees: `wood_1`, `leaf_1`, `wood_2`, …"""
        return tuple(replace(mesh, name=f"{mesh.name}_{k}") for k, one in enumerate(self.each, 1) for mesh in one.at(time))

    def asset(self, *, seconds: float = 10.0, about: dict | None = None) -> Asset:
        """As `Growing.asset`."""
        assets = [one.asset(seconds=seconds) for one in self.each]
        first = np.cumsum([0, *(len(one.armature) - 1 for one in assets)])  # joint j > 0 of tree k becomes j + first[k]; their roots are one
        part = np.cumsum([0, *(len(one.parts) for one in assets)])
        parts = [_renumbered(mesh, int(first[k]), k + 1) for k, one in enumerate(assets) for mesh in one.parts]
        moving = [one.animation for one in assets]
        tracks = {name: _joined([_moved(getattr(one, name), int(at)) for one, at in zip(moving, first, strict=False)]) for name in ("translation", "rotation", "scale")}
        morphs = tuple(replace(morph, part=morph.part + int(at)) for one, at in zip(moving, part, strict=False) for morph in one.morphs)
        skeleton = joined([one.skeleton.replace(tree=np.full(len(one.skeleton), k)) for k, one in enumerate(assets)])
        bones, animation = _armature([one.armature for one in assets], first), Animation("growth", seconds, **tracks, morphs=morphs)
        return Asset.of(parts, skeleton=skeleton, name="trees", armature=bones, animation=animation, about=about or {})


def _armature(bones: Sequence[Armature], first) -> Armature:
    """One root for all, that of the first tree."""
    parent = [np.where(one.parent[1:] == 0, 0, one.parent[1:] + at) for one, at in zip(bones, first, strict=False)]
    names = [f"{name}_{k}" for k, one in enumerate(bones, 1) for name in one.name[1:]]
    columns = {name: np.concatenate([getattr(bones[0], name)[:1], *(getattr(one, name)[1:] for one in bones)]) for name in ("position", "rotation", "length")}
    return Armature((bones[0].name[0], *names), np.concatenate([[NULL], *parent]), **columns)


def _renumbered(mesh: Mesh, first: int, tree: int) -> Mesh:
    joint = mesh.extra["JOINTS_0"].astype(np.int64)
    return replace(mesh, name=f"{mesh.name}_{tree}", extra={**mesh.extra, "JOINTS_0": np.where(joint > 0, joint + first, 0).astype(np.uint16)})


def _moved(keys: Keys, first: int) -> Keys:
    assert (keys.joint > 0).all(), "the root does not move"
    return replace(keys, joint=keys.joint + first)


def _joined(all_keys: Sequence[Keys]) -> Keys:
    start = np.cumsum([0, *(len(one.time) for one in all_keys)])
    starts = [one.start[1:] + at for one, at in zip(all_keys, start, strict=False)]
    return Keys(*(np.concatenate(column) for column in ([one.joint for one in all_keys], [[0], *starts], [one.time for one in all_keys], [one.value for one in all_keys])))
