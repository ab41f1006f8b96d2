"""Which colour stands for which distance? From blue through yellow to red, in steps that look equally large.

Colours are mixed in OKLab (Ottosson 2020), where the distance of two colours is about how different they look:

    l' m' s' = cbrt(M₁ · linear sRGB)        L a b = M₂ · l' m' s'

Blue and red are as far from yellow as each other, so that every step of a share is the same step for the eye; they differ in hue and not only in red and green, for the colour-blind.
"""

import numpy as np
from jaxtyping import Float

_M1 = np.array([[0.4122214708, 0.5363325363, 0.0514459929], [0.2119034982, 0.6806995451, 0.1073969566], [0.0883024619, 0.2817188376, 0.6299787005]])
_M2 = np.array([[0.2104542553, 0.7936177850, -0.0040720468], [1.9779984951, -2.4285922050, 0.4505937099], [0.0259040371, 0.7827717662, -0.8086757660]])
NEAR, BETWEEN, FAR = np.array([0.475, -0.02, -0.125]), np.array([0.885, -0.02, 0.155]), np.array([0.4228, 0.145, 0.08])  # L a b: blue, yellow, red


def ramp(share: Float[np.ndarray, "*place"]) -> Float[np.ndarray, "*place 3"]:
    """sRGB, 0-1, of shares: 0 blue, 0.5 yellow, 1 red; beyond, the same as at the end."""
    share = np.clip(np.asarray(share, float), 0.0, 1.0)[..., None]
    return srgb(np.where(share < 0.5, NEAR + 2 * share * (BETWEEN - NEAR), BETWEEN + (2 * share - 1) * (FAR - BETWEEN)))


def srgb(lab: Float[np.ndarray, "*colour 3"]) -> Float[np.ndarray, "*colour 3"]:
    """OKLab → sRGB, 0-1; what no screen shows is cut off."""
    linear = np.clip((lab @ np.linalg.inv(_M2).T) ** 3 @ np.linalg.inv(_M1).T, 0.0, 1.0)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def oklab(colour: Float[np.ndarray, "*colour 3"]) -> Float[np.ndarray, "*colour 3"]:
    """sRGB, 0-1 → OKLab."""
    linear = np.where(colour <= 0.04045, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4)
    return np.cbrt(linear @ _M1.T) @ _M2.T
