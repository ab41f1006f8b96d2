"""What every report says (`--report`): the run itself, and how the drawing was read. Nothing here needs more than the reader.

Lengths are sketch units, y up; a missing value is null.
"""

import math
import sys
from pathlib import Path

import numpy as np

from sketchtree.sketch.graph import Attachment, Role, SketchGraph
from sketchtree.version import __version__

SCHEMA = 1
SECONDS = ("import", "read", "match", "infer", "propagate", "foliage", "mesh", "export", "total")


def reading_report(graph: SketchGraph, *, command: str, seed: int, seconds: dict[str, float], options: dict) -> dict:
    """The report of a run that only read the drawing: what was not asked for is null."""
    return plain(frame(command, seed, seconds, options, graph.warnings) | reading(graph, graph.segment_count))


def frame(command: str, seed: int, seconds: dict[str, float], options: dict, warnings: tuple[str, ...]) -> dict:
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
        "wood_used": None,
        "transform": None,
        "infer": None,
        "seconds": {name: seconds.get(name) for name in SECONDS},
        "peak_mb": peak_mb(),
        "warnings": list(dict.fromkeys(warnings)),
        "options": options,
        "seed": seed,
    }


def reading(graph: SketchGraph, total: int) -> dict:
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


def _attachment(attachment: Attachment) -> dict:
    return {
        "stroke": attachment.stroke,
        "parent": attachment.parent,
        "point": list(attachment.point),
        "gap": attachment.gap,
        "cost": attachment.cost,
        "alternatives": [{"parent": parent, "cost": cost} for parent, cost in attachment.alternatives],
        "reason": attachment.reason,
    }


def _role(role: Role) -> dict:
    return {
        "stroke": role.stroke,
        "role": role.role,
        "reason": role.reason,
        "alternatives": [{"role": other, "cost": cost} for other, cost in role.alternatives],
    }


def plain(value):
    """The same value in JSON's own types; a number that is not finite becomes null."""
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, Path):
        return str(value)
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
