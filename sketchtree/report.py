"""What was done, as one JSON object (`--report`): schema 1, held by `report.schema.json`.

Angles are in degrees, lengths in metres unless a key says sketch units; a missing value is null.
"""

import json
from importlib.resources import files

import numpy as np

from sketchtree.mrf.solver import RESULTS
from sketchtree.parameters import TreeParameters
from sketchtree.pipeline import DrawnTree, TreeModel
from sketchtree.reading_report import frame, plain, reading


def report_schema() -> dict:
    """The JSON schema every report satisfies."""
    return json.loads(files("sketchtree").joinpath("report.schema.json").read_text())


def build_report(
    drawn: DrawnTree,
    model: TreeModel | None,
    *,
    command: str,
    seed: int,
    seconds: dict[str, float],
    options: dict,
    warnings: tuple[str, ...] = (),
) -> dict:
    """The report of one run; `model` is None where only the drawn branches were asked for."""
    seen = drawn.warnings if model is None else model.warnings
    total = drawn.graph.segment_count if model is None else model.skeleton.segment_count
    found = of_tree(drawn, model)
    return plain(frame(command, seed, seconds, options, (*seen, *warnings)) | reading(drawn.graph, total) | found)


def of_tree(drawn: DrawnTree, model: TreeModel | None) -> dict:
    """What is reported of one tree, its reading aside."""
    return {
        "template": [_match(match) for match in drawn.matches],
        "template_used": drawn.exemplar.name if drawn.exemplar else None,
        "theta": {"before": _theta(drawn.fit.theta_before), "after": _theta(drawn.fit.theta)},
        "height": drawn.skeleton.height if model is None else model.skeleton.height,
        "leaves": None if model is None else len(model.leaves),
        "triangles": None if model is None else _triangles(model),
        "wood_used": None if model is None else model.wood_used,
        "transform": {"scale": drawn.similarity.scale, "translate": list(drawn.similarity.translate)},
        "infer": _inference(drawn),
    }


def _match(match) -> dict:
    return {
        "name": match.name,
        "view_deg": match.view_deg,
        "score": match.score,
        "crown": match.crown,
        "branching": match.branching,
    }


def _theta(theta: TreeParameters | None) -> dict | None:
    return None if theta is None else theta.as_dict(degrees=True)


def _inference(drawn: DrawnTree) -> dict:
    fit, samples = drawn.fit, drawn.fit.posterior
    return {
        "method": fit.method,
        "result": _result_name(fit.result),
        "log_posterior": fit.log_posterior,
        "seconds_warm": fit.seconds_warm,
        "steps": fit.steps,
        "rhat": None if samples is None else samples.rhat,
        "ess": None if samples is None else samples.ess,
        "intervals": [] if samples is None else _intervals(drawn),
        "alternatives": [{"log_posterior": reading.log_posterior, "odds": reading.odds} for reading in fit.alternatives],
    }


def _intervals(drawn: DrawnTree) -> list[dict]:
    """|dz|/|v| of every drawn segment above the ground; `id` is that of its tip in the SWC."""
    spread, ids = drawn.fit.posterior.intervals, drawn.skeleton.node_id
    rows = np.flatnonzero(np.isfinite(spread.q50))
    return [{"id": int(ids[row])} | {name: round(float(getattr(spread, name)[row]), 6) for name in spread._fields} for row in rows]


def _result_name(result: RESULTS) -> str:
    names = ("converged", "out_of_steps", "not_finite")
    return next(name for name in names if result == getattr(RESULTS, name))


def _triangles(model: TreeModel) -> dict:
    count = {"wood": 0, "leaf": 0}
    for mesh in model.meshes:
        count["leaf" if mesh.name.startswith("leaf") else "wood"] += len(mesh.triangle)
    return count
