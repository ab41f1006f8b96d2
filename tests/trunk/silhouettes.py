"""Small trunks as mattes."""

import numpy as np


def capsules(lines, size=(120, 100)) -> np.ndarray:
    """A matte of round lines: each ((x, y), (x, y), radius); edges are smooth over one pixel."""
    y, x = np.mgrid[0 : size[0], 0 : size[1]] + 0.5
    depth = np.full(size, -np.inf)
    for (ax, ay), (bx, by), radius in lines:
        length = (bx - ax) ** 2 + (by - ay) ** 2
        t = np.clip(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length, 0.0, 1.0)
        depth = np.maximum(depth, radius - np.hypot(x - ax - t * (bx - ax), y - ay - t * (by - ay)))
    return np.clip(depth + 0.5, 0.0, 1.0)


STEM = ((50.0, 130.0), (50.0, 20.0), 6.0)
LEFT = ((50.0, 80.0), (20.0, 50.0), 3.0)
RIGHT = ((50.0, 60.0), (82.0, 40.0), 3.0)


def forked() -> np.ndarray:
    """A stem with a limb on either side, cut by the picture's lower edge."""
    return capsules([STEM, LEFT, RIGHT])


def ring() -> np.ndarray:
    """A stem whose two limbs meet again above a hole; the right-hand one is thinner in the middle of its upper part."""
    thin = [((50.0, 100.0), (80.0, 70.0), 5.0), ((80.0, 70.0), (70.0, 50.0), 2.0), ((70.0, 50.0), (50.0, 35.0), 4.0)]
    return capsules([((50.0, 130.0), (50.0, 100.0), 6.0), ((50.0, 100.0), (25.0, 70.0), 5.0), ((25.0, 70.0), (50.0, 35.0), 5.0), ((50.0, 35.0), (50.0, 15.0), 4.0), *thin])
