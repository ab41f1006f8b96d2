"""Which points stand for a surface, and what does it enclose?

*Samples*: triangles are halved across their longest edge, those outside the box of interest dropped on the way, and then cut into n²
like themselves whose edges are no longer than s; the centroids of these are the samples. A point of a triangle is within 2/3 of its
longest median of the centroid, and no median is longer than √3/2 of the longest edge, so that no point of the surface is
farther than s / √3 from a sample.

*What is enclosed*: going level from a point to either side, along x and along z, every surface that is met counts 1 if it is crossed
outwards and −1 inwards. Inside a closed surface all four ways count other than 0; beside an open sheet one does, or two.
So a house without its floor is enclosed, and a wall encloses nothing. For a single point the winding number says it
of closed surfaces (each triangle's solid angle by van Oosterom & Strackee 1983):

    w(p) = 1/4π Σ_t Ω_t(p),     tan(Ω/2) = a·(b × c) / (abc + (a·b) c + (b·c) a + (c·a) b)

with a, b, c from p to the triangle's corners.
"""

import numpy as np
from jaxtyping import Bool, Float

APART = 3.0**-0.5  # of the edge length s: how far from every sample a point of the surface may lie
_CUTS = 8  # n at most
ENCLOSES = 0.5  # |w| from which a point is inside
_OFF = (0.00137, 0.00271)  # of a pitch: how far beside its corners a way goes, so as not to meet edges


def surface_samples(
    triangle: Float[np.ndarray, "triangle 3 3"], low: Float[np.ndarray, " 3"], high: Float[np.ndarray, " 3"], edge: float
) -> tuple[Float[np.ndarray, "sample 3"], Float[np.ndarray, "sample 3"]]:
    """(points, unit normals) of the triangles (metres) inside the box from `low` to `high`, and some about it; no point of them inside is
    farther than `APART` · `edge` from all."""
    piece = pieces(triangle, low, high, _CUTS * edge)
    cross = np.cross(piece[:, 1] - piece[:, 0], piece[:, 2] - piece[:, 0])
    cross /= np.maximum(np.linalg.norm(cross, axis=1), 1e-300)[:, None]
    longest = np.sqrt(np.max([_squared(piece[:, k] - piece[:, k - 1]) for k in range(3)], axis=0))
    cuts = np.clip(np.ceil(longest / edge), 1, _CUTS).astype(np.int64)
    point, normal = [np.zeros((0, 3))], [np.zeros((0, 3))]
    for n in np.unique(cuts):
        share = _centroids(int(n))
        point.append((share @ piece[cuts == n]).reshape(-1, 3))
        normal.append(np.repeat(cross[cuts == n], len(share), axis=0))
    return np.concatenate(point), np.concatenate(normal)


def pieces(
    triangle: Float[np.ndarray, "triangle 3 3"], low: Float[np.ndarray, " 3"], high: Float[np.ndarray, " 3"], edge: float
) -> Float[np.ndarray, "piece 3 3"]:
    """The triangles halved until no edge is longer than `edge` (metres), without those that lie outside the box."""
    found = [np.zeros((0, 3, 3))]
    left = _in_box(triangle, low, high)
    while len(left):
        sides = np.stack([_squared(left[:, k] - left[:, (k + 1) % 3]) for k in range(3)], axis=1)
        longest = sides.argmax(axis=1)
        large = sides[np.arange(len(left)), longest] > edge**2
        found.append(left[~large])
        left = _in_box(_halved(left[large], longest[large]), low, high)
    return np.concatenate(found)


def line_samples(
    outline: Float[np.ndarray, "point 2"], edge: float
) -> tuple[Float[np.ndarray, "sample 2"], Float[np.ndarray, "sample 2"]]:
    """(points, unit normals) of a closed outline (metres), no point of it farther than half an `edge` from all."""
    way = np.roll(outline, -1, axis=0) - outline
    count = np.maximum(np.ceil(np.linalg.norm(way, axis=1) / edge).astype(np.int64), 1)
    owner = np.repeat(np.arange(len(outline)), count)
    along = (np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)) / count[owner]
    normal = way[:, ::-1] * [1.0, -1.0] / np.maximum(np.linalg.norm(way, axis=1), 1e-300)[:, None]
    return outline[owner] + along[:, None] * way[owner], normal[owner]


def enclosed(triangle: Float[np.ndarray, "triangle 3 3"], corners: tuple[Float[np.ndarray, " corner"], ...]) -> Bool[np.ndarray, "x y z"]:
    """Which corners of a grid have the surface all about them."""
    x, y, z = corners
    along_x = _crossed(triangle, x, y, z)
    along_z = _crossed(triangle[:, :, ::-1], z, y, x)
    return along_x & along_z.transpose(2, 1, 0)


def winding(point: Float[np.ndarray, "point 3"], triangle: Float[np.ndarray, "triangle 3 3"]) -> Float[np.ndarray, " point"]:
    """w of each point: 1 (or −1) inside a closed surface, 0 outside. One pass over all triangles a point."""
    return np.array([_winding(triangle - p) for p in point]).reshape(len(point))


def _winding(corner) -> float:
    a, b, c = corner[:, 0], corner[:, 1], corner[:, 2]
    la, lb, lc = (np.linalg.norm(x, axis=1) for x in (a, b, c))
    volume = np.einsum("ti,ti->t", a, np.cross(b, c))
    rest = la * lb * lc
    for u, v, length in ((a, b, lc), (b, c, la), (c, a, lb)):
        rest = rest + np.einsum("ti,ti->t", u, v) * length
    return float(np.arctan2(volume, rest).sum() / (2 * np.pi))


def _in_box(triangle, low, high):
    a, b, c = triangle[:, 0], triangle[:, 1], triangle[:, 2]
    held = (np.minimum(np.minimum(a, b), c) <= high) & (np.maximum(np.maximum(a, b), c) >= low)
    held = held[:, 0] & held[:, 1] & held[:, 2]
    return triangle if held.all() else triangle[held]


def _centroids(n: int):
    """Barycentric coordinates of the centroids of the n² triangles that lines along the sides cut a triangle into."""
    i, j = (axis.ravel() for axis in np.meshgrid(np.arange(n), np.arange(n), indexing="ij"))
    upright, turned = i + j <= n - 1, i + j <= n - 2
    first = np.concatenate([i[upright] + 1 / 3, i[turned] + 2 / 3]) / n
    second = np.concatenate([j[upright] + 1 / 3, j[turned] + 2 / 3]) / n
    return np.stack([first, second, 1.0 - first - second], axis=1)


def _squared(vector):
    return vector[:, 0] ** 2 + vector[:, 1] ** 2 + vector[:, 2] ** 2


def _halved(triangle, longest):
    """Two triangles for each, cut across the edge from corner `longest` to the next."""
    rows = np.arange(len(triangle))
    a, b, c = (triangle[rows, (longest + k) % 3] for k in range(3))
    middle = 0.5 * (a + b)
    return np.concatenate([np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1)])


def _crossed(triangle, u, v, w):
    """Which corners count other than 0 both ways along the first of three axes."""
    column, place, sign = _crossings(triangle, u[1] - u[0], v, w)
    index = np.clip(np.ceil((place - u[0]) / (u[1] - u[0])), 0, len(u)).astype(np.int64)
    count = np.zeros((len(u) + 1, len(v) * len(w)), np.int32)
    np.add.at(count, (index, column), sign)
    before = np.cumsum(count, axis=0)[:-1]
    after = before - count.sum(axis=0)
    return ((before != 0) & (after != 0)).reshape(len(u), len(v), len(w))


def _crossings(triangle, pitch, v, w):
    """(column, u, which way: ±1) wherever a line through the grid's corners, a little aside, meets a triangle."""
    start = np.array([v[0] + _OFF[0] * pitch, w[0] + _OFF[1] * pitch])
    at = (triangle[:, :, 1:] - start) / pitch
    first = np.clip(np.ceil(at.min(axis=1)), 0, (len(v), len(w))).astype(np.int64)
    last = np.clip(np.floor(at.max(axis=1)), -1, (len(v) - 1, len(w) - 1)).astype(np.int64)
    span = np.maximum(last - first + 1, 0)
    count = span.prod(axis=1)
    owner = np.repeat(np.arange(len(triangle)), count)
    number = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    i = first[owner, 0] + number // span[owner, 1]
    j = first[owner, 1] + number % span[owner, 1]
    a, b, c = (at[owner, k] for k in range(3))
    share = np.stack([_area(b, c, i, j), _area(c, a, i, j), _area(a, b, i, j)], axis=1)
    area = share.sum(axis=1)
    hit = (np.sign(share) == np.sign(area)[:, None]).all(axis=1) & (area != 0)
    u = np.einsum("tk,tk->t", share[hit] / area[hit, None], triangle[owner[hit], :, 0])
    return i[hit] * len(w) + j[hit], u, np.sign(area[hit]).astype(np.int32)


def _area(a, b, i, j):
    """Twice the area of the triangle from (i, j) to a and b, signed."""
    return (a[:, 0] - i) * (b[:, 1] - j) - (a[:, 1] - j) * (b[:, 0] - i)
