"""How are blossoms drawn? Clusters seen from the side, tuft coordinates: the stalk starts at (0, 0), the cluster ends near (0, 1).

Petals are blades, stamens and hearts are veins, stalks and sepals are stems. A flower that looks away is seen foreshortened:
its height is times cos θ, θ the angle between its face and the eye.
"""

import numpy as np

from sketchtree.foliage.layers import Layer, disc, line, paint_layers, placed
from sketchtree.foliage.outline import closed, smooth
from sketchtree.foliage.painting import Painting


def apple_blossom() -> Painting:
    """Malus: a flat posy of five to seven wide flowers, rosy outside, with yellow stamens."""
    return _umbel(61, flowers=9, radius=0.21, petal=0.62, stalk=0.30, spread=0.62, rise=0.60, heart=0.20)


def cherry_blossom() -> Painting:
    """Prunus avium: white flowers on long stalks from one bud."""
    return _umbel(62, flowers=10, radius=0.185, petal=0.58, stalk=0.45, spread=0.70, rise=0.52, heart=0.16)


def hawthorn_blossom() -> Painting:
    """Crataegus: a dense cushion of a dozen and more small flowers with dark anthers."""
    return _umbel(63, flowers=20, radius=0.135, petal=0.66, stalk=0.22, spread=0.66, rise=0.50, heart=0.30)


def cercis_blossom() -> Painting:
    """Cercis: a handful of pea flowers on short stalks out of old wood."""
    return _umbel(67, flowers=9, radius=0.20, petal=0.60, stalk=0.10, spread=0.75, rise=0.42, heart=0.22)


def elder_blossom() -> Painting:
    """Sambucus: a flat plate of hundreds of tiny cream flowers on five branching stalks."""
    rng = np.random.default_rng(64)
    layers: list[Layer] = []
    for x in np.linspace(-0.62, 0.62, 7):
        layers.append(line(_arc((0, 0), (x, 0.62 - 0.12 * abs(x)), 0.05 * np.sign(x)), 0.020, 0.010))
    for _ in range(230):
        x = rng.uniform(-1, 1)
        at = (0.72 * x, 0.68 + 0.20 * (1 - x * x) * rng.uniform(0.2, 1) - 0.10 * rng.uniform() ** 2)
        layers += _flower(at, 0.040, 0.7, rng.uniform(0, 6), rng.uniform(0.4, 1), 0.3, rng.normal(1.0, 0.05))
    return paint_layers(layers)


def chestnut_candle() -> Painting:
    """Aesculus: an upright candle of white flowers with yellow and pink hearts."""
    return _panicle(65, flowers=78, width=0.22, flower=0.062, heart=0.34, taper=0.75, foot=0.10)


def lilac_panicle() -> Painting:
    """Syringa: a dense cone of four-lobed flowers, often two together."""
    return _panicle(66, flowers=150, width=0.24, flower=0.048, heart=0.16, taper=0.85, foot=0.08, petals=4)


def _umbel(seed, *, flowers, radius, petal, stalk, spread, rise, heart) -> Painting:
    """Flowers on stalks from one point, on a dome of half width `spread` that starts at height `rise`."""
    rng = np.random.default_rng(seed)
    turn = 137.5 * np.arange(flowers)
    out = np.sqrt((np.arange(flowers) + 0.5) / flowers)
    place = np.stack([spread * out * np.sin(np.radians(turn)), rise + 0.34 * np.sqrt(1 - out**2) + 0.10 * out * np.cos(np.radians(turn))], axis=1)
    order = np.argsort(np.cos(np.radians(turn)) * out)
    layers: list[Layer] = [line([(0, 0), (0, 0.5 * stalk), (0, stalk)], 0.035, 0.03)]
    layers += [line(_arc((0, stalk), at, 0.06), 0.022, 0.014) for at in place]
    for i in order:
        face = 0.55 + 0.45 * rng.uniform()
        layers += _flower(place[i], radius, petal, rng.uniform(0, 6), face, heart, rng.normal(1.0, 0.04), np.arctan2(place[i][0], 0.8))
    return paint_layers(layers)


def _panicle(seed, *, flowers, width, flower, heart, taper, foot, petals=5) -> Painting:
    """Flowers round an upright axis, closer to it towards the end."""
    rng = np.random.default_rng(seed)
    axis = [(0, 0), (0.01, 0.3), (0, 0.95)]
    layers: list[Layer] = [line(axis, 0.03, 0.012)]
    up, side = rng.uniform(0, 1, flowers) ** 0.85, rng.uniform(-1, 1, flowers)
    reach = width * (1 - taper * up) * np.clip((up + 0.12) / 0.25, 0, 1)
    for i in np.argsort(-np.abs(side), kind="stable"):
        at = (reach[i] * side[i], foot + 0.06 + (0.92 - foot) * up[i])
        face = 0.55 + 0.45 * (1 - abs(side[i]))
        layers += _flower(at, flower * rng.uniform(0.85, 1.1), 0.66, rng.uniform(0, 6), face, heart, 0.90 + 0.14 * face + rng.normal(0, 0.05), 1.2 * side[i], petals)
    return paint_layers(layers)


def _flower(at, radius, petal, turn, face, heart, shade, heading=0.0, petals=5) -> list[Layer]:
    """`petals` petals round a heart; `face` (0-1) is the cosine by which it is foreshortened along `heading`."""
    half = smooth([(0, 0), (0.45 * petal, 0.3), (petal, 0.68), (0.75 * petal, 0.95), (0.18 * petal, 0.98), (0, 0.93)], 5)
    layers = []
    for k in range(petals):
        drawn = placed(closed(half), (0, 0), turn + 2 * np.pi * k / petals, radius) * [1.0, face]
        layers.append(Layer(placed(drawn, at, heading, 1.0), "blade", shade * (1.0 - 0.05 * (k % 2))))
    return [*layers, disc(at, heart * radius, "vein", 1.0, face, heading)]


def _arc(start, end, bow: float):
    start, end, t = np.asarray(start, float), np.asarray(end, float), np.linspace(0, 1, 8)[:, None]
    across = np.array([end[1] - start[1], start[0] - end[0]])
    return start + t * (end - start) + 4 * bow * t * (1 - t) * across
