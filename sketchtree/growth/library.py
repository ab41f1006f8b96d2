"""Which little branches are grafted on? Parametric units of two types (single-image growth, Figure 7a).

    L   a shoot that goes on and bears others at its sides
    Y   a shoot that forks

A unit says which piece stands on which, and how long each is; angles and sizes come from the tree's manner when it is grafted on.
"""

from dataclasses import dataclass

from sketchtree.axes import NULL


@dataclass(frozen=True)
class BranchUnit:
    """A branch of several pieces, parents first; one entry a piece."""

    name: str  # begins with its type
    parent: tuple[int, ...]  # piece that each stands on; NULL: where the unit is grafted on
    length: tuple[float, ...]  # share of the unit's length
    lean: tuple[float, ...]  # of the tree's usual lean: 0 goes on, above 0 to one side, below to the other
    is_new: tuple[bool, ...]  # a limb of its own begins

    def __len__(self) -> int:
        return len(self.parent)

    @property
    def limb(self) -> tuple[int, ...]:
        """The piece that each one's limb begins with; NULL: the limb that goes through the unit."""
        limb = []
        for piece, above in enumerate(self.parent):
            limb.append(piece if self.is_new[piece] else NULL if above == NULL else limb[above])
        return tuple(limb)


def _unit(name: str, *pieces: tuple[int, float, float, bool]) -> BranchUnit:
    return BranchUnit(name, *(tuple(column) for column in zip(*pieces, strict=True)))


_ON, _NEW = False, True
LIBRARY = (
    _unit("L", (NULL, 0.30, 0, _ON), (0, 0.30, 0, _ON), (1, 0.25, 0, _ON), (2, 0.15, 0, _ON), (0, 0.26, 1, _NEW), (4, 0.20, 0, _ON)),
    _unit("L, late", (NULL, 0.25, 0, _ON), (0, 0.25, 0, _ON), (1, 0.25, 0, _ON), (2, 0.25, 0, _ON), (1, 0.24, 1, _NEW), (4, 0.16, 0, _ON)),
    _unit(
        "L, alternate", (NULL, 0.22, 0, _ON), (0, 0.24, 0, _ON), (1, 0.28, 0, _ON), (2, 0.26, 0, _ON), (0, 0.26, 1, _NEW), (4, 0.18, 0, _ON),
        (1, 0.22, -1, _NEW), (6, 0.16, 0, _ON),
    ),  # fmt: skip
    _unit("Y", (NULL, 0.30, 0, _ON), (0, 0.20, 0, _ON), (1, 0.28, 0.45, _ON), (2, 0.22, 0, _ON), (1, 0.28, -0.45, _NEW), (4, 0.20, 0, _ON)),
    _unit("Y, uneven", (NULL, 0.25, 0, _ON), (0, 0.20, 0, _ON), (1, 0.30, 0.25, _ON), (2, 0.25, 0, _ON), (1, 0.22, -0.75, _NEW), (4, 0.14, 0, _ON)),
    _unit(
        "Y, twice", (NULL, 0.28, 0, _ON), (0, 0.26, 0.4, _ON), (1, 0.24, 0.4, _ON), (2, 0.22, 0, _ON), (0, 0.28, -0.5, _NEW), (4, 0.20, 0, _ON),
        (1, 0.24, -0.45, _NEW),
    ),  # fmt: skip
)  # fmt: skip
