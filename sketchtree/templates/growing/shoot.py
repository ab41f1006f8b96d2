"""Which way does one limb grow, and where does it stop? Steps of one segment from its insertion to its tip.

    heading ← wind(tropism(sway(turn by N(0, bend)(heading))))

At a node it turns away from the lateral it bears (`deflect`), or dies back and goes on as a side shoot (`sympodial`). It stops
when it has its length, where it broke, at the crown's envelope, at the ground, or where other wood leaves no room.
"""

from dataclasses import dataclass
from math import pi, radians, sin

from sketchtree.templates.growing.draws import Draws, limb_stream_id
from sketchtree.templates.growing.envelope import below, inside
from sketchtree.templates.growing.headings import Vector, along, bend, cross, lateral, level_off, towards, tropism, turn, unit
from sketchtree.templates.growing.site import Bud, Site

GROUND, GROUND_SHARE = 0.15, 0.02  # metres, and share of the height of a small tree; hanging twigs stop here
FREE = 1.5  # clearances from its insertion in which a limb is not yet in anyone's way
_SWAY, _BREAK = 20_000, 20_001  # ranks of the streams for what a recipe may leave out


@dataclass(frozen=True)
class Node:
    """A place on a grown limb; bears a lateral where `azimuth` is a number."""

    row: int
    heading: Vector
    gone: float  # metres from where the limb starts
    azimuth: float | None  # radians about the limb


@dataclass(frozen=True)
class Fork:
    """A place where the limb splits."""

    row: int
    heading: Vector  # of the limb before it
    share: float  # of the limb's length behind it
    count: int  # limbs that go on, this one among them
    azimuth: float  # radians, of this limb's own branch


class Shoot:
    """One limb while it grows."""

    def __init__(self, site: Site, bud: Bud, limb: int):
        self.site, self.bud, self.limb = site, bud, limb
        self.table = site.recipe.level(bud.level)
        self.draws = bud.draws
        self.reach = self.draws.log_normal(site.recipe.crown.outline_sd)
        self.azimuth = 0.0 if self.table.planar else self.draws.between(0, 360)
        self.left = self._left()
        self.snapped = False  # did it grow to where it broke?
        self.ground = min(GROUND, GROUND_SHARE * site.recipe.crown.height)
        self.forks: list[Fork] = []
        self._sway = self._swaying()

    def grow(self) -> list[Node]:
        """Adds the limb's rows; its nodes from base to tip. Empty where nothing grew or what grew was shed."""
        rows, space, first = self.site.rows, self.site.space, len(self.site.rows)
        nodes = self._trace()
        reached = self.bud.place + (nodes[-1].gone / self.bud.length if nodes else 0.0)
        if self.snapped:
            rows.lost[nodes[-1].row] = (1.0 - reached) * self.bud.length
        elif reached < self.table.shed_short - 1e-9:
            rows.cut(first)
            self.forks.clear()
            return []
        if space is not None:
            for row in range(first, len(rows)):
                start, tip = rows.tip[rows.parent[row]], rows.tip[row]
                space.add(tip, self.limb)
                space.add(tuple((a + b) / 2 for a, b in zip(start, tip, strict=True)), self.limb)
        return nodes

    def _trace(self) -> list[Node]:
        table, bud, rows = self.table, self.bud, self.site.rows
        at, heading, row, gone, due = rows.tip[bud.row], bud.heading, bud.row, 0.0, 0.0
        ahead = bud.length * (1 - bud.place)
        steps = max(1, round(ahead / table.segment))
        step = ahead / steps
        forks = [] if table.forks is None else [k for k in table.forks.knots if k[0] > bud.place + 1e-6]
        nodes, was_inside = [], self._inside(at)
        for index in range(steps):
            if index and bud.place + (index + 1) * step / bud.length > self.left + 1e-9:
                self.snapped = True
                break
            heading = self._heading(heading, index, bud.place + (index + 0.5) * step / bud.length, at, step)
            heading = self._room(at, heading, step, gone)
            if heading is None:
                break
            reached = along(at, step, heading)
            if reached[1] < min(self.ground, at[1]) or (index and table.clip and self._leaves(reached, was_inside)):
                break
            was_inside = was_inside or self._inside(reached)
            at, gone = reached, gone + step
            row = rows.add(row, at, bud.order, self.limb)
            share = bud.place + gone / bud.length
            while index < steps - 1 and forks and share >= forks[0][0]:
                heading = self._split(row, heading, share, int(forks.pop(0)[1]))
            if table.bare <= share <= table.end and gone >= due - 0.5 * step:
                due = max(gone, (due or gone) + table.spacing)
                heading = self._node(nodes, row, heading, gone, index == steps - 1)
            else:
                nodes.append(Node(row, heading, gone, None))
        return nodes

    def _heading(self, heading: Vector, index: int, share: float, at: Vector, step: float) -> Vector:
        """Where the next segment points, were there nothing else."""
        table = self.table
        if index:
            azimuth = self.draws.between(0, 2 * pi)
            heading = bend(heading, radians(abs(self.draws.normal(table.bend))), azimuth)
        if self._sway is not None:
            heading = self._sway(heading, share * self.bud.length)
        pull = radians(table.tropism(share) * step)
        heading = tropism(heading, pull) if table.rest is None else level_off(heading, radians(table.rest(share)), pull)
        return self.site.wind.bent(heading, at, step)

    def _room(self, at: Vector, heading: Vector, step: float, gone: float) -> Vector | None:
        """`heading`, turned away from wood in its way; None where the limb must stop."""
        table, space, rows = self.table, self.site.space, self.site.rows
        if not table.clearance or gone < FREE * table.clearance:
            return heading
        others = (self.limb, rows.limb[self.bud.row]) if gone < 2 * FREE * table.clearance else (self.limb,)
        close = space.nearest(along(at, step, heading), table.clearance, others)
        if close is None:
            return heading
        away = along(at, -1.0, close)
        if table.avoid and any(away):
            heading = towards(heading, unit(away), radians(table.avoid))
            if space.nearest(along(at, step, heading), table.clearance, others) is None:
                return heading
        return None

    def _node(self, nodes: list[Node], row: int, heading: Vector, gone: float, last: bool) -> Vector:
        """Notes the laterals of one node; the limb's heading after it."""
        table = self.table
        self.azimuth += table.phyllotaxis
        whorl = int(table.whorl)
        axes = [radians(self.azimuth + 360.0 * k / whorl + self.draws.normal(table.azimuth_sd)) for k in range(whorl)]
        nodes.extend(Node(row, heading, gone, azimuth) for azimuth in axes)
        if last:
            return heading
        if table.sympodial and self.draws.uniform() < table.sympodial:
            return lateral(heading, radians(table.relay_angle), axes[0] + pi / whorl if whorl > 1 else axes[0] + pi)
        return lateral(heading, radians(table.deflect), axes[0] + pi) if table.deflect and whorl == 1 else heading

    def _split(self, row: int, heading: Vector, share: float, count: int) -> Vector:
        """Notes a fork; the heading of the limb's own branch."""
        start = self.draws.between(0, 2 * pi)
        self.forks.append(Fork(row, heading, share, count, start))
        return lateral(heading, radians(self.table.fork_angle / 2), start)

    def _left(self) -> float:
        """Share of the limb that has not broken off."""
        chance = self.table.broken(self.bud.borne)
        if not chance:
            return 1.0
        luck = Draws(self.site.seed, limb_stream_id(self.bud.id, _BREAK))
        return min(1.0, self.table.broken_at * luck.between(2 / 3, 4 / 3)) if luck.uniform() < chance else 1.0

    def _swaying(self):
        """A sinuous limb's turn: two waves across each other, the second longer and weaker."""
        table = self.table
        if not table.sway:
            return None
        luck = Draws(self.site.seed, limb_stream_id(self.bud.id, _SWAY))
        first = unit(lateral(self.bud.heading, pi / 2, luck.between(0, 2 * pi)))
        waves = [(first, 1.0, table.sway_length), (cross(self.bud.heading, first), 0.6, 1.6 * table.sway_length)]
        waves = [(axis, radians(table.sway) * size, wave, luck.between(0, 2 * pi)) for axis, size, wave in waves]
        swung = [0.0, 0.0]

        def sway(heading: Vector, gone: float) -> Vector:
            for k, (axis, size, wave, phase) in enumerate(waves):
                angle = size * sin(2 * pi * gone / wave + phase)
                heading, swung[k] = turn(heading, axis, angle - swung[k]), angle
            return unit(heading)

        return sway

    def _inside(self, at: Vector) -> bool:
        return inside(self.site.recipe.crown, self.site.wind.way, self.reach, at)

    def _leaves(self, at: Vector, was_inside: bool) -> bool:
        """Is `at` outside the crown, and not on the way into it from below?"""
        return not self._inside(at) and (was_inside or not below(self.site.recipe.crown, self.reach, at))
