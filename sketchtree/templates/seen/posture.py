"""How does a drawn tree hold itself? What a person sees first, as numbers.

Beyond Chen et al. 2008: footprint and branching alone do not tell a palm from an umbrella, because they
forget where limbs stand on the trunk and where they point. Per view, of the drawing (y up):

    aspect       log of width / height
    bare         height of the lower limbs' insertions (10th percentile) / height
    leader       height of the highest stem tip / height
    insertions   sd of the insertions' heights / height
    rise         sin of a limb's elevation, insertion to tip      mean over limbs of the lowest order on
    start        sin of elevation of a limb's first segment       stems, weighted by their length
    droop        sin of elevation of a limb's last segment        over all limbs but stems, same weights
    reach        limb length / height, mean
    taper        slope of limb length / height over insertion height / height
    arch         1 − chord / length of limbs
    stems        log₂ of the number of stems

What a drawing does not show is NaN: `insertions` and `taper` need three limbs on the stems; where there is no limb
at all, only `aspect`, `leader` and `stems` are known. All are free of scale; mirror images agree.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.axes import NULL
from sketchtree.templates.seen.drawing import Drawing
from sketchtree.traverse import limb_chains

FEATURES = ("aspect", "bare", "leader", "insertions", "rise", "start", "droop", "reach", "taper", "arch", "stems")


def posture(drawing: Drawing) -> Float[np.ndarray, "view feature"]:
    """The features of every view, in the order of `FEATURES`."""
    base = drawing.parent == NULL
    ground = drawing.tip[:, base, 1].min(axis=1)
    height = np.maximum(drawing.tip[:, :, 1].max(axis=1) - ground, 1e-9)
    wide = np.ptp(drawing.tip[:, :, 0], axis=1)
    limbs = _Limbs(drawing)
    at = (limbs.start[..., 1] - ground[:, None]) / height[:, None]
    first, every = limbs.first_order, limbs.not_stem
    length = limbs.length / height[:, None]
    stem_top = np.where(limbs.stem, limbs.tip[..., 1], -np.inf).max(axis=1)
    shown = np.stack([
        np.clip(np.log(np.maximum(wide, 1e-9) / height), -3, 3),
        np.percentile(at[:, first], 10, axis=1),
        (stem_top - ground) / height,
        np.std(at[:, first], axis=1),
        _mean(_sine(limbs.tip - limbs.start)[:, first], length[:, first]),
        _mean(_sine(limbs.first)[:, first], length[:, first]),
        _mean(_sine(limbs.last)[:, every], length[:, every]),
        np.mean(length[:, first], axis=1),
        _slope(at[:, first], length[:, first]),
        _mean(1 - limbs.chord[:, every] / np.maximum(limbs.length[:, every], 1e-9), length[:, every]),
        np.full(len(height), np.log2(max(1, int(base.sum())))),
    ], axis=1)  # fmt: skip
    unknown = [FEATURES.index(name) for name in _hidden(limbs)]
    shown[:, unknown] = np.nan
    return shown


def _hidden(limbs: "_Limbs") -> tuple[str, ...]:
    if limbs.stem.all():
        return tuple(name for name in FEATURES if name not in ("aspect", "leader", "stems"))
    return ("insertions", "taper") if limbs.first_order.sum() < 3 else ()


class _Limbs:
    """Columns with one entry a limb: where it starts and ends, how it sets out and ends, its length."""

    def __init__(self, drawing: Drawing):
        is_base = drawing.parent == NULL
        chains = [rows[~is_base[rows]] for rows in limb_chains(drawing.parent, drawing.limb)]
        chains = [rows for rows in chains if len(rows)]
        begin, end = np.array([rows[0] for rows in chains]), np.array([rows[-1] for rows in chains])
        vector = drawing.tip - drawing.start
        size = np.hypot(vector[..., 0], vector[..., 1])
        self.start, self.tip = drawing.start[:, begin], drawing.tip[:, end]
        self.first, self.last = vector[:, begin], vector[:, end]
        self.length = np.stack([size[:, rows].sum(axis=1) for rows in chains], axis=1)
        self.chord = np.hypot(*np.moveaxis(self.tip - self.start, -1, 0))
        order = drawing.order[end]
        self.stem = order == 0
        self.first_order = order == 1 if (order == 1).any() else self.stem
        self.not_stem = ~self.stem if (~self.stem).any() else self.stem


def _sine(vector):
    return vector[..., 1] / np.maximum(np.hypot(vector[..., 0], vector[..., 1]), 1e-12)


def _mean(x, weight):
    return np.sum(x * weight, axis=1) / np.maximum(weight.sum(axis=1), 1e-12)


def _slope(x, y, ridge: float = 0.02):
    dx, dy = x - x.mean(axis=1, keepdims=True), y - y.mean(axis=1, keepdims=True)
    return np.mean(dx * dy, axis=1) / (np.mean(dx * dx, axis=1) + ridge)
