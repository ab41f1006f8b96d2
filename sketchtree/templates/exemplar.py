"""What does the database keep of one tree? Its skeleton and all that is measured on it.

Chen et al. 2008, §7: every exemplar carries its global parameters Θ, silhouettes and branching statistics
under V views, and a leaf. Beyond the paper: Θ per order, limb statistics, posture, habit, thumbnail.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, UInt8

from sketchtree.parameters import Habit, LimbStatistics, TreeParameters
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.seen.branching import Branching, branching
from sketchtree.drawable import drawable
from sketchtree.templates.seen.drawing import Drawing
from sketchtree.templates.estimate import estimate, estimate_by_order
from sketchtree.templates.seen.footprint import crown_points, footprint, project, view_azimuths
from sketchtree.templates.limb_statistics import limb_statistics
from sketchtree.templates.seen.posture import posture
from sketchtree.templates.seen.thumbnail import thumbnail


@dataclass(frozen=True, eq=False)
class Views:
    """What is seen of one exemplar, or of many (a leading exemplar axis), from every azimuth."""

    footprint: Float[np.ndarray, "*exemplar view direction"]
    branching: Branching
    posture: Float[np.ndarray, "*exemplar view feature"]


@dataclass(frozen=True, eq=False)
class Exemplar:
    """One tree of the database."""

    name: str
    title: str
    theta: TreeParameters  # of the whole tree
    theta_order: tuple[TreeParameters, ...]  # of pairs whose parent is of order 0, 1, 2+
    limbs: LimbStatistics
    habit: Habit
    skeleton: TreeSkeleton  # world metres, root at the origin
    thumbnail: UInt8[np.ndarray, "row column"]  # 255 paper, 0 wood
    recipe: str  # text of its recipe; "" a digitised tree
    source: str  # where the recipe's figures come from, or the tree itself
    seed: int
    version: str  # of the program that grew or imported it
    species: str = ""  # botanical name; "" not said
    growth_habit: str = ""  # one of recipe.GROWTH_HABITS; "" not said


def views_of(tree: TreeSkeleton) -> Views:
    """Footprint (of the whole tree), branching and posture (of what a person would draw) under all views."""
    azimuth = view_azimuths()
    outline = crown_points(tree.start, tree.tip, tree.parent)
    drawing = Drawing.of_skeleton(drawable(tree), azimuth)
    return Views(
        np.stack([footprint(project(outline, v)) for v in azimuth]), branching(drawing), posture(drawing)
    )


def measure(
    tree: TreeSkeleton, *, name: str, title: str, habit: Habit, recipe: str, source: str, seed: int, version: str,
    species: str = "", growth_habit: str = "",
) -> tuple[Exemplar, Views]:  # fmt: skip
    """The exemplar of a skeleton. Positions and radii are first rounded to what the database stores."""
    tree = tree.replace(tip=tree.tip.astype(np.float32), radius=tree.radius.astype(np.float32))
    exemplar = Exemplar(
        name=name, title=title, theta=estimate(tree), theta_order=estimate_by_order(tree), limbs=limb_statistics(tree),
        habit=habit, skeleton=tree, thumbnail=thumbnail(tree), recipe=recipe, source=source, seed=seed, version=version,
        species=species, growth_habit=growth_habit,
    )  # fmt: skip
    return exemplar, views_of(tree)
