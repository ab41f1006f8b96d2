"""A few tints in place of many.

UsdPreviewSurface can't multiply a texture by a colour of the vertex, and readers take no connection into a texture's scale; a material a tint is what
all of them show. The tints t that one material wears, in all parts and levels, are cut at equal counts along their main axis (the first principal
component of ln t); the mean of each piece is kept, and every face or place has the nearest.
"""

from collections.abc import Iterable

import numpy as np
from jaxtyping import Float, Int

from sketchtree.geometry.instances import Instances
from sketchtree.geometry.mesh import Mesh

MOST = 8
_WHITE = np.ones((1, 3))


def palettes(parts: Iterable[Mesh | Instances]) -> dict[int, Float[np.ndarray, "tint 3"]]:
    """The tints of each material, by its `id`: those of all parts that wear it."""
    worn: dict[int, list] = {}
    for part in parts:
        tint = tint_of(part)
        worn.setdefault(id((part.mesh if isinstance(part, Instances) else part).material), []).append(_WHITE if tint is None or not len(tint) else tint)
    return {material: few_tints(np.concatenate(tints)) for material, tints in worn.items()}


def tint_of(part: Mesh | Instances) -> Float[np.ndarray, "row 3"] | None:
    """The tint of every face, or of every place; None where there is none."""
    if isinstance(part, Mesh):
        return None if part.color is None else np.asarray(part.color, float)[part.triangle][..., :3].mean(axis=1)
    own, each = part.mesh.color, part.color
    if own is None and each is None:
        return None
    tint = np.ones((len(part), 3)) if each is None else np.asarray(each, float)[:, :3]
    return tint if own is None else tint * np.asarray(own, float)[:, :3].mean(axis=0)  # a prototype has one material


def few_tints(tint: Float[np.ndarray, "row 3"], most: int = MOST) -> Float[np.ndarray, "tint 3"]:
    """At most `most` tints that stand for those given; exactly those given if they are no more."""
    given = np.unique(np.round(tint, 4), axis=0)
    if len(given) <= most:
        return given
    log = np.log(np.maximum(tint, 1e-3))
    log = log - log.mean(axis=0)
    axis = np.linalg.eigh(log.T @ log)[1][:, -1]
    along = log @ (axis * np.sign(axis[np.argmax(np.abs(axis))]))
    order = np.argsort(along, kind="stable")
    return np.stack([tint[piece].mean(axis=0) for piece in np.array_split(order, most)])


def nearest(tint: Float[np.ndarray, "row 3"], palette: Float[np.ndarray, "tint 3"]) -> Int[np.ndarray, " row"]:
    """Which of the palette's tints is nearest to each."""
    from scipy.spatial import cKDTree

    return cKDTree(palette).query(tint)[1].astype(np.int64)
