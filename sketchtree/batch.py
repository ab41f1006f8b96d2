"""Which drawings does a batch build, and what is each of its files called?

Names follow the drawings: sub-folders are kept from where the patterns' own wildcards begin, so that a name doesn't depend on what else
is in a folder.

    'sketches/*.svg'      sketches/oak.svg         DIR/oak.glb       DIR/oak.report.json
    'sketches/**/*.svg'   sketches/a/oak.svg       DIR/a/oak.glb     DIR/a/oak.report.json
    sketches (a folder)   oak.svg, oak.png in it   DIR/oak.svg.glb, DIR/oak.png.glb: each with its extension, where two would be one
"""

import glob
import os
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from sketchtree.errors import OptionError
from sketchtree.options import FileOptions, ReadingOptions, TreeOptions
from sketchtree.sketch.formats import READABLE
from sketchtree.tree_files import TreeFiles, tree_files

SUMMARY, TABLE = "batch.json", "batch.csv"
_WRITTEN = (".json", ".png", ".jpg")  # what a batch writes and a drawing may be: in DIR itself it is no drawing
_SEVERAL = "Put a pattern in quotes, such as 'sketches/**/*.svg', or name a folder of drawings."


@dataclass(frozen=True)
class Manner:
    """What all trees of a batch have in common."""

    out: str  # DIR, as the user wrote it
    root: str  # absolute; where the user's relative paths begin
    kind: str  # extension of what is written of each tree, without its dot
    seed: int
    reading: ReadingOptions
    tree: TreeOptions
    db: str | None = None
    skeleton: bool = False  # NAME.swc beside it
    preview: bool = False  # NAME.png beside it
    files: FileOptions = FileOptions()
    made_by: str = ""  # hash of the options, the seed, the program and the files they name


@dataclass(frozen=True)
class TreeOrder:
    """One drawing of which a tree is to be made."""

    sketch: str  # as found
    name: str  # within DIR, without extension
    manner: Manner

    @property
    def output(self) -> Path:
        """The tree as `build -o` would name it."""
        return self._named(f".{self.manner.kind}")

    @property
    def tree(self) -> TreeFiles:
        """What the tree becomes."""
        return tree_files(self.output, self.manner.files)

    @property
    def report(self) -> Path:
        return self._named(".report.json")

    @property
    def skeleton(self) -> Path | None:
        return self._named(".swc") if self.manner.skeleton else None

    @property
    def preview(self) -> Path | None:
        return self._named(".png") if self.manner.preview else None

    @property
    def files(self) -> tuple[Path, ...]:
        """All that may be written, the report last."""
        return (*self.tree.all, *self._beside)

    @property
    def sure(self) -> tuple[Path, ...]:
        """All that is written in any case, the report last."""
        return (*self.tree.sure, *self._beside)

    @property
    def _beside(self) -> tuple[Path, ...]:
        return tuple(path for path in (self.skeleton, self.preview, self.report) if path is not None)

    def at(self, path: Path | str) -> Path:
        """The same path, wherever the program runs."""
        return Path(self.manner.root) / path

    def _named(self, ending: str) -> Path:
        return Path(self.manner.out) / (self.name + ending)


def orders(patterns: Sequence[str], manner: Manner) -> tuple[list[TreeOrder], int]:
    """An order for every drawing that the patterns match, sorted, and how many other files they match.

    A pattern is a file (FILE#N: the N-th drawing in it), a folder, or has wildcards (`*`, `?`, `[…]`; `**` for any folders). Raises OptionError for one without a drawing.
    """
    found, passed, bases = {}, 0, []
    for pattern in map(os.path.expanduser, patterns):
        files, base = _matched(pattern)
        drawings = [file for file in files if file == pattern or Path(file).suffix.lower() in READABLE]
        ours = [file for file in drawings if not _is_ours(file, manner)]
        if not ours:
            raise _nothing(pattern, files, drawings, manner.out)
        found |= dict.fromkeys(ours)
        passed += len(files) - len(ours)
        bases.append(os.path.abspath(base))
    sketches = sorted(found, key=lambda file: Path(file).parts)
    names = _distinct([os.path.relpath(os.path.abspath(_page(file)), os.path.commonpath(bases)) for file in sketches], manner)
    return [TreeOrder(sketch, name, manner) for sketch, name in zip(sketches, names, strict=True)], passed


def check_manner(manner: Manner) -> None:
    """Raise OptionError for what can't be written, before any work."""
    for kind, beside in (("swc", manner.skeleton and "--skeleton"), ("png", manner.preview and "--preview")):
        if beside and manner.kind == kind:
            raise OptionError(f"`{beside}` and `--format {kind}` would write the same files.", remedy=f"Leave {beside} out.")
    if os.path.exists(manner.out) and not os.path.isdir(manner.out):
        raise OptionError(f"`--out {manner.out}` is a file.", remedy="Name a folder; it is made if there is none.")


def check_free(wanted: Sequence[TreeOrder]) -> None:
    """Raise OptionError where a file that would be written is there already."""
    held = [order for order in wanted if any(map(os.path.lexists, order.files))]
    if not held:
        return
    first = next(path for path in held[0].files if os.path.lexists(path))
    raise OptionError(
        f"There are files already of {len(held)} of the {len(wanted)} trees, such as {first}.",
        remedy="With --resume those made of the same drawings by the same options are kept and the others are made anew; or name another --out.",
    )


def drawing_file(sketch: str) -> tuple[str, str]:
    """The file of a drawing, and which of it: ("tree.ndjson", "3") of "tree.ndjson#3"."""
    file, mark, number = sketch.rpartition("#")
    return (file, number) if mark and number.isdecimal() and not os.path.exists(sketch) else (sketch, "")


def _page(sketch: str) -> str:
    """What a drawing of several in a file is named after: tree-3.ndjson."""
    file, number = drawing_file(sketch)
    stem, extension = os.path.splitext(file)
    return f"{stem}-{number}{extension}" if number else file


def _matched(pattern: str) -> tuple[list[str], str]:
    """The files of one pattern, and the folder from which their names count."""
    if os.path.isdir(pattern):
        return [str(path) for path in Path(pattern).iterdir() if path.is_file() and not path.name.startswith(".")], pattern
    if os.path.isfile(drawing_file(pattern)[0]):
        return [pattern], os.path.dirname(pattern)
    parts = Path(pattern).parts
    fixed = next((k for k, part in enumerate(parts) if glob.has_magic(part)), len(parts) - 1)
    return [file for file in glob.glob(pattern, recursive=True) if os.path.isfile(file)], os.path.join("", *parts[:fixed])


def _is_ours(file: str, manner: Manner) -> bool:
    """Whether a batch into the same folder may have written it."""
    return Path(file).suffix.lower() in _WRITTEN and Path(file).resolve().is_relative_to(Path(manner.out).resolve())


def _nothing(pattern: str, files: list[str], drawings: list[str], out: str) -> OptionError:
    if drawings:
        return OptionError(f"All drawings that `{pattern}` matches lie in `--out {out}` itself, among the results.", remedy="Name another folder for --out.")
    if files:
        count = "one file" if len(files) == 1 else f"{len(files)} files"
        return OptionError(f"`{pattern}` matches {count}, but no drawing.", remedy=f"Drawings are {', '.join(READABLE)}.")
    what = "is a folder without a drawing" if os.path.isdir(pattern) else "matches no file"
    return OptionError(f"`{pattern}` {what}.", remedy=_SEVERAL)


def _distinct(paths: list[str], manner: Manner) -> list[str]:
    """A name for each path, without its extension where that leaves them apart: no two write the same file, on any disk."""
    plain = [os.path.splitext(path)[0] for path in paths]
    count = Counter(file for name in plain for file in _written(name, manner))
    taken = {SUMMARY, TABLE}
    alone = [all(count[file] == 1 and file not in taken for file in _written(name, manner)) for name in plain]
    taken |= {file for name, free in zip(plain, alone, strict=True) if free for file in _written(name, manner)}
    names = []
    for path, name, free in zip(paths, plain, alone, strict=True):
        turn, candidate = 1, name if free else path
        while not free and taken & _written(candidate, manner):
            turn, candidate = turn + 1, f"{path}-{turn + 1}"
        taken |= _written(candidate, manner)
        names.append(candidate)
    return names


def _written(name: str, manner: Manner) -> set[str]:
    """What a tree of that name writes into DIR, capitals aside."""
    return {os.path.relpath(file, manner.out).casefold() for file in TreeOrder("", name, manner).files}
