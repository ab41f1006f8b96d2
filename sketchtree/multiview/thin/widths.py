"""How thick is wood, as photos show it? Across a limb with sky or an even cloth on both sides, a photo tells its width to a fraction of a pixel (ours).

    w = Σ c / C        c   along a line across the limb, as far as `REACH` times the width that was thought of and 2 pixels more
                       C   the most of it, where that is much; of wood narrower than a pixel that of wide wood

times what a pixel is at that depth. Of all photos whose line begins and ends with noise the median counts; `LEAST` of them are enough. Points of a cloud lie a pixel or two off the bark, and
a pixel that is half plant is no point: what is measured in them alone is too thin by a quarter where a limb is 2 to 8 pixels wide.
"""

import numpy as np
from jaxtyping import Bool, Float
from scipy.ndimage import median_filter
from scipy.optimize import isotonic_regression

from sketchtree.axes import NULL
from sketchtree.multiview.compiled import compiled
from sketchtree.multiview.thin.contrasts import NOISE, Contrasts, read
from sketchtree.multiview.thin.standing import unit
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import generations, limb_chains

LEAST = 3  # photos
MIDDLE = 0.35  # quantile of the photos: other wood beside makes a limb seem wider, nothing makes it seem thinner
REACH = 0.9  # of the width thought of: to each side of the axis
WIDEST = 14.0  # pixels
WIDE = (6.0, 10.0)  # pixels: thinner wood is as thick as photos show it, thicker as its points do, between them both count
_FORK = 4.0  # pixels beyond the bark of what bears a limb, in which both are seen as one
_MEDIAN = 9  # rows
_UNSURE = 0.1  # what a place counts whose width no photo tells
_BETWEEN = 0.5  # pixels between places that are read


def widths(place: Float[np.ndarray, "place 3"], axis: Float[np.ndarray, "place 3"], radius: Float[np.ndarray, " place"], full: float, photos: Contrasts) -> Float[np.ndarray, " place"]:
    """The radius at each place of the axis of a limb, metres; NaN where too few photos tell. `radius`: about; `full`: c of wood that fills its pixel."""
    return _measured(np.ascontiguousarray(place), np.ascontiguousarray(axis), np.ascontiguousarray(radius), full, *photos)


@compiled
def _measured(place, axis, radius, full, to_pixel, contrast, sizes):
    found = np.full(len(place), np.nan)
    one = np.empty(len(to_pixel))
    for k in range(len(place)):
        count = 0
        for view in range(len(to_pixel)):
            p = to_pixel[view]
            x, y, z = place[k, 0], place[k, 1], place[k, 2]
            depth = p[2, 0] * x + p[2, 1] * y + p[2, 2] * z + p[2, 3]
            if depth <= 0.0:
                continue
            u = (p[0, 0] * x + p[0, 1] * y + p[0, 2] * z + p[0, 3]) / depth
            v = (p[1, 0] * x + p[1, 1] * y + p[1, 2] * z + p[1, 3]) / depth
            au, av, scale = 0.0, 0.0, 0.0
            for j in range(3):
                du, dv = (p[0, j] - u * p[2, j]) / depth, (p[1, j] - v * p[2, j]) / depth
                au += du * axis[k, j]
                av += dv * axis[k, j]
                scale += du * du + dv * dv
            scale = np.sqrt(0.5 * scale)  # pixels a metre
            size = np.sqrt(au * au + av * av)
            if size < 0.5 * scale:  # nearly end on
                continue
            nu, nv = -av / size, au / size
            half = 2.0 * REACH * radius[k] * scale + 2.0
            if half > WIDEST:
                continue
            steps = int(np.ceil(half / _BETWEEN))
            total, most, middle, edge = 0.0, 0.0, 0.0, 0.0
            for n in range(-steps, steps + 1):
                c = read(contrast, view, sizes[view, 0], sizes[view, 1], u + n * _BETWEEN * nu, v + n * _BETWEEN * nv)
                if c < 0.0:
                    edge = 1.0
                    break
                total += c
                most = max(most, c)
                if abs(n) <= 2:
                    middle = max(middle, c)
                if abs(n) >= steps - 1:
                    edge = max(edge, c)
            if edge < max(NOISE, 0.08 * most) and middle > NOISE and middle >= 0.6 * most:
                one[count] = 0.5 * total * _BETWEEN / (most if most > 0.7 * full else full) / scale
                count += 1
        if count >= LEAST:
            found[k] = np.quantile(one[:count], MIDDLE)
    return found


def thickened(tree: TreeSkeleton, full: float, photos: Contrasts, pixel: float) -> TreeSkeleton:
    """The tree with the thickness that photos show, where it is under `WIDE` pixels; along a limb it never grows. `pixel`: of the plant, metres."""
    shown = widths(tree.tip, unit(tree.vector), np.maximum(tree.radius, 0.5 * pixel), full, photos)
    known = np.isfinite(shown) & _clear(tree, np.fmax(tree.radius, shown), pixel)
    if not known.any():
        return tree
    width = 2.0 * np.where(known, shown, tree.radius) / pixel
    share = np.where(known, np.clip((WIDE[1] - width) / (WIDE[1] - WIDE[0]), 0.0, 1.0), 0.0)
    radius = share * np.nan_to_num(shown) + (1.0 - share) * tree.radius
    for rows in limb_chains(tree.parent, tree.limb):
        told = rows[known[rows]]
        if not len(told):
            continue
        radius[told], at = median_filter(radius[told], _MEDIAN, mode="mirror"), np.cumsum(tree.length[rows])
        unsure = ~known[rows] & (width[rows] < WIDE[0])
        radius[rows[unsure]] = np.interp(at[unsure], at[known[rows]], radius[told])
        weight = np.maximum(tree.length[rows], 1e-3 * pixel) * np.where(known[rows], 1.0, _UNSURE)
        radius[rows] = isotonic_regression(radius[rows], weights=weight, increasing=False).x
    for rows in generations(tree.parent)[1:]:
        radius[rows] = np.minimum(radius[rows], radius[tree.parent[rows]])
    return tree.replace(radius=radius)


def _clear(tree: TreeSkeleton, radius, pixel: float) -> Bool[np.ndarray, " row"]:
    """Which rows are clear of the limb that bears theirs."""
    found = np.ones(len(tree), bool)
    for rows in limb_chains(tree.parent, tree.limb):
        foot = tree.parent[rows[0]]
        if foot != NULL:
            found[rows] = np.cumsum(tree.length[rows]) > radius[foot] + _FORK * pixel
    return found
