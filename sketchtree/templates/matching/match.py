"""Which exemplar is a sketch most like, and from which side?

Chen et al. 2008, §7: the exemplar whose best view is likest to the sketch is the template, by

    L(S, E) = max_v L_c(S, E | v) + L_b(S, E | v) with a crown, max_v L_b(S, E | v) without        `score="chen"`

The terms are not comparable as they stand: L_b ranges over hundreds where a drawing is regular, and few drawn pairs make
its means unsure. `score="calibrated"`, the default, is ours: crown, branching and a third term, the drawing's posture, are measured by how far
sketches of a tree of the same kind lie apart, and weighed so that exp L is proportional to how probable the exemplars are
(`likeness`, `metric`, `weights`). Both keep crown and branching apart in the result.
"""

from dataclasses import dataclass

import numpy as np

from sketchtree.axes import NULL
from sketchtree.errors import OptionError, SketchError, TemplateError
from sketchtree.sketch.graph import SketchGraph
from sketchtree.templates.seen.branching import branching
from sketchtree.templates.store.database import Database
from sketchtree.templates.seen.drawing import Drawing
from sketchtree.templates.seen.footprint import footprint, root_branch
from sketchtree.templates.matching.likeness import SketchShape
from sketchtree.templates.seen.posture import FEATURES, posture
from sketchtree.templates.matching.search import best_views
from sketchtree.templates.matching.weights import BARE, CROWN

SCORES = ("calibrated", "chen")


@dataclass(frozen=True)
class Match:
    """One exemplar and how well its best view fits; higher is better."""

    name: str
    view_deg: float  # azimuth of the best view
    score: float
    crown: float | None  # its crown term; None where no crown was drawn
    branching: float  # its branching term
    posture: float | None = None  # its posture term; None for `chen`
    probability: float | None = None  # that the sketch shows this exemplar's kind, all of them alike beforehand; None for `chen`


def match(graph: SketchGraph, db: Database, *, score: str = "calibrated", count: int | None = None) -> list[Match]:
    """The exemplars, best first, each with its best view: all of them, or the first `count`."""
    if score not in SCORES:
        raise OptionError(f"There is no score called {score!r}.", remedy=f"Use one of: {', '.join(SCORES)}.")
    if len(db) == 0:
        raise TemplateError(f"{db.path}: the database has no exemplars.", remedy="Rebuild it with `sketchtree templates build`.")
    shape = sketch_shape(graph)
    learnt = CROWN if graph.crown else BARE
    found = best_views(shape, db.views, learnt if score == "calibrated" else None)
    ranked = np.argsort(-found.score, kind="stable")
    share = np.exp((found.score - found.score[ranked[0]]).astype(float))
    share /= share.sum()

    def at(column, i):
        return None if column is None else float(column[i])

    return [
        Match(
            db.names[i], float(db.azimuths[found.view[i]]), float(found.score[i]), *(at(term, i) for term in found.terms),
            **({"probability": float(share[i])} if score == "calibrated" else {}),
        )
        for i in ranked[:count]
    ]  # fmt: skip


def sketch_shape(graph: SketchGraph) -> SketchShape:
    """Footprint of crown and branches without the root branch, branching and posture of a sketch."""
    if graph.segment_count == 0:
        raise SketchError("There is no branch to match.", remedy="Draw a trunk, or name a template with --template.")
    drawing = Drawing.of_graph(graph)
    held = posture(drawing)[0]
    if not graph.crown:
        return SketchShape(None, branching(drawing), held)
    held[FEATURES.index("aspect")] = np.nan  # the crown's curve says how wide the tree is, be its limbs ever so few
    outline = np.concatenate([_branch_points(graph), *graph.crown])
    return SketchShape(footprint(outline), branching(drawing), held)


def _branch_points(graph: SketchGraph):
    keep = ~root_branch(graph.parent) if len(graph) > 1 else graph.parent == NULL
    keep = keep if keep.any() else np.ones(len(graph), bool)
    owner = np.repeat(np.arange(len(graph)), np.diff(graph.curve_start))
    return np.concatenate([graph.start[keep], graph.xy[keep], graph.curve_points[keep[owner]]])
