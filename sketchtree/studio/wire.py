"""How does what the page says become a document, and a document what the page is told? On the wire y points down, in a document up."""

import dataclasses
import hashlib
from functools import lru_cache

import msgspec
import numpy as np

from sketchtree.editing.document import Document, Underlay
from sketchtree.editing.edits import Edits
from sketchtree.editing.laid_cloud import CloudChoices, LaidCloud
from sketchtree.errors import OptionError, SketchError
from sketchtree.sketch.strokes import Stroke, StrokeKind
from sketchtree.studio import messages
from sketchtree.studio.change import Change
from sketchtree.trunk.wanted import TrunkChoices

_READING = ("template", "theta", "height", "planar", "crown")
_TREE = {name: name for name in ("generations", "fill", "density", "light", "leaf", "bark", "season")} | {"gravity": "sag"}
_PHOTO = ("foliage", "library", "alternate", "colours", "leaf_size", "leaf_density", "leaf_arrangement", "bark_colour")
_DOWN = np.array([1.0, -1.0])
_AGAIN = "Draw it again."


def stroke_in(said: messages.Stroke, old: Stroke | None = None) -> Stroke:
    """A stroke as the page says it; what a page can't say of one that was there before (`old`: its layer, its paint) stays. Raises SketchError."""
    points = np.array(said.xy, np.float64)
    if len(points) % 2:
        raise SketchError("it has an x without a y.", stroke=said.id, remedy=_AGAIN)
    points = points.reshape(-1, 2)
    for name, column in (("pressures", said.pressure), ("times", said.time)):
        if column is not None and len(column) != len(points):
            raise SketchError(f"it has {len(points)} points and {len(column)} {name}.", stroke=said.id, remedy=_AGAIN)
    kind = StrokeKind(said.kind)
    kept = {} if old is None else {"filled": old.filled, "wood": old.wood, "layer": old.layer}
    return Stroke(
        said.id, flipped(points), kind,
        labelled=old.labelled if old is not None and old.kind == kind else True,
        closed=said.closed, width=said.width, view_deg=said.view_deg,
        pressure=None if said.pressure is None else np.array(said.pressure, np.float64),
        time=None if said.time is None else np.array(said.time, np.float64),
        **kept,
    )  # fmt: skip


def stroke_out(stroke: Stroke) -> messages.Stroke:
    """A stroke as the page is told."""
    return messages.Stroke(
        id=stroke.id, kind=stroke.kind.value, xy=flipped(stroke.points).ravel().tolist(),
        pressure=None if stroke.pressure is None else np.asarray(stroke.pressure, np.float64).tolist(),
        time=None if stroke.time is None else np.asarray(stroke.time, np.float64).tolist(),
        width=None if stroke.width is None else float(stroke.width), closed=bool(stroke.closed), view_deg=float(stroke.view_deg),
    )  # fmt: skip


def flipped(points: np.ndarray) -> np.ndarray:
    """Points with y the other way; no zero becomes a negative one."""
    return points * _DOWN + 0.0


def options_out(document: Document) -> messages.Options:
    """The options as the page is told."""
    said = {name: getattr(document.reading, name) for name in _READING}
    said |= {name: getattr(document.tree, own) for name, own in _TREE.items()}
    said |= {name: getattr(document.photo, name) for name in _PHOTO} | {"library": ",".join(document.photo.library)}
    return messages.Options(seed=document.seed, **said)


def choose(document: Document, options: dict) -> Document:
    """The document with other options, those named as in `messages.Options`. Raises OptionError."""
    unknown = next((name for name in options if name not in messages.Options.__struct_fields__), None)
    if unknown is not None:
        raise OptionError("There is no option of that name.", remedy=f"The options are {', '.join(messages.Options.__struct_fields__)}.")
    whole = {name: getattr(options_out(document), name) for name in messages.Options.__struct_fields__} | options
    try:
        said = msgspec.convert(whole, messages.Options)
    except msgspec.ValidationError as error:
        what, _, name = str(error).partition(" - at `$.")
        raise OptionError(f"The option {name.rstrip('`') or 'given'} can't be that: {_small(what)}.", remedy="Choose another value.") from None
    reading = dataclasses.replace(document.reading, **{name: getattr(said, name) for name in _READING if name in options})
    tree = dataclasses.replace(document.tree, **{own: getattr(said, name) for name, own in _TREE.items() if name in options})
    named = {name: getattr(said, name) for name in _PHOTO if name in options}
    photo = dataclasses.replace(document.photo, **named | ({"library": tuple(dict.fromkeys(said.library.split(",")))} if "library" in named else {}))
    return document.replace(reading=reading, tree=tree, photo=photo, seed=said.seed)


def trunk_out(trunk: TrunkChoices) -> messages.Trunk:
    """How the tree is taken from scribbles, as the page is told."""
    return msgspec.convert(dataclasses.asdict(trunk), messages.Trunk)


def trunk_in(said: messages.Trunk) -> TrunkChoices:
    """And as the page says it. Raises OptionError."""
    return TrunkChoices(**{name: getattr(said, name) for name in messages.Trunk.__struct_fields__})


def edits_out(edits: Edits) -> list[messages.Edit]:
    """What was done to the tree by hand, for the page's list."""
    held = [messages.Edit(what="held", limb=str(one.limb), share=np.asarray(one.share).tolist(), depth=np.asarray(one.depth).tolist()) for one in edits.held.values()]
    adopted = [messages.Edit(what="adopted", limb=str(limb)) for limb in edits.adopted]
    return [*held, *adopted, *(messages.Edit(what="cleared", limb=str(limb)) for limb in edits.cleared)]


def underlay_out(underlay: Underlay | None) -> messages.Underlay | None:
    """The picture to trace over as the page is told."""
    if underlay is None:
        return None
    return messages.Underlay(
        digest=digest(underlay.picture), x=underlay.x, y=0.0 - underlay.y, width=underlay.width, height=underlay.height, opacity=underlay.opacity,
        photo=underlay.photo,
    )  # fmt: skip


def underlay_in(said: messages.Underlay, picture: bytes) -> Underlay:
    """The picture to trace over, at its place."""
    return Underlay(picture, said.x, 0.0 - said.y, said.width, said.height, said.opacity, said.photo)


def cloud_out(cloud: LaidCloud | None) -> messages.Cloud | None:
    """The points behind the drawing as the page is told."""
    if cloud is None:
        return None
    return messages.Cloud(
        digest=cloud.digest, x=cloud.x, y=0.0 - cloud.y, unit=cloud.unit, count=len(cloud), coloured=cloud.coloured, height=cloud.height, remarks=list(cloud.remarks)
    )  # fmt: skip


def cloud_in(said: messages.Cloud, cloud: LaidCloud) -> LaidCloud:
    """These points, at the place that the page says."""
    return dataclasses.replace(cloud, x=said.x, y=0.0 - said.y, unit=said.unit)


def points_out(points: CloudChoices) -> messages.Points:
    """How they are seen and used, as the page is told."""
    return msgspec.convert(dataclasses.asdict(points), messages.Points)


def points_in(said: messages.Points) -> CloudChoices:
    """And as the page says it. Raises OptionError."""
    return CloudChoices(said.shown, said.size, said.traced, said.turn)


@lru_cache(maxsize=8)
def digest(picture: bytes) -> str:
    """What a picture is known by."""
    return hashlib.sha256(picture).hexdigest()[:32]


def changed(what: Change, document: Document, since: int, revision: int, **state) -> messages.Changed:
    """The message of a change that led to this document; `state` is undo, redo, saved."""
    others = what.others
    return messages.Changed(
        since=since, revision=revision,
        put=[stroke_out(stroke) for stroke in what.put.values()], gone=list(what.gone), order=None if what.order is None else list(what.order),
        options=options_out(document) if others.keys() & {"reading", "tree", "photo", "seed"} else None,
        edits=edits_out(document.edits) if "edits" in others else None,
        trunk=trunk_out(document.trunk) if "trunk" in others else None,
        underlay=underlay_out(document.underlay) if "underlay" in others else None, underlay_changed="underlay" in others,
        cloud=cloud_out(document.cloud) if "cloud" in others else None, cloud_changed="cloud" in others,
        points=points_out(document.points) if "points" in others else None,
        name=document.name if "name" in others else None, **state,
    )  # fmt: skip


def whole(document: Document, revision: int, **state) -> messages.Changed:
    """The message that tells everything."""
    return messages.Changed(
        since=0, revision=revision, put=[stroke_out(stroke) for stroke in document.strokes.values()], options=options_out(document),
        edits=edits_out(document.edits), trunk=trunk_out(document.trunk), underlay=underlay_out(document.underlay), underlay_changed=True,
        cloud=cloud_out(document.cloud), cloud_changed=True, points=points_out(document.points), name=document.name, **state,
    )  # fmt: skip


def _small(text: str) -> str:
    return text[:1].lower() + text[1:]
