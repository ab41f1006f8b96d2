"""What is known of one kind of leaf, needle tuft, leaflet or blossom?

A name, a drawing (outline, veins and petiole, or a twig with needles), a palette for each season and the few numbers
that say how its card bends and how it stands on the twig.
"""

from collections.abc import Callable
from dataclasses import dataclass

from sketchtree.foliage.painting import Painting
from sketchtree.foliage.seasons import Palette


@dataclass(frozen=True)
class LeafModel:
    """One kind of leaf, needle tuft, leaflet or blossom."""

    name: str
    draw: Callable[[], Painting]
    palettes: dict[str, Palette]  # spring, summer, autumn
    arrangement: str  # where a tree of another species wears it
    size: float  # metres, length of the blade or of one needle
    spacing: float  # metres between the nodes of blades or needles
    inclination: float = 55.0  # degrees between twig and leaf
    droop: float = 0.25  # 0 stiff, 1 hangs straight down, < 0 rises
    fold: float = 14.0  # degrees that each half rises from the midrib
    curl: float = 0.10  # how far the tip bends down, blade lengths
    planes: int = 0  # 0: one card; else how many crossed planes a tuft has
    needle: float = 1.0  # length of a needle, tuft lengths; 1: a blade
    bundle: int = 1  # how many nodes of needles one tuft stands for
    shoot: float = 3.2  # leafy length of a twig, in the habit's twig lengths
    spur: int = 1  # nodes of a short shoot on wood older than a year; 1: that wood bears single leaves
    every: int = 4  # nodes of the twig between two short shoots
    fan: int = 0  # folds of a fan at the end of each frond; 0: leaflets along it
    evergreen: bool = False
    roughness: float = 0.6
    translucency: float = 0.35  # share of the light that passes through
    flower: bool = False  # a blossom, not a leaf
    blossom: str | None = None  # name of the model that its twigs bear in spring beside it
    blossom_share: float = 0.6  # of the nodes that bear it
    blossom_on: str = "twigs"  # twigs: at their ends, and those of short shoots; old wood: all along limbs that have lost their leaves
    blossom_nodes: int = 1  # how many nodes at the end of each twig and short shoot may bear it

    @property
    def is_blade(self) -> bool:
        """One card rather than several crossed ones."""
        return self.planes == 0


def seasons(spring, summer, autumn) -> dict[str, Palette]:
    """A palette for each season: (blade from, blade to, vein, stem)."""
    return {"spring": Palette(*spring), "summer": Palette(*summer), "autumn": Palette(*autumn)}


def always(*colours: str) -> dict[str, Palette]:
    """The same palette in every season."""
    return seasons(colours, colours, colours)
