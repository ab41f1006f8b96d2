"""At which azimuths about its twig does each leaf of a node stand?

Botany's arrangements, the "botanical laws" of Chen et al. 2008, §6; node 0 is the one at the tip. Azimuths
are measured about the twig from its side vector (level, for a twig that is not upright):

    alternate    one leaf      ψ_k = 180° k                     two ranks
    opposite     two leaves    ψ_kj = 180° j                    two ranks, in pairs
    decussate    two leaves    ψ_kj = 90° k + 180° j            four ranks, crossed pairs
    whorled      w leaves      ψ_kj = (360°/w)(j + k/2)         successive whorls in each other's gaps
    spiral       one leaf      ψ_k = 137.5° k                   golden angle (or the habit's own)
    fascicled    one bundle    ψ_k = 137.5° k                   a bundle of needles a node
    frond        two leaflets  ψ_kj = ν, 180° − ν               two rows that make a V of half opening 90° − ν

    k   node, from the tip    j   leaf of the node
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.errors import OptionError

GOLDEN_ANGLE = 137.5  # degrees
FROND_RISE = 24.0  # ν, degrees that each row of leaflets rises above the frond's own plane

ARRANGEMENTS = ("opposite", "decussate", "alternate", "whorled", "spiral", "fascicled", "frond")


def leaves_per_node(arrangement: str, whorl: int = 3) -> int:
    """How many leaves one node carries; `whorl` is asked only by `whorled`."""
    if arrangement not in ARRANGEMENTS:
        raise OptionError(
            f"There is no leaf arrangement called {arrangement!r}.",
            remedy=f"Choose one of: {', '.join(ARRANGEMENTS)}.",
        )
    return {"opposite": 2, "decussate": 2, "frond": 2, "whorled": max(int(whorl), 3)}.get(arrangement, 1)


def azimuths(
    arrangement: str,
    node: Int[np.ndarray, " node"],
    *,
    phyllotaxis: float = GOLDEN_ANGLE,
    whorl: int = 3,
) -> Float[np.ndarray, "node leaf"]:
    """The azimuths, radians, of the leaves of each node. `phyllotaxis` (degrees) turns a spiral."""
    count = leaves_per_node(arrangement, whorl)
    k, j = np.asarray(node, float)[:, None], np.arange(count)[None, :]
    degrees = {
        "alternate": 180.0 * k + 0.0 * j,
        "opposite": 0.0 * k + 180.0 * j,
        "decussate": 90.0 * k + 180.0 * j,
        "whorled": 360.0 / count * (j + k / 2),
        "spiral": phyllotaxis * k + 0.0 * j,
        "fascicled": phyllotaxis * k + 0.0 * j,
        "frond": 0.0 * k + np.where(j == 0, FROND_RISE, 180.0 - FROND_RISE),
    }[arrangement]
    return np.radians(degrees % 360.0)
