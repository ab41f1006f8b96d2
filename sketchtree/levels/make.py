"""Which levels of detail does a tree get?

LOD0 is the tree itself. LOD1, LOD2 and LOD3 have at most `SHARES` of its triangles, and the impostor 16. Each takes over where its outline is off by no more
than a pixel or what else is allowed (`outline_error`), measured from two sides, so that detail goes only where it can't be seen.
"""

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from sketchtree.asset import Level
from sketchtree.dressing import Dress
from sketchtree.errors import OptionError
from sketchtree.foliage.leaves import Leaves
from sketchtree.geometry.mesh import Mesh
from sketchtree.levels.impostor import impostor
from sketchtree.levels.outline_error import coverage, displacement, views_round
from sketchtree.levels.raster import silhouette
from sketchtree.levels.spend import Budget
from sketchtree.options import FEWEST_TRIANGLES, FileOptions
from sketchtree.skeleton import TreeSkeleton

SHARES = (0.5, 0.2, 0.06)
"""Most triangles of LOD1, LOD2, LOD3, as shares of LOD0's."""

_SIDES, _PIXELS = 4, 512  # every other of so many sides is looked at for the coverages


class Model(Protocol):
    """What levels are made of: `pipeline.TreeModel` is one."""

    skeleton: TreeSkeleton
    leaves: Leaves
    blossom: Leaves | None
    meshes: tuple[Mesh, ...]
    dress: Dress


def level_of_detail(model: Model, number: int) -> tuple[Mesh, ...]:
    """The meshes of LOD0-3: wood first, then leaves and blossoms if there are any."""
    if number == 0:
        return tuple(model.meshes)
    return _budget(model).meshes(_most(model, number))


def within_triangles(model: Model, triangles: int) -> tuple[Mesh, ...]:
    """The meshes with so many triangles at most, in the order of `level_of_detail`; the model's own where they have no more. Of bare wood as near to its surface as they allow: such a
    mesh isn't seen from afar, but measured, or worked on. Raises OptionError for fewer than `FEWEST_TRIANGLES`."""
    if triangles < FEWEST_TRIANGLES:
        raise OptionError(f"{triangles:,} triangles are too few for a tree.", remedy=f"Give {FEWEST_TRIANGLES} or more.")
    if sum(mesh.triangle_count for mesh in model.meshes) <= triangles:
        return tuple(model.meshes)
    return _budget(model, surface=True).meshes(triangles)


def as_fine_as(model: Model, wanted: FileOptions) -> tuple[Mesh, ...]:
    """The meshes of the one level that is to be written."""
    return level_of_detail(model, wanted.lod) if wanted.triangles is None else within_triangles(model, wanted.triangles)


def make_levels(model: Model, *, pixel_error: float = 1.0, with_impostor: bool = True) -> tuple[Level, ...]:
    """LOD0 to LOD3 and, if asked for, the impostor, each with the share of the screen's height down to which it serves.

    `pixel_error` is what an outline may be off where a level takes over, pixels of a screen of 1080 rows, > 0.
    """
    budget = _budget(model)
    parts = [tuple(model.meshes), *(budget.meshes(_most(model, number + 1)) for number in range(len(SHARES)))]
    if with_impostor:
        card = impostor(parts[1])  # as good from afar, and half the work
        parts += [(card,)] if card.triangle_count else []
    return tuple(Level(part, share) for part, share in zip(parts, _coverages(model, parts, pixel_error), strict=True))


def _budget(model: Model, surface: bool = False) -> Budget:
    worn = [leaves for leaves in (model.leaves, model.blossom) if leaves is not None and len(leaves)]
    return Budget(model.skeleton, worn, model.meshes, model.dress, surface)


def _most(model: Model, number: int) -> int:
    return int(SHARES[number - 1] * sum(mesh.triangle_count for mesh in model.meshes))


def _coverages(model: Model, parts: Sequence[tuple[Mesh, ...]], pixel_error: float) -> list[float]:
    """Down to which share of the screen's height each level serves: where the next one is good enough. They fall."""
    views = views_round(parts[0], _SIDES, _PIXELS)[:2]
    full = [silhouette(parts[0], view) for view in views]
    shares = []
    for part in parts[1:]:
        error = np.mean([displacement(shown, silhouette(part, view), view) for shown, view in zip(full, views, strict=True)]) if views else 0.0
        shares.append(coverage(float(error), model.skeleton.height, pixel_error))
    return [*np.minimum.accumulate(shares).tolist(), 0.0]
