"""How does one file of a digitised tree become an exemplar?"""

import hashlib
import re
from dataclasses import dataclass
from pathlib import Path

from sketchtree.errors import SketchTreeError, TemplateError
from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_files import read_skeleton
from sketchtree.templates.store.columns import to_columns
from sketchtree.templates.exemplar import measure
from sketchtree.templates.importing.forks import forked
from sketchtree.templates.importing.frame import UP, stood
from sketchtree.templates.importing.habit import habit_from_tree
from sketchtree.templates.making.order import Block
from sketchtree.templates.growing.recipe import NAME_LENGTH
from sketchtree.version import __version__


@dataclass(frozen=True)
class Described:
    """What the user says of a digitised tree; None where the file or a default decides."""

    name: str | None = None  # of the exemplar; else the file's
    title: str | None = None
    species: str = ""
    growth_habit: str = ""
    unit: str = "m"
    up: str | None = None  # "y" or "z"; else what files of its kind have
    source: str = ""  # who measured it, where
    leaf: str | None = None
    bark: str | None = None
    like: Habit | None = None  # whose other fields it borrows


def imported(file: Path, said: Described, traced: TreeSkeleton | None = None) -> Block:
    """The columns of the exemplar in `file`. `traced`: the tree that stands in it, metres, y up, where the file is a point cloud. Raises a `SketchTreeError` that names the file."""
    file = Path(file)
    up = said.up or UP.get(file.suffix.lower(), "y")
    tree = stood(read_skeleton(file), file=str(file), unit=said.unit, up=up) if traced is None else forked(stood(traced, file=str(file)))
    like = said.like or Habit()
    habit = habit_from_tree(tree, like=like)
    habit = Habit(**{**vars(habit), "leaf": said.leaf or like.leaf, "bark": said.bark or like.bark})
    name = said.name or name_of(file)
    hashed = hashlib.sha256(file.read_bytes()).hexdigest()[:12]
    what, frame = ("digitised tree, imported from", f", {up} up") if traced is None else ("traced in the point cloud", "")
    origin = f"{what} {file.name} (sha256 {hashed}, {said.unit}{frame})"
    try:
        exemplar, views = measure(
            tree, name=name, title=said.title or name.replace("_", " "), habit=habit, recipe="",
            source=f"{said.source}; {origin}" if said.source else origin, seed=0, version=__version__, species=said.species,
            growth_habit=said.growth_habit,
        )  # fmt: skip
    except (ValueError, IndexError, FloatingPointError) as error:
        if isinstance(error, SketchTreeError):
            raise
        raise TemplateError(f"{file}: the tree can't be measured ({error}).", remedy="Give a tree with a trunk and limbs.") from error
    return to_columns([exemplar], [views])


def name_of(file: Path) -> str:
    """An exemplar's name from a file's: small letters, digits and _."""
    name = re.sub(r"[^a-z0-9]+", "_", Path(file).stem.lower()).strip("_")
    name = name if name.isidentifier() else f"tree_{name}".rstrip("_")
    return name[:NAME_LENGTH].rstrip("_")


def check_name(name: str) -> str:
    """The name, if it is one. Raises `TemplateError`."""
    if not (name.isidentifier() and name.isascii() and name == name.lower() and len(name) <= NAME_LENGTH):
        raise TemplateError(f"{name!r} is no plain name of an exemplar.", remedy=f"Use small letters, digits and _ (at most {NAME_LENGTH}).")
    return name
