"""A tree as a table of cylinders, as quantitative structure models of laser scans come: TreeQSM, SimpleForest, aRchi and the like.

One row a cylinder, separated by commas, semicolons, tabs or blanks. The first line names the columns; letter case, blanks, points and
underscores in names don't count:

    radius   radius, radius_cyl, r                            length   length, len
    start    startX startY startZ, start1 …, start_x …, x y z, sx …
    axis     axisX axisY axisZ, axis1 …, ax …         or      end      endX endY endZ, end1 …
    parent   parent, parent_ID, parent cylinder               id       ID, cyl_ID, cylinder (else rows count from 1)
    branch   branch, branch_ID, axis_ID                       order    BranchOrder, branching_order, branch_order

Needed are the radius, the start, `parent`, and the end or the axis and the length. A parent that is 0 or less and no id is the ground's.
Without names, fifteen numbers a line are read as TreeQSM 2.3 writes them. A cylinder becomes one segment; it continues its
parent's limb if both have the same `branch`, or, without that column, the same `order`; a lateral stands on the end of its parent that is nearer.
"""

import os
import re

import numpy as np

from sketchtree.axes import NULL
from sketchtree.errors import SkeletonError
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_rows import filled_radius, observed

_SPELLINGS = {
    "radius": ("radius", "radiuscyl", "r"), "length": ("length", "len"), "parent": ("parent", "parentid", "parentcylinder"),
    "id": ("id", "cylid", "cylinder", "cylinderid"), "branch": ("branch", "branchid", "axisid"),
    "order": ("branchorder", "branchingorder", "order"),
    **{f"start{k}": (f"start{a}", f"start{k}", f"{a}start", f"s{a}", a) for k, a in enumerate("xyz", 1)},
    **{f"axis{k}": (f"axis{a}", f"axis{k}", f"a{a}") for k, a in enumerate("xyz", 1)},
    **{f"end{k}": (f"end{a}", f"end{k}", f"{a}end", f"e{a}") for k, a in enumerate("xyz", 1)},
}  # fmt: skip
TREEQSM = "radius length start1 start2 start3 axis1 axis2 axis3 parent extension added unmodradius branch branchorder positioninbranch".split()


def read_cylinders(path: str | os.PathLike) -> TreeSkeleton:
    """The tree of a table of cylinders, in the file's units and axes. Raises `SkeletonError` naming the line or column at fault."""
    columns, line = _table(path)
    start = np.stack([columns[f"start{k}"] for k in (1, 2, 3)], 1)
    if all(f"end{k}" in columns for k in (1, 2, 3)):
        end = np.stack([columns[f"end{k}"] for k in (1, 2, 3)], 1)
    else:
        end = start + columns["length"][:, None] * np.stack([columns[f"axis{k}"] for k in (1, 2, 3)], 1)
    parent = _parents(columns, path, line)
    return _skeleton(path, start, end, columns, parent)


def _skeleton(path, start, end, columns, parent) -> TreeSkeleton:
    """Nodes are the cylinders' ends, and a base where a cylinder stands on the ground."""
    count, on_ground = len(parent), np.flatnonzero(parent == NULL)
    base = np.full(count, NULL)
    base[on_ground] = count + np.arange(len(on_ground))
    same = next((columns[name] for name in ("branch", "order") if name in columns), None)
    continues = None if same is None else (parent == NULL) | (same == same[parent])
    above = np.where(parent == NULL, base, parent)
    if continues is not None:
        below = np.where(parent == NULL, NULL, above[parent])  # where the parent itself starts
        nearer = np.linalg.norm(start - start[parent], axis=1) < np.linalg.norm(start - end[parent], axis=1)
        above = np.where(~continues & nearer & (below != NULL), below, above)
        continues = np.r_[continues, np.ones(len(on_ground), bool)]
    tip = np.concatenate([end, start[on_ground]])
    radius = np.r_[columns["radius"], columns["radius"][on_ground]]
    return observed(path, np.r_[above, np.full(len(on_ground), NULL)], tip, filled_radius(radius), continues)


def _parents(columns, path, line):
    ids = columns.get("id", np.arange(1, len(line) + 1)).astype(np.int64)
    row_of = {node: row for row, node in enumerate(ids.tolist())}
    if len(row_of) < len(ids):
        twin = next(i for i, node in enumerate(ids.tolist()) if node in ids[:i])
        raise SkeletonError(f"{path}, line {line[twin]}: the id {ids[twin]} stands twice.", remedy="Number every cylinder once.")
    parent = np.full(len(ids), NULL)
    for i, above in enumerate(columns["parent"].astype(np.int64).tolist()):
        if above in row_of:
            parent[i] = row_of[above]
        elif above > 0:
            raise SkeletonError(f"{path}, line {line[i]}: its parent {above} is not in the file.", remedy="Name the id of a cylinder, or 0 on the ground.")
    if not (parent == NULL).any():
        raise SkeletonError(f"{path}: no cylinder stands on the ground.", remedy="Give the trunk's first cylinder the parent 0, or -1 where ids begin at 0.")
    return parent


def _table(path) -> tuple[dict[str, np.ndarray], list[int]]:
    try:
        with open(path, encoding="utf-8-sig", errors="replace") as file:
            lines = [(number, text.strip()) for number, text in enumerate(file, 1) if text.strip() and not text.startswith("#")]
    except OSError as error:
        raise SkeletonError(f"Can't read {path}: {(error.strerror or 'unknown error').lower()}.", remedy="Check the path.") from error
    if not lines:
        raise SkeletonError(f"{path} is empty.", remedy="Give a table of cylinders, one a line.")
    cut = next((mark for mark in (",", ";", "\t") if mark in lines[0][1]), None)
    first = [word.strip(" \"'") for word in lines[0][1].split(cut)]
    if not _is_number(first[0]):
        names, lines = [re.sub(r"[^a-z0-9]", "", word.lower()) for word in first], lines[1:]
    elif len(first) == len(TREEQSM):
        names = TREEQSM
    else:
        raise SkeletonError(
            f"{path}, line {lines[0][0]}: {len(first)} numbers and no names of columns.",
            remedy="Let the first line name the columns (radius, length, startX …, axisX …, parent); fifteen columns of TreeQSM 2.3 need none.",
        )
    spelt = {key: next((spelling for spelling in spellings if spelling in names), None) for key, spellings in _SPELLINGS.items()}
    place = {key: names.index(spelling) for key, spelling in spelt.items() if spelling is not None}
    _refuse_missing(place, path)
    rows = np.array([_numbers(path, number, text, cut, len(names), place) for number, text in lines]).reshape(-1, len(place))
    if not len(rows):
        raise SkeletonError(f"{path} has no cylinders.", remedy="Give a table of cylinders, one a line.")
    return dict(zip(place, rows.T, strict=True)), [number for number, _ in lines]


def _refuse_missing(place, path) -> None:
    needed = ["radius", "parent", *(f"start{k}" for k in (1, 2, 3))]
    if not all(f"end{k}" in place for k in (1, 2, 3)):
        needed += ["length", *(f"axis{k}" for k in (1, 2, 3))]
    for key in needed:
        if key not in place:
            spelled = ", ".join(f"`{name}`" for name in _SPELLINGS[key])
            raise SkeletonError(
                f"{path}: there is no column for {key} (looked for {spelled}).",
                remedy="Name the column so; docs/templates.md lists all spellings.",
            )


def _numbers(path, number, text, cut, count, place) -> list[float]:
    words = text.split(cut)
    chosen = [words[at].strip(" \"'") if at < len(words) else "" for at in place.values()]
    if len(words) != count or not all(map(_is_number, chosen)):
        raise SkeletonError(f"{path}, line {number}: expected {count} columns of numbers, got `{text[:60]}`.", remedy="Repair or remove the line.")
    return [float(word) for word in chosen]


def _is_number(word: str) -> bool:
    try:
        return abs(float(word)) < 2**53  # beyond it an id is no longer told from the next
    except ValueError:
        return False
