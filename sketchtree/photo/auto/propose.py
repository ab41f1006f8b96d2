"""Which strokes would a person draw? One round the crown and one along the trunk of the photo's main tree, found by themselves; and whether to believe them.

What stands before the sky (`skyline`), the lump about the middle of it (`crown`), the upright strip under that (`trunk`). How sure the proposal is is the product of five shares:
the sky is smooth, the crown's outline lies against the sky, the crown fills a fair part of the photo and not its whole width, the trunk is plainly seen. Under SURE it should be looked at.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Array, Key
from PIL import Image
from scipy import ndimage

from sketchtree.errors import SketchError
from sketchtree.photo.auto.crown import find_crown, outline_of, without_skirt
from sketchtree.photo.auto.skyline import find_skyline
from sketchtree.photo.auto.trunk import find_trunk
from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import Photo

SURE = 0.5
_WORKED = 480  # pixels: the longer side of what is looked at


class Proposal(NamedTuple):
    """Strokes nobody drew."""

    trees: tuple[Marked, ...]  # one
    confidence: float  # 0-1
    why: str  # what speaks against it; empty where nothing does


def propose(photo: Photo, *, key: Key[Array, ""]) -> Proposal:
    """Crown and trunk of the main tree. Raises SketchError where nothing stands out."""
    scale = max(1.0, max(photo.width, photo.height) / _WORKED)
    size = (max(2, round(photo.width / scale)), max(2, round(photo.height / scale)))
    rgb = np.asarray(Image.fromarray(photo.rgb).resize(size, Image.Resampling.BOX))
    skyline = find_skyline(rgb, key=key)
    stands, sky = skyline.stands, skyline.sky
    if photo.alpha is not None:
        stands, sky = np.asarray(Image.fromarray(photo.alpha).resize(size, Image.Resampling.BOX)) >= 128, 1.0
    area = find_crown(stands, skyline.ground if photo.alpha is None else np.full(size[0], size[1]))
    if area is None:
        raise SketchError(f"No tree stands out in {photo.name}.", remedy="Draw a stroke round its crown and one along its trunk: --strokes.")
    stem = find_trunk(rgb if photo.alpha is None else np.where(stands[..., None], np.uint8(0), np.uint8(255)).repeat(3, axis=2), area)
    area = without_skirt(area, float(stem.line[0, 1])) if photo.alpha is None else area
    shares = {
        "the sky is not of one kind": min(1.0, 1.2 * sky),
        "the crown hardly stands out from what is around it": _against_sky(area, stands),
        "the crown is very small, or fills the photo": _fair_size(area),
        "the crown runs out of both sides of the photo": _within_sides(area),
        "the trunk is hardly seen": 0.4 + 0.6 * stem.clear,
    }
    confidence = float(np.prod(list(shares.values())))
    why = ", ".join(reason for reason, share in shares.items() if share < 0.75)
    ratio = np.array([photo.width / size[0], photo.height / size[1]])
    tree = Marked(outline_of(area) * ratio, (stem.line * ratio,), ("trunk",), "crown", (_told(why),) if confidence < SURE else ())
    return Proposal((tree,), confidence, why)


def _told(why: str) -> str:
    return f"The strokes were proposed, and may be wrong: {why or 'several things are in doubt'}. Look at them, or draw your own."


def _against_sky(area, stands) -> float:
    """The share of the crown's upper two thirds' outline that lies against the sky."""
    rows = np.flatnonzero(area.any(axis=1))
    rim = ndimage.binary_dilation(area, iterations=4) & ~ndimage.binary_dilation(area, iterations=2)
    rim[int(rows[0] + 0.67 * len(rows)) :] = False
    return float((rim & ~stands).sum() / max(rim.sum(), 1))


def _fair_size(area) -> float:
    """1 where a crown covers 6 to 70 % of the photo, less outside that."""
    share = float(area.mean())
    return float(np.clip(min(share / 0.06, (1 - share) / 0.3), 0, 1))


def _within_sides(area) -> float:
    """1 where a crown ends within the photo; down to 0.3 where it touches both sides over a third of its height."""
    rows = np.flatnonzero(area.any(axis=1))
    edge = max(2, int(0.035 * max(area.shape)))
    touched = min(float(area[rows][:, :edge].any(axis=1).mean()), float(area[rows][:, -edge:].any(axis=1).mean()))
    return 1.0 - 0.7 * min(1.0, 3 * touched)
