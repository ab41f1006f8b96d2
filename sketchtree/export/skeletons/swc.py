"""Skeletons as SWC, for other programs.

SWC (Cannon et al. 1998): one line a node, `id type x y z radius parent`, parents first, ids from 1. Type 5 is a fork,
6 an end, 0 anything else. Every node of the read polylines is a line, the drawn points between two tips too; their
radius is interpolated along the curve. Numbers have 9 significant digits.
"""

import os
from collections.abc import Mapping

import numpy as np

from sketchtree.axes import NULL
from sketchtree.export.files import check_extension, write_whole
from sketchtree.skeleton import TreeSkeleton
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
