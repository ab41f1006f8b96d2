"""Which pixels are the trunk? Those at least half opaque, and more than what is round them, of one connected piece.

Twigs finer than a pixel make a veil, all of it half opaque, before which a limb is more opaque still. In a veil the threshold is the mean alpha of what is not clear (ours, under a Gaussian of σ `NEAR_BY` pixels),
at most `VEIL`. A veil it is where what is not clear is half opaque, by the mean of 4 α (1 − α): from `EDGES` on, which limbs with their soft edges have, wholly from `VEILED` on; and
where that is dense, `THIN` to `DENSE` of all near by: a thin limb by itself is none. Elsewhere the threshold is ½.

Pieces are counted over all eight neighbours, so that a twig one pixel wide holds together. Kept is the piece that holds the root, or else the largest; the others are left out, and a warning says how
many. Where `gap` is more than 0, ours, pieces that lie so near to the trunk, or to one that was joined, belong to it: thin twigs fall apart where they are half transparent. Holes of less than `SMALL_HOLE` of the piece, or in which no square of three pixels finds room, are filled; a warning says how many. Larger ones stay: a hole between two limbs that cross is seen through.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy import ndimage

from sketchtree.errors import OptionError, SketchError
from sketchtree.photo.photo import at_pixels
from sketchtree.trunk.drained import drained

HALF = 0.5
VEIL = 0.75
EDGES, VEILED = 0.35, 0.6
THIN, DENSE = 0.33, 0.43  # of the pixels near by
_CLEAR = 0.05  # alpha that counts as none
NEAR_BY = 6.0  # pixels
SMALL_HOLE = 0.002  # of the piece's area
LEAST = 12  # pixels that a trunk has
_BRIDGE = 2.0  # gaps round the nearest place of a piece, and eight pixels, within which a bridge lies
_THIN = 0.9  # alpha, at least, where the piece is one pixel wide, and beside that: the contour leaves a way through
_EIGHT = np.ones((3, 3), bool)
_NEAR = 0.05  # of the picture's longer side: how far beside the trunk a given root may lie


@dataclass(frozen=True, eq=False)
class Binary:
    """One piece of trunk, with a border of background round it."""

    level: Float[np.ndarray, "row column"]  # alpha within the piece and just round it, padded by one pixel; ½ is the contour
    mask: Bool[np.ndarray, "row column"]  # the piece, padded alike
    warnings: tuple[str, ...] = ()


def binary_trunk(alpha: Float[np.ndarray, "row column"], root: tuple[float, float] | None = None, gap: float = 0.0) -> Binary:
    """The piece of trunk in a matte; `root`: a point on it, pixels, y down; `gap`: pixels that are bridged. Raises SketchError if there is no piece."""
    alpha = np.asarray(alpha, np.float64)
    if alpha.ndim != 2 or not np.isfinite(alpha).all():
        raise SketchError("A matte is one channel of finite numbers from 0 to 1.", remedy="Save it as a grey picture.")
    padded = np.pad(unveiled(np.clip(alpha, 0.0, 1.0)), 1)
    labels, count = ndimage.label(padded >= HALF, structure=_EIGHT)
    sizes = np.bincount(labels.ravel(), minlength=count + 1)[1:]
    if count == 0 or sizes.max() < LEAST:
        raise SketchError("The matte is empty: nowhere is it half opaque.", remedy="Draw a foreground scribble along the trunk, or give another matte.")
    chosen = 1 + int(np.argmax(sizes)) if root is None else _holding(labels, root)
    labels, joined = bridged(labels, sizes, chosen, gap) if gap > 0 and count > 1 else (labels, 0)
    left = np.bincount(labels.ravel(), minlength=count + 1)[1:]
    told = [f"{joined} {'piece' if joined == 1 else 'pieces'} of the matte {'was' if joined == 1 else 'were'} joined to the trunk over gaps of at most {gap:g} pixels."] if joined else []
    told += _of_pieces(left, chosen)
    told += ["The matte is opaque all over: the whole picture was taken for the trunk. Draw a background scribble beside the tree."] if (labels[1:-1, 1:-1] == chosen).all() else []
    piece = labels == chosen
    whole = _without_small_holes(piece)[0]
    mask = drained(padded, piece, whole, None if root is None else _nearest(piece, root))
    mask, _, holes = _without_small_holes(mask)
    filled = ndimage.label(mask & whole & ~piece)[1]
    told += [f"{filled} small {'hole' if filled == 1 else 'holes'} in the trunk {'was' if filled == 1 else 'were'} filled."] if filled else []
    told += [f"The trunk has {holes} {'hole' if holes == 1 else 'holes'}; the loop round each is cut where the ways round it meet."] if holes else []
    mask = _without_pinches(mask, padded)
    thin = ndimage.binary_dilation(mask & ~ndimage.binary_opening(mask, structure=np.ones((2, 2))), structure=_EIGHT)
    least = np.where(thin, _THIN, HALF + 1e-3)
    level = np.where(mask, np.maximum(padded, least), np.minimum(padded, HALF - 1e-3))
    return Binary(level, mask, tuple(told))


def unveiled(alpha: Float[np.ndarray, "row column"]) -> Float[np.ndarray, "row column"]:
    """Alpha less what the threshold near by is above ½."""
    seen = (alpha > _CLEAR).astype(np.float64)
    much = ndimage.gaussian_filter(seen, NEAR_BY, mode="constant") + 1e-6
    mean, partly = (ndimage.gaussian_filter(seen * part, NEAR_BY, mode="constant") / much for part in (alpha, 4 * alpha * (1 - alpha)))
    veil = np.clip((partly - EDGES) / (VEILED - EDGES), 0.0, 1.0) * np.clip((much - THIN) / (DENSE - THIN), 0.0, 1.0)
    return np.clip(alpha - veil * (np.clip(mean, HALF, VEIL) - HALF), 0.0, 1.0)


def _holding(labels, root) -> int:
    """The piece that a given root lies on, or that is nearest to it."""
    x, y = root
    rows, columns = labels.shape[0] - 2, labels.shape[1] - 2
    if not (0 <= x <= columns and 0 <= y <= rows):
        raise OptionError(f"The root ({x:g}, {y:g}) lies outside the picture of {columns} × {rows} pixels.", remedy="Give a point on the trunk, in pixels from the top left.")
    distance, nearest = ndimage.distance_transform_edt(labels == 0, return_indices=True)
    row, column = min(int(y), rows - 1) + 1, min(int(x), columns - 1) + 1
    if distance[row, column] > _NEAR * max(rows, columns):
        raise OptionError(f"The root ({x:g}, {y:g}) lies {distance[row, column]:.0f} pixels beside the trunk.", remedy="Give a point on the trunk, in pixels from the top left.")
    return int(labels[nearest[0, row, column], nearest[1, row, column]])


def _nearest(piece, root) -> tuple[int, int]:
    """The pixel of a padded piece that is nearest to a point of the picture."""
    at = np.argwhere(piece)
    row, column = at[int(np.argmin(np.hypot(at[:, 0] - 0.5 - root[1], at[:, 1] - 0.5 - root[0])))]
    return int(row), int(column)


def bridged(labels, sizes, chosen: int, gap: float) -> tuple[Int[np.ndarray, "row column"], int]:
    """(the pieces, those joined now part of the chosen one; how many were): whatever of `LEAST` pixels or more is near enough to what is the trunk by now, over all that lies straight between the two."""
    labels, joined = labels.copy(), 0
    while True:
        distance = ndimage.distance_transform_edt(labels != chosen)
        near = ndimage.minimum_position(distance, labels, np.arange(1, len(sizes) + 1))
        fresh = [k for k, at in enumerate(near, 1) if k != chosen and sizes[k - 1] >= LEAST and labels[at] == k and 0 < distance[at] <= gap + 1.0]
        if not fresh:
            return labels, joined
        for k in fresh:
            row, column = near[k - 1]
            reach = int(np.ceil(_BRIDGE * gap)) + 8
            window = np.s_[max(row - reach, 1) : min(row + reach, labels.shape[0] - 1), max(column - reach, 1) : min(column + reach, labels.shape[1] - 1)]
            across = distance[window] + ndimage.distance_transform_edt(labels[window] != k)
            labels[labels == k] = chosen
            labels[window][across <= distance[row, column] + 1.0] = chosen
        joined += len(fresh)


def _of_pieces(sizes, chosen: int) -> list[str]:
    others = int(np.count_nonzero(sizes)) - 1
    if not others:
        return []
    share = (sizes.sum() - sizes[chosen - 1]) / sizes.sum()
    what = "one other piece was" if others == 1 else f"{others} other pieces were"
    return [f"The matte is in pieces: {what} left out ({share:.1%} of its pixels)."]


def _without_small_holes(piece) -> tuple[Bool[np.ndarray, "row column"], int, int]:
    """(the piece, how many holes were filled, how many stay)."""
    labels, count = ndimage.label(~piece)  # four neighbours: what the piece joins diagonally, it parts
    if count <= 1:
        return piece, 0, 0
    outside = labels[0, 0]
    area = np.bincount(labels.ravel(), minlength=count + 1)
    wide = np.zeros(count + 1, bool)
    wide[labels[ndimage.binary_erosion((labels > 0) & (labels != outside), structure=_EIGHT)]] = True
    small = (area < SMALL_HOLE * piece.sum()) | ~wide
    small[[0, outside]] = False
    return piece | small[labels], int(small.sum()), count - 1 - int(small.sum())


def _without_pinches(mask, alpha) -> Bool[np.ndarray, "row column"]:
    """The same piece, where it holds together by a corner alone also by the more opaque of the two pixels beside that: otherwise the contour would leave no way through."""
    mask = mask.copy()
    for flip in (1, -1):
        on, grey = mask[:, ::flip], alpha[:, ::flip]
        pinch = on[:-1, :-1] & on[1:, 1:] & ~on[:-1, 1:] & ~on[1:, :-1]
        upper = pinch & (grey[:-1, 1:] >= grey[1:, :-1])
        on[:-1, 1:] |= upper
        on[1:, :-1] |= pinch & ~upper
    mask[[0, -1]] = mask[:, [0, -1]] = False
    return mask


def holds(binary: Binary, points: Float[np.ndarray, "point 2"]) -> Bool[np.ndarray, " point"]:
    """Which points (pixels, y down) lie on the trunk."""
    return at_pixels(binary.mask, np.asarray(points) + 1.0)
