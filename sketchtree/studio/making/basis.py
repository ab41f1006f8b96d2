"""What do the pages have of the tree? Kept by the server between two jobs, so what is named here imports no more than it does."""

from dataclasses import dataclass

from sketchtree.editing.settled import Settled


@dataclass(frozen=True)
class Basis:
    """What the pages have of the tree, for a hurried answer to fit in with."""

    scale: float
    translate: tuple[float, float, float]
    owners: tuple[str, ...]
    settled: Settled
    height: float  # metres
    low: tuple[float, float, float]
    high: tuple[float, float, float]
    segments: int
    leaves: int
    triangles: tuple[int, int]
