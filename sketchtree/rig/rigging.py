"""What does a rigged mesh carry?

    COLOR_0       tint, as ever: every viewer multiplies it into the colour     COLOR_1      sway, branch, phase, flutter
    TEXCOORD_1    pixel of its pivot (`pivots.py`)                               TEXCOORD_2   sway, branch
    TEXCOORD_3    phase, flutter                                                 TEXCOORD_4   x, y of its pivot, metres
    TEXCOORD_5    z of its pivot, number of the element that carries it          JOINTS_0, WEIGHTS_0   bones

The wind stands in it twice: engines that read one set of colours (Unreal, Unity, Godot) read several of texture places, and
in the one set of colours the leaves' tint has to stay, or every other viewer would show the wind as colour.
"""

from dataclasses import dataclass, replace

import numpy as np

from sketchtree.foliage.leaves import Leaves
from sketchtree.geometry.limbs import CentreLines, centre_lines
from sketchtree.geometry.mesh import Mesh
from sketchtree.rig.bones import Bones, bones
from sketchtree.rig.boughs import Boughs, boughs
from sketchtree.rig.collar import collar
from sketchtree.rig.islands import mesh_places
from sketchtree.rig.leaf_rows import leaf_rows
from sketchtree.rig.pivots import Pivots, pivot_columns, pivots, texel
from sketchtree.rig.weights import Weights, place_weights
from sketchtree.rig.wind import Wind, each_leaf_wind, far_wind, leaf_places, wind_of, wood_wind
from sketchtree.skeleton import TreeSkeleton


@dataclass(frozen=True, eq=False)
class Rigging:
    """All that is known of how a tree moves; it dresses any mesh of it."""

    tree: TreeSkeleton
    lines: CentreLines
    limbs: Boughs
    wind: Wind
    bones: Bones
    pivots: Pivots

    @classmethod
    def of(cls, tree: TreeSkeleton, *, most_joints: int = 64, most_pivots: int = 1000) -> "Rigging":
        """The rigging of a tree that has at least one limb."""
        lines = centre_lines(tree)
        limbs = boughs(tree, lines)
        return cls(tree, lines, limbs, wind_of(tree, lines, limbs), bones(lines, limbs, most=most_joints), pivots(lines, limbs, most=most_pivots))

    def wood(self, mesh: Mesh) -> Mesh:
        """A mesh of the tree's wood with all columns."""
        place = mesh_places(self.lines, self.limbs, mesh)
        over = collar(self.lines, self.limbs, place, mesh.position)
        weights = place_weights(self.lines, self.limbs, self.bones, place, over)
        return self._dressed(mesh, wood_wind(self.wind, self.lines, place, over, mesh.position), self.pivots.of_limb[place.limb], weights)

    def leaves(self, mesh: Mesh, leaves: Leaves) -> Mesh:
        """A mesh of these leaves with all columns; each leaf moves as one, but for its flutter. There is at least one leaf."""
        rows = leaf_rows(mesh, leaves)
        place = leaf_places(self.tree, self.lines, leaves)
        wind = np.column_stack([each_leaf_wind(self.wind, self.lines, place, leaves.position)[rows.leaf], rows.reach])
        weights = place_weights(self.lines, self.limbs, self.bones, place)
        weights = Weights(*(column[rows.leaf] for column in weights))
        return self._dressed(mesh, wind, self.pivots.of_limb[place.limb[rows.leaf]], weights)

    def impostor(self, mesh: Mesh) -> Mesh:
        """A mesh that stands for the whole tree: it sways as one, without bones."""
        whole = np.zeros(len(mesh.position), np.int64)
        return self._dressed(mesh, far_wind(self.wind, mesh.position), whole, None)

    def _dressed(self, mesh: Mesh, wind, element, weights: Weights | None) -> Mesh:
        beside, behind = pivot_columns(self.pivots, element)
        columns = {
            "COLOR_1": wind,
            "TEXCOORD_1": texel(self.pivots, element),
            "TEXCOORD_2": wind[:, :2],
            "TEXCOORD_3": wind[:, 2:],
            "TEXCOORD_4": beside,
            "TEXCOORD_5": behind,
        }
        columns = {name: column.astype(np.float32) for name, column in columns.items()}
        if weights is not None:
            columns |= {"JOINTS_0": weights.joint.astype(np.uint16), "WEIGHTS_0": weights.weight.astype(np.float32)}
        tint = np.ones((len(mesh.position), 4)) if mesh.color is None else mesh.color
        return replace(mesh, color=tint, extra={**mesh.extra, **columns})
