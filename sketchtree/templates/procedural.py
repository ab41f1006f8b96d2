"""What tree does a recipe describe? The procedural generator of exemplars.

Limbs are grown level by level, each from its insertion to its tip in steps of one segment:

    heading ← tropism(turn away from the lateral just borne(turn by N(0, bend)(heading)))

until the limb has its length, leaves the crown's envelope or reaches the ground. Nodes along it bear
laterals (single or in whorls, azimuths by phyllotaxis) whose length and divergence depend on their
place u ∈ [0, 1] along the limb: falling `ratio` is apical control of an excurrent tree, rising that
of a decurrent one. At a fork the limb goes on as two or more of its own kind, so that trunks
dissolve into limbs. All numbers come from the recipe; the same recipe and seed give the same tree.
"""

from collections import deque
from dataclasses import dataclass
from math import cos, hypot, inf, pi, radians, sin, sqrt, tan

import numpy as np

from sketchtree.axes import NULL
from sketchtree.errors import TemplateError
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.draws import Draws, limb_stream_id
from sketchtree.templates.headings import UP, Vector, along, bend, lateral, tropism, unit
from sketchtree.templates.pipes import pipe_radii
from sketchtree.templates.recipe import Recipe

GROUND = 0.15  # metres; hanging twigs stop here
MAX_SEGMENTS = 20_000  # a recipe that grows more is refused


@dataclass(frozen=True, eq=False)
class Bud:
    """Where a limb will start."""

    row: int  # of the parent's tip
    heading: Vector  # unit
    level: int  # of its recipe table
    order: int  # branching order
    length: float  # metres
    id: int  # of its random stream
    draws: Draws
    place: float = 0.0  # share of the length a fork's branch has behind it


class _Rows:
    """The skeleton's columns while it grows."""

    def __init__(self):
        self.parent, self.tip, self.order, self.limb = [], [], [], []

    def add(self, parent: int, tip, order: int, limb: int) -> int:
        self.parent.append(parent)
        self.tip.append(tip)
        self.order.append(order)
        self.limb.append(limb)
        return len(self.parent) - 1


def grow(recipe: Recipe, seed: int | None = None) -> TreeSkeleton:
    """The exemplar's skeleton: metres, y up, the (first) stem's base near the origin."""
    seed = recipe.seed if seed is None else seed
    rows, buds = _Rows(), deque()
    for stem in range(int(recipe.crown.stems)):
        buds.append(_stem(recipe, rows, stem, seed))
    limb = 0
    while buds:
        bud = buds.popleft()
        buds.extend(_Limb(recipe, rows, bud, seed, limb).grow())
        limb += 1
        if len(rows.parent) > MAX_SEGMENTS:
            raise _too_many(recipe)
    tree = TreeSkeleton.from_columns(
        np.array(rows.parent), np.array(rows.tip), np.ones(len(rows.parent)),
        order=np.array(rows.order), limb=np.array(rows.limb),
    )  # fmt: skip
    return tree.replace(radius=pipe_radii(tree, recipe.habit))


def _too_many(recipe: Recipe) -> TemplateError:
    return TemplateError(
        f"Recipe {recipe.name}: it grows more than {MAX_SEGMENTS} segments.",
        remedy="Use longer segments, wider spacing, smaller ratios or fewer levels.",
    )


def _stem(recipe: Recipe, rows: _Rows, stem: int, seed: int) -> Bud:
    crown, table = recipe.crown, recipe.level(0)
    draws = Draws(seed, limb_stream_id(0, stem))
    rank = stem / max(1.0, crown.stems - 1)
    azimuth = radians(137.5 * stem) + draws.normal(0.3) if crown.stems > 1 else draws.between(0, 2 * pi)
    out = (cos(azimuth), 0.0, sin(azimuth))
    base = rows.add(NULL, along((0.0, 0.0, 0.0), crown.stem_ring * sqrt(rank), out), 0, stem)
    heading = unit(along(UP, tan(radians(crown.stem_lean(rank))), out))
    length = table.ratio(rank) * crown.height * draws.log_normal(table.ratio_sd)
    return Bud(base, heading, 0, 0, length, limb_stream_id(0, stem), draws)


class _Limb:
    """One limb while it grows."""

    def __init__(self, recipe: Recipe, rows: _Rows, bud: Bud, seed: int, limb: int):
        self.recipe, self.rows, self.bud, self.seed, self.limb = recipe, rows, bud, seed, limb
        self.draws = bud.draws
        self.table = recipe.level(bud.level)
        self.reach = self.draws.log_normal(recipe.crown.outline_sd)  # of the envelope: outlines are not turned on a lathe
        self.azimuth = 0.0 if self.table.planar else self.draws.between(0, 360)

    def grow(self) -> list[Bud]:
        """Adds the limb's rows; returns the buds of its laterals and forks."""
        nodes, forks = self._trace()
        if not nodes:
            return []
        grown = nodes[-1][2]
        buds = [self._lateral(node, grown, rank) for rank, node in enumerate(n for n in nodes if n[3] is not None)]
        return [bud for bud in buds if bud is not None] + forks

    def _trace(self):
        """Steps along the limb. Nodes: (row, heading, metres from the base, azimuth of a lateral or None)."""
        table, bud, rows, draws = self.table, self.bud, self.rows, self.draws
        at, heading, row, gone, node_at = rows.tip[bud.row], bud.heading, bud.row, 0.0, -inf
        ahead = bud.length * (1 - bud.place)
        steps = max(1, round(ahead / table.segment))
        step = ahead / steps
        fork_places = [] if table.forks is None else [k for k in table.forks.knots if k[0] > bud.place + 1e-6]
        nodes, forks, inside = [], [], self._inside(at)
        for index in range(steps):
            share = bud.place + (index + 0.5) * step / bud.length
            if index:
                azimuth = draws.between(0, 2 * pi)
                heading = bend(heading, radians(abs(draws.normal(table.bend))), azimuth)
            heading = tropism(heading, radians(table.tropism(share) * step))
            reached = along(at, step, heading)
            now_inside = self._inside(reached)
            if reached[1] < min(GROUND, at[1]) or (index and table.clip and inside and not now_inside):
                break
            inside = inside or now_inside
            at, gone = reached, gone + step
            row = rows.add(row, at, bud.order, self.limb)
            share = bud.place + gone / bud.length
            while index < steps - 1 and fork_places and share >= fork_places[0][0]:
                heading, more = self._fork(row, heading, share, int(fork_places.pop(0)[1]), len(forks))
                forks.extend(more)
            if table.bare <= share <= table.end and gone - node_at >= table.spacing * 0.99:
                node_at = gone
                heading = self._node(nodes, row, heading, gone, index == steps - 1)
            else:
                nodes.append((row, heading, gone, None))
        return nodes, forks

    def _node(self, nodes, row, heading, gone, last):
        """The laterals of one node; the limb's heading after it has turned away from them."""
        table = self.table
        self.azimuth += table.phyllotaxis
        whorl = int(table.whorl)
        axes = [radians(self.azimuth + 360.0 * k / whorl + self.draws.normal(table.azimuth_sd)) for k in range(whorl)]
        nodes.extend((row, heading, gone, azimuth) for azimuth in axes)
        if table.deflect and whorl == 1 and not last:
            return lateral(heading, radians(table.deflect), axes[0] + pi)
        return heading

    def _lateral(self, node, grown: float, rank: int) -> Bud | None:
        row, heading, gone, azimuth = node
        bud, own = self.bud, self.table
        if bud.level + 1 >= self.recipe.crown.levels:
            return None
        stream = limb_stream_id(bud.id, rank)
        draws = Draws(self.seed, stream)
        table = self.recipe.level(bud.level + 1)
        share = bud.place + (1 - bud.place) * gone / grown
        place = min(max((share - own.bare) / max(own.end - own.bare, 1e-9), 0.0), 1.0)
        if draws.uniform() < own.shed(place):
            return None
        divergence = radians(max(1.0, table.angle(place) + draws.normal(table.angle_sd)))
        direction = lateral(heading, divergence, azimuth)
        if direction[1] < heading[1] - 0.15 and draws.uniform() < own.shed_below:
            return None
        parent_length = grown / (1 - bud.place)
        length = table.ratio(place) * parent_length * draws.log_normal(table.ratio_sd)
        length = min(length, table.longest * draws.log_normal(table.ratio_sd))
        if length < 0.5 * table.segment:
            return None
        return Bud(row, direction, bud.level + 1, bud.order + 1, length, stream, draws)

    def _fork(self, row, heading, share, count, rank):
        """`count` limbs of this limb's kind go on from here, this one among them."""
        start, angle = self.draws.between(0, 2 * pi), radians(self.table.fork_angle / 2)
        own = lateral(heading, angle, start)
        more = []
        for k in range(1, count):
            azimuth = start + 2 * pi * k / count + self.draws.normal(0.15)
            way = lateral(heading, angle * self.draws.between(0.8, 1.25), azimuth)
            length = self.bud.length * self.draws.between(0.85, 1.05)
            stream = limb_stream_id(self.bud.id, 10_000 + 100 * rank + k)
            more.append(Bud(row, way, self.bud.level, self.bud.order + 1, length, stream, Draws(self.seed, stream), share))
        return own, more

    def _inside(self, at) -> bool:
        envelope, height = self.recipe.crown.envelope, self.recipe.crown.height
        level = at[1] / (height * self.reach)
        if len(envelope.knots) > 1 and not envelope.knots[0][0] <= level <= envelope.knots[-1][0]:
            return False
        return hypot(at[0], at[2]) <= self.reach * envelope(level)
