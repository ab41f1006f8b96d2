"""Which exemplar is a sketch most like, and from which side?

Chen et al. 2008, §7. For sketch S and exemplar E under view v:

    L_c(S, E | v) = −‖f_S − f_E|v‖                                             crown (footprint f)
    L_b(S, E | v) = −Σ_{x = s, α, β} (μ_x − μ_x,E|v)² / (σ_x² + σ_x,E|v²)      branching, in 2D
    L = L_c + L_b with a crown, else L_b                                       `score="chen"`

The exemplar whose best view scores highest is the template. The terms are not comparable as they stand (L_b ranges
over hundreds where a drawing is regular), and few drawn pairs make its means unsure. `score="calibrated"`,
the default, is ours: each term is divided by what two different exemplars differ by on average, so
that 1 means "as unlike as two species"; and the drawing's posture is a third term:

    C = ‖f_S − f_E|v‖² / E‖f_A − f_B‖²
    B = mean_x ρ( (μ_x − μ_x,E|v)² / (2 S_x² + σ_x² / n_x) )        S_x sd of μ_x between exemplars
    P = mean_k ρ( (p_k − p_k,E|v)² / 2 S_k² )                       p the posture (what is shown of it), S_k as S_x
    L = −(w_C C + w_B B + w_P P),     ρ(d) = 3 ln(1 + d/3)          heavy tails: one odd trait costs little more

All exemplars and views are one array expression.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from sketchtree.axes import NULL
from sketchtree.errors import OptionError, SketchError, TemplateError
from sketchtree.sketch.graph import SketchGraph
from sketchtree.templates.branching import Branching, branching
from sketchtree.templates.database import Database
from sketchtree.templates.drawing import Drawing
from sketchtree.templates.exemplar import Views
from sketchtree.templates.footprint import footprint, root_branch
from sketchtree.templates.posture import posture

SCORES = ("calibrated", "chen")
WEIGHTS = (2.0, 0.5, 3.0)  # w_C, w_B, w_P
SIGMA_FLOOR = (0.05, 0.01, 0.01)  # of sqrt(σ² + σ²) for s (1), α, β (rad): a drawing may be exactly regular


@dataclass(frozen=True)
class Match:
    """One exemplar and how well its best view fits; higher is better."""

    name: str
    view_deg: float  # azimuth of the best view
    score: float
    crown: float | None  # its crown term; None where no crown was drawn
    branching: float  # its branching term
    posture: float | None = None  # its posture term; None for `chen`


@dataclass(frozen=True, eq=False)
class SketchShape:
    """What matching knows of a sketch."""

    footprint: Float[np.ndarray, " direction"] | None  # None without a crown
    branching: Branching  # one view
    posture: Float[np.ndarray, " feature"]


def match(graph: SketchGraph, db: Database, *, score: str = "calibrated") -> list[Match]:
    """All exemplars, best first, each with its best view."""
    if score not in SCORES:
        raise OptionError(f"There is no score called {score!r}.", remedy=f"Use one of: {', '.join(SCORES)}.")
    if len(db) == 0:
        raise TemplateError(f"{db.path}: the database has no exemplars.", remedy="Rebuild it with `sketchtree templates build`.")
    shape = sketch_shape(graph)
    terms = (chen_terms if score == "chen" else calibrated_terms)(shape, db.views)
    total = sum(term for term in terms if term is not None)
    best = np.argmax(total, axis=1)
    rows = np.arange(len(best))
    ranked = np.argsort(-total[rows, best], kind="stable")

    def at(term, i):
        return None if term is None else float(term[i, best[i]])

    return [
        Match(db.names[i], float(db.azimuths[best[i]]), float(total[i, best[i]]), *(at(term, i) for term in terms))
        for i in ranked
    ]


def sketch_shape(graph: SketchGraph) -> SketchShape:
    """Footprint of crown and branches without the root branch, branching and posture of a sketch."""
    if graph.segment_count == 0:
        raise SketchError("There is no branch to match.", remedy="Draw a trunk, or name a template with --template.")
    drawing = Drawing.of_graph(graph)
    outline = np.concatenate([_branch_points(graph), *graph.crown])
    width = None
    if graph.crown:
        width = np.array([np.ptp(np.concatenate([graph.xy, *graph.crown])[:, 0])])
    return SketchShape(footprint(outline) if graph.crown else None, branching(drawing), posture(drawing, width)[0])


def chen_terms(shape: SketchShape, views: Views):
    """(L_c or None, L_b), each (exemplar, view); exactly §7."""
    return crown_likeness(shape, views), branching_likeness(shape, views)


def crown_likeness(shape: SketchShape, views: Views) -> Float[np.ndarray, "exemplar view"] | None:
    """L_c = −‖f_S − f_E|v‖; None without a crown."""
    if shape.footprint is None:
        return None
    return -np.sqrt(np.sum((views.footprint - shape.footprint) ** 2, axis=-1))


def branching_likeness(shape: SketchShape, views: Views) -> Float[np.ndarray, "exemplar view"]:
    """L_b. A statistic that sketch or view lacks is left out of the sum."""
    sketch, exemplar = shape.branching, views.branching
    variance = np.maximum(sketch.sd[0] ** 2 + exemplar.sd**2, np.square(SIGMA_FLOOR))
    return -np.nansum((sketch.mean[0] - exemplar.mean) ** 2 / variance, axis=-1)


def calibrated_terms(shape: SketchShape, views: Views):
    """(−w_C C or None, −w_B B, −w_P P), each (exemplar, view)."""
    w_crown, w_branching, w_posture = WEIGHTS
    crown = None
    if shape.footprint is not None:
        apart = 2 * np.sum(_spread(views.footprint) ** 2)
        crown = -w_crown * np.sum((views.footprint - shape.footprint) ** 2, axis=-1) / max(apart, 1e-9)
    sketch, exemplar = shape.branching, views.branching
    error = np.nan_to_num(sketch.sd[0] ** 2 / np.maximum(sketch.count[0], 1))
    unlike = (sketch.mean[0] - exemplar.mean) ** 2 / (2 * _spread(exemplar.mean) ** 2 + error + 1e-6)
    unlike = np.where(np.isnan(unlike), 1.0, _heavy(unlike))  # lacking it is as bad as another species
    shown = ~np.isnan(shape.posture)  # `aspect` always is
    held = _heavy((shape.posture - views.posture) ** 2 / (2 * _spread(views.posture) ** 2 + 1e-4))[..., shown]
    return crown, -w_branching * unlike.mean(axis=-1), -w_posture * held.mean(axis=-1)


def _heavy(d):
    return 3.0 * np.log1p(d / 3.0)


def _spread(x: Float[np.ndarray, "exemplar view trait"]) -> Float[np.ndarray, " trait"]:
    """Sd of a trait between exemplars (of its mean over views)."""
    known = ~np.isnan(x)
    mean = np.where(known, x, 0.0).sum(axis=1) / np.maximum(known.sum(axis=1), 1)
    valid = known.any(axis=1)
    centre = (mean * valid).sum(axis=0) / np.maximum(valid.sum(axis=0), 1)
    return np.sqrt((((mean - centre) ** 2) * valid).sum(axis=0) / np.maximum(valid.sum(axis=0), 1))


def _branch_points(graph: SketchGraph) -> Float[np.ndarray, "point 2"]:
    keep = ~root_branch(graph.parent) if len(graph) > 1 else graph.parent == NULL
    keep = keep if keep.any() else np.ones(len(graph), bool)
    owner = np.repeat(np.arange(len(graph)), np.diff(graph.curve_start))
    return np.concatenate([graph.start[keep], graph.xy[keep], graph.curve_points[keep[owner]]])
