"""Where is every vertex at a time, in a wind?

The formula that `docs/game.md` gives for each engine, here in numpy, to be drawn and tested. With the four channels of `wind.py`, the wind's
direction d (level, unit), its strength w (0 calm, 1 storm) and the time t in seconds:

    whole tree   p₁ = o + |p − o| unit(p − o + d H sway w (a + g sin 2πt f_s))         o: the tree's foot; lengths are kept
    boughs       p₂ = p₁ + w r branch (c (d + ½ up) sin θ + ½ c (d × up) sin(1.7 θ + 2))            θ = 2π (t f_b + phase)
    leaves       p₃ = p₂ + w l flutter n sin 2π(t f_l + phase + 3 (x + y + z))                 n: normal; x y z of the vertex at rest

    H, r   height and reach of the tree, metres (`tree.pack.json`)      a .08   lean       g .03   gusts       c .06   boughs' amplitude
    f_s .25   f_b .6   f_l 3.1   per second                             l .02   leaves' amplitude, metres

In the manner of Sousa 2007 (GPU Gems 3, chapter 16), who also leans the whole by a power of the height, keeps lengths, and adds the leaves' own
motion along their normals; sines instead of his smoothed triangle waves.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

_UP = np.array([0.0, 1.0, 0.0])


@dataclass(frozen=True)
class Sway:
    """The formula's constants."""

    lean: float = 0.08  # of the height, at strength 1
    gust: float = 0.03  # of the height
    bough: float = 0.06  # of the reach
    leaf: float = 0.02  # metres
    gusts_a_second: float = 0.25
    boughs_a_second: float = 0.6
    leaves_a_second: float = 3.1


def swayed(
    position: Float[np.ndarray, "vertex 3"],
    normal: Float[np.ndarray, "vertex 3"],
    wind: Float[np.ndarray, "vertex 4"],
    *,
    time: float,
    height: float,
    reach: float,
    strength: float = 0.5,
    direction: tuple[float, float] = (1.0, 0.0),
    foot: tuple[float, float, float] = (0.0, 0.0, 0.0),
    constants: Sway = Sway(),  # noqa: B008 (frozen)
) -> Float[np.ndarray, "vertex 3"]:
    """The vertices at `time` (seconds). `wind` holds sway, branch, phase and flutter; `direction` is x and z of where the wind blows to."""
    sway, branch, phase, flutter = wind.T
    k, tau = constants, 2.0 * np.pi
    along = np.array([direction[0], 0.0, direction[1]]) / np.hypot(*direction)
    arm = position - foot
    lean = height * strength * (k.lean + k.gust * np.sin(tau * time * k.gusts_a_second))
    leant = arm + (sway * lean)[:, None] * along
    leant *= (np.linalg.norm(arm, axis=1) / np.maximum(np.linalg.norm(leant, axis=1), 1e-9))[:, None]
    turn = tau * (time * k.boughs_a_second + phase)
    swing = np.sin(turn)[:, None] * (along + 0.5 * _UP) + 0.5 * np.sin(1.7 * turn + 2.0)[:, None] * np.cross(along, _UP)
    shake = np.sin(tau * (time * k.leaves_a_second + phase + 3.0 * position.sum(axis=1)))
    return foot + leant + (strength * k.bough * reach * branch)[:, None] * swing + (strength * k.leaf * flutter * shake)[:, None] * normal
