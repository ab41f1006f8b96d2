"""Trees as a scanner sees them: a trunk, limbs, twigs; with ground, with others beside, or with noise."""

import numpy as np


def limb(begin, end, thick: float, thin: float, chance, per_metre: float = 300) -> np.ndarray:
    """Points on the bark of a straight limb."""
    begin, end = np.asarray(begin, float), np.asarray(end, float)
    t = chance.uniform(size=int(per_metre * np.linalg.norm(end - begin)) + 3)
    way = (end - begin) / np.linalg.norm(end - begin)
    side = np.cross(way, [0.31, 0.2, 0.93])
    side /= np.linalg.norm(side)
    turn, radius = chance.uniform(0, 2 * np.pi, len(t)), thick + (thin - thick) * t
    return begin + t[:, None] * (end - begin) + radius[:, None] * (np.cos(turn)[:, None] * side + np.sin(turn)[:, None] * np.cross(way, side))


def tree(height: float = 6.0, seed: int = 0, at=(0.0, 0.0)) -> np.ndarray:
    """A trunk and twenty limbs, each with two twigs."""
    chance = np.random.default_rng(seed)
    parts = [limb([0, 0, 0], [0, height, 0], 0.02 * height, 0.004 * height, chance, 200)]
    for k in range(20):
        y, turn = height * (0.35 + 0.03 * k), 2.4 * k + chance.uniform(-0.3, 0.3)
        reach = height * 0.3 * (1.3 - y / height)
        out = np.array([np.cos(turn), 0.5, np.sin(turn)])
        end = [0, y, 0] + reach * out
        parts.append(limb([0, y, 0], end, 0.006 * height, 0.003 * height, chance, 120))
        parts += [limb(end - 0.4 * reach * out, end + reach * chance.uniform(-0.3, 0.3, 3), 0.003 * height, 0.001 * height, chance, 70) for _ in range(2)]
    return np.concatenate(parts) + [at[0], 0.0, at[1]]


def wide_in_leaf(seed: int = 3) -> np.ndarray:
    """A short trunk of a hundred points under a crown, twice as wide as high, of leaves; some of them in dense sprays."""
    chance = np.random.default_rng(seed)
    way = chance.normal(size=(6000, 3))
    crown = way / np.linalg.norm(way, axis=1)[:, None] * chance.uniform(0.6, 1.0, (6000, 1)) * [3.0, 1.5, 3.0]
    sprays = np.concatenate([middle + chance.normal(0, 0.12, (150, 3)) for middle in crown[:8]])
    return np.concatenate([limb([0, 0, 0], [0, 1.6, 0], 0.1, 0.08, chance, 60), np.concatenate([crown, sprays]) + [0.0, 2.6, 0.0]])


def box(wide: float = 0.8, high: float = 1.0, count: int = 3000, seed: int = 7) -> np.ndarray:
    """Points all through a round pot."""
    chance = np.random.default_rng(seed)
    far, turn = wide * np.sqrt(chance.uniform(size=count)), chance.uniform(0, 2 * np.pi, count)
    return np.c_[far * np.cos(turn), chance.uniform(0, high, count), far * np.sin(turn)]


def buttressed(seed: int = 8) -> np.ndarray:
    """A tree on six buttresses, six times as wide as its trunk at the ground."""
    chance = np.random.default_rng(seed)
    fins = [limb([out * np.cos(turn), 0, out * np.sin(turn)], [0.1 * np.cos(turn), 1.2, 0.1 * np.sin(turn)], 0.05, 0.05, chance, 300) for turn in np.arange(6) * np.pi / 3 for out in (0.4, 0.8)]
    return np.concatenate([tree(), *fins])


def weeping(seed: int = 11) -> np.ndarray:
    """A tree whose three boughs each end in a curtain of leaves that hangs to the ground."""
    chance, parts = np.random.default_rng(seed), [tree()]
    for turn in np.arange(3) * 2 * np.pi / 3:
        out = np.array([2.2 * np.cos(turn), 0.0, 2.2 * np.sin(turn)])
        parts.append(limb([0, 2.4, 0], out + [0, 3.2, 0], 0.04, 0.02, chance, 120))
        parts.append(out + np.c_[chance.normal(0, 0.3, 1200), chance.uniform(0.0, 3.3, 1200), chance.normal(0, 0.3, 1200)])
    return np.concatenate(parts)


def floor(wide: float = 4.0, slope: float = 0.0, rough: float = 0.01, seed: int = 5, count: int = 6000) -> np.ndarray:
    """Ground that rises along x and waves a little."""
    chance = np.random.default_rng(seed)
    x, z = chance.uniform(-wide, wide, (2, count))
    return np.c_[x, slope * x + 0.03 * np.sin(2 * x) + chance.normal(size=count) * rough, z]


def lying(xyz: np.ndarray) -> np.ndarray:
    """The same with z up."""
    return np.stack([xyz[:, 0], -xyz[:, 2], xyz[:, 1]], axis=1)
