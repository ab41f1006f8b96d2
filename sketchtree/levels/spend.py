"""Where do a level's triangles go: to leaves, their short shoots, or wood?

Where it shows most. Leaves come in several forms (`foliage.leaf_cards`), short shoots too, wood in any number of triangles (`levels.wood`). Each form of each is
looked at alone, from one side; of the silhouettes, since what is in front does not matter to an outline,

    S(leaves, shoots, wood) = S(leaves) ∪ S(shoots) ∪ S(wood)

so every combination is compared with the full tree without being drawn. Of those within the budget the one of the greatest overlap is taken, and the wood gets
what is left.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool

from sketchtree.dressing import Dress
from sketchtree.foliage.leaf_cards import leaf_cards
from sketchtree.foliage.leaf_model import LeafModel
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.models import leaf_model
from sketchtree.foliage.short_shoots import stems
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.levels.outline_error import overlap, views_round
from sketchtree.levels.raster import silhouette
from sketchtree.levels.wood import LevelWood
from sketchtree.skeleton import TreeSkeleton

_FORMS = (4.0, 3.0, 2.5, 2.0, 1.5, 1.25, 1.0, 0.8, 0.65, 0.5, 0.4, 0.3, 0.22, 0.16, 0.12, 0.08)  # triangles a picture of a leaf
_STEMS = (6, 3, 1, 0)  # triangles a short shoot
_WOOD = (1.0, 0.7, 0.5, 0.4, 0.32, 0.26, 0.2, 0.15, 0.11, 0.08, 0.055, 0.035, 0.02)  # shares of the full wood's triangles
_UNSPENT = 0.75  # of a level, what leaves may leave to the wood
_SIDES, _SIDE, _PIXELS = 16, 1, 512  # the side that is looked at, of so many round the tree: none that anyone else measures by


@dataclass(frozen=True, eq=False)
class _Form:
    """One form of a part of the tree, and where it is seen."""

    triangles: int
    shown: Bool[np.ndarray, "row column"]
    how: object  # what makes it again


class Budget:
    """A tree whose triangles are to be spent. What is made once serves every level."""

    def __init__(self, skeleton: TreeSkeleton, worn: Sequence[Leaves], full: Sequence[Mesh], dress: Dress, surface: bool = False):
        """`surface`: wood that wears nothing is to keep its surface, rather than its outline alone."""
        self._worn, self._season = tuple(worn), dress.season
        leafy = np.zeros(len(skeleton), bool)
        for leaves in worn:
            leafy[leaves.segment] = True
        self._wood = LevelWood.of(skeleton, bark=dress.bark, bark_colour=dress.bark_colour, habit=dress.habit, leafy=leafy, surface=surface and not self._worn)
        views = views_round(full, _SIDES, _PIXELS)
        self._view = views[_SIDE] if views else None  # None: there is nothing to see
        self._all = None if self._view is None else silhouette(full, self._view)
        self._made: dict[tuple, _Form] = {}
        self._total = sum(mesh.triangle_count for mesh in full if not mesh.name.startswith("leaf"))

    def meshes(self, triangles: int) -> tuple[Mesh, ...]:
        """At most so many triangles: wood first, then leaves and blossoms if there are any."""
        if not self._worn or self._view is None:
            return self._wood.meshes(triangles)
        woods, foliage, shoots = self._woods(triangles), self._foliage(triangles), self._shoots()
        best, chosen = -1.0, None
        for leaves in foliage:
            for stem in shoots:
                left = triangles - leaves.triangles - stem.triangles
                wood = next((form for form in woods if form.triangles <= left), None)
                if left < 0 or wood is None:
                    continue
                found = overlap(self._all, leaves.shown | stem.shown | wood.shown)
                if found > best + 1e-9:
                    best, chosen = found, (leaves.how, stem.how)
        if chosen is None:
            return self._wood.meshes(triangles)
        worn = self._cards(*chosen)
        return (*self._wood.meshes(triangles - sum(mesh.triangle_count for mesh in worn)), *worn)

    def _woods(self, triangles: int) -> list[_Form]:
        """Forms of the wood that so many triangles allow, the richest first; none at all is the last."""
        shares = [share for share in _WOOD if share * self._total <= triangles]
        return [self._kept(("wood", share), lambda share=share: self._wood.meshes(int(share * self._total)), share) for share in shares] + [self._kept(("wood", 0.0), tuple, 0.0)]

    def _foliage(self, triangles: int) -> list[_Form]:
        """Forms of the leaves that so many triangles allow and that leave no more than `_UNSPENT` of them to the wood, or the poorest."""
        counts = sorted({self._counts(form) for form in _FORMS if min(self._counts(form)) >= 1}, reverse=True)
        able = [count for count in counts if sum(count) <= triangles]
        some = [count for count in able if sum(count) >= (1 - _UNSPENT) * triangles] or able[:1]
        return [self._kept(("leaf", count), lambda count=count: self._cards(count, 0), count) for count in some]

    def _kept(self, name: tuple, make, how) -> _Form:
        if name not in self._made:
            meshes = make()
            self._made[name] = _Form(sum(mesh.triangle_count for mesh in meshes), silhouette(meshes, self._view), how)
        return self._made[name]

    def _counts(self, form: float) -> tuple[int, ...]:
        """Triangles of each set of leaves in a form."""
        return tuple(int(form * len(leaves) * pictures(leaf_model(leaves.model), form)) for leaves in self._worn)

    def _cards(self, counts: tuple[int, ...], stem: int) -> tuple[Mesh, ...]:
        made = [leaf_cards(leaves, season=self._season, triangles=max(count, 1), stem=stem) for leaves, count in zip(self._worn, counts, strict=True)]
        return tuple(mesh for mesh in made if mesh.triangle_count)

    def _shoots(self) -> list[_Form]:
        """Forms of the short shoots."""
        any_ = any(len(leaves.shoot) for leaves in self._worn)
        made = lambda stem: [_stem_mesh(leaves, stem) for leaves in self._worn if stem and len(leaves.shoot)]  # noqa: E731
        return [self._kept(("stem", stem), lambda stem=stem: made(stem), stem) for stem in (_STEMS if any_ else (0,))]


def pictures(model: LeafModel, form: float) -> int:
    """Of one leaf: a tuft has one on each of its planes."""
    return 1 if form > 2.0 else max(model.planes, 1)


def _stem_mesh(leaves: Leaves, stem: int) -> Mesh:
    shape = stems(leaves, 0, stem)
    return Mesh("leaf_stem", shape.position, shape.normal, shape.uv, shape.triangle, Material("leaf_stem"))
