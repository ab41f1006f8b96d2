"""How is a trunk to be taken from the picture that is scribbled on? Every choice, with its range. A document keeps them, so nothing here imports what finds or grows anything."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from sketchtree.errors import OptionError

if TYPE_CHECKING:
    from sketchtree.trunk.edits import VertexEdits

Point = tuple[float, float]
MOST_VERTICES, MOST_GAP, MOST_LEVELS, MOST_EDITS = 10_000, 1_000.0, 5, 2_000
MOST_PIXELS = 1e6  # how far from the photo's corner a point may lie
MATTINGS = ("layered", "closed-form", "normalised")  # as `matting.matte.MATTINGS`
LIFTS = ("siblings", "elevation")


@dataclass(frozen=True)
class TrunkChoices:
    """What is made of scribbles on a photo. Points are pixels of the photo, x right, y down. Raises OptionError for a value out of range."""

    on: bool = False  # scribbles say what is tree: the tree is grown on its trunk (`growth_tree`)
    vertices: int | None = None  # m, of the contour; None: by its roughness
    gap: float = 3.0  # pixels over which pieces of the matte belong together, as `skeletonise.GAP`
    levels: int = 3  # of branches that are grafted on, as `growth_tree.LEVELS`
    remove: tuple[Point, ...] = ()  # of the contour's vertices, as `trunk.edits.VertexEdits`
    add: tuple[Point, ...] = ()
    merge: tuple[tuple[Point, Point], ...] = ()
    root: Point | None = None  # of the trunk, where it stands; None: the middle of its foot
    matting: str = MATTINGS[0]  # how the matte is found
    lift: str = LIFTS[0]  # how the trunk gets its depths

    def __post_init__(self):
        for name in ("remove", "add"):
            object.__setattr__(self, name, tuple(_point(point) for point in getattr(self, name)))  # files have lists
        object.__setattr__(self, "merge", tuple(_pair(pair) for pair in self.merge))
        object.__setattr__(self, "root", None if self.root is None else _point(self.root, "The foot of the trunk", "Put it on the trunk."))
        if self.vertices is not None and not 3 <= self.vertices <= MOST_VERTICES:
            raise OptionError(f"A contour of {self.vertices} vertices is out of range.", remedy=f"Ask for 3 to {MOST_VERTICES:,}, or let the number be found.")
        if not 0 <= self.gap <= MOST_GAP:
            raise OptionError(f"A gap of {self.gap:g} pixels is out of range.", remedy=f"Give 0 to {MOST_GAP:g} pixels.")
        if not 0 <= self.levels <= MOST_LEVELS:
            raise OptionError(f"{self.levels} levels of branches are out of range.", remedy=f"Give 0 to {MOST_LEVELS}: 0 grafts nothing on, a full crown has 3.")
        _named("matting", self.matting, MATTINGS)
        _named("lift", self.lift, LIFTS)
        if len(self.remove) + len(self.add) + len(self.merge) > MOST_EDITS:
            raise OptionError(f"More than {MOST_EDITS:,} edits of the contour can't be kept.", remedy="Take some back, or paint into the matte instead.")

    @property
    def edits(self) -> "VertexEdits":
        """What is done by hand to the contour. Scribbles change and the contour with them: an edit that finds nothing any more is passed over."""
        from sketchtree.trunk.edits import VertexEdits

        return VertexEdits(self.vertices, self.remove, self.add, self.merge, exact=False)


def _point(point, what: str = "An edit of the contour", remedy: str = "Take it back.") -> Point:
    x, y = (float(value) for value in point)
    if not (abs(x) <= MOST_PIXELS and abs(y) <= MOST_PIXELS):
        raise OptionError(f"{what} lies on no picture.", remedy=remedy)
    return x, y


def _named(what: str, name: str, known: tuple[str, ...]) -> None:
    if name not in known:
        raise OptionError(f"There is no {what} called '{name}'.", remedy=f"Choose one of: {', '.join(known)}.")


def _pair(pair) -> tuple[Point, Point]:
    one, other = pair
    return _point(one), _point(other)
