"""One mesh at many places: EXT_mesh_gpu_instancing.

A reader that does not know it would draw the mesh once, at the origin; hence it is listed as required too. Turns are
normalised 16-bit quaternions (0.003° apart). The tint of a place is `_COLOR_0`, the attribute that three.js reads as
the instance's colour; other readers pass over what begins with `_`.
"""

import numpy as np

from sketchtree.export.gltf.tables import Tables, as_bytes
from sketchtree.geometry.instances import Instances

EXTENSION = "EXT_mesh_gpu_instancing"


def instancing(tables: Tables, places: Instances) -> dict:
    """The `extensions` of the node that draws the mesh at all its places."""
    attributes = {
        "TRANSLATION": tables.column(places.translation.astype("<f4"), None),
        "ROTATION": tables.column(_shorts(places.rotation), None, normalized=True),
        "SCALE": tables.column(places.scale.astype("<f4"), None),
    }
    if places.color is not None:
        attributes["_COLOR_0"] = tables.column(as_bytes(places.color), None, normalized=True)
    return {tables.use(EXTENSION, required=True): {"attributes": attributes}}


def _shorts(turn):
    turn = turn / np.maximum(np.linalg.norm(turn, axis=1, keepdims=True), 1e-12)
    return np.round(turn * 32767.0).astype("<i2")
