"""How is a tree to be made of a photo? Every choice, with its range. A document keeps them, so nothing here imports what finds or grows anything."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from sketchtree.errors import OptionError

if TYPE_CHECKING:
    from sketchtree.photo.trace.trace import Tracing

RULES = ("contrast", "paper")
COLOURS = ("photo", "season")
BARK_COLOURS = ("photo", "species")
ARRANGEMENTS = ("alternate", "opposite", "decussate", "whorled", "spiral")  # as `foliage.wear.FREE`
LIBRARIES = ("visible", "I", "II")  # as `propagate.attractors.library`


@dataclass(frozen=True)
class PhotoOptions:
    """How the foliage and the limbs are found in the photo, and how the rest grows. Raises OptionError for a value out of range."""

    foliage: str = RULES[0]  # contrast: what sets the crown apart from what is round it; paper: the greenest or reddest of ten colours (§2)
    trace: bool = True  # follow the wood on from the strokes; False: the strokes alone
    library: tuple[str, ...] = LIBRARIES  # subtrees that grow: of the visible branches, predefined of type I, of type II (§3.1)
    libraries: tuple[tuple[str, ...], ...] = ()  # of the second, third … tree of a photo, where they have others than the first (Figures 8-9)
    replacements: int = 100  # rounds of them at most, each of up to three, 0-10000 (§3.1: “about 100 times”, one by one)
    alternate: bool = True  # image and 3D attractors by turns; False: image attractors alone (Figure 6a)
    colours: str = COLOURS[0]  # photo: leaves in the colours they are seen in (§4); season: the species'
    fit_leaves: bool = True  # as large and dense as it takes to cover the foliage; False: as the species has them
    leaf_size: float = 1.0  # times that, 0.1-10
    leaf_density: float = 1.0  # times the leaves, 0.1-10
    leaf_arrangement: str | None = None  # of the leaves about their twig (ARRANGEMENTS); None: the species'
    bare_as_seen: bool = True  # a tree that stands bare in the photo has no leaves, unless a leaf model is asked for
    bark_colour: str = BARK_COLOURS[0]  # photo: bark in the colour that the trunk is seen in; species: in its own

    def __post_init__(self):
        object.__setattr__(self, "library", tuple(self.library))  # files have lists
        object.__setattr__(self, "libraries", tuple(tuple(names) for names in self.libraries))
        for name, known in (("foliage", RULES), ("colours", COLOURS), ("bark_colour", BARK_COLOURS)):
            if getattr(self, name) not in known:
                raise OptionError(f"`{name}` is {getattr(self, name)!r}.", remedy=f"Choose one of: {', '.join(known)}.")
        if self.leaf_arrangement not in (None, *ARRANGEMENTS):
            raise OptionError(f"`--leaf-arrangement {self.leaf_arrangement}` is none.", remedy=f"Choose one of: {', '.join(ARRANGEMENTS)}; or leave it out.")
        for names in (self.library, *self.libraries):
            if not names or any(name not in LIBRARIES for name in names):
                raise OptionError(f"`--library {','.join(names)}` names no library of subtrees.", remedy=f"Choose all, or some of: {', '.join(LIBRARIES)}.")
        if not 0 <= self.replacements <= 10_000:
            raise OptionError(f"`--rounds {self.replacements}` is out of range.", remedy="Give 0 to 10000; about 100 fill a crown.")
        for name in ("leaf_size", "leaf_density"):
            if not 0.1 <= getattr(self, name) <= 10:
                raise OptionError(f"`--{name.replace('_', '-')} {getattr(self, name):g}` is out of range.", remedy="Give 0.1 to 10; 1 is as the photo's foliage asks for.")

    def of_tree(self, number: int) -> "PhotoOptions":
        """The choices for one tree of a photo, the first being 0."""
        return replace(self, library=(self.library, *self.libraries)[number] if number <= len(self.libraries) else self.library, libraries=())

    @property
    def tracing(self) -> "Tracing":
        """How limbs are traced."""
        from sketchtree.photo.trace.trace import Tracing

        return Tracing(most=2_000 if self.trace else 0)
