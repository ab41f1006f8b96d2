"""How joints and morphs move, in glTF's words: a sampler and a channel a track.

All tables of one kind lie one after the other in one buffer view, as an accessor each: thousands of joints make thousands of them.
"""

import numpy as np

from sketchtree.asset import Animation, Keys
from sketchtree.export.gltf.tables import Tables


def animation_entry(tables: Tables, animation: Animation, first: int, nodes: dict[int, int]) -> dict:
    """The animation; joints are the nodes from `first` on, `nodes` the node of each part that has a morph."""
    entry = {"name": animation.name, "samplers": [], "channels": []}
    for path in ("translation", "rotation", "scale"):
        keys = getattr(animation, path)
        if len(keys):
            times, values = _times(tables, keys), _values(tables, keys)
            for track, joint in enumerate(keys.joint.tolist()):
                _add(entry, times[track], values[track], first + joint, path)
    for morph in animation.morphs:
        if morph.part in nodes:
            time, weight = morph.time.astype("<f4"), morph.weight.astype("<f4")
            _add(entry, tables.column(time, None, bounds=True), tables.column(weight, None), nodes[morph.part], "weights")
    return entry


def _add(entry: dict, time: int, value: int, node: int, path: str) -> None:
    entry["channels"].append({"sampler": len(entry["samplers"]), "target": {"node": node, "path": path}})
    entry["samplers"].append({"input": time, "output": value})


def _times(tables: Tables, keys: Keys) -> list[int]:
    """An accessor of times for each track, one for all that have the same."""
    time = keys.time.astype("<f4")
    view = tables.view(time.tobytes())
    known, found = {}, []
    for low, high in zip(keys.start[:-1].tolist(), keys.start[1:].tolist(), strict=True):
        own = time[low:high]
        key = own.tobytes()
        if key not in known:
            known[key] = _accessor(tables, view, low, own)
            tables.accessors[known[key]] |= {"min": [float(own[0])], "max": [float(own[-1])]}
        found.append(known[key])
    return found


def _values(tables: Tables, keys: Keys) -> list[int]:
    value = keys.value.astype("<f4")
    view = tables.view(value.tobytes())
    return [_accessor(tables, view, low, value[low:high]) for low, high in zip(keys.start[:-1].tolist(), keys.start[1:].tolist(), strict=True)]


def _accessor(tables: Tables, view: int, row: int, rows) -> int:
    width = rows.shape[1] if rows.ndim == 2 else 1
    kind = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}[width]
    tables.accessors.append({"bufferView": view, "byteOffset": 4 * width * row, "componentType": 5126, "count": len(rows), "type": kind})
    return len(tables.accessors) - 1
