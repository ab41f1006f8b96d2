"""How finely is a tree to move? Numbers of joints, with their range; nothing here imports what makes them."""

from sketchtree.errors import OptionError

LEAST_JOINTS, LIMIT_JOINTS = 64, 60_000  # a file counts joints with 16 bits
MOST_JOINTS = 3000
_OF_LEVEL = (MOST_JOINTS, MOST_JOINTS, 1500, 750)  # a coarser level of detail has wood in fewer pieces, and is looked at from afar


def joints_of(lod: int) -> int:
    """At most so many joints move a tree of a level of detail, 0-3, where nobody says how many."""
    return _OF_LEVEL[lod]


def check_joints(joints: int) -> None:
    """Raises `OptionError` for a number out of range."""
    if not LEAST_JOINTS <= joints <= LIMIT_JOINTS:
        raise OptionError(f"A growing tree can't do with {joints} joints.", remedy=f"Ask for {LEAST_JOINTS} to {LIMIT_JOINTS:,}; {MOST_JOINTS:,} are usual.")
