"""How do leaves become triangles? All in one mesh: a bent card a leaf, petals and stalks a blossom (`flowers`), a thin tube a short shoot.

Shading normals lean from the card's own towards "out of the crown":

    n ∝ (1 − b) n_card + b (p − c)/|p − c|        c: centre of the crown, b: 0.35 for blades, 0.6 for tufts
"""

import numpy as np
from jaxtyping import Float

from sketchtree.foliage.card_shape import bends, bent, card, card_normals
from sketchtree.foliage.crown_light import crown_light
from sketchtree.foliage.flowers.worn import MERGED, flower_for
from sketchtree.foliage.leaf_materials import card_material, colours_of, leaf_factor, leaf_material
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.models import leaf_model
from sketchtree.foliage.seasons import check_season
from sketchtree.foliage.short_shoots import on_petals, stems
from sketchtree.geometry.mesh import Mesh

_OUTWARD = {True: 0.35, False: 0.6}  # blade, tuft


def leaf_mesh(leaves: Leaves, *, season: str = "summer") -> Mesh:
    """All leaves as one mesh called `leaf` (`leaf_blossom` if they are blossoms), its material `leaf_<model>`. Raises OptionError."""
    check_season(season)
    model = leaf_model(leaves.model)
    flower = flower_for(leaves.model, len(leaves), MERGED)
    corners, uv, triangle = card(leaves.model) if flower is None else flower
    one = bent(corners, model, *bends(leaves.tint, model)) if flower is None else corners[None]
    position = leaves.position[:, None] + turned(one, leaves) * leaves.size[:, None, None]
    own = card_normals(corners, triangle, model) if flower is None else flower.normals()
    normal = outward(turned(own[None], leaves), position, model.is_blade or flower is not None)
    factor = leaf_factor(leaves, season, crown_light(leaves))
    vertices = len(corners)
    stem = stems(leaves, vertices * len(leaves))
    stem = stem if flower is None else on_petals(stem)
    mesh = Mesh(
        name=mesh_name(leaves.model),
        position=np.vstack([position.reshape(-1, 3), stem.position]),
        normal=np.vstack([normal.reshape(-1, 3), stem.normal]),
        uv=np.vstack([np.tile(uv, (len(leaves), 1)), stem.uv]),
        triangle=np.vstack([(triangle[None] + vertices * np.arange(len(leaves))[:, None, None]).reshape(-1, 3), stem.triangle]),
        material=(card_material if flower is None else leaf_material)(leaves.model, colours_of(leaves, season)),
        color=np.vstack([np.repeat(factor, vertices, axis=0), np.ones((len(stem.position), 4))]),
    )
    return mesh if leaves.printed is None else leaves.printed.on(mesh, model)


def mesh_name(model: str) -> str:
    """`leaf`, or `leaf_blossom`."""
    return "leaf_blossom" if leaf_model(model).flower else "leaf"


def leaf_axes(leaves: Leaves) -> Float[np.ndarray, "leaf 3 3"]:
    """Rows: what x (across), y (to the tip) and z (out of the upper face) of a card become."""
    return np.stack([np.cross(leaves.direction, leaves.normal), leaves.direction, leaves.normal], axis=1)


def turned(local: Float[np.ndarray, "card vertex 3"], leaves: Leaves) -> Float[np.ndarray, "leaf vertex 3"]:
    """Vectors of one card, or of each leaf's own, in world axes."""
    return np.matmul(local, leaf_axes(leaves))


def outward(normal, position, is_blade: bool) -> Float[np.ndarray, "leaf vertex 3"]:
    """Card normals leaning out of the crown."""
    if len(position) == 0:
        return np.zeros_like(position)
    share = _OUTWARD[is_blade]
    out = position - position.reshape(-1, 3).mean(axis=0)
    out /= np.maximum(np.linalg.norm(out, axis=2, keepdims=True), 1e-9)
    lean = (1 - share) * normal + share * out
    return lean / np.maximum(np.linalg.norm(lean, axis=2, keepdims=True), 1e-9)
