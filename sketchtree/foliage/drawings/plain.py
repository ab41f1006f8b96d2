"""Which blades are no living leaf's?"""

import numpy as np

from sketchtree.foliage.painting import Painting

_ROWS, _BORDER = 256, 4


def rectangle() -> Painting:
    """A flat square without veins or petiole, as in Tan et al. 2008, §4; a border of it is transparent."""
    coverage = np.zeros((_ROWS, _ROWS), np.float32)
    coverage[_BORDER:-_BORDER, _BORDER:-_BORDER] = 1.0
    nothing, edge = np.zeros_like(coverage), _BORDER / (_ROWS - 2 * _BORDER)
    return Painting(coverage, nothing, nothing, np.ones_like(coverage), nothing, -0.5 - edge, 0.5 + edge, -edge, 1.0 + edge)
