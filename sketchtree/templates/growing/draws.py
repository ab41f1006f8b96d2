"""Which random numbers does a limb of an exemplar get?

Every limb has its own stream, seeded by (recipe's seed, parent limb's id, rank along it), so adding
a limb leaves the numbers of all others as they were. Streams are the raw doubles of PCG64, whose bits
are fixed for good; normals are made from them here (Box-Muller), not by a generator that may change.
"""

import hashlib
from math import cos, exp, log1p, pi, sqrt

import numpy as np


class Draws:
    """The stream of one limb: numbers in order of asking."""

    def __init__(self, seed: int, limb_id: int):
        self._bits = np.random.PCG64(np.random.SeedSequence([seed, limb_id]))

    def uniform(self) -> float:
        """In [0, 1)."""
        return (int(self._bits.random_raw()) >> 11) * 2.0**-53

    def between(self, low: float, high: float) -> float:
        """Uniform in [low, high)."""
        return low + (high - low) * self.uniform()

    def normal(self, sd: float = 1.0) -> float:
        """Normal with mean 0."""
        radius = sqrt(-2.0 * log1p(-self.uniform()))
        return sd * radius * cos(2.0 * pi * self.uniform())

    def log_normal(self, sd: float) -> float:
        """Median 1; `sd` of the logarithm, cut at ± 2 sd."""
        return exp(min(max(self.normal(sd), -2 * sd), 2 * sd))


def limb_stream_id(parent_id: int, rank: int) -> int:
    """The 63-bit id of the limb at `rank` along its parent; a stem's parent id is 0."""
    word = hashlib.blake2b(f"{parent_id}/{rank}".encode(), digest_size=8).digest()
    return int.from_bytes(word, "little") >> 1
