"""How fine is the wood's mesh?"""

from dataclasses import dataclass, replace

from sketchtree.errors import OptionError

_COARSEST = 0.02  # tolerance past which a limb of three sides loses nothing more


@dataclass(frozen=True)
class Detail:
    """Tolerances are shares of the tree's height, so that a sapling and an oak get alike meshes."""

    tolerance: float = 3e-4  # largest sagitta of a ring's side, and 0.4 of that of a bend, / height, > 0
    fewest_sides: int = 3  # of a ring, ≥ 3
    most_sides: int = 24  # of a ring, ≥ fewest_sides
    longest: float = 0.05  # farthest two rings stand apart, / height, > 0
    collar_radius: float = 1.5e-3  # limbs at least this thick at their foot get a collar, / height, ≥ 0
    flare: float = 0.45  # how much wider a stem is at the ground, share of its radius, 0-2
    most_triangles: int = 1_500_000  # of all wood, ≥ 12; a larger mesh is made anew with coarser tolerances
    tile: float = 0.5  # side of the bark texture on thick wood, metres, > 0

    def __post_init__(self):
        ranges = {
            "tolerance": (1e-7, 0.1),
            "fewest_sides": (3, 256),
            "most_sides": (self.fewest_sides, 256),
            "longest": (1e-4, 10.0),
            "collar_radius": (0.0, float("inf")),
            "flare": (0.0, 2.0),
            "most_triangles": (12, float("inf")),
            "tile": (1e-3, 100.0),
        }
        for name, (low, high) in ranges.items():
            value = getattr(self, name)
            if not low <= value <= high:
                raise OptionError(
                    f"`{name}` is {value}, outside {low:g} to {high:g}.", remedy=f"Choose `{name}` in that range."
                )

    @property
    def is_coarsest(self) -> bool:
        """No coarser mesh is to be had."""
        return self.tolerance >= _COARSEST

    def coarser(self, factor: float) -> "Detail":
        """Tolerances times `factor` > 1, and fewer collars: as many times fewer triangles."""
        return replace(
            self,
            tolerance=min(factor * self.tolerance, _COARSEST),
            longest=min(factor * self.longest, 10.0),
            collar_radius=factor * max(self.collar_radius, self.tolerance),
        )
