"""What was done by hand, and what the depths have come to, as JSON: how a project file and a recovery journal keep it.

    edits     [{"op": "hold", "limb": "…", "share": […], "depth": […], "whole": false}, {"op": "clear", "limb", "path": [[x, y, z], …], "radius"},
               {"op": "adopt", "limb", "parent", "share", "path", "radius", "was"}, …]       limb ids are decimal text; sketch units, y up
    settled   {"template", "asked", "manner": {"theta", "blocks", "limbs", "scale"}, "axis",
               "limbs": {id: {"share", "depth", "sd", "course", "parent", "strokes", "view_deg"}}}

Numbers are written so that they read back to the last bit; an sd that is not known is null.
"""

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np

from sketchtree.editing.edits import Adopted, Cleared, Edits, Held
from sketchtree.editing.settled import COURSE, Depths, Manner, Settled
from sketchtree.parameters import TreeParameters
from sketchtree.propagate.blocks.block import Blocks


_CHILDREN = ("apical", "scale", "divergence", "orientation", "reach", "length", "droop")
_BLOCKS = {name: np.int64 for name in ("id", "order", "start")} | {name: float for name in ("position", "zone", *_CHILDREN[1:])} | {"apical": bool}


def edits_as_json(edits: Edits) -> list[dict]:
    """The operations, in an order that can be followed."""
    held = [{"op": "hold", "limb": str(one.limb), "share": _list(one.share), "depth": _list(one.depth), "whole": one.whole} for one in edits.held.values()]
    cleared = [{"op": "clear", "limb": str(one.limb), "path": _list(one.path), "radius": float(one.radius)} for one in edits.cleared.values()]
    adopted = [
        {
            "op": "adopt", "limb": str(one.limb), "parent": str(one.parent), "share": float(one.share), "path": _list(one.path),
            "radius": float(one.radius), "was": str(one.was),
        }  # fmt: skip
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
    manner = None if settled.manner is None else _manner_as_json(settled.manner)
    return {"template": settled.template, "asked": settled.asked, "manner": manner, "axis": settled.axis, "limbs": limbs}


def settled_from_json(row: Any) -> Settled:
    """Raises ValueError for what is not that."""
    row = _checked(row, dict)
    limbs = {_limb(name): _depths(one) for name, one in _checked(row.get("limbs", {}), dict).items()}
    return Settled(
        limbs,
        None if row.get("template") is None else str(row["template"]),
        str(row.get("asked", "")),
        None if row.get("manner") is None else _manner(_checked(row["manner"], dict)),
        _number(row.get("axis", 0.0)),
    )


def _manner_as_json(manner: Manner) -> dict:
    blocks = manner.blocks
    columns = None if blocks is None else {name: _plain(getattr(blocks, name)) for name in _BLOCKS}
    return {"theta": manner.theta.as_dict(), "blocks": columns, "limbs": sorted(map(str, manner.limbs)), "scale": float(manner.scale)}


def _plain(column) -> list:
    """Whole numbers as they are, those that are unknown as null."""
    return [None if value != value else value for value in np.asarray(column).tolist()]


def _manner(row: dict) -> Manner:
    theta = _checked(row["theta"], dict)
    if set(theta) != {field.name for field in dataclasses.fields(TreeParameters)}:
        raise ValueError("its Θ has other parameters")
    blocks = None if row.get("blocks") is None else _blocks(_checked(row["blocks"], dict))
    limbs = frozenset(_limb(name) for name in _checked(row["limbs"], list))
    return Manner(TreeParameters(**{name: _number(value) for name, value in theta.items()}), blocks, limbs, _number(row["scale"]))


def _blocks(row: dict) -> Blocks:
    columns = {}
    for name, kind in _BLOCKS.items():
        values = [np.nan if value is None else value for value in _checked(row[name], list)]
        columns[name] = np.array(values, kind)
    blocks, count = Blocks(**columns), int(columns["start"][-1]) if len(columns["start"]) else -1
    of_block, of_child = (len(columns[name]) for name in ("id", "apical"))
    if len(columns["start"]) != of_block + 1 or columns["start"][0] != 0 or (np.diff(columns["start"]) < 0).any() or count != of_child:
        raise ValueError("its blocks do not fit each other")
    if any(len(columns[name]) != of_block for name in ("order", "position", "zone")) or any(len(columns[name]) != of_child for name in _CHILDREN):
        raise ValueError("its blocks do not fit each other")
    return blocks


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
