"""What a user may choose: the options of reading a sketch and of completing its tree."""

import dataclasses
from dataclasses import dataclass

import numpy as np

from sketchtree.errors import OptionError
from sketchtree.propagate.after import shears


@dataclass(frozen=True)
class DrawingOptions:
    """How a file becomes the branches that it shows."""

    crown: str = "auto"  # auto | off
    max_strokes: int = 20_000  # ≥ 1
    max_mb: float = 100.0  # largest file, MB (10⁶ bytes), > 0
    max_megapixels: float = 200.0  # largest picture, 10⁶ pixels, > 0


@dataclass(frozen=True)
class ReadingOptions(DrawingOptions):
    """How a sketch becomes drawn branches in 3D."""

    template: str = "auto"  # auto: best match; none: no template; else an exemplar's name
    theta: str = "fit"  # fit: learn Θ from the sketch; fixed: hold the template's
    method: str = "elevation"
    height: float | None = None  # metres, > 0; None: the template's
    planar: bool = False
    samples: int = 0  # posterior samples wanted at least, ≥ 0; 0: as many as the method keeps anyway
    alternatives: int = 0  # distinct readings wanted, the answer included; 0: only the answer

    def __post_init__(self):
        for name, most in (("samples", 1_000_000), ("alternatives", 64)):
            if not 0 <= getattr(self, name) <= most:
                raise OptionError(f"`--{name} {getattr(self, name)}` is out of range.", remedy=f"Give 0 to {most}.")
        if self.height is not None and not (np.isfinite(self.height) and 0 < self.height <= 1000):
            raise OptionError(f"`--height {self.height:g}` is no height of a tree.", remedy="Give metres above 0, at most 1000.")


@dataclass(frozen=True)
class TreeOptions:
    """How the drawn branches become a complete tree."""

    generations: float | None = None  # 0-50; 3.5: three and half of the fourth; None: 5, or up to 12 inside a crown; 0: only what was drawn
    fill: bool = False  # keep on until the crown is evenly filled
    max_segments: int = 200_000
    density: float = 1.0  # laterals a metre of limb, over the species', 0.01-10
    light: float = 0.0  # 0-1, how much twigs turn to the light and buds in the shade stay shut; 0: not at all
    sag: float = 0.0  # 0-5 times the weight that bends undrawn branches; 0: none, 1: as physics says
    shed: float = 0.0  # 0-1: undrawn branches that get less than this share of the light are dropped; 0: none
    shed_twigs: float = 0.0  # 0-20 twig lengths: shorter undrawn branches that bear nothing are dropped; 0: none
    untangle: bool = True  # undrawn branches that run through others are turned a little, or cut where that doesn't help
    prune: tuple[str, ...] = ()  # planes and mesh files that cut the tree, drawn wood too (`propagate.after.shears`)
    obstacle: tuple[str, ...] = ()  # mesh files that nothing grows through: metres, y up, the trunk's root at the origin
    leaf: str | None = None  # leaf model, exemplar whose leaf to take, or "none"; None: the template's
    season: str = "summer"
    bark: str | None = None  # None: the template's
    wood: str | None = None  # one-piece | tubes; None: one piece up to 2,000 limbs
    solid: bool = False  # the wood's tubes united into one surface that meets itself nowhere

    def __post_init__(self):
        _whole(self, "generations")
        for name, most in (("generations", 50), ("light", 1), ("sag", 5), ("shed", 1), ("shed_twigs", 20)):
            value = getattr(self, name)
            if value is not None and not 0 <= value <= most:
                raise OptionError(f"`--{name.replace('_', '-')} {value:g}` is out of range.", remedy=f"Give 0 to {most}.")
        if not 0.01 <= self.density <= 10:
            raise OptionError(f"`--density {self.density:g}` is out of range.", remedy="Give 0.01 to 10; 1 is the species' own, 2 bears twice as densely.")
        for shape in self.prune:
            shears.plane(shape)  # refuse a misspelt one before the work


FEWEST_TRIANGLES = 12
"""That a whole tree may be asked to have."""


@dataclass(frozen=True)
class FileOptions:
    """What of a complete tree goes into its mesh file."""

    lod: int = 0  # 0-3, the level of detail that is written where only one is
    triangles: int | None = None  # that level has so many at most, instead of a share of them
    levels: str = "one"  # one: that of `lod`; together: all in one file, the impostor last; apart: each in a file of its own
    pixel_error: float = 1.0  # what an outline may be off where a level takes over, pixels of a screen of 1080 rows, > 0
    leaves: str = "merged"  # merged: one mesh; instanced: a few small ones, drawn at many places (level 0 only)
    pack: str | None = None  # game: everything that a game needs, in files beside each other

    def __post_init__(self):
        if not 0 < self.pixel_error <= 100:
            raise OptionError(f"`--pixel-error {self.pixel_error:g}` is out of range.", remedy="Give pixels above 0, at most 100.")
        if self.pixel_error != 1.0 and self.levels == "one" and not self.pack:
            raise OptionError(
                f"`--pixel-error {self.pixel_error:g}` says where a coarser level takes over, and one level alone is written.",
                remedy="Leave it out, or ask for `--levels together`, `--levels apart` or `--pack game`.",
            )
        if self.triangles is not None and self.triangles < FEWEST_TRIANGLES:
            raise OptionError(f"`--triangles {self.triangles}` are too few for a tree.", remedy=f"Give {FEWEST_TRIANGLES} or more.")
        if self.lod and self.triangles is not None:
            raise OptionError(f"`--lod {self.lod}` and `--triangles {self.triangles}` both say how fine the meshes are.", remedy="Leave one of the two out.")
        coarser = f"--triangles {self.triangles}" if self.triangles is not None else f"--lod {self.lod}"
        if self.is_coarser and (self.levels != "one" or self.pack):
            other = f"--pack {self.pack}" if self.pack else f"--levels {self.levels}"
            raise OptionError(f"`{coarser}` asks for one level of detail, `{other}` for all of them.", remedy="Leave one of the two out.")
        if self.leaves == "instanced" and (self.is_coarser or self.pack):
            other = f"--pack {self.pack}" if self.pack else coarser
            raise OptionError(f"`--leaves instanced` can't be had with `{other}`, whose leaves are one mesh.", remedy="Leave one of the two out.")
        if self.pack and self.levels != "one":
            raise OptionError(f"`--pack {self.pack}` writes all levels of detail in any case.", remedy=f"Leave `--levels {self.levels}` out.")

    @property
    def is_coarser(self) -> bool:
        """Whether the one level that is written may be another one than the tree's own."""
        return self.lod > 0 or self.triangles is not None


def _whole(record, name: str) -> None:
    """3.0 is 3, in the report too."""
    value = getattr(record, name)
    if isinstance(value, float) and value.is_integer():
        object.__setattr__(record, name, int(value))


def options_as_dict(*options) -> dict:
    """Options as used, for the report."""
    merged: dict = {}
    for record in options:
        merged |= dataclasses.asdict(record)
    return merged
