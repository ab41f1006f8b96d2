"""Trees as people draw them in twenty seconds: a lobed outline, open here or there, in one stroke or several, on a trunk."""

import numpy as np
import shapely
from drawn import drawing

from sketchtree.sketch.strokes import Sketch

TRUNKS = {"edges": 0.6, "one line down and up": 0.2, "a line": 0.12, "a box": 0.08}  # how often each is drawn


def cartoon(seed: int) -> Sketch:
    """One tree, about 255 high; its strokes in any direction, sometimes on a ground line."""
    rng = np.random.default_rng(seed)
    centre, width, low, top = 128 + rng.uniform(-15, 15), rng.uniform(90, 240), 255 - rng.uniform(80, 150), 255.0
    crown = _crown(rng, centre, width, low, top)
    lines = [*crown, *_trunk(rng, centre + rng.uniform(-0.15, 0.15) * width, low + rng.uniform(-25, 30))]
    if rng.random() < 0.15:
        lines.append(np.c_[np.linspace(0, 255, 9), rng.normal(0, 1.5, 9)])
    lines = [shapely.get_coordinates(shapely.simplify(shapely.LineString(line), 1.5)) for line in lines]
    return drawing(*(line[::-1] if rng.random() < 0.5 else line for line in lines))


def _crown(rng, centre, width, low, top) -> list[np.ndarray]:
    """The outline, closed, overlapping or open; above the trunk where it is wide open."""
    opening = rng.choice([0.0, 0.1, 0.3, 0.6]) if rng.random() < 0.6 else -rng.uniform(0, 0.3)
    begin = -0.5 * np.pi + (0.0 if opening > 0.2 else rng.uniform(-0.6, 0.6))
    angle = np.linspace(begin + 0.5 * opening, begin + 2 * np.pi - 0.5 * opening, 160)
    lobes = 1 + rng.uniform(0, 0.2) * (np.abs(np.sin(0.5 * rng.integers(4, 11) * angle + rng.uniform(0, 3))) - 0.5)
    out = lobes * (1 + 0.2 * np.cumsum(rng.normal(0, 0.15, 160)) / np.sqrt(160))
    outline = np.c_[centre + 0.5 * width * out * np.cos(angle), 0.5 * (low + top) + 0.5 * (top - low) * out * np.sin(angle)]
    if rng.random() < 0.65:
        return [outline]
    cuts = sorted(rng.choice(np.arange(30, 130, 25), rng.integers(1, 4), replace=False).tolist())
    return [arc + rng.normal(0, 3, 2) for arc in np.split(outline, cuts)]


def _trunk(rng, x, top) -> list[np.ndarray]:
    width, flare = rng.uniform(10, 40), rng.uniform(0, 18)

    def edge(side):
        y = np.linspace(0, top + rng.uniform(-6, 6), 7)
        return np.c_[x + side * (0.5 * width + flare * np.exp(-y / 18)) + np.cumsum(rng.normal(0, 0.8, 7)), y]

    left, right = edge(-1), edge(1)
    kind = rng.choice(list(TRUNKS), p=list(TRUNKS.values()))
    if kind == "edges":
        return [left, right]
    if kind == "a line":
        return [np.c_[x + np.cumsum(rng.normal(0, 1, 7)), np.linspace(0, top, 7)]]
    return [np.vstack([left[::-1], right, *([left[-1:]] if kind == "a box" else [])])]
