"""Where does old wood bear leaves after all? Where it is bare and light falls on it.

Thick limbs bear no leaves of their own, and twigs are seldom wherever a limb is drawn thick up to its end or runs out of the crown. There
dormant buds wake (epicormic or water shoots: light on the bark releases them; Meier, Saunders and Michler 2012, Tree Physiology 32). Of the
nodes of old wood, those stay that have no leaf within `APART` lengths of a shoot, and of these each with probability

    P(shoot) = I        the share of the open sky's light there (`crown_light`)

so that the inside of a full crown stays as bare as it is. A shoot is as long as a twig of its species. Trunks bear none, nor do the ends of
limbs that were sawn off, needles and palms, and trees without a leaf elsewhere.
"""

from dataclasses import replace

import numpy as np
from jaxtyping import Array, Bool, Float, Int, Key
from scipy.spatial import cKDTree

from sketchtree import keys
from sketchtree.foliage.buds import STRETCH, Buds, short_shoots, spread, stem_nodes
from sketchtree.foliage.crown_light import light_at
from sketchtree.foliage.twigs import THICKEST, Twigs
from sketchtree.foliage.wear import Wear
from sketchtree.parameters import Habit

APART = 0.4  # lengths of a shoot from where other leaves start
_OUTER = 0.55  # share of a limb that may bear shoots, from its tip
_BOUGH = 60.0  # twig radii: thicker wood is bare
_EVERY = 0.11  # metres between shoots, about
_WAKES = 24  # the draw of a node


def water_shoots(
    pieces: Twigs, order: Int[np.ndarray, " segment"], limb: Int[np.ndarray, " segment"], borne: Buds, wear: Wear, habit: Habit, key: Key[Array, ""]
) -> tuple[Buds, Float[np.ndarray, "shoot 2 3"]]:
    """The buds on water shoots (each bud names its shoot) and the shoots, start and end, metres. `pieces` are all wood, `borne` the
    buds that stand anyway."""
    length = 1.2 * habit.twig_length
    model = replace(wear.model, spur=max(2, round(length / (STRETCH * wear.spacing))), every=max(1, round(_EVERY / wear.spacing)))
    wear = replace(wear, model=model)
    able = wear.model.is_blade and wear.arrangement != "frond" and len(borne) > 0
    old = pieces.select(_bare(pieces, order, habit) & able)
    nodes = stem_nodes(old, limb, wear, key)
    nodes = nodes.select((nodes.node % model.every == 0) & (nodes.along > 1 - _OUTER))
    if len(nodes):
        nodes = nodes.select(cKDTree(borne.foot, balanced_tree=False, compact_nodes=False).query(nodes.foot, distance_upper_bound=APART * length)[0] > APART * length)
        nodes = nodes.select(keys.uniform(key, nodes.id, _WAKES) < light_at(nodes.foot, borne.foot, wear.size))
    stems, shoots = short_shoots(nodes, wear, key, longest=length)
    return spread(stems, wear), shoots


def _bare(pieces: Twigs, order, habit: Habit) -> Bool[np.ndarray, " piece"]:
    """The wood of limbs that is too thick for leaves, but not as thick as the boughs that carry the crown; no limb's last row."""
    last = np.zeros(len(order), bool)
    last[pieces.row[pieces.to_tip < 1e-9]] = True
    thick = (pieces.end_radius > THICKEST * habit.twig_radius) & (pieces.end_radius <= _BOUGH * habit.twig_radius)
    return thick & ~last[pieces.row] & (order[pieces.row] > 0) & (pieces.length > 1e-9)
