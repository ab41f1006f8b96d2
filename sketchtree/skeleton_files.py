"""Skeletons from files: SWC (Cannon et al. 1998), our JSON and HDF5, numpy's `.npz` with `parent`, `pos` and `radius`, MTG, and tables of
cylinders.

What other programs and digitised trees come in; `export.skeletons` writes. MTG is in `skeleton_mtg`, cylinders in
`skeleton_cylinders`, HDF5 in `skeleton_hdf5`.
"""

import json
import os
import zipfile
import zlib
from pathlib import Path

import numpy as np

from sketchtree.axes import NULL
from sketchtree.errors import SkeletonError
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_rows import filled_radius, observed

FLOATS = ("tip", "radius", "depth_sd", "age", "curve_points")
INTEGERS = ("parent", "order", "limb", "stroke", "tree", "kind", "curve_start")
FORMAT = 1
LARGEST_ID = 2**53  # beyond it a number is no longer told from the next
ENDINGS = (".swc", ".json", ".npz")  # always trees: what a folder is searched for
ALL_ENDINGS = (*ENDINGS, ".mtg", ".csv", ".txt", ".h5", ".sketchtree")


def read_skeleton(path: str | os.PathLike) -> TreeSkeleton:
    """The tree of a file, told by its ending. Raises `SkeletonError`."""
    ending = Path(path).suffix.lower()
    from sketchtree.skeleton_cylinders import read_cylinders
    from sketchtree.skeleton_hdf5 import read_skeleton_hdf5
    from sketchtree.skeleton_mtg import read_mtg

    readers = {
        ".swc": read_swc, ".json": read_skeleton_json, ".npz": read_npz, ".mtg": read_mtg,
        ".csv": read_cylinders, ".txt": read_cylinders, ".h5": read_skeleton_hdf5, ".sketchtree": read_skeleton_hdf5,
    }  # fmt: skip
    if ending not in readers:
        raise SkeletonError(f"{path} is no skeleton that can be read.", remedy=f"Give a file that ends in one of {', '.join(ALL_ENDINGS)}.")
    try:
        return readers[ending](path)
    except SkeletonError as error:
        if str(path) in error.message:
            raise
        raise SkeletonError(f"{path}: {error.message}", remedy=error.remedy) from error


def read_npz(path: str | os.PathLike) -> TreeSkeleton:
    """A digitised tree: `parent` (row, −1 at a base), `pos` (y up), `radius` (NaN where unknown); limbs follow the thickest
    child, the straightest of equals. Raises `SkeletonError`."""
    try:
        with open(path, "rb") as whole, np.load(whole, allow_pickle=False) as file:
            parent, tip, radius = file["parent"].astype(np.int64), file["pos"].astype(float), file["radius"].astype(float)
    except OSError as error:
        raise SkeletonError(f"Can't read {path}: {(error.strerror or 'it is no .npz file').lower()}.", remedy="Check the path.") from error
    except (ValueError, KeyError, TypeError, AttributeError, EOFError, RuntimeError, zipfile.BadZipFile, zlib.error) as error:
        raise SkeletonError(f"{path} holds no skeleton.", remedy="Give an .npz file with the arrays `parent`, `pos` and `radius`.") from error
    if tip.ndim != 2 or tip.shape[1] != 3 or not len(parent) == len(tip) == len(radius):
        raise SkeletonError(f"{path}: `parent`, `pos` and `radius` have different lengths.", remedy="Give one row a node, three columns of `pos`.")
    if len(parent) == 0 or parent.max() >= len(parent):
        what = "has no rows" if len(parent) == 0 else "names a parent that is not in the file"
        raise SkeletonError(f"{path} {what}.", remedy="Give one row a node, `parent` the row it grows from or -1.")
    return observed(path, np.where(parent < 0, NULL, parent), tip, filled_radius(radius))


def read_swc(path: str | os.PathLike) -> TreeSkeleton:
    """The tree of an SWC file: one row a node, in the file's units and axes; kind OBSERVED.

    Ids may be any numbers in any order. Limbs follow the thickest child, the straightest of equals. A radius that is
    not positive becomes the smallest positive one of the file. Raises `SkeletonError` naming the line at fault.
    """
    table, line = _swc_table(path)
    ids, parent_id = table[:, 0].astype(np.int64), table[:, 6].astype(np.int64)
    row_of = {node: row for row, node in enumerate(ids.tolist())}
    if len(row_of) < len(ids):
        twin = int(np.flatnonzero(np.bincount(np.unique(ids, return_inverse=True)[1]) > 1)[0])
        raise SkeletonError(f"{path}: the id {np.unique(ids)[twin]} stands twice.", remedy="Number every node once.")
    parent = np.array([NULL if node < 0 else row_of.get(node, -2) for node in parent_id.tolist()], np.int64)
    if (parent == -2).any():
        bad = int(np.flatnonzero(parent == -2)[0])
        raise SkeletonError(
            f"{path}, line {line[bad]}: its parent {parent_id[bad]} is not in the file.",
            remedy="Name an id of the file, or -1.",
        )
    radius = table[:, 5]
    smallest = float(radius[radius > 0].min()) if (radius > 0).any() else None
    return observed(path, parent, table[:, 2:5], filled_radius(radius, smallest))


def _swc_table(path):
    rows, lines = [], []
    try:
        with open(path, encoding="utf-8-sig", errors="replace") as file:
            text = file.read()
    except OSError as error:
        raise SkeletonError(f"Can't read {path}: {(error.strerror or 'unknown error').lower()}.", remedy="Check the path.") from error
    for number, content in enumerate(text.splitlines(), 1):
        words = content.split("#")[0].split()
        if not words:
            continue
        try:
            values = [float(word) for word in words[:7]]
        except ValueError:
            values = []
        shown = "".join(sign if sign.isprintable() else "?" for sign in content.strip()[:60])
        if len(values) < 7 or not np.isfinite(values).all() or np.abs([values[0], values[6]]).max() > LARGEST_ID:
            raise SkeletonError(
                f"{path}, line {number}: expected `id type x y z radius parent`, got `{shown}`.",
                remedy="Repair the line or start it with #.",
            )
        rows.append(values)
        lines.append(number)
    if not rows:
        raise SkeletonError(
            f"{path} holds no nodes.",
            remedy="Give an SWC file with at least one line `id type x y z radius parent`.",
        )
    return np.array(rows), lines


def read_skeleton_json(path: str | os.PathLike) -> TreeSkeleton:
    """The tree that `write_skeleton_json` wrote. Raises `SkeletonError` where the file is not one."""
    try:
        with open(path, encoding="utf-8") as file:
            content = json.load(file)
        version = content["sketchtree_skeleton"]
    except OSError as error:
        raise SkeletonError(f"Can't read {path}: {(error.strerror or 'unknown error').lower()}.", remedy="Check the path.") from error
    except (ValueError, KeyError, TypeError) as error:
        raise SkeletonError(f"{path} is not a skeleton of ours.", remedy="Give a JSON file written by `sketchtree`.") from error
    if version != FORMAT:
        raise SkeletonError(
            f"{path} has skeleton format {version}; this version reads {FORMAT}.", remedy="Update sketchtree."
        )
    try:
        columns = {name: np.array(content["columns"][name], float if name in FLOATS else np.int64) for name in INTEGERS + FLOATS}
        columns = shaped(columns)
    except (KeyError, TypeError, ValueError, OverflowError) as error:
        raise SkeletonError(f"{path}: a column is missing or holds no numbers ({error}).", remedy="Give a JSON file written by `sketchtree`.") from error
    return TreeSkeleton(**columns)


def shaped(columns: dict) -> dict:
    """Columns of points with three entries a row."""
    return columns | {name: columns[name].reshape(-1, 3) for name in ("tip", "curve_points")}
