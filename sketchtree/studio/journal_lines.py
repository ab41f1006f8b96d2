"""What does the journal say of a step? One JSON object a line; played from the first, they give the drawing with all its steps.

    begin     the drawing that the steps start from         picture   the bytes of a picture to trace over, or of points behind the drawing, once
    step      what a step changed, and what undo calls it   keep      where the depths have settled since
    back, on  undo, redo
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import msgspec
import numpy as np
from msgspec import UNSET, UnsetType

from sketchtree.editing import kept
from sketchtree.editing.document import Document, Underlay
from sketchtree.editing.edits import Edits
from sketchtree.editing.laid_cloud import CloudChoices, LaidCloud
from sketchtree.editing.settled import Depths, Settled
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.photo.wanted import PhotoOptions
from sketchtree.sketch.strokes import Stroke
from sketchtree.studio import wire
from sketchtree.studio.change import Change, apply, change
from sketchtree.trunk.wanted import TrunkChoices

VERSION = 1
_PLAIN = ("edits", "reading", "tree", "photo", "trunk", "points", "seed", "name", "units", "page", "warnings")  # fields that are written as they are


class _Line(msgspec.Struct, forbid_unknown_fields=True, frozen=True, kw_only=True, omit_defaults=True):
    """Fields by name; any other is refused."""


class _Placed(_Line):
    digest: str
    x: float
    y: float
    width: float
    height: float
    opacity: float
    photo: bool = False


class _Laid(_Line):
    digest: str
    coloured: bool
    x: float
    y: float
    unit: float
    trunk: float = 0.0
    remarks: tuple[str, ...] = ()


class _Resettled(_Line):
    rest: dict[str, Any]  # all but its limbs, as a project has it
    put: dict[int, Depths] = {}
    gone: list[int] = []
    order: list[int] | None = None  # of all limbs, where `put` and `gone` alone don't give it


class Different(_Line):
    """A `Change` that can be written down."""

    put: list[Stroke] = []
    gone: list[str] = []
    order: list[str] | None = None
    edits: Edits | UnsetType = UNSET
    settled: _Resettled | UnsetType = UNSET
    reading: ReadingOptions | UnsetType = UNSET
    tree: TreeOptions | UnsetType = UNSET
    photo: PhotoOptions | UnsetType = UNSET
    trunk: TrunkChoices | UnsetType = UNSET
    seed: int | UnsetType = UNSET
    underlay: _Placed | None | UnsetType = UNSET
    cloud: _Laid | None | UnsetType = UNSET
    points: CloudChoices | UnsetType = UNSET
    name: str | UnsetType = UNSET
    units: str | UnsetType = UNSET
    page: tuple[float, float, float, float] | None | UnsetType = UNSET
    warnings: tuple[str, ...] | UnsetType = UNSET


class Begin(_Line, tag="begin"):
    """The first line."""

    version: int
    document: Different
    saved: bool  # as in its file
    signature: tuple[int, int] | None  # of the file as it was then: when it was written (ns), bytes; None: there was none


class Picture(_Line, tag="picture"):
    """A picture to trace over, or points behind the drawing, before the first line that names it."""

    digest: str
    data: bytes


class Step(_Line, tag="step"):
    """A step was done."""

    label: str
    different: Different
    merges: bool = False  # with that before


class Keep(_Line, tag="keep"):
    """The depths have settled; no step."""

    different: Different


class Back(_Line, tag="back"):
    """Undo."""


class On(_Line, tag="on"):
    """Redo."""


Line = Begin | Picture | Step | Keep | Back | On


def different(old: Document, new: Document) -> Different:
    """What makes `new` of `old`, to be written down."""
    return told(old, change(old, new), new)


def told(old: Document, what: Change, new: Document) -> Different:
    """A change from `old` to `new`, to be written down."""
    said: dict[str, Any] = {name: what.others[name] for name in _PLAIN if name in what.others}
    if "settled" in what.others:
        said["settled"] = _resettled(old.settled, new.settled)
    if "underlay" in what.others:
        said["underlay"] = _placed(new.underlay)
    if "cloud" in what.others:
        said["cloud"] = _laid(new.cloud)
    return Different(put=list(what.put.values()), gone=list(what.gone), order=None if what.order is None else list(what.order), **said)


def differing(document: Document, said: Different, pictures: Mapping[str, bytes]) -> Document:
    """The document after what was written down. Raises KeyError where a picture or a stroke is missing."""
    others = {name: getattr(said, name) for name in _PLAIN if getattr(said, name) is not UNSET}
    if said.settled is not UNSET:
        limbs = _mixed(document.settled.limbs, said.settled.put, said.settled.gone)
        limbs = limbs if said.settled.order is None else {limb: limbs[limb] for limb in said.settled.order}
        others["settled"] = replace(kept.reading(kept.settled_from_json, said.settled.rest), limbs=limbs)
    if said.underlay is not UNSET:
        place = said.underlay
        others["underlay"] = place and Underlay(pictures[place.digest], place.x, place.y, place.width, place.height, place.opacity, place.photo)
    if said.cloud is not UNSET:
        laid = said.cloud
        others["cloud"] = laid and LaidCloud(pictures[laid.digest], laid.coloured, laid.x, laid.y, laid.unit, laid.trunk, laid.remarks)
    order = None if said.order is None else tuple(said.order)
    return apply(document, Change({stroke.id: stroke for stroke in said.put}, tuple(said.gone), order, others))


def encode(line: Line) -> bytes:
    """One line, with its end."""
    return _ENCODER.encode(line) + b"\n"


def decode(text: bytes) -> Line:
    """Raises msgspec.MsgspecError, or SketchTreeError where a stroke or an option is none."""
    return _DECODER.decode(text)


def _resettled(old: Settled, new: Settled) -> _Resettled:
    put = {limb: depths for limb, depths in new.limbs.items() if old.limbs.get(limb) is not depths}
    gone, order = [limb for limb in old.limbs if limb not in new.limbs], list(new.limbs)
    as_it_is = order == list(_mixed(old.limbs, put, gone))
    return _Resettled(rest=kept.settled_as_json(replace(new, limbs={})), put=put, gone=gone, order=None if as_it_is else order)


def _mixed(limbs: Mapping[int, Depths], put: Mapping[int, Depths], gone: list[int]) -> dict[int, Depths]:
    left = set(gone)
    return {limb: depths for limb, depths in limbs.items() if limb not in left} | put


def _placed(underlay: Underlay | None) -> _Placed | None:
    if underlay is None:
        return None
    place = (underlay.x, underlay.y, underlay.width, underlay.height, underlay.opacity)
    return _Placed(digest=wire.digest(underlay.picture), photo=underlay.photo, **dict(zip(("x", "y", "width", "height", "opacity"), map(float, place))))


def _laid(cloud: LaidCloud | None) -> _Laid | None:
    return cloud and _Laid(digest=cloud.digest, coloured=cloud.coloured, trunk=float(cloud.trunk), remarks=cloud.remarks, **dict(zip(("x", "y", "unit"), map(float, cloud.place))))


def _plain(value: Any) -> Any:
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    raise TypeError(f"the journal has no word for {type(value).__name__}")


def _array(kind: type, value: Any) -> Any:
    if isinstance(value, list):
        return np.array(value, np.float64)  # what is unknown, NaN, is written as null, and comes back
    raise TypeError(f"the journal has no {kind}")


_ENCODER = msgspec.json.Encoder(enc_hook=_plain)
_DECODER = msgspec.json.Decoder(Line, dec_hook=_array)
