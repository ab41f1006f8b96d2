"""How thick is the wood, everywhere?

The pipe model (Shinozaki et al. 1964): every leaf is fed by one pipe that runs down to the ground, and
the wood at any place is the bundle of the pipes that pass it. With exponent n (Murray's law, n = 2 … 3),

    r^n = Σ_c r_c^n                 at a fork: r below it, r_c where each child leaves it
    r(s)^n = ρ^n (N(s) + λ L(s))    anywhere: N tips and L metres of wood stand beyond s

    ρ   radius of one twig                                  `habit.twig_radius`
    n   exponent of the pipe model                          `habit.pipe_exponent`
    λ   pipes a metre: the twigs that no row stands for     from r(ground) = `habit.trunk_ratio` × height

Both ends are met: twigs are as thin as twigs and the trunk as thick as its species', however many or few
rows the tree has, and wood without branches tapers gently because leaves were fed along it. Where
more tips stand than the trunk has pipes, λ is 0 and n grows until they fit. Palms thicken no further
(monocots have no cambium): their trunk is nearly a cylinder and their fronds thin, whatever they carry.

A tip that is still growing may count for part of a pipe (`tip_weight`), and wood that was a tip until it bore for the rest;
nothing is thinner than one pipe, so that radii change as smoothly as the tree grows.

Radii that were drawn are honoured; the model fills in between them. A stroke of one width all along says how thick the
wood is where it starts, not that it ends like a pipe: it tapers from there to a twig. A hairline is no measure of wood:
nothing is thinner than a twig, nor than `_LEAST` of what the model says it takes to carry what stands beyond.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Bool, Float, Key

from sketchtree.errors import OptionError
from sketchtree.parameters import Habit
from sketchtree.roots import root_radius, without_roots
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import generations, is_tip, sum_to_root

_PALM_TAPER = 0.18  # how much thinner a palm's trunk is at its head
_LEAST = 1.0 / 3.0  # drawn wood is at least this share of the model's radius
_ONE_WIDTH = 1.1  # widths that differ by less than this factor count as one
_FROND_BASE = 3.0  # radius of a frond's foot / radius of its tip


@dataclass(frozen=True, eq=False)
class PipeRadii:
    """A stage that fills in the `radius` column. Nothing else of the tree changes.

    Afterwards no row is thicker than its parent. Without drawn radii, the stem of each tree that carries the most
    wood has the radius trunk_ratio × height at the ground.
    """

    habit: Habit
    drawn_radius: Float[np.ndarray, " segment"] | None = None  # metres at the tip, > 0; NaN where nothing was drawn
    tip_weight: Float[np.ndarray, " segment"] | None = None  # pipes that start in each row, ≥ 0; None: one in every tip

    def __call__(self, tree: TreeSkeleton, *, key: Key[Array, ""] | None = None) -> TreeSkeleton:
        """The tree with new radii. `key` is part of the stage's door; nothing here is random."""
        if len(tree) == 0:
            return tree
        drawn = None if self.drawn_radius is None else _checked(self.drawn_radius, len(tree))
        above, rows = without_roots(tree)
        weight = None if self.tip_weight is None else self.tip_weight[rows]
        radius, start = pipe_radii(above, self.habit, weight)
        if drawn is not None:
            radius = honour_drawn(above, radius, start, drawn[rows], self.habit.twig_radius)
        full = np.ones(len(tree))
        full[rows] = radius
        return tree.replace(radius=root_radius(tree, full, drawn, self.habit.twig_radius))


def pipe_radii(
    tree: TreeSkeleton, habit: Habit, tip_weight: Float[np.ndarray, " segment"] | None = None
) -> tuple[Float[np.ndarray, " segment"], Float[np.ndarray, " segment"]]:
    """Radius by the pipe model at the tip and at the start of every segment, metres."""
    tips = sum_to_root(tree.parent, is_tip(tree.parent).astype(float) if tip_weight is None else tip_weight)
    beyond = sum_to_root(tree.parent, tree.length) - tree.length  # metres of wood past each tip
    at_tip, at_start = np.empty(len(tree)), np.empty(len(tree))
    for name in np.unique(tree.tree):
        rows = np.flatnonzero(tree.tree == name)
        bases = rows[tree.is_base[rows]]
        stem = bases[np.argmax(beyond[bases])]
        ground = max(habit.trunk_ratio * _extent(tree, rows), 1.01 * habit.twig_radius)
        for radius, wood in ((at_tip, beyond), (at_start, beyond + tree.length)):
            radius[rows] = _one_tree(tips[rows], wood[rows], tips[stem], beyond[stem], ground, habit)
            if habit.leaf_arrangement == "frond":
                radius[rows] = _palm(tree, rows, ground, wood[rows], beyond[rows], habit)
    return at_tip, at_start


def _one_tree(tips, wood, stem_tips: float, stem_wood: float, ground: float, habit: Habit):
    """ρ (N + λ L)^(1/n), with λ, or else n, from the radius at the ground."""
    twig, exponent = habit.twig_radius, habit.pipe_exponent
    pipes = (ground / twig) ** exponent
    if pipes < stem_tips:
        exponent = np.log(stem_tips) / np.log(ground / twig)
        pipes = stem_tips
    per_metre = (pipes - stem_tips) / stem_wood if stem_wood > 0 else 0.0
    return twig * np.maximum(tips + per_metre * wood, 1.0) ** (1.0 / exponent)


def _palm(tree: TreeSkeleton, rows, ground: float, wood, beyond, habit: Habit):
    """A nearly cylindrical trunk up to its last frond; fronds from a slim foot to a twig's tip."""
    y = tree.tip[rows, 1]
    trunk = ~is_frond(tree)[rows]
    rise = (y - y.min()) / max(np.ptp(y[trunk]) if trunk.any() else 1.0, 1e-9)
    stem = ground * (1.0 - _PALM_TAPER * np.clip(rise, 0.0, 1.0))
    longest = max(beyond[~trunk].max(initial=0.0), 1e-9)
    frond = habit.twig_radius * (1.0 + (_FROND_BASE - 1.0) * np.minimum(wood / longest, 1.0))
    radius = np.where(trunk, stem, np.minimum(frond, 0.5 * ground * (1.0 - _PALM_TAPER)))
    return never_thicker(tree.parent, _scatter(len(tree), rows, radius))[rows]


def is_frond(tree: TreeSkeleton) -> Bool[np.ndarray, " segment"]:
    """Rows of a palm that are midribs of fronds: all laterals, and what carries the trunk's limb on above the last of them."""
    fronds = sum_to_root(tree.parent, (tree.order > 0).astype(float))
    most = np.zeros(len(tree))
    for name in np.unique(tree.tree):
        most[tree.tree == name] = fronds[tree.tree == name].max()
    return (tree.order > 0) | ((fronds == 0) & (most > 0) & ~tree.is_base)


def honour_drawn(
    tree: TreeSkeleton,
    model: Float[np.ndarray, " segment"],
    model_start: Float[np.ndarray, " segment"],
    drawn: Float[np.ndarray, " segment"],
    twig: float,
) -> Float[np.ndarray, " segment"]:
    """Drawn radii where there are any (NaN: none), the model's elsewhere, never growing towards the tips.

    From a place of drawn radius a (where the model says m) on towards the twigs, r = ρ (r_model / ρ)^γ with γ such
    that m becomes a: the place keeps its width and twigs stay twigs. Where one stroke's radii along a limb differ by
    less than a tenth, that place is where the stroke starts; else every drawn row is one. A drawn radius below
    max(ρ, m / 3) counts as that: no row of the result is thinner.
    """
    if np.isnan(drawn).all():
        return model
    parent = tree.parent
    even, foot = _evenly_drawn(tree, drawn)
    least = np.maximum(_LEAST * np.where(foot, model_start, model), twig)
    drawn = np.where(np.isnan(drawn), np.nan, np.maximum(drawn, least))
    pinned = np.where(even, np.nan, drawn)
    pinned[tree.is_base] = _drawn_bases(parent, model, drawn)[tree.is_base]
    needed = _needed(parent, pinned, np.where(foot, drawn, np.nan))
    radius, anchor, anchor_model = pinned.copy(), pinned.copy(), model.copy()
    for rows in generations(parent)[1:]:
        above = parent[rows]
        starts = foot[rows]
        anchor[rows] = np.where(starts, np.minimum(drawn[rows], radius[above]), anchor[above])
        anchor_model[rows] = np.where(starts, model_start[rows], anchor_model[above])
        filled = _between(model[rows], anchor[rows], anchor_model[rows], twig)
        free = np.isnan(pinned[rows])
        filled = np.maximum(filled, np.maximum(needed[rows], np.maximum(_LEAST * model[rows], twig)))
        radius[rows] = np.minimum(np.where(free, filled, pinned[rows]), radius[above])
        held = rows[~free]
        anchor[held], anchor_model[held] = radius[held], model[held]
    return radius


def _evenly_drawn(tree: TreeSkeleton, drawn):
    """Rows drawn by a stroke of one width all along its limb, and which of them is the first of such a stretch."""
    known = np.flatnonzero(~np.isnan(drawn) & ~tree.is_base)
    stretch = np.stack([tree.limb[known], tree.stroke[known]], axis=1)
    _, first, index = np.unique(stretch, axis=0, return_index=True, return_inverse=True)
    index = index.reshape(-1)
    low, high = np.full(len(first), np.inf), np.zeros(len(first))
    np.minimum.at(low, index, drawn[known])
    np.maximum.at(high, index, drawn[known])
    is_even = high <= _ONE_WIDTH * low
    even, foot = np.zeros(len(drawn), bool), np.zeros(len(drawn), bool)
    even[known] = is_even[index]
    foot[known[first[is_even]]] = True
    return even, foot


def _needed(parent, pinned, at_foot):
    """The least radius of every row that lets all drawn wood beyond it keep its width."""
    most = np.nan_to_num(pinned, nan=0.0)
    for rows in reversed(generations(parent)[1:]):
        np.maximum.at(most, parent[rows], np.fmax(most[rows], at_foot[rows]))
    return most


def never_thicker(parent, radius):
    """The radii with every row cut down to its parent's."""
    radius = np.array(radius, float)
    for rows in generations(parent)[1:]:
        radius[rows] = np.minimum(radius[rows], radius[parent[rows]])
    return radius


def _between(model, anchor, anchor_model, twig: float):
    span = np.log(np.maximum(anchor_model, 1.001 * twig) / twig)
    gamma = np.log(np.maximum(anchor, 1.001 * twig) / twig) / span
    return twig * np.maximum(model / twig, 1.0) ** gamma


def _drawn_bases(parent, model, drawn):
    """Every base gets a drawn radius: its own, or the model's scaled as its thickest drawn row was."""
    drawn = drawn.copy()
    stem = np.arange(len(parent))
    for rows in generations(parent)[1:]:
        stem[rows] = stem[parent[rows]]
    known = np.flatnonzero(~np.isnan(drawn))
    known = known[np.argsort(-model[known], kind="stable")]
    stems, first = np.unique(stem[known], return_index=True)
    thickest = dict(zip(stems.tolist(), known[first].tolist(), strict=True))
    for base in np.flatnonzero((parent < 0) & np.isnan(drawn)):
        row = thickest.get(int(base))
        scaled = model[base] if row is None else drawn[row] * np.clip(model[base] / model[row], 1.0, 1.5)
        drawn[base] = max(scaled, _LEAST * model[base])
    return drawn


def _extent(tree: TreeSkeleton, rows) -> float:
    """Height of one tree; the longest side of its box where it hardly rises (a creeping stem)."""
    points = tree.tip[rows]
    foot = points[tree.is_base[rows], 1].min()
    return float(max(points[:, 1].max() - foot, 0.25 * np.ptp(points, axis=0).max()))


def _scatter(size: int, rows, value):
    full = np.full(size, np.inf)
    full[rows] = value
    return full


def _checked(drawn, rows: int):
    drawn = np.asarray(drawn, float)
    if drawn.shape != (rows,):
        raise OptionError(
            f"`drawn_radius` has shape {drawn.shape}, but the tree has {rows} rows.",
            remedy="Give one radius per row, NaN where nothing was drawn.",
        )
    if (drawn <= 0).any() or np.isinf(drawn).any():
        row = int(np.flatnonzero((drawn <= 0) | np.isinf(drawn))[0])
        raise OptionError(
            f"The drawn radius of row {row} is {drawn[row]:g}, which is not a positive length.",
            remedy="Give metres above zero, NaN where nothing was drawn.",
        )
    return drawn

