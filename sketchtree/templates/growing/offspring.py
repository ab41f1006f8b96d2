"""What does a grown limb bear? The buds of its laterals and of the branches of its forks.

A lateral's length and divergence depend on its place u ∈ [0, 1] along the part of the limb that bears laterals: `ratio`
falling with u is the apical control of an excurrent tree, rising that of a decurrent one.
"""

from math import pi, radians

from sketchtree.templates.growing.draws import Draws, limb_stream_id
from sketchtree.templates.growing.headings import lateral
from sketchtree.templates.growing.shoot import Node, Shoot
from sketchtree.templates.growing.site import Bud

_FORKS, _WIND = 10_000, 20_002  # ranks of the streams of forks, and of what the wind sheds


def offspring(shoot: Shoot, nodes: list[Node]) -> list[Bud]:
    """The buds on a limb that grew these nodes: forks, which go first where room is short, then laterals from the base up."""
    if not nodes:
        return []
    laterals = (_lateral(shoot, node, nodes[-1].gone, rank) for rank, node in enumerate(n for n in nodes if n.azimuth is not None))
    return [bud for k in range(len(shoot.forks)) for bud in _fork(shoot, k)] + [bud for bud in laterals if bud is not None]


def _lateral(shoot: Shoot, node: Node, grown: float, rank: int) -> Bud | None:
    site, bud, own = shoot.site, shoot.bud, shoot.table
    if bud.level + 1 >= site.recipe.crown.levels:
        return None
    if shoot.left < 1.0:  # what broke off still counts
        grown = bud.length * (1 - bud.place)
    stream = limb_stream_id(bud.id, rank)
    draws = Draws(site.seed, stream)
    table = site.recipe.level(bud.level + 1)
    share = bud.place + (1 - bud.place) * node.gone / grown
    place = min(max((share - own.bare) / max(own.end - own.bare, 1e-9), 0.0), 1.0)
    if draws.uniform() < own.shed(place):
        return None
    divergence = radians(max(1.0, table.angle(place) + draws.normal(table.angle_sd)))
    direction = lateral(node.heading, divergence, node.azimuth)
    if direction[1] < node.heading[1] - 0.15 and draws.uniform() < own.shed_below:
        return None
    if site.wind.shed and site.wind.kills(direction, Draws(site.seed, limb_stream_id(stream, _WIND)).uniform()):
        return None
    parent_length = grown / (1 - bud.place)
    length = table.ratio(place) * parent_length * draws.log_normal(table.ratio_sd)
    length = min(length, table.longest * draws.log_normal(table.ratio_sd))
    if length < 0.5 * table.segment:
        return None
    return Bud(node.row, direction, bud.level + 1, bud.order + 1, length, stream, draws, borne=place)


def _fork(shoot: Shoot, rank: int) -> list[Bud]:
    """The limbs of this limb's own kind that part from it at one fork."""
    bud, fork = shoot.bud, shoot.forks[rank]
    more, angle = [], radians(shoot.table.fork_angle / 2)
    for k in range(1, fork.count):
        stream = limb_stream_id(bud.id, _FORKS + 100 * rank + k)
        draws = Draws(shoot.site.seed, stream)
        azimuth = fork.azimuth + 2 * pi * k / fork.count + draws.normal(0.15)
        way = lateral(fork.heading, angle * draws.between(0.8, 1.25), azimuth)
        length = bud.length * draws.between(0.85, 1.05)
        more.append(Bud(fork.row, way, bud.level, bud.order + 1, length, stream, draws, place=fork.share, borne=bud.borne))
    return more
