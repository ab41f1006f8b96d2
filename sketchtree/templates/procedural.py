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

import numpy as np

from sketchtree.axes import NULL
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.draws import Draws, limb_stream_id
from sketchtree.templates.headings import lateral, side, tropism, turn, unit, UP
from sketchtree.templates.pipes import pipe_radii
from sketchtree.templates.recipe import Recipe

GROUND = 0.15  # metres; hanging twigs stop here
MAX_SEGMENTS = 20_000  # a recipe that grows more is refused


@dataclass(frozen=True, eq=False)
class Bud:
    """Where a limb will start."""

    row: int  # of the parent's tip
    heading: np.ndarray  # unit
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


def _too_many(recipe: Recipe):
    from sketchtree.errors import TemplateError

    return TemplateError(
        f"Recipe {recipe.name}: it grows more than {MAX_SEGMENTS} segments.",
        remedy="Use longer segments, wider spacing, smaller ratios or fewer levels.",
    )


def _stem(recipe: Recipe, rows: _Rows, stem: int, seed: int) -> Bud:
    crown, table = recipe.crown, recipe.level(0)
    draws = Draws(seed, limb_stream_id(0, stem))
    rank = stem / max(1.0, crown.stems - 1)
    azimuth = np.radians(137.5 * stem) + draws.normal(0.3) if crown.stems > 1 else draws.between(0, 2 * np.pi)
    out = np.array([np.cos(azimuth), 0.0, np.sin(azimuth)])
    base = rows.add(NULL, out * crown.stem_ring * np.sqrt(rank), 0, stem)
    heading = unit(UP + out * np.tan(np.radians(crown.stem_lean(rank))))
    length = float(table.ratio(rank)) * crown.height * draws.log_normal(table.ratio_sd)
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
        table, bud, rows = self.table, self.bud, self.rows
        at, heading, row, gone, node_at = np.array(rows.tip[bud.row]), bud.heading, bud.row, 0.0, -np.inf
        steps = max(1, round(bud.length * (1 - bud.place) / table.segment))
        step = bud.length * (1 - bud.place) / steps
        fork_places = [] if table.forks is None else [k for k in table.forks.knots if k[0] > bud.place + 1e-6]
        nodes, forks, inside = [], [], self._inside(at)
        for index in range(steps):
            share = bud.place + (index + 0.5) * step / bud.length
            heading = turn(heading, unit(lateral(heading, np.pi / 2, self.draws.between(0, 2 * np.pi))),
                           np.radians(abs(self.draws.normal(table.bend)))) if index else heading  # fmt: skip
            heading = tropism(heading, np.radians(float(table.tropism(share)) * step))
            nxt = at + step * heading
            now_inside = self._inside(nxt)
            if index and ((nxt[1] < min(GROUND, at[1])) or (table.clip and inside and not now_inside)):
                break
            inside = inside or now_inside
            at, gone = nxt, gone + step
            row = rows.add(row, at, bud.order, self.limb)
            share = bud.place + gone / bud.length
            while fork_places and share >= fork_places[0][0]:
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
        axes = [np.radians(self.azimuth + 360.0 * k / whorl + self.draws.normal(table.azimuth_sd)) for k in range(whorl)]
        nodes.extend((row, heading, gone, azimuth) for azimuth in axes)
        if table.deflect and whorl == 1 and not last:
            away = lateral(heading, np.pi / 2, axes[0])
            return unit(heading * np.cos(np.radians(table.deflect)) - away * np.sin(np.radians(table.deflect)))
        return heading

    def _lateral(self, node, grown: float, rank: int) -> Bud | None:
        row, heading, gone, azimuth = node
        bud, own = self.bud, self.table
        if bud.level + 1 >= self.recipe.crown.levels:
            return None
        stream = limb_stream_id(bud.id, rank)
        draws = Draws(self.seed, stream)
        table = self.recipe.level(bud.level + 1)
        place = bud.place + (1 - bud.place) * gone / max(grown, 1e-9)
        span = max(own.end - own.bare, 1e-9)
        along = float(np.clip((place - own.bare) / span, 0, 1))
        if draws.uniform() < own.shed(along):
            return None
        divergence = np.radians(max(1.0, float(table.angle(along)) + draws.normal(table.angle_sd)))
        direction = lateral(heading, divergence, azimuth)
        if direction[1] < heading[1] - 0.15 and draws.uniform() < own.shed_below:
            return None
        parent_length = grown / (1 - bud.place)
        length = float(table.ratio(along)) * parent_length * draws.log_normal(table.ratio_sd)
        length = min(length, table.longest * draws.log_normal(table.ratio_sd))
        if length < 0.5 * table.segment:
            return None
        return Bud(row, direction, bud.level + 1, bud.order + 1, length, stream, draws)

    def _fork(self, row, heading, share, count, rank):
        """`count` limbs of this limb's kind go on from here, this one among them."""
        start, angle = self.draws.between(0, 2 * np.pi), np.radians(self.table.fork_angle / 2)
        own = lateral(heading, angle, start)
        more = []
        for k in range(1, count):
            azimuth = start + 2 * np.pi * k / count + self.draws.normal(0.15)
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
        return bool(np.hypot(at[0], at[2]) <= self.reach * envelope(level))
