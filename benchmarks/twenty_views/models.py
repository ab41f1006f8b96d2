"""Which trees are known, and which others are of their kind? Six exemplars and four digitised fruit trees, chosen before anything was measured.

Exemplars are grown anew of their recipes, bare, with orders 0 to 2 (trunk, limbs, branches; the dead oak whole): what is finer is thinner than a pixel of these pictures. *Another seed*
of an exemplar is the same recipe with other seeds. Of a digitised tree it is another digitised tree of the species, scaled to the known height (nectarines are peaches: *Prunus persica*).
Limbs follow the thickest child, then the straightest, in all: only thickness can be seen.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sketchtree.geometry.wood import wood_mesh
from sketchtree.export.gltf import write_glb
from sketchtree.keys import root_key
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_files import read_npz
from sketchtree.skeleton_rows import limbs
from sketchtree.templates.growing.procedural import grow
from sketchtree.templates.growing.recipe import read_recipe
from sketchtree.templates.making.regenerate import recipe_folder
from sketchtree.view.picture import footing

MEASURED = Path(__file__).parents[1] / "data" / "measured"
RECIPES = {"english_oak_young": 2, "wild_cherry": 2, "scots_pine": 2, "black_alder": 2, "hazel": 2, "dead_oak": 9}
"""Recipes, and the highest order that is kept."""
DIGITISED = {
    "apple_11_10_13": ("apple_cl1", "apple_cl3"), "apple_cl1": ("apple_cl3", "apple_11_10_13"),
    "nectarine_30_6_14_1": ("nectarine_6_4_14", "peach_23_03_14"), "peach_23_03_14": ("nectarine_6_4_14", "nectarine_30_6_14_1"),
}  # fmt: skip
"""Digitised trees, and others of the species."""
NAMES = (*RECIPES, *DIGITISED)
SEEDS = (101, 102, 103)


@dataclass(frozen=True, eq=False)
class Model:
    """A known tree, the middle of its surface's extent over the origin, and others of its kind."""

    name: str
    tree: TreeSkeleton
    mesh: object
    others: tuple[TreeSkeleton, ...]

    def write(self, path: Path) -> Path:
        """Its surface as GLB."""
        write_glb(path, [self.mesh])
        return path


def model(name: str) -> Model:
    """One of `NAMES`."""
    tree, others = _grown(name) if name in RECIPES else _digitised(name)
    mesh = wood_mesh(tree, bark="oak", key=root_key(0), wood="tubes")
    shift = footing(np.asarray(mesh.position, float))
    tree = tree.replace(tip=tree.tip - shift)
    return Model(name, tree, wood_mesh(tree, bark="oak", key=root_key(0), wood="tubes"), others)


def _grown(name: str):
    recipe = read_recipe(recipe_folder() / f"{name}.toml")

    def bare(seed: int) -> TreeSkeleton:
        whole = grow(recipe, seed)
        return _by_thickness(whole.select(whole.order <= RECIPES[name]))

    return bare(recipe.seed), tuple(bare(seed) for seed in SEEDS)


def _digitised(name: str):
    tree = read_npz(MEASURED / f"{name}.npz")
    others = [read_npz(MEASURED / f"{other}.npz") for other in DIGITISED[name]]
    return tree, tuple(_as_high(other, tree.height) for other in others)


def _by_thickness(tree: TreeSkeleton) -> TreeSkeleton:
    limb, order = limbs(tree.parent, tree.tip, tree.radius)
    return tree.replace(limb=limb, order=order)


def _as_high(tree: TreeSkeleton, height: float) -> TreeSkeleton:
    by = height / tree.height
    return tree.replace(tip=by * tree.tip, radius=by * tree.radius)
