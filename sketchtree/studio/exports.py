"""What does the page get to keep? The tree as files of any kind, its growth, the project, and the command line that makes the same."""

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
from sketchtree.errors import OptionError
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.photo.wanted import PhotoOptions
from sketchtree.studio import messages
from sketchtree.studio.folder import PROJECT
from sketchtree.studio.growth import FILMS, Grown
from sketchtree.studio.making.photo_asked import Wish, is_photo
from sketchtree.studio.underlays import suffix_of

Format = Annotated[str, Meta(pattern=r"^\.[a-z0-9]{1,12}$")]
_LATER = {"reading": ("samples", "alternatives"), "tree": ()}  # options that the tree does not hang on
_THE_DAY = (1980, 1, 1, 0, 0, 0)  # of every file in a ZIP: the first there is


class Export(msgspec.Struct, forbid_unknown_fields=True, frozen=True, kw_only=True):
    """What to export, as `sketchtree build` has it, or `sketchtree grow`."""

    format: Format
    tree: Literal["drawn", "photo"] = "drawn"  # photo: the one of the photo under the page, as `sketchtree photo` makes it of its marks, or `sketchtree grow` of its scribbles
    lod: Annotated[int, Meta(ge=0, le=3)] = 0
    levels: Literal["one", "together", "apart"] = "one"
    leaves: Literal["merged", "instanced"] = "merged"
    pack: Literal["game"] | None = None
    wood: Literal["one-piece", "tubes"] | None = None
    solid: bool = False
    growth: Grown | None = None  # the tree as it grows, animated or as a film; of the options above none counts
    revision: int | None = None  # that the page shows
    id: messages.Id | None = None  # how far it is, is told under this one (`messages.Making`)

    @property
    def options(self) -> dict:
        """What the tree's files hang on, beside the format."""
        return {name: getattr(self, name) for name in ("lod", "levels", "leaves", "pack", "wood", "solid")}


def command_line(document: Document, export: Export) -> str:
    """What makes the same tree of the saved project, or of the photo and the strokes that mark it; every option that is not as by default is spelled out."""
    name = document.name if not document.name.startswith("-") else f"./{document.name}"
    made_anew = document.points.traced or document.trunk.on  # of what its project holds: points, or scribbles
    own = export.tree == "photo" and made_anew
    if export.growth is not None:
        if made_anew != (export.tree == "photo"):
            raise OptionError("No command makes this tree grow: `grow` takes a project's own drawing, its scribbles or its points.", remedy="Save the file here; or export a GLB of the tree, and give that to `grow`.")
        return shlex.join([*_growing(name, export), *(_spelled(_kept_by_none(document.tree), TreeOptions(), ()) if own else [])])
    if own:
        document = document.replace(reading=ReadingOptions(), tree=_kept_by_none(document.tree), seed=0)  # its project says the rest
    wish = Wish.of(document, "") if export.tree == "photo" and not own else None
    tree = document.tree if wish is None else wish.tree
    tree = tree if export.wood is None else dataclasses.replace(tree, wood=export.wood)
    tree = dataclasses.replace(tree, solid=True) if export.solid else tree
    if wish is None:
        words = ["sketchtree", "build", name + PROJECT, "-o", name + export.format, *(["--as-drawn"] if (document.points.traced or is_photo(document.underlay)) and not own else [])] + _spelled(document.reading, ReadingOptions(), _LATER["reading"])
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


def _kept_by_none(tree: TreeOptions) -> TreeOptions:
    """What a tree of scribbles, or of points, hangs on, and its project does not say again to whoever reads it."""
    return TreeOptions(prune=tree.prune, max_segments=tree.max_segments)


def _growing(name: str, export: Export) -> list[str]:
    """`sketchtree grow` of the saved project: the tree as it grows."""
    grown, output = export.growth, name + export.format
    words = ["sketchtree", "grow", name + PROJECT, "-o", output if export.format not in FILMS else name + ".glb"]
    words += ["--movie", output] if export.format in FILMS else []
    said = {"mode": grown.mode, "bend": grown.bend, "seconds": grown.seconds, "lod": grown.lod}
    plain = Grown()
    return words + [word for one, value in said.items() if value != getattr(plain, one) for word in (f"--{one}", value if one == "mode" else f"{value:g}")]


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
