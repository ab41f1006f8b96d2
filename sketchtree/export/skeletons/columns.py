"""Skeletons with every column: as JSON text, which anything reads."""

import json
import os
from collections.abc import Mapping

import numpy as np

from sketchtree.export.files import check_extension, write_whole
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_files import FLOATS, FORMAT, INTEGERS
from sketchtree.version import __version__


def write_skeleton_json(path: str | os.PathLike, tree: TreeSkeleton, *, header: Mapping[str, object] | None = None) -> None:
    """Write every column without loss, all or nothing. NaN is written as null."""
    check_extension(path, (".json",))
    write_whole(path, skeleton_json(tree, header=header))


def skeleton_json(tree: TreeSkeleton, *, header: Mapping[str, object] | None = None) -> bytes:
    """The file of `write_skeleton_json` as bytes."""
    columns = {name: _plain(getattr(tree, name)) for name in INTEGERS + FLOATS}
    content = {"sketchtree_skeleton": FORMAT, "version": __version__, "header": dict(header or {}), "columns": columns}
    return json.dumps(content, allow_nan=False, separators=(",", ":")).encode()


def _plain(column):
    if column.dtype.kind == "f" and np.isnan(column).any():
        return [None if np.isnan(value) else value for value in column.tolist()]
    return column.tolist()
