"""Which round bars does a game collide with instead of the wood?

Each limb as thick as a threshold is cut into pieces, and round each piece stands the capsule whose line is the piece's chord and whose radius

    r = max over the piece (distance of the limb's line from the chord + the limb's radius there)

so that all of the wood is inside. How loosely it sits is 1 − mean(wood's radius) / r; as long as there are capsules to give, the piece is cut in two
that is worst, by looseness × length × r: long thick wood first. Where even so they sit too loosely on average, there is too much wood for so
few, and the threshold rises. Stems flare at the ground (`geometry/rootflare.py`): their lines count as wider there.
"""

import heapq
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int

from sketchtree.asset import Capsules
from sketchtree.axes import NULL
from sketchtree.geometry.detail import Detail
from sketchtree.geometry.limbs import CentreLines
from sketchtree.rig.bones import Bones
from sketchtree.rig.boughs import Boughs
from sketchtree.rig.place import Places
from sketchtree.rig.weights import place_weights

_SAMPLES = 24  # of a piece
_TIGHT = 0.08  # looseness below which a piece is not cut further
_LOOSE = 0.25  # on average, at most, while the threshold may rise
_RISE, _RISES = 1.1, 31  # of the threshold: factor, and how often at most
_FLARE = 1.1  # radii above the ground in which the flare falls to 1 / e


@dataclass(frozen=True, eq=False)
class _Piece:
    limb: int
    low: float  # metres along the limb
    high: float
    start: Float[np.ndarray, " 3"]
    end: Float[np.ndarray, " 3"]
    radius: float
    loose: float

    @property
    def badness(self) -> float:
        return self.loose * (self.high - self.low) * self.radius


class Fitted(NamedTuple):
    """Capsules, and how thin the wood is that still has some."""

    capsules: Capsules
    thinnest: float  # metres of radius, no less than was asked for
    loose: float  # mean of 1 − wood's radius / capsule's, weighted by length


def capsules(
    lines: CentreLines, limbs: Boughs, bones: Bones | None, *, thinnest: float = 0.02, most: int = 64, flare: float = Detail().flare
) -> Fitted:
    """Capsules round the wood above the ground of at least `thinnest` metres radius (> 0), `most` of them (≥ 1) at most."""
    low, high = 0, _RISES  # least rise at which they sit well: between these
    while low < high:
        rise = (low + high) // 2
        low, high = (low, rise) if _fits(lines, limbs, thinnest * _RISE**rise, most, flare) else (rise + 1, high)
    thinnest *= _RISE**low
    pieces = _pieces(lines, limbs, thinnest, most, flare)
    pieces.sort(key=lambda piece: (piece.limb, piece.low))
    found = Capsules(
        np.array([piece.start for piece in pieces]).reshape(-1, 3),
        np.array([piece.end for piece in pieces]).reshape(-1, 3),
        np.array([piece.radius for piece in pieces]),
        _joints(lines, limbs, bones, pieces),
    )
    return Fitted(found, thinnest, _looseness(pieces))


def _fits(lines: CentreLines, limbs: Boughs, thinnest: float, most: int, flare: float) -> bool:
    """Every limb so thick has a capsule, and they sit well."""
    thick = (_thickest(lines) >= thinnest) & ~limbs.is_root
    return int(thick.sum()) <= most and _looseness(_pieces(lines, limbs, thinnest, most, flare)) <= _LOOSE


def _looseness(pieces: list[_Piece]) -> float:
    return float(np.average([piece.loose for piece in pieces], weights=[piece.high - piece.low for piece in pieces])) if pieces else 0.0


def _pieces(lines: CentreLines, limbs: Boughs, thinnest: float, most: int, flare: float) -> list[_Piece]:
    radius = _thickest(lines)
    able = np.flatnonzero((radius >= thinnest) & ~limbs.is_root)
    able = able[np.lexsort((able, -radius[able], limbs.depth[able] > 0))][:most]
    whole = [_piece(lines, limbs, int(limb), *_thick(lines, limbs, int(limb), thinnest), flare) for limb in able]
    return _cut(lines, limbs, [piece for piece in whole if piece.high > piece.low], most, flare)


def _thickest(lines: CentreLines) -> Float[np.ndarray, " limb"]:
    return np.maximum.reduceat(lines.radius, lines.start[:-1]) if len(lines) else np.zeros(0)


def _thick(lines: CentreLines, limbs: Boughs, limb: int, thinnest: float) -> tuple[float, float]:
    """Where along the limb the wood is out of the ground or of its parent, and thick enough."""
    own = slice(lines.start[limb], lines.start[limb + 1])
    high = lines.s[own][np.flatnonzero(lines.radius[own] >= thinnest)[-1]]
    low = lines.ground[limb] if limbs.is_stem[limb] else limbs.buried[limb]
    return float(low), float(high)


def _cut(lines: CentreLines, limbs: Boughs, pieces: list[_Piece], most: int, flare: float) -> list[_Piece]:
    """Halve the worst pieces until there are `most`, or all sit well."""
    worst = [(-piece.badness, rank, piece) for rank, piece in enumerate(pieces)]
    heapq.heapify(worst)
    count, done = len(worst), []
    while worst and len(worst) + len(done) < most:
        _, _, piece = heapq.heappop(worst)
        if piece.loose < _TIGHT or piece.high - piece.low < piece.radius:
            done.append(piece)
            continue
        middle = _balanced(lines, limbs, piece, flare)
        for low, high in ((piece.low, middle), (middle, piece.high)):
            half = _piece(lines, limbs, piece.limb, low, high, flare)
            heapq.heappush(worst, (-half.badness, count, half))
            count += 1
    return done + [piece for _, _, piece in worst]


def _balanced(lines: CentreLines, limbs: Boughs, piece: _Piece, flare: float) -> float:
    """Where to cut a piece, so that its halves sit best."""
    tried = piece.low + (piece.high - piece.low) * np.array([0.1, 0.2, 0.35, 0.5, 0.65, 0.8])
    halves = [[_piece(lines, limbs, piece.limb, low, high, flare) for low, high in ((piece.low, at), (at, piece.high))] for at in tried]
    return float(tried[np.argmin([a.badness + b.badness for a, b in halves])])


def _piece(lines: CentreLines, limbs: Boughs, limb: int, low: float, high: float, flare: float) -> _Piece:
    own = slice(lines.start[limb], lines.start[limb + 1])
    known = lines.s[own]
    s = np.sort(np.r_[np.linspace(low, high, _SAMPLES), known[(known > low) & (known < high)]])
    point = np.column_stack([np.interp(s, known, lines.point[own, axis]) for axis in range(3)])
    radius = np.interp(s, known, lines.radius[own])
    if limbs.is_stem[limb]:
        foot = lines.radius[lines.start[limb]]
        radius = radius * (1.0 + flare * np.exp(-np.maximum(s - lines.ground[limb], 0.0) / (_FLARE * foot)))
    start, end = point[0], point[-1]
    chord = end - start
    share = np.clip((point - start) @ chord / max(chord @ chord, 1e-12), 0.0, 1.0)
    most = float(np.max(np.linalg.norm(point - start - share[:, None] * chord, axis=1) + radius))
    mean = float(np.trapezoid(radius, s) / (high - low)) if high > low else float(radius[0])
    return _Piece(limb, low, high, start, end, most, 1.0 - mean / most)


def _joints(lines: CentreLines, limbs: Boughs, bones: Bones | None, pieces: list[_Piece]) -> Int[np.ndarray, " capsule"]:
    """The bone that moves the middle of each piece most."""
    if bones is None or not pieces:
        return np.full(len(pieces), NULL)
    middle = Places(np.array([piece.limb for piece in pieces]), np.array([0.5 * (piece.low + piece.high) for piece in pieces]))
    found = place_weights(lines, limbs, bones, middle)
    return found.joint[np.arange(len(pieces)), found.weight.argmax(axis=1)]
