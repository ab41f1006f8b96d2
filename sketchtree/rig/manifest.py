"""What is in a game pack, as JSON: `NAME.pack.json`, format 1, held by `pack.schema.json`.

Metres, y up, right-handed, as in the files; a missing parent or bone is null.
"""

import dataclasses
import json
from collections.abc import Mapping
from importlib.resources import files

import numpy as np

from sketchtree.asset import Asset, Capsules
from sketchtree.rig.capsules import Fitted
from sketchtree.rig.engines import notes
from sketchtree.rig.pivots import Pivots
from sketchtree.rig.rigging import Rigging
from sketchtree.rig.sway import Sway
from sketchtree.version import __version__

FORMAT = 1
_WHERE = {  # in the order of COLOR_1
    "sway": ("TEXCOORD_2", 0),
    "branch": ("TEXCOORD_2", 1),
    "phase": ("TEXCOORD_3", 0),
    "flutter": ("TEXCOORD_3", 1),
}


def pack_schema() -> dict:
    """The JSON schema every manifest satisfies."""
    return json.loads(files("sketchtree.rig").joinpath("pack.schema.json").read_text())


def manifest(asset: Asset, rigging: Rigging, fitted: Fitted, roles: Mapping[str, str], impostor_triangles: int | None) -> dict:
    """The manifest of a pack; `roles` are the files' names and what each is for."""
    return {
        "sketchtree_pack": FORMAT,
        "version": __version__,
        "name": asset.name,
        "units": "metres, y up, right-handed",
        "about": asset.about,
        "files": [{"name": name, "role": role} for name, role in roles.items()],
        "levels": _levels(asset, roles),
        "impostor": None if impostor_triangles is None else {"triangles": impostor_triangles},
        "bounds": _bounds(asset),
        "wind": _wind(asset, rigging),
        "bones": _bones(asset),
        "capsules": {"thinnest": _short(fitted.thinnest), "loose": _short(fitted.loose), "rows": _capsules(fitted.capsules, asset)},
        "pivots": _pivots(rigging.pivots),
        "engines": notes(),
    }


def _levels(asset: Asset, roles: Mapping[str, str]) -> list[dict]:
    names = [name for name, role in roles.items() if role.startswith("level")]
    rows = []
    for name, level in zip(names, asset.levels, strict=True):
        leaf = sum(part.triangle_count for part in level.parts if part.name.startswith("leaf"))
        rows.append({"file": name, "coverage": float(level.coverage), "triangles": {"wood": level.triangle_count - leaf, "leaf": leaf}})
    return rows


def _bounds(asset: Asset) -> dict:
    points = np.vstack([part.position[np.unique(part.triangle)] for part in asset.parts])
    return {"min": _short(points.min(axis=0)), "max": _short(points.max(axis=0))}


def _wind(asset: Asset, rigging: Rigging) -> dict:
    wind = np.vstack([part.extra["COLOR_1"] for part in asset.parts])
    channels = {
        name: {"texture_set": texture_set, "component": component, "color_component": k, "min": _short(wind[:, k].min()), "max": _short(wind[:, k].max())}
        for k, (name, (texture_set, component)) in enumerate(_WHERE.items())
    }
    amounts = {"ground": rigging.wind.ground, "height": rigging.wind.height, "reach": rigging.wind.reach}
    return {"color_set": "COLOR_1", "channels": channels} | {name: _short(value) for name, value in amounts.items()} | {"formula": dataclasses.asdict(Sway())}


def _bones(asset: Asset) -> list[dict]:
    bones = asset.armature
    rows = zip(bones.name, bones.parent.tolist(), bones.position, bones.rotation, bones.length, strict=True)
    return [
        {"name": name, "parent": None if above < 0 else bones.name[above], "position": _short(place), "rotation": _short(turn), "length": _short(length)}
        for name, above, place, turn, length in rows
    ]


def _capsules(capsules: Capsules, asset: Asset) -> list[dict]:
    rows = zip(capsules.start, capsules.end, capsules.radius, capsules.joint.tolist(), strict=True)
    return [
        {"start": _short(start), "end": _short(end), "radius": _short(radius), "bone": None if joint < 0 else asset.armature.name[joint]}
        for start, end, radius, joint in rows
    ]


def _pivots(found: Pivots) -> dict:
    return {
        "texture_set": "TEXCOORD_1",
        "size": list(found.size),
        "parent": [None if above < 0 else above for above in found.parent.tolist()],
        "position": _short(found.position),
        "axis": _short(found.axis),
        "extent": _short(found.extent),
    }


def _short(value):
    """Numbers with six digits after the point, as a person would write them."""
    return (np.round(np.asarray(value, float), 6) + 0.0).tolist()
