"""Which mesh does a blossom wear? The finest of which there may be as many, or none: then it is crossed cards, as tufts of needles are (`card_shape`).

    fine, plain, bowl    the first whose triangles, times the blossoms, are no more than may be spent
"""

from functools import lru_cache

from sketchtree.foliage.flowers.atlas import atlas
from sketchtree.foliage.flowers.forms import blossom_shape
from sketchtree.foliage.flowers.pieces import BOWL, FINE, PLAIN
from sketchtree.foliage.flowers.recipe import names, recipe
from sketchtree.foliage.flowers.shape import Shape
from sketchtree.foliage.painting import Painting

MERGED, INSTANCED = 450_000, 1_500_000
"""Triangles of all blossoms, where each is written and where one is drawn many times."""


@lru_cache(maxsize=1)
def with_meshes() -> frozenset[str]:
    """The leaf models that are flowers with a mesh."""
    return frozenset(names())


@lru_cache(maxsize=None)
def flower_shape(name: str, level: str) -> Shape:
    """A blossom's mesh, made once; as long as 1, its stalk's foot at the origin."""
    return blossom_shape(recipe(name), level)


@lru_cache(maxsize=None)
def flower_painting(name: str) -> Painting:
    """What is painted on it."""
    return atlas(recipe(name))


def flower_for(name: str, count: int, most: int) -> Shape | None:
    """The mesh that so many blossoms of a model wear, in at most so many triangles; None: cards."""
    if name not in with_meshes():
        return None
    shapes = (flower_shape(name, level) for level in (FINE, PLAIN, BOWL))
    return next((shape for shape in shapes if len(shape.triangle) * count <= most), None)
