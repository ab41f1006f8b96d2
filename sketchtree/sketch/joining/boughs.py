"""Does the tree stand on its lowest end? Not where that is a twig's, and a far heavier line ends free.

A bough drawn without its tree starts at its thick end, wherever that is on the page; and the twigs of a weeping tree may
hang lower than its foot. With the middle width w_i and the length |i| of a line, its ink is w_i |i|. The foot is the thick end
(the lower one of an even line) of the line with the most ink, if that is HEAVIER times what the line of the lowest end has,
THICKER times as wide, and no other line comes near that end.
"""

import numpy as np
import shapely

from sketchtree.sketch.joining.bundle import Bundle

HEAVIER, THICKER = 2.0, 1.5
EVEN = 0.1  # log ratio of its widths toward both ends, below which a line is even
FREE = 0.03  # of H, beyond half its width: no other line is nearer to a free end


def heavier_foot(bundle: Bundle, lowest: int) -> int | None:
    """The end (2 k + e) that is likelier the foot of the tree than the end `lowest`; None if that is as likely as any."""
    ink = np.nan_to_num(bundle.width * bundle.length)
    heavy, light = int(np.argmax(ink)), lowest // 2
    if not 0 < HEAVIER * ink[light] <= ink[heavy] or bundle.width[heavy] < THICKER * bundle.width[light]:
        return None
    thick, low = int(bundle.taper[heavy] > 0), int(np.argmin(bundle.ends[2 * heavy : 2 * heavy + 2, 1]))
    foot = 2 * heavy + (thick if abs(bundle.taper[heavy]) >= EVEN else low)
    others = np.delete(bundle.shapes, heavy)
    gap = shapely.distance(shapely.Point(bundle.ends[foot]), others).min()
    return foot if gap > FREE * bundle.height + 0.5 * bundle.width[heavy] else None
