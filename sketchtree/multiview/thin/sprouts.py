"""Where along wood that is known do more twigs begin? Where photos show `FIRST` steps that leave it, and no wood is yet; of neighbours the best shown."""

import numpy as np
from jaxtyping import Bool, Float
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.multiview.compiled import compiled
from sketchtree.multiview.thin.contrasts import BESIDE, LEAST, Contrasts, told
from sketchtree.multiview.thin.standing import APART, Standing, beside, unit
from sketchtree.multiview.thin.steps import STEP, Twigs
from sketchtree.skeleton import TreeSkeleton

ANGLES = np.radians([35.0, 55.0, 75.0])  # from the limb that bears it
AROUND = 16  # directions at each
FIRST = 3  # steps that all must be shown
SURE, PAST = LEAST + 1, 0.1  # photos that show each of them; share that may look past it


def sprouts(tree: TreeSkeleton, wood: Standing, photos: Contrasts) -> Twigs:
    """Twigs with their first steps, the best shown first; they are added to `wood`."""
    row = np.flatnonzero((tree.parent != NULL) & (tree.length > 0))
    start, ways = _directions(tree, row, wood.pixel)
    step = STEP * wood.pixel
    least, dark = _shown(start, ways, step, *photos)
    n, w = np.nonzero(np.isfinite(least))
    best = np.argsort(-least[n, w], kind="stable")
    n, w = n[best], w[best]
    way = start[n, w][:, None] + (np.arange(FIRST + 1) * step)[None, :, None] * ways[n, w][:, None]
    kept = np.flatnonzero(wood.distance(way).min(axis=1) >= APART * wood.pixel)
    kept = kept[_apart(way[kept], 2 * APART * wood.pixel)]
    if len(kept):
        wood.more(way[kept].reshape(-1, 3), wood.owner.min(initial=0) - 1 - np.repeat(np.arange(len(kept)), FIRST + 1), np.repeat(ways[n, w][kept], FIRST + 1, axis=0))
    foot = row[n[kept]]
    return Twigs(foot, np.full(len(kept), NULL), way[kept][:, -1], ways[n, w][kept], [[tree.tip[r], *some] for r, some in zip(foot, way[kept], strict=True)],
                 [[c] * (FIRST + 1) for c in dark[n, w][kept]])  # fmt: skip


def _directions(tree: TreeSkeleton, row, pixel: float) -> tuple[Float[np.ndarray, "row way 3"], Float[np.ndarray, "row way 3"]]:
    """(where a twig would come clear of its limb, which way it would run)."""
    axis = unit(tree.vector[row])
    one, other = (side[:, None] for side in beside(axis))
    turn = np.arange(AROUND) * (2 * np.pi / AROUND)
    around = np.cos(turn)[:, None] * one + np.sin(turn)[:, None] * other
    ways = np.concatenate([np.cos(angle) * axis[:, None] + np.sin(angle) * around for angle in ANGLES], axis=1)
    clear = np.maximum(tree.radius[row], 0.5 * pixel)[:, None] + (BESIDE + 0.5) * pixel
    return tree.tip[row][:, None] + (clear / np.repeat(np.sin(ANGLES), AROUND))[..., None] * ways, ways


def _apart(way: Float[np.ndarray, "twig place 3"], apart: float) -> Bool[np.ndarray, " twig"]:
    """Which twigs are nowhere so near to an earlier one that was kept."""
    kept = np.zeros(len(way), bool)
    flat, per = way.reshape(-1, 3), way.shape[1]
    near = cKDTree(flat).query_ball_point(flat, apart) if len(flat) else []
    for k in range(len(way)):
        others = {row // per for place in range(per) for row in near[per * k + place]}
        kept[k] = not any(kept[other] for other in others if other < k)
    return kept


@compiled
def _shown(start, ways, step, to_pixel, contrast, sizes):
    """[row way] (the sum of c of the first step that is shown least, −∞ where one isn't; mean c)."""
    count, many = ways.shape[0], ways.shape[1]
    least, dark = np.full((count, many), np.inf), np.zeros((count, many))
    for k in range(count):
        for w in range(many):
            for n in range(FIRST):
                begin = start[k, w] + n * step * ways[k, w]
                shows, past, much = told(begin, begin + step * ways[k, w], to_pixel, contrast, sizes)
                if shows < SURE or past > PAST * (shows + past):
                    least[k, w] = -np.inf
                    break
                least[k, w] = min(least[k, w], much)
                dark[k, w] += much / shows / FIRST
    return least, dark
