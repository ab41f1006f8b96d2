"""Which view of every exemplar is a sketch most like? One pass over the database, block by block.

100,000 exemplars under 36 views have 1 GB of footprints, so nothing of their size is made on the way: a block's terms are summed,
each exemplar's best view is kept, and the block is forgotten. A squared distance of `likeness`, W the whitening of its metric, is taken apart,

    ‖W(x − X)‖² = ‖W x‖² − 2 (WᵀW x) · X + ‖W X‖²         x of the sketch, X of every view

whose last term does not depend on the sketch and is kept from the first search on: what remains is one product of a matrix and a vector.
Large databases stay in single precision, as they are stored; small ones are compared in double.
"""

import weakref
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.templates.seen.branching import Branching
from sketchtree.templates.exemplar import Views
from sketchtree.templates.matching.likeness import SketchShape, chen_terms, heavy, trait_distance, whitening
from sketchtree.templates.matching.metric import BRANCHING, POSTURE, Metric

BLOCK, CHEN_BLOCK = 1024, 64  # exemplars at a time; the paper's sum makes differences of whole footprints, which should stay in a cache
SMALL = 1024  # exemplars; up to so many are compared in double precision
PATTERNS = 12  # squares kept: one for each pattern of what sketches show


@dataclass(frozen=True, eq=False)
class Found:
    """Of every exemplar its best view, and its terms there."""

    view: Int[np.ndarray, " exemplar"]
    score: Float[np.ndarray, " exemplar"]
    terms: tuple  # (exemplar) each; None: no such term


def best_views(shape: SketchShape, views: Views, metric: Metric | None) -> Found:
    """The best view of every exemplar by the calibrated score, or by the paper's where `metric` is None."""
    ready = _kept.get(views)
    if ready is None:
        ready = _kept[views] = _Ready(views)
    parts = [] if metric is None else _parts(shape, ready, metric)
    blocks = []
    step = CHEN_BLOCK if metric is None else BLOCK
    for first in range(0, len(views.footprint), step):
        among = slice(first, first + step)
        terms = chen_terms(shape, ready.block(among)) if metric is None else [part and part.term(among) for part in parts]
        blocks.append(_best(terms))
    view, score, *terms = (None if column[0] is None else np.concatenate(column) for column in zip(*blocks, strict=True))
    return Found(view, score, tuple(terms))


def _best(terms):
    total = sum(term for term in terms if term is not None)
    view = np.argmax(total, axis=1)
    rows = np.arange(len(view))
    return view, total[rows, view], *(None if term is None else term[rows, view] for term in terms)


class _Ready:
    """Views in the precision they are compared in, and the squares known of them."""

    def __init__(self, views: Views):
        kind = views.footprint.dtype if len(views.footprint) > SMALL else np.dtype(float)
        b = views.branching
        self.footprint = views.footprint.astype(kind, copy=False)
        self.branching = Branching(*(x.astype(kind, copy=False) for x in (b.mean, b.sd, b.count)))
        self.posture = views.posture.astype(kind, copy=False)
        self._square = {}

    def block(self, among: slice) -> Views:
        """The views of some exemplars."""
        b = self.branching
        return Views(self.footprint[among], Branching(b.mean[among], b.sd[among], b.count[among]), self.posture[among])

    def square(self, key, figures, whiten) -> Float[np.ndarray, "exemplar view"]:
        """‖W X‖² of every view."""
        if key not in self._square:
            while len(self._square) >= PATTERNS:
                self._square.pop(next(iter(self._square)))
            whole = np.empty(figures.shape[:2], figures.dtype)
            for first in range(0, len(whole), BLOCK):
                wave = figures[first : first + BLOCK] @ whiten.astype(figures.dtype)
                whole[first : first + BLOCK] = np.einsum("...c,...c->...", wave, wave)
            self._square[key] = whole
        return self._square[key]


_kept: weakref.WeakKeyDictionary[Views, _Ready] = weakref.WeakKeyDictionary()


class _Part:
    """One term of the calibrated score: −weight · heavy(‖W(x − X)‖²)."""

    def __init__(self, key, ready: _Ready, figures, whiten, at, weight: float, exact=None):
        self._figures, self._weight, self._exact = figures, float(weight), exact
        self._shown = int((whiten != 0).any(axis=1).sum()) if exact else whiten.shape[1]
        self._square = ready.square(key, figures, whiten)
        wave = at @ whiten
        self._constant, self._slope = float(wave @ wave), (2 * whiten @ wave).astype(figures.dtype)

    def term(self, among: slice) -> Float[np.ndarray, "exemplar view"]:
        """The term of some exemplars."""
        figures = self._figures[among]
        distance = self._square[among] - figures @ self._slope
        distance += self._constant
        np.maximum(distance, 0, out=distance)
        if self._exact and np.isnan(distance.sum()):  # an exemplar lacks a trait
            rows = np.isnan(distance)
            distance[rows] = self._exact(figures[rows])
        return heavy(distance, self._shown) * -self._weight


def _parts(shape: SketchShape, ready: _Ready, metric: Metric) -> list[_Part | None]:
    """Crown (or None), branching, posture."""
    crown = None
    if shape.footprint is not None:
        crown = _Part((metric.name, "crown"), ready, ready.footprint, metric.basis, shape.footprint, metric.weight[0])
    parts = [crown]
    for among, figures, weight in ((BRANCHING, ready.branching.mean, metric.weight[1]), (POSTURE, ready.posture, metric.weight[2])):
        wanted = (shape.traits - metric.shift)[among]
        shown = ~np.isnan(wanted)
        whiten = np.zeros((len(wanted), int(shown.sum())))
        whiten[shown] = whitening(metric, among, shown)
        key = (metric.name, among.start, shown.tobytes())

        def exact(rows, among=among):
            return trait_distance(shape, rows, metric, among)[0]

        parts.append(_Part(key, ready, figures, whiten, np.where(shown, wanted, 0.0), weight, exact))
    return parts
