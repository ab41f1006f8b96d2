"""Which way does wood go on that became too thin for depth maps, and where does more of it begin? Twigs are followed in the photos themselves (ours).

    1. at every end of the tree: a step in that of the directions near its course which the photos show best (`contrasts`), again and again, until photos look past it
    2. at places along the wood, the same in directions that leave it, where `FIRST` steps are shown and no wood is yet; of neighbours the best shown one is followed

What is followed ends where it comes to other wood. So a tree goes on as far as photos show it, and no farther; what none shows is not made up.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.multiview.compiled import compiled
from sketchtree.multiview.contrasts import BESIDE, LEAST, SHARE, Contrasts, told
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import is_tip

STEP = 2.5  # pixels
TURNS = np.radians([10.0, 20.0])  # from the course, at a step
AROUND = 8  # directions at each
LONGEST = 120  # steps
DOUBLE, SAME_WAY = 4.5, 0.85  # pixels: beside wood that runs the same way, nothing runs by chance
APART = 2.0  # pixels: what is nearer to other wood is that wood
LEAVES = np.radians([35.0, 55.0, 75.0])  # from the limb that bears it
SPROUTS = 16  # directions at each
FIRST = 3  # steps that all must be shown, for a twig to begin
SHORTEST = 3  # steps of a twig
SURE = 3  # steps that a spur must go on, not to be roughness
SPUR = 10.0  # pixels: shorter limbs must be shown
BENDS = 0.08  # what a turn of TURNS[-1] costs, of what is shown straight on
_BACK = 6.0  # pixels of the end's course


@dataclass(eq=False)
class _Front:
    """Twigs that are being followed."""

    row: Int[np.ndarray, " twig"]  # of the tree that each leaves
    place: Float[np.ndarray, "twig 3"]  # how far it has come
    course: Float[np.ndarray, "twig 3"]  # a unit vector
    way: list[list[np.ndarray]]  # places on the way of each
    begin: Float[np.ndarray, "twig 3"]
    own: Int[np.ndarray, " twig"]  # the limb that each is the end of; NULL of one that begins


def followed(tree: TreeSkeleton, photos: Contrasts, pixel: float) -> TreeSkeleton:
    """The tree whose ends go on, with twigs that begin on it; new rows are the last, kind OBSERVED. `pixel`: of the plant, metres; the tree stands in the frame of `photos`."""
    ends = np.flatnonzero(is_tip(tree.parent) & (tree.parent != NULL))
    front = _Front(ends, tree.tip[ends], np.array([_course(tree, row, _BACK * pixel) for row in ends]).reshape(-1, 3), [[] for _ in ends], tree.tip[ends], tree.limb[ends])
    wood = _Wood(tree, pixel)
    _follow(front, wood, photos, pixel)
    _trimmed(front, photos)
    spur = np.bincount(tree.limb, tree.length)[tree.limb[ends]] < SPUR * pixel
    front.way = [way if len(way) >= SURE or not short else [] for way, short in zip(front.way, spur, strict=True)]
    tree = _with(tree, front, 1, pixel)
    front = _sprouts(tree, wood, photos, pixel)
    _follow(front, wood, photos, pixel)
    _trimmed(front, photos)
    return shown(_with(tree, front, SHORTEST, pixel), photos, pixel)


def shown(tree: TreeSkeleton, photos: Contrasts, pixel: float) -> TreeSkeleton:
    """The tree without short limbs that no photo shows by themselves: roughness of what they stand on."""
    for _ in range(3):
        long = np.bincount(tree.limb, tree.length)
        up = np.flatnonzero(tree.parent != NULL)
        first = up[tree.limb[tree.parent[up]] != tree.limb[up]]  # rows with which limbs leave others
        bears = np.zeros(len(long), bool)
        bears[tree.limb[tree.parent[first]]] = True
        foot = np.full(len(long), NULL)
        foot[tree.limb[first]] = tree.parent[first]
        tips = np.flatnonzero(is_tip(tree.parent) & (foot[tree.limb] != NULL) & ~bears[tree.limb] & (long[tree.limb] < SPUR * pixel))
        on = foot[tree.limb[tips]]
        seen = _shown_by(tree.tip[on], tree.tip[tips], tree.vector[on], tree.radius[on], pixel, *photos)
        keep = ~np.isin(tree.limb, tree.limb[tips[seen < LEAST]])
        if keep.all():
            break
        tree = tree.select(keep)
    return tree


@compiled
def _shown_by(foot, tip, axis, radius, pixel, to_pixel, contrast, sizes):
    """How many photos show the outer half of each spur beside what it stands on."""
    found = np.zeros(len(tip), np.int64)
    for k in range(len(tip)):
        way = tip[k] - foot[k]
        long = np.sqrt((way**2).sum())
        if long <= 0.0:
            continue
        start = tip[k] - min(0.5, STEP * pixel / long) * way
        for view in range(len(to_pixel)):
            p = to_pixel[view]
            z = p[2, 0] * foot[k, 0] + p[2, 1] * foot[k, 1] + p[2, 2] * foot[k, 2] + p[2, 3]
            ax, ay = np.zeros(3), np.zeros(3)
            u = (p[0, :3] * foot[k]).sum() + p[0, 3]
            v = (p[1, :3] * foot[k]).sum() + p[1, 3]
            # how a small move of the place moves the pixel
            for j in range(3):
                ax[j], ay[j] = (p[0, j] - u / z * p[2, j]) / z, (p[1, j] - v / z * p[2, j]) / z
            a0, a1, w0, w1 = (ax * axis[k]).sum(), (ay * axis[k]).sum(), (ax * way).sum(), (ay * way).sum()
            size = np.sqrt(a0 * a0 + a1 * a1)
            if size <= 0.0:
                continue
            beside = abs(a0 * w1 - a1 * w0) / size
            if beside < max(radius[k] / pixel, 0.5) + BESIDE:
                continue
            shows, past, much = told(start, tip[k], to_pixel[view : view + 1], contrast[view : view + 1], sizes[view : view + 1])
            found[k] += shows
    return found


class _Wood:
    """Where wood is already, whose, and which way it runs."""

    def __init__(self, tree: TreeSkeleton, pixel: float):
        share = [np.linspace(0.0, 1.0, max(2, int(np.ceil(long / pixel)) + 1))[1:] for long in tree.length]
        row = np.repeat(np.arange(len(tree)), [len(one) for one in share])
        self.place = tree.tip[row] - (1.0 - np.concatenate(share))[:, None] * tree.vector[row]
        self.owner, self.axis = tree.limb[row], _unit(tree.vector[row])
        self._index = cKDTree(self.place)

    def near(self, place, reach):
        """Rows of wood within reach of each place."""
        return self._index.query_ball_point(place, reach)

    def more(self, place, owner, axis) -> None:
        self.place, self.owner, self.axis = np.concatenate([self.place, place]), np.append(self.owner, owner), np.concatenate([self.axis, axis])
        self._index = cKDTree(self.place)


def _follow(front: _Front, wood: _Wood, photos: Contrasts, pixel: float) -> None:
    """Take steps until all have ended."""
    step, alive = STEP * pixel, np.arange(len(front.row))
    name = -1 - np.arange(len(front.row))  # owners of what is added
    for _ in range(LONGEST):
        if not len(alive):
            return
        ways = _cone(front.course[alive])
        score, fine = _scored(front.place[alive], ways, step, *photos)
        best = score.argmax(axis=1)
        at = np.arange(len(alive))
        to = front.place[alive] + step * ways[at, best]
        goes = fine[at, best] & ~_met(to, ways[at, best], alive, name, front, wood, pixel)
        alive, to, way = alive[goes], to[goes], ways[at, best][goes]
        for k, place in zip(alive, to, strict=True):
            front.way[k].append(place)
        front.course[alive] = _unit(0.5 * front.course[alive] + 0.5 * way)
        front.place[alive] = to
        if len(alive):
            wood.more(to, name[alive], way)


def _trimmed(front: _Front, photos: Contrasts) -> None:
    """Twigs end in the middle of their last step, where its outer half is no longer shown."""
    for k, way in enumerate(front.way):
        if way:
            before = way[-2] if len(way) > 1 else front.begin[k]
            middle = 0.5 * (before + way[-1])
            if not _fine(middle, way[-1], *photos):
                way[-1] = middle


@compiled
def _fine(start, end, to_pixel, contrast, sizes):
    shows, past, _ = told(start, end, to_pixel, contrast, sizes)
    return shows >= LEAST and past <= SHARE * (shows + past)


def _met(to, way, alive, name, front: _Front, wood: _Wood, pixel: float):
    """Which places are at other wood than their own, and no farther from it than the step before; or beside wood that runs the same way."""
    found = np.zeros(len(to), bool)
    for k, rows in enumerate(wood.near(to, DOUBLE * pixel)):
        rows = np.asarray(rows, int)
        rows = rows[(wood.owner[rows] != name[alive[k]]) & (wood.owner[rows] != front.own[alive[k]])]
        far = np.linalg.norm(wood.place[rows] - to[k], axis=1)
        rows = rows[(far < APART * pixel) | (np.abs(wood.axis[rows] @ way[k]) > SAME_WAY)]
        if len(rows):
            now, before = (np.linalg.norm(wood.place[rows] - place, axis=1).min() for place in (to[k], front.place[alive[k]]))
            found[k] = now < before + 0.5 * STEP * pixel
    return found


def _cone(course: Float[np.ndarray, "twig 3"]) -> Float[np.ndarray, "twig way 3"]:
    """Directions near each course, itself the first."""
    side = _unit(np.cross(course, np.where(np.abs(course[:, 1:2]) < 0.9, [0.0, 1.0, 0.0], [1.0, 0.0, 0.0])))
    other = np.cross(course, side)
    ways = [course]
    for n, turn in enumerate(TURNS):
        for angle in (np.arange(AROUND) + 0.5 * n) * (2 * np.pi / AROUND):
            ways.append(np.cos(turn) * course + np.sin(turn) * (np.cos(angle) * side + np.sin(angle) * other))
    return np.stack(ways, axis=1)


def _sprouts(tree: TreeSkeleton, wood: _Wood, photos: Contrasts, pixel: float) -> _Front:
    """Where more twigs begin."""
    row = np.flatnonzero((tree.parent != NULL) & (tree.length > 0))
    axis = _unit(tree.vector[row])
    angle = np.arange(SPROUTS) * (2 * np.pi / SPROUTS)
    side = _unit(np.cross(axis, np.where(np.abs(axis[:, 1:2]) < 0.9, [0.0, 1.0, 0.0], [1.0, 0.0, 0.0])))
    round_ = np.cos(angle)[:, None] * side[:, None] + np.sin(angle)[:, None] * np.cross(axis, side)[:, None]  # [row way 3]
    ways = np.concatenate([np.cos(turn) * axis[:, None] + np.sin(turn) * round_ for turn in LEAVES], axis=1)
    clear = np.concatenate([np.tile((np.maximum(tree.radius[row], 0.5 * pixel) + (BESIDE + 0.5) * pixel)[:, None] / np.sin(turn), (1, SPROUTS)) for turn in LEAVES], axis=1)
    start = tree.tip[row][:, None] + clear[..., None] * ways
    score = np.full(clear.shape, np.inf)
    for k in range(FIRST):
        one, fine = _scored_single(start + k * STEP * pixel * ways, ways, STEP * pixel, *photos)
        score = np.where(fine, np.minimum(score, one), -np.inf)
    n, w = np.nonzero(np.isfinite(score))
    n, w = (some[np.argsort(-score[n, w], kind="stable")] for some in (n, w))
    begun, taken = _Front(row[:0], np.zeros((0, 3)), np.zeros((0, 3)), [], np.zeros((0, 3)), row[:0]), []
    kept = []
    for k, way in zip(n.tolist(), w.tolist(), strict=True):
        places = start[k, way] + (np.arange(FIRST + 1) * STEP * pixel)[:, None] * ways[k, way]
        if taken and cKDTree(np.concatenate(taken)).query(places)[0].min() < 2 * APART * pixel:
            continue
        if wood._index.query(places)[0].min() < APART * pixel:
            continue
        taken.append(places)
        kept.append((row[k], places[-1], ways[k, way], list(places)))
    if kept:
        begun = _Front(np.array([one[0] for one in kept]), np.array([one[1] for one in kept]), np.array([one[2] for one in kept]), [one[3] for one in kept], np.array([one[1] for one in kept]), np.full(len(kept), -10**9))
        own = np.concatenate([np.full(FIRST + 1, -1 - k) for k in range(len(kept))])
        wood.more(np.concatenate([one[3] for one in kept]), own, np.repeat([one[2] for one in kept], FIRST + 1, axis=0))
    return begun


@compiled
def _scored(place, ways, step, to_pixel, contrast, sizes):
    """[twig way] (how well a step is shown, and what would come next; whether it is)."""
    count, many = ways.shape[0], ways.shape[1]
    score, fine = np.zeros((count, many)), np.zeros((count, many), np.bool_)
    for k in range(count):
        for w in range(many):
            way = ways[k, w]
            end = place[k] + step * way
            shows, past, much = told(place[k], end, to_pixel, contrast, sizes)
            fine[k, w] = shows >= LEAST and past <= SHARE * (shows + past)
            then, lost, more = told(end, end + step * way, to_pixel, contrast, sizes)
            bend = 0.0 if w == 0 else (BENDS / 4 if w <= AROUND else BENDS)
            score[k, w] = (much + 0.7 * more - 0.3 * past - 0.2 * lost) * (1.0 - bend) if fine[k, w] else -1e9
    return score, fine


@compiled
def _scored_single(place, ways, step, to_pixel, contrast, sizes):
    count, many = ways.shape[0], ways.shape[1]
    score, fine = np.zeros((count, many)), np.zeros((count, many), np.bool_)
    for k in range(count):
        for w in range(many):
            shows, past, much = told(place[k, w], place[k, w] + step * ways[k, w], to_pixel, contrast, sizes)
            fine[k, w] = shows >= LEAST + 1 and past <= 0.1 * (shows + past)
            score[k, w] = much
    return score, fine


def _course(tree: TreeSkeleton, row: int, length: float):
    """Which way a limb goes at its end: from so many metres before it."""
    at, back = row, 0.0
    while tree.parent[at] != NULL and back < length and (at == row or tree.limb[at] == tree.limb[row]):
        back += tree.length[at]
        at = tree.parent[at]
    return _unit(tree.tip[row] - tree.tip[at])


def _with(tree: TreeSkeleton, front: _Front, fewest: int, pixel: float) -> TreeSkeleton:
    """The tree and what was followed, where it is so many steps long."""
    columns = {name: [] for name in ("parent", "tip", "radius", "limb", "order", "tree")}
    own, new_limb = len(tree), int(tree.limb.max()) + 1
    tips = is_tip(tree.parent)
    for row, way in zip(front.row.tolist(), front.way, strict=True):
        if len(way) < fewest:
            continue
        goes_on = tips[row]
        limb, order = (tree.limb[row], tree.order[row]) if goes_on else (new_limb, tree.order[row] + 1)
        new_limb += not goes_on
        parent = row
        for k, place in enumerate(way):
            columns["parent"].append(parent)
            columns["tip"].append(place)
            columns["radius"].append(min(tree.radius[row], 0.3 * pixel))
            columns["limb"].append(limb)
            columns["order"].append(order)
            columns["tree"].append(tree.tree[row])
            parent = own + len(columns["parent"]) - 1
    if not columns["parent"]:
        return tree
    return tree.append({name: np.array(value) for name, value in columns.items()} | {"kind": np.full(len(columns["parent"]), int(Kind.OBSERVED))})


def _unit(vector):
    return vector / np.maximum(np.linalg.norm(vector, axis=-1, keepdims=True), 1e-12)
