"""What does the page get to keep? The tree as files of any kind, the project, and the command line that makes the same tree."""

import dataclasses
import io
import shlex
import zipfile
from pathlib import PurePosixPath
from typing import Annotated, Literal
from urllib.parse import quote

import msgspec
from msgspec import Meta

from sketchtree.editing.document import Document
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.photo.wanted import PhotoOptions
from sketchtree.studio.folder import PROJECT
from sketchtree.studio.making.photo_asked import Wish, is_photo
from sketchtree.studio.underlays import suffix_of

Format = Annotated[str, Meta(pattern=r"^\.[a-z0-9]{1,12}$")]
_LATER = {"reading": ("samples", "alternatives"), "tree": ()}  # options that the tree does not hang on
_THE_DAY = (1980, 1, 1, 0, 0, 0)  # of every file in a ZIP: the first there is


class Export(msgspec.Struct, forbid_unknown_fields=True, frozen=True, kw_only=True):
    """What to export, as `sketchtree build` has it."""

    format: Format
    tree: Literal["drawn", "photo"] = "drawn"  # photo: the one that grows in the photo under the page, as `sketchtree photo` makes it
    lod: Annotated[int, Meta(ge=0, le=3)] = 0
    levels: Literal["one", "together", "apart"] = "one"
    leaves: Literal["merged", "instanced"] = "merged"
    pack: Literal["game"] | None = None
    wood: Literal["one-piece", "tubes"] | None = None
    solid: bool = False
    revision: int | None = None  # that the page shows

    @property
    def options(self) -> dict:
        """All but the format, the tree and the revision."""
        return {name: getattr(self, name) for name in self.__struct_fields__ if name not in ("format", "tree", "revision")}


def command_line(document: Document, export: Export) -> str:
    """What makes the same tree of the saved project, or of the photo and the strokes that mark it; every option that is not as by default is spelled out."""
    name = document.name if not document.name.startswith("-") else f"./{document.name}"
    wish = Wish.of(document, "") if export.tree == "photo" else None
    tree = document.tree if wish is None else wish.tree
    tree = tree if export.wood is None else dataclasses.replace(tree, wood=export.wood)
    tree = dataclasses.replace(tree, solid=True) if export.solid else tree
    if wish is None:
        words = ["sketchtree", "build", name + PROJECT, "-o", name + export.format, *(["--as-drawn"] if is_photo(document.underlay) else [])] + _spelled(document.reading, ReadingOptions(), _LATER["reading"])
    else:
        words = ["sketchtree", "photo", name + suffix_of(document.underlay.picture), "--strokes", name + ".svg", "-o", name + export.format]
        words += _spelled(wish.reading, ReadingOptions(), _LATER["reading"]) + _of_photo(wish.wanted)
    words += _spelled(tree, TreeOptions(), _LATER["tree"])
    plain = Export(format=export.format)
    for one, value in export.options.items():
        if one not in ("wood", "solid") and value != getattr(plain, one):
            words += [f"--{one}", str(value)]
    if document.seed:
        words += ["--seed", str(document.seed)]
    return shlex.join(words)


def zipped(files: dict[str, bytes]) -> bytes:
    """Several files in one; the same files give the same bytes."""
    whole = io.BytesIO()
    with zipfile.ZipFile(whole, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in sorted(files):
            path = PurePosixPath(name)
            if path.is_absolute() or ".." in path.parts or "\\" in name:
                raise ValueError(f"a file of an export is called {name!r}")
            entry = zipfile.ZipInfo(str(path), _THE_DAY)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, files[name])
    return whole.getvalue()


def disposition(name: str) -> str:
    """`Content-Disposition` of a file to keep, whatever its name is."""
    plain = "".join(letter if letter.isascii() and (letter.isalnum() or letter in "._- ") else "_" for letter in name)
    return f"attachment; filename=\"{plain}\"; filename*=UTF-8''{quote(name, safe='')}"


def _of_photo(wanted: PhotoOptions) -> list[str]:
    """The options of a photo's tree, in the words of `sketchtree photo`."""
    words = _spelled(wanted, PhotoOptions(), ("library", "libraries", "alternate", "bare_as_seen"))
    each = (wanted.library, *wanted.libraries)
    words += [] if each == (PhotoOptions().library,) else [word for names in each for word in ("--library", ",".join(names))]
    return words + ([] if wanted.alternate else ["--image-only"])


def _spelled(options, plain, without: tuple[str, ...]) -> list[str]:
    words: list[str] = []
    for field in dataclasses.fields(options):
        value, name = getattr(options, field.name), f"--{field.name.replace('_', '-')}"
        if field.name in without or value == getattr(plain, field.name):
            continue
        if isinstance(value, bool):
            words.append(name if value else f"--no-{name[2:]}")
        elif isinstance(value, tuple):
            words += [word for one in value for word in (name, one)]
        elif value is not None:
            words += [name, f"{value:g}" if isinstance(value, float) and float(f"{value:g}") == value else str(value)]
    return words
