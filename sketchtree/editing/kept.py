"""What was done by hand, and what the depths have come to, as JSON: how a project file and a recovery journal keep it.

    edits     [{"op": "hold", "limb": "…", "share": […], "depth": […], "whole": false}, {"op": "clear", "limb", "path": [[x, y, z], …], "radius"},
               {"op": "adopt", "limb", "parent", "share", "path", "radius", "was"}, …]       limb ids are decimal text; sketch units, y up
    settled   {"template", "asked", "theta": {…}, "counted", "axis", "limbs": {id: {"share", "depth", "sd", "course", "parent", "strokes", "view_deg"}}}

Numbers are written so that they read back to the last bit; an sd that is not known is null.
"""

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np

from sketchtree.editing.edits import Adopted, Cleared, Edits, Held
from sketchtree.editing.settled import COURSE, Depths, Settled
from sketchtree.parameters import TreeParameters


def edits_as_json(edits: Edits) -> list[dict]:
    """The operations, in an order that can be followed."""
    held = [{"op": "hold", "limb": str(one.limb), "share": _list(one.share), "depth": _list(one.depth), "whole": one.whole} for one in edits.held.values()]
    cleared = [{"op": "clear", "limb": str(one.limb), "path": _list(one.path), "radius": float(one.radius)} for one in edits.cleared.values()]
    adopted = [
        {"op": "adopt", "limb": str(one.limb), "parent": str(one.parent), "share": float(one.share), "path": _list(one.path), "radius": float(one.radius), "was": str(one.was)}
        for one in edits.adopted.values()
    ]
    return [*held, *cleared, *adopted]


def edits_from_json(rows: Any) -> Edits:
    """Raises ValueError for what is no list of operations, or an operation that this version does not know."""
    held, cleared, adopted = {}, {}, {}
    for row in _checked(rows, list):
        limb = _limb(_checked(row, dict).get("limb"))
        if row.get("op") == "hold":
            held[limb] = Held(limb, _array(row["share"], 1), _array(row["depth"], 1, len(row["share"])), bool(row.get("whole", False)))
        elif row.get("op") == "clear":
            cleared[limb] = Cleared(limb, _path(row["path"]), _number(row["radius"]))
        elif row.get("op") == "adopt":
            adopted[limb] = Adopted(limb, _limb(row["parent"]), _number(row["share"]), _path(row["path"]), _number(row["radius"]), int(row.get("was", -1)))
        else:
            raise ValueError(f"unknown operation {row.get('op')!r}")
    return Edits(held, cleared, adopted)


def settled_as_json(settled: Settled) -> dict:
    """All of it."""
    limbs = {
        str(name): {
            "share": _list(one.share), "depth": _list(one.depth), "sd": [None if np.isnan(sd) else float(sd) for sd in one.sd], "course": _list(one.course),
            "parent": None if one.parent is None else str(one.parent), "strokes": list(one.strokes), "view_deg": float(one.view_deg),
        }
        for name, one in settled.limbs.items()
    }  # fmt: skip
    theta = None if settled.theta is None else settled.theta.as_dict()
    return {"template": settled.template, "asked": settled.asked, "theta": theta, "counted": settled.counted, "axis": settled.axis, "limbs": limbs}


def settled_from_json(row: Any) -> Settled:
    """Raises ValueError for what is not that."""
    row = _checked(row, dict)
    limbs = {_limb(name): _depths(one) for name, one in _checked(row.get("limbs", {}), dict).items()}
    theta = row.get("theta")
    names = {field.name for field in dataclasses.fields(TreeParameters)}
    if theta is not None and set(_checked(theta, dict)) != names:
        raise ValueError("its Θ has other parameters")
    return Settled(
        limbs,
        None if row.get("template") is None else str(row["template"]),
        str(row.get("asked", "")),
        None if theta is None else TreeParameters(**{name: _number(value) for name, value in theta.items()}),
        int(row.get("counted", 0)),
        _number(row.get("axis", 0.0)),
    )


def reading(make: Callable, row: Any):
    """`make(row)`, with whatever is wrong with the row as a ValueError."""
    try:
        return make(row)
    except (TypeError, KeyError, AttributeError, IndexError, OverflowError) as error:
        raise ValueError(f"{type(error).__name__}: {error}") from error


def _depths(row: dict) -> Depths:
    share = _array(row["share"], 1)
    sd = np.array([np.nan if value is None else _number(value) for value in row["sd"]], float)
    course = _array(row["course"], 2)
    if course.shape != (COURSE, 2) or len(sd) != len(share) or len(share) < 2:
        raise ValueError("a limb's columns do not fit each other")
    parent = None if row.get("parent") is None else _limb(row["parent"])
    return Depths(share, _array(row["depth"], 1, len(share)), sd, course, parent, tuple(map(str, row["strokes"])), _number(row.get("view_deg", 0.0)))


def _list(values) -> list:
    return np.asarray(values, float).tolist()


def _limb(name: Any) -> int:
    if not (isinstance(name, str) and name.isascii() and name.isdigit() and len(name) <= 20):
        raise ValueError(f"{name!r} is no limb's id")
    return int(name)


def _number(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not np.isfinite(value):
        raise ValueError(f"{value!r} is no number")
    return float(value)


def _array(values: Any, axes: int, length: int | None = None):
    column = np.array(values, float)
    if column.ndim != axes or not np.isfinite(column).all() or (length is not None and len(column) != length):
        raise ValueError("a column is no list of finite numbers of the right length")
    return column


def _path(values: Any):
    path = _array(values, 2)
    if path.shape[1] != 3 or len(path) < 2:
        raise ValueError("a path has fewer than two points, or points that are not x, y, z")
    return path


def _checked(value: Any, kind: type):
    if not isinstance(value, kind):
        raise ValueError(f"{kind.__name__} expected")
    return value
