"""What was done, as one JSON object (`--report`): schema 1, held by `report.schema.json`.

Angles are in degrees, lengths in metres unless a key says sketch units; a missing value is null.
"""

import json
import math
import sys
from importlib.resources import files
from pathlib import Path

import numpy as np

from sketchtree.mrf.solver import RESULTS
from sketchtree.parameters import TreeParameters
from sketchtree.pipeline import DrawnTree, TreeModel
from sketchtree.sketch.graph import SketchGraph
from sketchtree.version import __version__

SCHEMA = 1
SECONDS = ("import", "read", "match", "infer", "propagate", "foliage", "mesh", "export", "total")


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
    found = {
        "template": [_match(match) for match in drawn.matches],
        "template_used": drawn.exemplar.name if drawn.exemplar else None,
        "theta": {"before": _theta(drawn.fit.theta_before), "after": _theta(drawn.fit.theta)},
        "height": drawn.skeleton.height if model is None else model.skeleton.height,
        "leaves": None if model is None else len(model.leaves),
        "triangles": None if model is None else _triangles(model),
        "transform": {"scale": drawn.similarity.scale, "translate": list(drawn.similarity.translate)},
        "infer": _inference(drawn),
    }
    return _plain(_frame(command, seed, seconds, options, (*seen, *warnings)) | _reading(drawn.graph, total) | found)


def reading_report(graph: SketchGraph, *, command: str, seed: int, seconds: dict[str, float], options: dict) -> dict:
    """The report of a run that only read the drawing: what was not asked for is null."""
    return _plain(_frame(command, seed, seconds, options, graph.warnings) | _reading(graph, graph.segment_count))


def _frame(command: str, seed: int, seconds: dict[str, float], options: dict, warnings: tuple[str, ...]) -> dict:
    """What every report says of the run itself; null where nothing is known yet."""
    return {
        "schema": SCHEMA,
        "version": __version__,
        "command": command,
        "template": [],
        "template_used": None,
        "theta": {"before": None, "after": None},
        "height": None,
        "leaves": None,
        "triangles": None,
        "transform": None,
        "infer": None,
        "seconds": {name: seconds.get(name) for name in SECONDS},
        "peak_mb": peak_mb(),
        "warnings": list(dict.fromkeys(warnings)),
        "options": options,
        "seed": seed,
    }


def _reading(graph: SketchGraph, total: int) -> dict:
    """How the drawing was read. Sketch units, y up."""
    return {
        "attachments": [_attachment(attachment) for attachment in graph.attachments],
        "roles": [_role(role) for role in graph.roles],
        "cuts": [{"stroke": cut.stroke, "point": list(cut.point), "edge": cut.edge} for cut in graph.cuts],
        "segments": {
            "drawn": graph.segment_count,
            "total": total,
            "limbs": len(graph.limb_id),
            "roots": int(np.sum(graph.root[graph.limb_first])),
            "stems": int(np.sum(graph.is_base)),
            "trees": len(np.unique(graph.tree)),
        },
    }


def peak_mb() -> float | None:
    """Peak resident memory of this process, MB (10⁶ bytes); None where the system does not tell."""
    try:
        import resource
    except ModuleNotFoundError:
        return None
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return round(peak / 1e6 if sys.platform == "darwin" else peak * 1024 / 1e6, 1)


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


def _attachment(attachment) -> dict:
    return {
        "stroke": attachment.stroke,
        "parent": attachment.parent,
        "point": list(attachment.point),
        "gap": attachment.gap,
        "cost": attachment.cost,
        "alternatives": [{"parent": parent, "cost": cost} for parent, cost in attachment.alternatives],
        "reason": attachment.reason,
    }


def _role(role) -> dict:
    return {
        "stroke": role.stroke,
        "role": role.role,
        "reason": role.reason,
        "alternatives": [{"role": other, "cost": cost} for other, cost in role.alternatives],
    }


def _inference(drawn: DrawnTree) -> dict:
    fit = drawn.fit
    return {
        "method": fit.method,
        "result": _result_name(fit.result),
        "log_posterior": fit.log_posterior,
        "seconds_warm": fit.seconds_warm,
        "steps": fit.steps,
        "rhat": None,
        "ess": None,
        "intervals": [],
        "alternatives": [],
    }


def _result_name(result: RESULTS) -> str:
    names = ("converged", "out_of_steps", "not_finite")
    return next(name for name in names if result == getattr(RESULTS, name))


def _triangles(model: TreeModel) -> dict:
    count = {"wood": 0, "leaf": 0}
    for mesh in model.meshes:
        count["leaf" if mesh.name.startswith("leaf") else "wood"] += len(mesh.triangle)
    return count


def _plain(value):
    """The same value in JSON's own types; a number that is not finite becomes null."""
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, Path):
        return str(value)
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
