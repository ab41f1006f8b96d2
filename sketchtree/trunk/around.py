"""Which sibling stands where round its parent, if the crown is to be as deep as wide?

A picture shows of every limb on which side it is, and how far it reaches; how far it might reach, its siblings near by on the same parent show. A limb that falls short of them points at the viewer, or away. Of all orders of k
limbs over k angles an even turn apart, and of the `PHASES` first angles, ours is that of least

    Σ_{i<j} w_ij cos(φ_i − φ_j) + `SHORT` Σ_i w_i (|cos φ_i| − `FULL` q_i)² + `EVEN` ((Σ_i w_i sin φ_i)² + (Σ_i w_i sin φ_i cos φ_i)²), older limbs' wood with theirs

    φ_i    angle of limb i, mirrored to the side on which it is drawn        q_i   its reach over the largest of the siblings near by
    w_i    its share of the siblings' wood                                   w_ij  √(w_i w_j) e^(−distance along the parent / `NEAR` of their range)

found by swapping two limbs as long as that helps, each first angle in turn. The first term keeps neighbours apart, the second says what is foreshortened, the last keeps front and back alike, and
both diagonals.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.sketch.graph import SketchGraph

PHASES = 8
SHORT, EVEN, FULL, NEAR = 0.3, 0.5, 0.65, 0.25
_NEIGHBOURS = 3  # along the parent, on either side
_SWEEPS = 6


@dataclass(frozen=True, eq=False)
class Seen:
    """What a picture shows of the limbs of one parent."""

    right: Float[np.ndarray, " limb"]  # 1 or −1: the side
    reach: Float[np.ndarray, " limb"]  # q, 0 to 1
    weight: Float[np.ndarray, " limb"]  # sums to 1
    along: Float[np.ndarray, " limb"]  # of the range on the parent, 0 to 1
    share: float  # of the whole tree's wood


def siblings_of(graph: SketchGraph) -> Iterator[tuple[int, Int[np.ndarray, " limb"]]]:
    """Every parent with its limbs from below, parents first."""
    for host in np.argsort(graph.limb_first):
        limbs = np.flatnonzero(graph.limb_parent == host)
        if len(limbs):
            yield int(host), limbs[np.argsort(graph.parent[graph.limb_first[limbs]], kind="stable")]


def seen_about(graph: SketchGraph, host: int, limbs: Int[np.ndarray, " limb"]) -> Seen:
    """What is seen of a parent's limbs."""
    reach, weight, right, at = (np.zeros(len(limbs)) for _ in range(4))
    run = _run(graph, host)
    for k, limb in enumerate(limbs):
        first = int(graph.limb_first[limb])
        up = int(graph.parent[first])
        along = _along(graph, host, up)
        beyond = _beyond(graph, first)
        off = (graph.xy[beyond] - graph.start[first]) @ np.array([along[1], -along[0]])
        reach[k], right[k] = np.abs(off).max(), np.sign(off[int(np.argmax(np.abs(off)))]) or 1.0
        weight[k] = np.hypot(*(graph.xy[beyond] - graph.start[beyond]).T).sum()
        at[k] = run.get(up, 0.0)
    most = np.array([reach[max(k - _NEIGHBOURS, 0) : k + _NEIGHBOURS + 1].max() for k in range(len(limbs))])
    whole = np.hypot(*(graph.xy - graph.start)[~graph.is_base].T).sum()
    return Seen(right, reach / np.maximum(most, 1e-9), weight / max(weight.sum(), 1e-9), at / max(at.max(), 1e-9), float(weight.sum() / max(whole, 1e-9)))


def around(seen: Seen, older: Float[np.ndarray, " 2"]) -> tuple[Float[np.ndarray, " limb"], Float[np.ndarray, " 2"]]:
    """(θ of every limb, radians; the sums of the last term for these and older limbs, in shares of the tree's wood). `older`: those of the limbs before them."""
    count = len(seen.right)
    near = np.sqrt(np.outer(seen.weight, seen.weight)) * np.exp(-np.abs(seen.along[:, None] - seen.along) / NEAR)
    np.fill_diagonal(near, 0.0)
    best, least = np.zeros(count), np.inf
    for phase in range(PHASES):
        angle = 2.0 * np.pi * (np.arange(count, 0, -1) + phase / PHASES) / count
        angle, worth = _swapped(_first_order(angle, seen), seen, near, older)
        if worth < least - 1e-9:
            best, least = angle, worth
    return best, older + _leaning(mirrored(best, seen.right), seen)


def mirrored(angle: Float[np.ndarray, "..."], right: Float[np.ndarray, "..."]) -> Float[np.ndarray, "..."]:
    """An angle on the side on which its limb is drawn; front stays front."""
    return np.where(np.cos(angle) * right >= 0.0, angle, np.pi - angle)


def _first_order(angle, seen: Seen) -> Float[np.ndarray, " limb"]:
    """The limbs that reach farthest where the page is."""
    order = np.empty_like(angle)
    order[np.argsort(-seen.reach, kind="stable")] = angle[np.argsort(-np.abs(np.cos(angle)), kind="stable")]
    return order


def _swapped(angle, seen: Seen, near, older) -> tuple[Float[np.ndarray, " limb"], float]:
    angle, worth = angle.copy(), _cost(angle, seen, near, older)
    for _ in range(_SWEEPS):
        before = worth
        for i in range(len(angle)):
            for j in range(i + 1, len(angle)):
                angle[[i, j]] = angle[[j, i]]
                other = _cost(angle, seen, near, older)
                if other < worth - 1e-12:
                    worth = other
                else:
                    angle[[i, j]] = angle[[j, i]]
        if worth >= before - 1e-12:
            break
    return angle, worth


def _cost(angle, seen: Seen, near, older) -> float:
    stands = mirrored(angle, seen.right)
    across, deep = np.cos(stands), np.sin(stands)
    alike = 0.5 * float(across @ near @ across + deep @ near @ deep)
    return alike + SHORT * float(seen.weight @ (np.abs(across) - FULL * seen.reach) ** 2) + EVEN * float(((older + _leaning(stands, seen)) ** 2).sum()) / max(seen.share, 1e-9)


def _leaning(stands, seen: Seen) -> Float[np.ndarray, " 2"]:
    """How far limbs lean towards the viewer, and to one diagonal."""
    return seen.share * np.array([seen.weight @ np.sin(stands), seen.weight @ (np.sin(stands) * np.cos(stands))])


def _along(graph: SketchGraph, host: int, up: int) -> Float[np.ndarray, " 2"]:
    row = int(graph.limb_first[host]) if graph.is_base[up] else up
    step = graph.xy[row] - graph.start[row]
    return step / max(float(np.hypot(*step)), 1e-9)


def _run(graph: SketchGraph, host: int) -> dict[int, float]:
    """How far along a limb each of its nodes lies."""
    total, found = 0.0, {}
    for row in np.flatnonzero(graph.limb == host):
        total += float(np.hypot(*(graph.xy[row] - graph.start[row]))) if graph.parent[row] != NULL else 0.0
        found[int(row)] = total
    return found


def _beyond(graph: SketchGraph, first: int) -> Int[np.ndarray, " row"]:
    """A row and all that it bears; parents stand before their children."""
    inside = np.zeros(len(graph), bool)
    inside[first] = True
    for row in range(first + 1, len(graph)):
        inside[row] = graph.parent[row] != NULL and inside[graph.parent[row]]
    return np.flatnonzero(inside)
