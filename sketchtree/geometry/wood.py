"""The wood of a whole tree as one textured mesh."""

import numpy as np
from jaxtyping import Array, Key

from sketchtree import keys
from sketchtree.geometry.bark import bark_material
from sketchtree.geometry.collars import collar_tops
from sketchtree.geometry.detail import Detail
from sketchtree.geometry.limbs import centre_lines
from sketchtree.geometry.mesh import Mesh
from sketchtree.geometry.resolution import collar_rings, sides
from sketchtree.geometry.rings import rings
from sketchtree.geometry.tubes import sweep
from sketchtree.skeleton import TreeSkeleton


def wood_mesh(tree: TreeSkeleton, *, bark: str, key: Key[Array, ""], detail: Detail = Detail()) -> Mesh:  # noqa: B008 (frozen)
    """Limbs as closed tubes that grow out of each other, in one mesh called `wood`.

    `bark` is a name of `bark_names()`; `key` shifts the bark of each limb. A tree without a segment gives an
    empty mesh. Raises `OptionError` for an unknown bark.
    """
    material = bark_material(bark)
    lines = centre_lines(tree)
    height = float(np.ptp(tree.tip, axis=0).max()) if len(lines) else 0.0  # the longest side of the tree's box
    if height == 0.0:
        return Mesh("wood", np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 2)), np.zeros((0, 3), np.int64), material)
    tolerance = detail.tolerance * height
    count = sides(lines.radius[lines.start[:-1]], tolerance, detail)
    tops = collar_tops(lines, detail, height)
    ring = rings(lines, tops, collar_rings(count), detail, height)
    shift = np.stack([keys.uniform(key, lines.limb_id, draw) for draw in (0, 1)], axis=1)
    surface = sweep(lines, ring, count, tops, shift, detail, tolerance)
    return Mesh("wood", surface.position, surface.normal, surface.uv, surface.triangle, material)
