"""Which colours does a leaf have in a season?

A palette names the two ends of the blade's range, the veins and the stem, in sRGB. The texture is
painted in the brighter channel of the two ends, and each leaf darkens it to its own place between them:

    C(tint) = (1 − tint) C_from + tint C_to        texture = max(C_from, C_to)        factor = C(tint) / texture ≤ 1
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from sketchtree.errors import OptionError
from sketchtree.foliage.painting import to_linear

SEASONS = ("spring", "summer", "autumn", "bare")


@dataclass(frozen=True)
class Palette:
    """sRGB colours as `#rrggbb`: the blade from one end of its range to the other, veins and stem."""

    blade_from: str
    blade_to: str
    vein: str
    stem: str

    @property
    def texture_blade(self) -> Float[np.ndarray, " 3"]:
        """The linear colour that the texture's blade is painted in."""
        return np.maximum(linear(self.blade_from), linear(self.blade_to))

    def factor(self, tint: Float[np.ndarray, " leaf"]) -> Float[np.ndarray, "leaf 3"]:
        """The linear factor, at most 1, that brings the texture's blade to a leaf's own colour."""
        t = np.clip(np.asarray(tint), 0, 1)[:, None]
        return ((1 - t) * linear(self.blade_from) + t * linear(self.blade_to)) / self.texture_blade


def linear(colour: str) -> Float[np.ndarray, " 3"]:
    """A `#rrggbb` colour in linear light."""
    return to_linear(np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) / 255.0)


def check_season(season: str) -> str:
    """The season, or an error that lists them."""
    if season not in SEASONS:
        raise OptionError(
            f"There is no season called {season!r}.",
            remedy=f"Choose one of: {', '.join(SEASONS)}.",
        )
    return season
