"""How light is the paper, all over the page? Uneven light, shadows and the tone of the paper, divided out.

    d = 1 − g / b       g lightness of a pixel, b of the paper there: 0 on paper, up to 1 on black ink

The paper is seen between the lines: in every block of a coarse grid the PERCENTILE-th lightness. Light and shadow
change it softly from block to block, an area of paint abruptly: blocks are linked where their tones differ by less
than STEP, and the paper is the linked blocks that hold most of the light. What is not paper is filled in from around it.
White on dark is turned round first.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float
from PIL import Image
from scipy.ndimage import binary_dilation, gaussian_filter, label
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

GRID = 72  # blocks along the page's longer side
COARSE = 1.0  # megapixels at which the paper is looked at
PERCENTILE = 85  # of a block's tones: paper, however many lines cross it
STEP = 0.14  # difference of log tone between neighbouring blocks that light alone makes at most
DEEP = 0.3  # of the lightest paper: blocks darker than this are never paper
SHARE = 0.25  # paper in several parts: each at least this part of the largest
DARK = 0.5  # part of the page and of its edge that is dark in a drawing white on dark
SIDE = 0.5  # part of a side of the picture along which it shows what lies around the page
LAGS = (1, 2, 4)  # pixels over which the grain of the paper is measured


@dataclass(frozen=True, eq=False)
class Darkness:
    """How much darker than the paper every pixel is, and how much of that is only grain."""

    d: Float[np.ndarray, "row col"]  # 0 paper to 1 black
    grain: float  # standard deviation of d on bare paper
    inverted: bool  # drawn white on dark
    outside: bool  # the picture shows more than the page


def darkness(grey: Float[np.ndarray, "row col"]) -> Darkness:
    """Divide the paper out of a picture's lightness."""
    inverted = _is_inverted(grey)
    if inverted:
        grey = np.float32(1.0) - grey
    tone, outside = _paper(grey)
    ratio = grey / np.maximum(tone, np.float32(1e-3))
    grain = _grain(ratio if outside is None else ratio[~outside.any(1)] if not outside.any(1).all() else ratio)
    d = np.clip(np.float32(1.0) - ratio, 0.0, 1.0)
    if outside is not None:
        d[outside] = 0.0
    return Darkness(d, grain, inverted, outside is not None)


def _is_inverted(grey: Float[np.ndarray, "row col"]) -> bool:
    """Whether both the page and its edge are mostly darker than the middle between its tones."""
    step = max(1, max(grey.shape) // 1000)
    seen = grey[::step, ::step]
    low, high = np.percentile(seen, (0.5, 99.5))
    middle = 0.5 * (low + high)
    rim = max(1, min(seen.shape) // 50)
    edge = np.concatenate([seen[:rim].ravel(), seen[-rim:].ravel(), seen[:, :rim].ravel(), seen[:, -rim:].ravel()])
    return bool(high - low > 0.1 and np.mean(seen < middle) > DARK and np.mean(edge < middle) > DARK)


def _paper(grey: Float[np.ndarray, "row col"]) -> tuple[Float[np.ndarray, "row col"], Bool[np.ndarray, "row col"] | None]:
    """(tone of the paper at every pixel, mask of what lies around the page or None)."""
    factor = max(1, int(np.sqrt(grey.size / (COARSE * 1e6))))
    seen = np.asarray(Image.fromarray(grey).reduce(factor)) if factor > 1 else grey
    side = max(1, -(-max(seen.shape) // GRID))
    rows, cols = (-(-n // side) for n in seen.shape)
    padded = np.pad(seen, ((0, rows * side - seen.shape[0]), (0, cols * side - seen.shape[1])), mode="edge")
    blocks = padded.reshape(rows, side, cols, side).transpose(0, 2, 1, 3).reshape(rows, cols, -1)
    tone = np.percentile(blocks, PERCENTILE, axis=2).astype(np.float32)
    is_paper = _linked(tone)
    filled = _filled(tone, is_paper)
    wide = Image.fromarray(filled).resize((cols * side * factor, rows * side * factor), Image.Resampling.BILINEAR)
    around = _around(is_paper)
    mask = None
    if around.any():
        mask = np.repeat(np.repeat(around, side * factor, 0), side * factor, 1)[: grey.shape[0], : grey.shape[1]]
    return np.asarray(wide)[: grey.shape[0], : grey.shape[1]], mask


def _around(is_paper: Bool[np.ndarray, "block block"]) -> Bool[np.ndarray, "block block"]:
    """The blocks of a table around the page: no paper, and along most of two sides of the picture at least."""
    labels, count = label(~is_paper)
    sides = np.stack([[np.mean(edge == k) for edge in (labels[0], labels[-1], labels[:, 0], labels[:, -1])] for k in range(1, count + 1)] or [[0] * 4])
    table = np.r_[False, (sides >= SIDE).sum(1) >= 2][: count + 1]
    return binary_dilation(table[labels], iterations=1) if table.any() else np.zeros_like(is_paper)


def _linked(tone: Float[np.ndarray, "block block"]) -> Bool[np.ndarray, "block block"]:
    """The blocks of paper: linked to each other by soft changes of tone."""
    shape, level = tone.shape, np.log(np.maximum(tone, 1e-3))
    index = np.arange(tone.size).reshape(shape)
    a = np.concatenate([index[:, 1:].ravel(), index[1:].ravel()])
    b = np.concatenate([index[:, :-1].ravel(), index[:-1].ravel()])
    near = np.abs(level.ravel()[a] - level.ravel()[b]) <= STEP
    links = coo_array((np.ones(near.sum(), bool), (a[near], b[near])), (tone.size,) * 2)
    _, part = connected_components(links, directed=False)
    light = np.bincount(part, weights=tone.ravel())
    lightest = np.quantile(tone, 0.95)
    mean = light / np.bincount(part)
    paper = (light >= SHARE * light.max()) & (mean >= 2 * DEEP * lightest)
    paper[np.argmax(light * (mean >= DEEP * lightest))] = True
    return (paper[part].reshape(shape)) & (tone >= DEEP * lightest)


def _filled(tone: Float[np.ndarray, "block block"], known: Bool[np.ndarray, "block block"]) -> Float[np.ndarray, "block block"]:
    """The tone smoothed a little where it is known, and carried on from the nearest known parts elsewhere."""
    result, done = np.zeros_like(tone), np.zeros(tone.shape, bool)
    weight = known.astype(np.float32)
    for sigma in (0.8, 1.6, 3.2, 6.4, 12.8, 25.6, 51.2, 102.4):
        total = gaussian_filter(weight, sigma, mode="nearest")
        mean = gaussian_filter(weight * tone, sigma, mode="nearest") / np.maximum(total, 1e-12)
        new = ~done & (total > 0.05)
        result[new] = mean[new]
        done |= new
        if done.all():
            return result
    result[~done] = float(tone[known].mean()) if known.any() else 1.0
    return result


def _grain(ratio: Float[np.ndarray, "row col"]) -> float:
    """Standard deviation of the paper's tone from pixel to pixel, by the middle difference over a few lags."""
    step = max(1, ratio.shape[0] // 500)
    rows = ratio[::step]
    spreads = [np.median(np.abs(rows[:, lag:] - rows[:, :-lag])) for lag in LAGS if ratio.shape[1] > lag]
    return float(max(spreads, default=0.0) / (0.6745 * np.sqrt(2.0)))
