"""A skeleton small enough to ride along in a mesh file: columns packed by zlib, as text in JSON."""

import base64
import zlib

import numpy as np

from sketchtree.errors import SkeletonError
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_files import FLOATS, FORMAT, INTEGERS, shaped
from sketchtree.version import __version__


def skeleton_extras(tree: TreeSkeleton) -> dict:
    """The tree as small JSON for the extras of a glTF scene: positions as 32-bit floats, columns packed by zlib.

    Columns that say nothing (all unknown) are left out. `skeleton_from_extras` reads it back.
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


def _smallest(column) -> str:
    low, high = (int(column.min()), int(column.max())) if column.size else (0, 0)
    return next(kind for kind in ("<i1", "<i2", "<i4", "<i8") if np.iinfo(kind).min <= low and high <= np.iinfo(kind).max)
