"""Which projects keep no tree, since it is made anew of what they hold? Scribbles on a photo, and points that a tree stands in."""

from pathlib import Path

from sketchtree.errors import OptionError
from sketchtree.sketch.files.project import holds_scribbles, holds_traced

_BUILD = "`sketchtree build {name} -o TREE.glb` makes its tree."


def is_made_anew(path: Path) -> bool:
    """Is it such a project?"""
    return holds_scribbles(path) or holds_traced(path)


def refuse(sketches: tuple[Path, ...], command: str, remedy: str = _BUILD) -> None:
    """Refuse such projects, of commands that read drawings alone; `remedy`: for scribbles, `{name}` in it is the project's. Raises OptionError."""
    for path in sketches:
        if holds_scribbles(path):
            raise OptionError(f"The tree of {path.name} is taken from scribbles on its photo, and `{command}` reads drawings.", remedy=remedy.format(name=path.name))
        if holds_traced(path):
            raise OptionError(f"The tree of {path.name} is traced in the points behind its drawing, and `{command}` reads drawings.", remedy=_BUILD.format(name=path.name))


def grown(source: Path, db: Path | None, **wanted):
    """(its tree, with its `model` and `warnings`; the seed in use), of commands that show or write it as it is; as `scribbled.grown` and `traced.grown`."""
    from sketchtree.commands import scribbled, traced

    return (scribbled if holds_scribbles(source) else traced).grown(source, db, **wanted)
