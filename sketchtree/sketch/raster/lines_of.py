"""Which whole lines were drawn? Edges joined through the joints, smoothed to a fraction of a pixel.

Inside a joint's ink the skeleton leans towards what meets there, so those points are left out and the line goes
straight over; a line that ends at a joint is drawn straight on to the middle of the line it meets. Each line is sampled
every pixel and smoothed by a Gaussian of SMOOTH of its width, its ends held.
"""

import dataclasses
from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Float
from scipy.ndimage import gaussian_filter1d

from sketchtree.sketch.raster.crossing import End, Links
from sketchtree.sketch.raster.ink import Ink
from sketchtree.sketch.raster.refining import centred
from sketchtree.sketch.raster.tracing import Web

SMOOTH = (0.35, 0.8)  # of the line's width, plus pixels
FLAT = 0.2  # pixels that a simplified line may lie off
APART = 4.0  # widths of the pen between two points of a line at most
CORE = 1.0  # half widths: how far around a joint the skeleton is not believed


@dataclass(eq=False)
class Traced:
    """One line. Pixels of the mask, (x, y), y DOWN."""

    points: Float[np.ndarray, "point 2"]
    width: Float[np.ndarray, " point"]
    closed: bool = False
    joints: tuple[int, int] = (-1, -1)  # the joints that its first and last point end in; -1 for a free end
    passes: frozenset[int] = frozenset()  # the joints it goes on through

    @property
    def length(self) -> float:
        """Length, pixels."""
        return float(np.hypot(*np.diff(self.points, axis=0).T).sum())

    def reversed(self) -> "Traced":
        """The same line drawn the other way."""
        return dataclasses.replace(self, points=self.points[::-1], width=self.width[::-1], joints=self.joints[::-1])

    def grow(self, side: int, more: Float[np.ndarray, "point 2"]) -> None:
        """Lengthen it by points beyond its first (0) or last (1) one, nearest first."""
        if side == 0:
            self.points, self.width = np.vstack([more[::-1], self.points]), np.r_[np.full(len(more), self.width[0]), self.width]
        else:
            self.points, self.width = np.vstack([self.points, more]), np.r_[self.width, np.full(len(more), self.width[-1])]


def whole_lines(web: Web, links: Links, ink: Ink) -> list[Traced]:
    """The lines of a web; those that end on another touch it exactly."""
    chains = _chains(web, links)
    lines = [_raw(web, chain, ring) for chain, ring in chains]
    through = _through(web, chains, links)
    for node, hosts in through.items():
        for k in hosts:
            lines[k].passes |= {node}
    lines = [_smooth(_centred(_even(line), ink)) for line in lines]
    _touch(lines, through, web)
    return lines


def _chains(web: Web, links: Links) -> list[tuple[list[End], bool]]:
    """Every run of edges that goes on through joints, as (edge, end it is entered by); and whether it is a ring."""
    used: set[int] = set(links.bridges)
    found = []
    starts = [(key, side) for key in sorted(web.edges) for side in (0, 1) if (key, side) not in links.onward]
    for start in starts + [(key, 0) for key in sorted(web.edges)]:
        if start[0] in used:
            continue
        chain, here = [], start
        while here is not None and here[0] not in used:
            used.add(here[0])
            chain.append(here)
            here = links.onward.get((here[0], 1 - here[1]))
        edge = web.edges[start[0]]
        ring = (here is not None and here == start) or (len(chain) == 1 and edge.a == edge.b and web.degree(edge.a) == 2)
        found.append((chain, ring))
    return found


def _node(web: Web, end: End) -> int:
    edge = web.edges[end[0]]
    return edge.a if end[1] == 0 else edge.b


def _raw(web: Web, chain: list[End], ring: bool) -> Traced:
    """The points of a chain without those inside the joints it passes."""
    points, half = [], []
    last = len(chain) - 1
    for k, (key, side) in enumerate(chain):
        edge = web.edges[key]
        p, h = (edge.points, edge.half) if side == 0 else (edge.points[::-1], edge.half[::-1])
        ends = (_node(web, (key, side)), _node(web, (key, 1 - side)))
        keep = np.ones(len(p), bool)
        for at, node in enumerate(ends):
            if web.degree(node) > 2:
                keep &= np.hypot(*(p - web.place[node]).T) >= CORE * web.half[node]
        if not keep.any():
            keep[len(p) // 2] = True
        points.append(p[keep])
        half.append(h[keep])
    nodes = (_node(web, chain[0]), _node(web, (chain[last][0], 1 - chain[last][1])))
    joints = tuple(-1 if ring or web.degree(node) < 2 else node for node in nodes)
    return Traced(np.concatenate(points), 2.0 * np.concatenate(half), ring, joints)


def _through(web: Web, chains: list[tuple[list[End], bool]], links: Links) -> dict[int, list[int]]:
    """The lines that go on through each joint."""
    line_of = {key: k for k, (chain, _) in enumerate(chains) for key, _ in chain}
    found: dict[int, list[int]] = {}
    for one, two in links.onward.items():
        for end in (one, two):
            node = _node(web, end)
            if line_of[one[0]] not in found.setdefault(node, []):
                found[node].append(line_of[one[0]])
    return found


def _even(line: Traced) -> Traced:
    """The line with a point at every pixel of its length; a ring's first point is repeated at its end."""
    points = np.vstack([line.points, line.points[:1]]) if line.closed else line.points
    width = np.r_[line.width, line.width[:1]] if line.closed else line.width
    s = np.r_[0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T))]
    at = np.linspace(0.0, s[-1], max(3, int(np.ceil(s[-1])) + 1))
    points = np.stack([np.interp(at, s, points[:, k]) for k in (0, 1)], 1)
    return dataclasses.replace(line, points=points, width=np.interp(at, s, width))


def _centred(line: Traced, ink: Ink) -> Traced:
    return dataclasses.replace(line, points=centred(line.points, float(np.median(line.width)), line.closed, ink))


def _smooth(line: Traced) -> Traced:
    points, width = line.points, line.width
    if len(points) < 4:
        return line
    sigma = SMOOTH[0] * float(np.median(width)) + SMOOTH[1]
    mode = "wrap" if line.closed else "held"
    width = np.maximum(_gauss(width[:, None], 2 * sigma, mode, False)[:, 0], 0.2)
    return dataclasses.replace(line, points=_gauss(points, sigma, mode), width=width)


def _gauss(values: Float[np.ndarray, "point column"], sigma: float, mode: str, odd: bool = True) -> Float[np.ndarray, "point column"]:
    """Gaussian smoothing along the points. "held": reflected through each end, so that the ends stay; else a ring."""
    if mode == "wrap":
        ring = gaussian_filter1d(values[:-1], min(sigma, len(values) / 4), axis=0, mode="wrap")
        return np.vstack([ring, ring[:1]])
    n = min(len(values) - 1, int(4 * sigma) + 1)
    sigma = min(sigma, len(values) / 4)
    before, after = values[1 : n + 1][::-1], values[-n - 1 : -1][::-1]
    if odd:
        before, after = 2 * values[:1] - before, 2 * values[-1:] - after
    smooth = gaussian_filter1d(np.vstack([before, values, after]), sigma, axis=0)[n : n + len(values)]
    if odd:
        smooth[0], smooth[-1] = values[0], values[-1]
    return smooth


def _touch(lines: list[Traced], through: dict[int, list[int]], web: Web) -> None:
    """Draw every line that ends in a joint on to the line that goes through it, or to the joint's middle."""
    for k in range(len(lines)):
        for side in (0, 1):
            node = lines[k].joints[side]
            if node < 0:
                continue
            hosts = [j for j in through.get(node, []) if j != k]
            end = lines[k].points[-side]
            ahead = end + end_direction(lines[k], side) * min(web.half[node], float(np.hypot(*(end - web.place[node]))))
            target = _nearest([lines[j] for j in hosts], ahead) if hosts else web.place[node]
            if (end != target).any():
                lines[k].grow(side, target[None])


def end_direction(line: Traced, side: int, over: float = 1.5) -> Float[np.ndarray, " 2"]:
    """Unit direction in which a line leaves at its first (0) or last (1) point, taken over so many of its widths."""
    points = line.points if side == 0 else line.points[::-1]
    s = np.r_[0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T))]
    reach = min(s[-1], max(4.0, over * float(line.width[0 if side == 0 else -1])))
    step = points[0] - [np.interp(reach, s, points[:, k]) for k in (0, 1)]
    return step / max(float(np.hypot(*step)), 1e-9)


def _nearest(hosts: list[Traced], point: Float[np.ndarray, " 2"]) -> Float[np.ndarray, " 2"]:
    best = min((h.points[np.argmin(np.hypot(*(h.points - point).T))] for h in hosts), key=lambda p: float(np.hypot(*(p - point))))
    return best


def thinned_out(line: Traced, pen: float) -> Traced:
    """The line with only the points that bend it, and some between them for its width."""
    if len(line.points) < 3:
        return line
    s = np.r_[0.0, np.cumsum(np.hypot(*np.diff(line.points, axis=0).T))]
    keep = _bending(line.points, FLAT)
    between = np.unique(np.searchsorted(s, np.arange(0.0, s[-1], APART * pen)))
    keep[between[between < len(keep)]] = True
    keep[[0, -1]] = True
    if line.closed and len(line.points) > 3 and (line.points[0] == line.points[-1]).all():
        keep[-1] = False
    return dataclasses.replace(line, points=line.points[keep], width=line.width[keep])


def _bending(points: Float[np.ndarray, "point 2"], tolerance: float) -> np.ndarray:
    """Mask of the points that Douglas and Peucker's simplification keeps."""
    kept = shapely.get_coordinates(shapely.simplify(shapely.LineString(points), tolerance, preserve_topology=False))
    mask, k = np.zeros(len(points), bool), 0
    for point in kept:
        while k < len(points) and not (points[k] == point).all():
            k += 1
        if k < len(points):
            mask[k] = True
    return mask
