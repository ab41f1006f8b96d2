"""How do the joints of a glTF file move? Its first animation, read back.

Step and cubic samplers are read as lines between their values; channels of nodes that are neither joints nor parts are passed over.
"""

from collections.abc import Sequence

import numpy as np

from sketchtree.asset import Animation, Keys, Morph
from sketchtree.export.gltf.document import Document

_WIDTH = {"translation": 3, "rotation": 4, "scale": 3}


def read_animation(document: Document, joints: Sequence[int], parts: Sequence[int]) -> Animation | None:
    """`joints`: the node of each joint; `parts`: the node of each part of the finest level. None: nothing moves."""
    found = document.content.get("animations")
    if not found:
        return None
    entry = found[0]
    tracks = [(channel["target"], *_sampled(document, entry["samplers"][channel["sampler"]])) for channel in entry["channels"] if "node" in channel["target"]]
    place = {node: number for number, node in enumerate(joints)}
    keys = {path: _keys([(place[of["node"]], time, value) for of, time, value in tracks if of["path"] == path and of["node"] in place], width) for path, width in _WIDTH.items()}
    morphs = tuple(_morph(document, parts, of["node"], time, value) for of, time, value in tracks if of["path"] == "weights" and of["node"] in parts)
    return Animation(entry.get("name", "animation"), max((float(time[-1]) for _, time, _ in tracks), default=0.0), **keys, morphs=morphs)


def _sampled(document: Document, sampler: dict):
    time, value = document.column(sampler["input"])[:, 0], document.column(sampler["output"])
    if sampler.get("interpolation") == "CUBICSPLINE":
        value = value[1::3]
    return time.astype(float), value.astype(float)


def _keys(tracks: list, width: int) -> Keys:
    if not tracks:
        return Keys(np.zeros(0, np.int64), np.zeros(1, np.int64), np.zeros(0), np.zeros((0, width)))
    joint, time, value = zip(*tracks, strict=True)
    return Keys(np.array(joint), np.r_[0, np.cumsum([len(one) for one in time])], np.concatenate(time), np.concatenate(value))


def _morph(document: Document, parts: Sequence[int], node: int, time, value) -> Morph:
    """The first of the node's targets."""
    mesh = document.content["meshes"][document.content["nodes"][node]["mesh"]]
    targets = mesh["primitives"][0]["targets"]
    offset = document.column(targets[0]["POSITION"])
    return Morph(list(parts).index(node), offset, time, value.reshape(len(time), -1)[:, 0])
