"""How do leaves become one small mesh drawn many times? A few bent cards, each at many places, and one unit stem.

`cards.leaf_mesh` bends every leaf a little differently; here each takes the nearest of `_BENDS` cards, so that tips lie a few hundredths of
a blade away from where they were. Normals are the card's own.
"""

import numpy as np
from scipy.spatial.transform import Rotation

from sketchtree.foliage.card_shape import bends, bent, card, card_normals
from sketchtree.foliage.cards import leaf_axes, mesh_name
from sketchtree.foliage.crown_light import crown_light
from sketchtree.foliage.flowers.worn import INSTANCED, flower_for
from sketchtree.foliage.leaf_materials import card_material, colours_of, leaf_factor, leaf_material
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.models import leaf_model
from sketchtree.foliage.seasons import check_season
from sketchtree.foliage.short_shoots import on_petals, stem_frames, unit_stem
from sketchtree.geometry.instances import Instances
from sketchtree.geometry.mesh import Mesh

_BENDS = 3  # cards that differ in their curl


def leaf_instances(leaves: Leaves, *, season: str = "summer") -> tuple[Instances, ...]:
    """The leaves as instances of up to three cards, and of one stem for the short shoots: `leaf_0`, `leaf_1`, `leaf_2`, `leaf_stem`
    (`leaf_blossom_0`, …). What no leaf uses is left out. Those of cards name their leaves' rows. Raises OptionError."""
    check_season(season)
    model = leaf_model(leaves.model)
    flower = flower_for(leaves.model, len(leaves), INSTANCED)
    material, factor = (card_material if flower is None else leaf_material)(leaves.model, colours_of(leaves, season)), leaf_factor(leaves, season, crown_light(leaves))
    kinds = _BENDS if model.is_blade and model.curl else 1
    share = bends(leaves.tint, model)[1] / model.curl if kinds > 1 else np.ones(len(leaves))
    kind = np.clip(((share - 0.4) / 1.2 * kinds).astype(int), 0, kinds - 1)
    turn = _quaternions(leaf_axes(leaves))
    found = []
    for k in np.unique(kind):
        of = kind == k
        title = f"{mesh_name(leaves.model)}_{k}"
        mesh = _card_mesh(leaves.model, title, 0.4 + 1.2 * (k + 0.5) / kinds, material) if flower is None else Mesh(title, flower.position, flower.normals(), flower.uv, flower.triangle, material)
        found.append(Instances(mesh, leaves.position[of], turn[of], np.repeat(leaves.size[of, None], 3, axis=1), factor[of], np.flatnonzero(of)))
    return (*found, _stem_instances(leaves, material, flower is not None)) if len(leaves.shoot) else tuple(found)


def _card_mesh(name: str, title: str, curl: float, material) -> Mesh:
    """One card of size 1, petiole's end at the origin; `curl` in the model's."""
    model, (corners, uv, triangle) = leaf_model(name), card(name)
    position = bent(corners, model, [np.radians(model.fold)], [curl * model.curl])[0]
    return Mesh(title, position, card_normals(corners, triangle, model), uv, triangle, material)


def _stem_instances(leaves: Leaves, material, petals: bool) -> Instances:
    one, at = unit_stem(leaves.model), stem_frames(leaves)
    one = on_petals(one) if petals else one
    radius = np.full(len(at.start), at.radius)
    mesh = Mesh("leaf_stem", one.position, one.normal, one.uv, one.triangle, material)
    return Instances(mesh, at.start, _quaternions(at.axes), np.stack([radius, at.length, radius], axis=1))


def _quaternions(axes):
    """Unit quaternions x y z w of the rotations that take x, y and z to the rows of `axes`."""
    return Rotation.from_matrix(np.swapaxes(axes, 1, 2)).as_quat() if len(axes) else np.zeros((0, 4))
