"""Which view of every exemplar is a sketch most like? One pass over the database, block by block.

100,000 exemplars under 36 views have 1 GB of footprints, so nothing of their size is made on the way: a block's terms are summed,
each exemplar's best view is kept, and the block is forgotten. Small databases are compared in double precision. Large ones stay as they are
stored, in single precision, and their crowns' distance is, with the basis W of the learnt `Metric`,

    ‖W(f_S − f)‖² = ‖W f_S‖² − 2 (W Wᵀ f_S) · f + ‖W f‖²

whose last term does not depend on the sketch and is kept from the first search on.
"""

import weakref
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.templates.branching import Branching
from sketchtree.templates.exemplar import Views
from sketchtree.templates.likeness import SketchShape, calibrated_terms, chen_terms
from sketchtree.templates.metric import Metric

BLOCK = 256  # exemplars at a time
SMALL = 1024  # exemplars; up to so many are compared in double precision

_squares = weakref.WeakKeyDictionary()  # Views → {id of a metric: ‖W f‖² (exemplar, view)}


@dataclass(frozen=True, eq=False)
class Found:
    """Of every exemplar its best view, and its terms there."""

    view: Int[np.ndarray, " exemplar"]
    score: Float[np.ndarray, " exemplar"]
    terms: tuple  # (exemplar) each; None: no such term


def best_views(shape: SketchShape, views: Views, metric: Metric | None) -> Found:
    """The best view of every exemplar by the calibrated score, or by the paper's where `metric` is None."""
    parts = []
    for first, block in _blocks(views):
        if metric is None:
            terms = chen_terms(shape, block)
        else:
            large = shape.footprint is not None and len(views.footprint) > SMALL
            square = _square(views, metric)[first : first + len(block.footprint)] if large else None
            terms = calibrated_terms(shape, block, metric, square)
        parts.append(_best(terms))
    view, score, *terms = (None if column[0] is None else np.concatenate(column) for column in zip(*parts, strict=True))
    return Found(view, score, tuple(terms))


def _best(terms):
    total = sum(term for term in terms if term is not None)
    view = np.argmax(total, axis=1)
    rows = np.arange(len(view))
    return view, total[rows, view], *(None if term is None else term[rows, view] for term in terms)


def _blocks(views: Views) -> Iterator[tuple[int, Views]]:
    """(first exemplar, a block of views): double precision where there are few exemplars."""
    kind = views.footprint.dtype if len(views.footprint) > SMALL else np.dtype(float)
    for first in range(0, len(views.footprint), BLOCK):
        among = slice(first, first + BLOCK)
        b = views.branching
        moments = Branching(*(x[among].astype(kind, copy=False) for x in (b.mean, b.sd, b.count)))
        yield first, Views(views.footprint[among].astype(kind, copy=False), moments, views.posture[among].astype(kind, copy=False))


def _square(views: Views, metric: Metric) -> Float[np.ndarray, "exemplar view"]:
    """‖W f‖² of every view."""
    known = _squares.setdefault(views, {})
    if metric.name not in known:
        basis = metric.basis.astype(views.footprint.dtype)
        square = np.empty(views.footprint.shape[:2], views.footprint.dtype)
        for first in range(0, len(square), BLOCK):
            wave = views.footprint[first : first + BLOCK] @ basis
            square[first : first + BLOCK] = np.einsum("...c,...c->...", wave, wave)
        known[metric.name] = square
    return known[metric.name]
