"""Where do a tree's blossoms stand in spring? At the ends of its twigs and short shoots, among the young leaves; a redbud's all along its old wood.

The same buds that unfold the leaves are asked, so each blossom ends a stem that is there. Which ends bear one is drawn by bud: a
new limb leaves the others' blossoms as they were.
"""

from dataclasses import replace

import numpy as np
from jaxtyping import Array, Key

from sketchtree import keys
from sketchtree.foliage.buds import Buds, stem_nodes
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.models import leaf_model
from sketchtree.foliage.populate import all_buds, capped, unfold
from sketchtree.foliage.seasons import check_season
from sketchtree.foliage.twigs import wood_pieces
from sketchtree.foliage.wear import Wear, enlargement, wear_of
from sketchtree.parameters import Habit
from sketchtree.roots import without_roots
from sketchtree.skeleton import TreeSkeleton
from sketchtree.watch import Pulse, no_pulse

_BEARS, _TURNED = 30, 31  # the draws of a bud
_YOUNGEST, _OLDEST = 0.9, 14.0  # twig radii, of wood that is no longer young and not yet too old to flower


def blossom(
    tree: TreeSkeleton, habit: Habit, *, key: Key[Array, ""], model: str | None = None, season: str = "summer", most: int = 12_000,
    pulse: Pulse = no_pulse,
) -> Leaves | None:
    """The blossoms of a tree that wears the leaf `model` (the habit's own by default), at most `most`; None out of spring and where its
    species has none. Raises OptionError."""
    check_season(season)
    wear = wear_of(habit, model)
    tree, _ = without_roots(tree)
    if season != "spring" or wear.model.blossom is None or tree.segment_count == 0:
        return None
    flower = leaf_model(wear.model.blossom)
    stand = _on_old_wood(tree, habit, wear, flower.spacing, key, pulse) if wear.model.blossom_on == "old wood" else _at_ends(tree, habit, wear, key, pulse)
    pulse()
    stand = stand.select(keys.uniform(key, stand.id, _BEARS) < wear.model.blossom_share)
    worn = Wear(flower, flower.arrangement, flower.size * enlargement(habit), flower.spacing, wear.phyllotaxis, 1)
    found = capped(unfold(tree, stand, np.zeros((0, 2, 3)), worn, season, key), np.full(len(stand), -1), stand.id, most, key)
    return found if len(found) else None


def _at_ends(tree: TreeSkeleton, habit: Habit, wear: Wear, key, pulse: Pulse) -> Buds:
    """The last nodes of twigs and short shoots."""
    stand, _ = all_buds(tree, habit, wear, key, pulse)
    return _one_a_node(stand.select(stand.node < wear.model.blossom_nodes))


def _on_old_wood(tree: TreeSkeleton, habit: Habit, wear: Wear, spacing: float, key, pulse: Pulse) -> Buds:
    """Places all along limbs that are older than this year's, to all sides."""
    pieces = wood_pieces(tree, pulse)
    thick = pieces.end_radius / habit.twig_radius
    old = pieces.select((thick > _YOUNGEST) & (thick < _OLDEST) & (pieces.length > 1e-9))
    nodes = stem_nodes(old, tree.limb, replace(wear, spacing=spacing), key)
    return replace(nodes, azimuth=2 * np.pi * keys.uniform(key, nodes.id, _TURNED), node=nodes.node + 1)


def _one_a_node(stand: Buds) -> Buds:
    """The first bud of every node."""
    _, first = np.unique(np.round(stand.foot, 9), axis=0, return_index=True)
    return stand.select(np.sort(first))
