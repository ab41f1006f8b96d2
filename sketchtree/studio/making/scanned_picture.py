"""What does a point cloud look like, small? From the front, near points over far ones, the far ones fading."""

import numpy as np
from jaxtyping import UInt8

from sketchtree.editing.laid_cloud import LaidCloud

_SIDE, _EDGE = 320, 12  # pixels
_PAPER, _PLAIN = np.array([251.0, 249.0, 244.0]), np.array([116.0, 108.0, 96.0])
_FAR = 0.6  # of the paper's colour in the farthest


def scanned_picture(cloud: LaidCloud) -> UInt8[np.ndarray, "row column 3"]:
    """It, as pixels."""
    points = cloud.cloud
    low, high = points.xyz.min(axis=0), points.xyz.max(axis=0)
    scale = (_SIDE - 2 * _EDGE) / max(high[0] - low[0], high[1] - low[1])
    aside = (_SIDE - scale * (high[0] - low[0])) / 2
    row = (_SIDE - _EDGE - scale * (points.xyz[:, 1] - low[1])).astype(int)
    column = (aside + scale * (points.xyz[:, 0] - low[0])).astype(int)
    far = (_FAR * (high[2] - points.xyz[:, 2]) / max(high[2] - low[2], 1e-9))[:, None]
    colour = np.full((len(far), 3), _PLAIN) if points.colour is None else 255 * points.colour
    picture = np.tile(_PAPER, (_SIDE, _SIDE, 1))
    order = np.argsort(points.xyz[:, 2], kind="stable")
    picture[row[order].clip(0, _SIDE - 1), column[order].clip(0, _SIDE - 1)] = (colour + far * (_PAPER - colour))[order]
    return np.round(picture).astype(np.uint8)
