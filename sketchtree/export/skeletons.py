"""Skeletons as files: SWC for other programs, JSON without loss, and a compact form inside a GLB.

SWC (Cannon et al. 1998): one line a node, `id type x y z radius parent`, parents first, ids from 1. Type 5 is a fork,
6 an end, 0 anything else. Every node of the read polylines is a line, the drawn points between two tips too; their
radius is interpolated along the curve. Numbers have 9 significant digits.
"""

import base64
import json
import os
import zlib
from collections.abc import Mapping

import numpy as np

from sketchtree.axes import NULL
from sketchtree.errors import ExportError, SkeletonError
from sketchtree.export.files import check_extension, write_whole
from sketchtree.export.gltf import read_glb_json
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_files import FLOATS, FORMAT, INTEGERS, shaped
from sketchtree.version import __version__


def write_swc(path: str | os.PathLike, tree: TreeSkeleton, *, header: Mapping[str, object]) -> None:
    """Write the tree as SWC, all or nothing. Each entry of `header` (units, frame, seed, …) becomes a comment.

    Raises `ExportError` where the file can't be written.
    """
    check_extension(path, (".swc",))
    node = swc_nodes(tree)
    lines = [f"# SketchTree {__version__}"]
    lines += [f"# {name}: {str(value).splitlines()[0] if str(value) else ''}" for name, value in header.items()]
    lines += ["# id type x y z radius parent"]
    columns = (node["type"], *(node["point"].T + 0.0), node["radius"], node["parent"])
    rows = zip(*(column.tolist() for column in columns), strict=True)
    lines += ["%d %d %.9g %.9g %.9g %.9g %d" % (i, *row) for i, row in enumerate(rows, 1)]
    write_whole(path, ("\n".join(lines) + "\n").encode())


def swc_nodes(tree: TreeSkeleton) -> dict[str, np.ndarray]:
    """Columns `point`, `radius`, `parent` (ids from 1, −1 none), `type`, and `id_of_row` (segment → id of its tip)."""
    inner = np.diff(tree.curve_start)
    id_of_row = tree.node_id
    size = int(id_of_row[-1]) if len(tree) else 0
    point, radius, parent = np.empty((size, 3)), np.empty(size), np.arange(size)
    row = np.repeat(np.arange(len(tree)), inner)
    place = id_of_row[row] - 1 - inner[row] + (np.arange(len(row)) - tree.curve_start[row])
    point[place], point[id_of_row - 1] = tree.curve_points, tree.tip
    share = _share_along(tree, row)
    start_radius = np.where(tree.is_base, tree.radius, tree.radius[tree.parent])
    radius[place] = (1 - share) * start_radius[row] + share * tree.radius[row]
    radius[id_of_row - 1] = tree.radius
    first = id_of_row - 1 - inner
    parent[first] = np.where(tree.is_base, NULL, id_of_row[tree.parent])
    children = np.bincount(parent[parent > 0] - 1, minlength=size)
    kind = np.where(children > 1, 5, np.where(children == 0, 6, 0))
    return {"point": point, "radius": radius, "parent": parent, "type": kind, "id_of_row": id_of_row}


def _share_along(tree: TreeSkeleton, row):
    """How far along its segment's drawn curve each curve point lies, 0-1."""
    if len(row) == 0:
        return np.zeros(0)
    first = np.r_[True, np.diff(row) != 0]
    last = np.r_[first[1:], True]
    before = np.where(first[:, None], tree.start[row], np.roll(tree.curve_points, 1, axis=0))
    step = np.linalg.norm(tree.curve_points - before, axis=1)
    total = np.cumsum(step)
    gone = total - np.repeat((total - step)[first], np.diff(np.r_[np.flatnonzero(first), len(row)]))
    rest = np.linalg.norm(tree.tip[row[last]] - tree.curve_points[last], axis=1)
    whole = np.repeat(gone[last] + rest, np.diff(np.r_[np.flatnonzero(first), len(row)]))
    return gone / np.where(whole > 0, whole, 1.0)


def write_skeleton_json(path: str | os.PathLike, tree: TreeSkeleton, *, header: Mapping[str, object] | None = None) -> None:
    """Write every column without loss, all or nothing. NaN is written as null."""
    check_extension(path, (".json",))
    columns = {name: _plain(getattr(tree, name)) for name in INTEGERS + FLOATS}
    content = {"sketchtree_skeleton": FORMAT, "version": __version__, "header": dict(header or {}), "columns": columns}
    write_whole(path, json.dumps(content, allow_nan=False, separators=(",", ":")).encode())


def skeleton_extras(tree: TreeSkeleton) -> dict:
    """The tree as small JSON for `write_glb(extras=...)`: positions as 32-bit floats, columns packed by zlib.

    Columns that say nothing (all unknown) are left out. `read_glb_skeleton` reads it back.
    """
    columns = {}
    for name in INTEGERS + FLOATS:
        column = getattr(tree, name)
        if name in ("depth_sd", "age") and np.isnan(column).all():
            continue
        column = column.astype("<f4" if name in FLOATS else _smallest(column))
        columns[name] = [column.dtype.str, base64.b64encode(zlib.compress(column.tobytes(), 6)).decode()]
    return {"sketchtree_skeleton": FORMAT, "version": __version__, "rows": len(tree), "columns": columns}


def skeleton_from_extras(extras: dict) -> TreeSkeleton:
    """The tree that `skeleton_extras` packed. Raises `SkeletonError` where there is none."""
    if not isinstance(extras, dict) or extras.get("sketchtree_skeleton") != FORMAT:
        raise SkeletonError("There is no skeleton of ours here.", remedy="Give a GLB file written by this version of `sketchtree`.")
    columns = {name: np.full(extras["rows"], np.nan) for name in ("depth_sd", "age")}
    for name, (dtype, text) in extras["columns"].items():
        columns[name] = np.frombuffer(zlib.decompress(base64.b64decode(text)), dtype)
    return TreeSkeleton(**shaped(columns))


def read_glb_skeleton(path: str | os.PathLike) -> TreeSkeleton:
    """The skeleton inside a GLB that we wrote. Raises `ExportError` where the file is none or holds none."""
    extras = read_glb_json(path).get("scenes", [{}])[0].get("extras", {})
    found = [value for value in (extras, *extras.values()) if isinstance(value, dict) and "sketchtree_skeleton" in value]
    if not found:
        raise ExportError(f"{path} holds no skeleton.", remedy="Give a GLB file written by `sketchtree build`.")
    return skeleton_from_extras(found[0])


def _plain(column):
    if column.dtype.kind == "f" and np.isnan(column).any():
        return [None if np.isnan(value) else value for value in column.tolist()]
    return column.tolist()


def _smallest(column) -> str:
    low, high = (int(column.min()), int(column.max())) if column.size else (0, 0)
    return next(kind for kind in ("<i1", "<i2", "<i4", "<i8") if np.iinfo(kind).min <= low and high <= np.iinfo(kind).max)
