"""How does a branch hang under its own weight?

Each undrawn branch is an elastic rod (Euler & Bernoulli). A piece of length ℓ turns by

    θ = c M ℓ / (E I),     M = g |S × ŷ|⊥,     I = π r⁴ / 4

    S     first moment Σ_j m_j (x_j − x) of all that lies beyond, about the piece's start and its end, the mean of both
    c     `strength`: 1 as physics says, 0 nothing
    ⊥     the part across the piece: the rest would twist it
    E     Young's modulus of green wood, 9 GPa (USDA Wood Handbook 2021, table 5-3: green white oak 8.6, red oak 9.3 GPa)
    ρ     1000 kg/m³, green (ibid.: specific gravity about 0.6, moisture about 70 %)

The mass of a piece is its wood and the leaves fed along it. By the pipe model (`geometry.radii`) P = (r / r_twig)^n twigs hang on
wood of radius r, also those that no row stands for; what a row i of siblings j is fed of its parent's, and its leaves, are

    p_i = P(parent) P_i / Σ_j P_j − P_i   (a tip: + P_i)        m = H π r_twig² p · 0.25 kg/m²

    H     leaf area over the wood's cross-section, 5000 (an inverse Huber value: Tyree & Ewers 1991 give 1000 to 10 000)
    0.25  kg a m² of fresh leaf: 0.08 dry (Wright et al. 2004), a third of it dry matter

From the foot of a branch to its twigs: S is turned with all that has turned before it, so that what has come to hang bends no
further. A piece turns by `_MOST` at most and neither past hanging straight down nor past where its load hangs under it. Its
chord takes half of the turn, what it bears all. Lengths stay; drawn wood, and what bears any, stays where it is.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.axes import NULL
from sketchtree.errors import OptionError
from sketchtree.parameters import Habit
from sketchtree.propagate.after.cutting import Cut, bears, cut, start_radius
from sketchtree.propagate.space.space import Space
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import generations

STRONGEST = 5.0
_GRAVITY = 9.81  # m/s²
_YOUNG = 9.0e9  # Pa
_DENSITY = 1000.0  # kg/m³
_LEAF = 0.25  # kg a m² of leaf
_LEAF_AREA = 5000.0  # H
_LEAFLETS = 0.15  # kg a metre of a palm's midrib: two leaflets 0.4 m by 0.03 m every 0.03 m
_MOST = np.radians(40.0)  # of one row
_STUMP = 0.05  # of a row: what is cut shorter at a barrier is left out


@dataclass(frozen=True)
class Sag:
    """A stage: undrawn branches bend under their weight. The tree needs its final radii (`PipeRadii`)."""

    strength: float = 1.0  # 0-5; 1: as physics says
    habit: Habit = Habit()
    space: Space = Space()  # what sags out of it, or into the ground, is cut there

    def __post_init__(self):
        if not 0 <= self.strength <= STRONGEST:
            raise OptionError(
                f"sag is {self.strength:g}, but must lie between 0 and {STRONGEST:g}.", remedy="1 is as heavy as wood is; 0 is none."
            )

    def __call__(self, tree: TreeSkeleton, *, key: Key[Array, ""] | None = None) -> TreeSkeleton:
        """The tree as it hangs. `key` is part of the stage's door; nothing here is random."""
        return self.run(tree).skeleton

    def run(self, tree: TreeSkeleton) -> Cut:
        """As the call, with the rows that are left."""
        if self.strength == 0 or len(tree) == 0:
            return Cut(tree, np.arange(len(tree)))
        moves = ~bears(tree.parent, ~np.isin(tree.kind, (int(Kind.PROPAGATED), int(Kind.GROWN)))) & ~tree.is_base
        hung = tree.replace(tip=hanging(tree, moves, self.strength, self.habit))
        return cut(hung, self._free(hung, moves))

    def _free(self, tree: TreeSkeleton, moves) -> Float[np.ndarray, " segment"]:
        """The share of every row up to a barrier or the ground."""
        share, rows = np.ones(len(tree)), np.flatnonzero(moves)
        start, end = tree.start[rows], tree.tip[rows]
        ground = tree.tip[tree.is_base, 1].min()
        binding = tuple(barrier for barrier in self.space.barriers if getattr(barrier, "binding", True))
        free = Space(binding).exit_fraction(start, end)
        sinks = (end[:, 1] < ground) & (end[:, 1] < start[:, 1])
        above = np.maximum(start[sinks, 1] - ground, 0.0)
        free[sinks] = np.minimum(free[sinks], above / (start[sinks, 1] - end[sinks, 1]))
        share[rows] = np.where(free > _STUMP, free, 0.0)
        return share


def hanging(tree: TreeSkeleton, moves, strength: float, habit: Habit) -> Float[np.ndarray, "segment 3"]:
    """The tips of all rows once those that may move have bent."""
    steps = generations(tree.parent)
    start, vector = tree.start, tree.vector
    length = np.linalg.norm(vector, axis=1)
    mass, stiffness = _rod(tree, length, habit)
    load = np.column_stack([mass[:, None] * (start + 0.5 * vector), mass])
    own = load.copy()
    for rows in reversed(steps[1:]):
        for column in range(4):
            np.add.at(load[:, column], tree.parent[rows], load[rows, column])
    beyond = load - own
    lever = 0.5 * (load[:, :3] - load[:, 3:] * start + beyond[:, :3] - beyond[:, 3:] * tree.tip)
    softness = strength * _GRAVITY * length / stiffness
    tip = np.array(tree.tip)
    turned = np.broadcast_to(np.eye(3), (len(tree), 3, 3)).copy()
    for rows in steps[1:]:
        rows = rows[moves[rows]]
        if len(rows) == 0:
            continue
        above = tree.parent[rows]
        carried = turned[above]
        chord = np.einsum("bij,bj->bi", carried, vector[rows])
        axis, angle = _bend(chord, np.einsum("bij,bj->bi", carried, lever[rows]), softness[rows])
        tip[rows] = tip[above] + np.einsum("bij,bj->bi", rotation(axis, 0.5 * angle), chord)
        turned[rows] = rotation(axis, angle) @ carried
    return tip


def _rod(tree: TreeSkeleton, length, habit: Habit):
    """(mass in kg, E I in N m²) of every row."""
    thick, thin = start_radius(tree), tree.radius
    wood = np.pi * length * (thick**2 + thick * thin + thin**2) / 3 * _DENSITY
    if habit.leaf_arrangement == "frond":
        leaves = _LEAFLETS * length
    else:
        leaves = _LEAF_AREA * np.pi * habit.twig_radius**2 * _LEAF * twigs_fed(tree, habit)
    return np.where(tree.parent == NULL, 0.0, wood + leaves), _YOUNG * np.pi / 4 * (thick * thin) ** 2


def twigs_fed(tree: TreeSkeleton, habit: Habit) -> Float[np.ndarray, " segment"]:
    """How many twigs hang on each row itself, not on what it bears, by the pipe model; none at bases."""
    pipes = (tree.radius / habit.twig_radius) ** habit.pipe_exponent
    rows = np.flatnonzero(tree.parent != NULL)
    above = tree.parent[rows]
    borne = np.bincount(above, pipes[rows], minlength=len(tree))
    fed = np.zeros(len(tree))
    fed[rows] = np.maximum(pipes[above] / borne[above] - 1.0, 0.0) * pipes[rows]
    return fed + np.where((borne == 0) & (tree.parent != NULL), pipes, 0.0)


def _bend(chord, lever, softness):
    """(unit axis, angle) by which rows with these chords turn under loads of these first moments (kg m)."""
    along = chord / np.maximum(np.linalg.norm(chord, axis=1, keepdims=True), 1e-300)
    torque = np.stack([lever[:, 2], np.zeros(len(lever)), -lever[:, 0]], axis=1)
    torque = torque - np.einsum("bi,bi->b", torque, along)[:, None] * along
    size = np.linalg.norm(torque, axis=1)
    axis = np.where((size > 0)[:, None], torque / np.where(size > 0, size, 1.0)[:, None], [1.0, 0.0, 0.0])
    ahead = np.cross(axis, along)
    hangs = np.mod(np.arctan2(ahead[:, 1], along[:, 1]) + np.pi, 2 * np.pi)
    down = -np.eye(3)[1] + axis[:, 1:2] * axis
    under = np.arctan2(np.einsum("bi,bi->b", axis, np.cross(lever, down)), np.einsum("bi,bi->b", lever, down))
    return axis, np.clip(softness * size, 0.0, np.minimum(np.minimum(hangs, np.maximum(under, 0.0)), _MOST))


def rotation(axis: Float[np.ndarray, "row 3"], angle: Float[np.ndarray, " row"]) -> Float[np.ndarray, "row 3 3"]:
    """Rodrigues: R = cos θ 1 + sin θ [a]× + (1 − cos θ) a aᵀ, for unit axes; radians."""
    x, y, z = axis.T
    zero = np.zeros(len(axis))
    cross = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=1).reshape(-1, 3, 3)
    cosine, sine = np.cos(angle)[:, None, None], np.sin(angle)[:, None, None]
    return cosine * np.eye(3) + sine * cross + (1 - cosine) * axis[:, :, None] * axis[:, None, :]
