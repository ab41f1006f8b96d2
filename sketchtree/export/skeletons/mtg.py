"""A skeleton as a Multiscale Tree Graph, the text format of AMAPmod and OpenAlea, form A.

Godin & Caraglio 1998; the sections and columns are those of OpenAlea's documentation of `.mtg` files. Scale 1 is the plant `P`, scale 2 its
nodes `N`, one a node of the read polylines as in SWC. A node that goes on along its limb follows with `<` in its own column
(`^` names the entity above); a lateral is borne with `+` one column to the right, before its bearer goes on:

    /P1 → ^/N1 → ^<N2 → ^<N3            features XX YY ZZ radius, metres, y up
                     +N4 → ^<N5         borne by N3
                 ^<N6                   goes on from N3
"""

import os

import numpy as np

from sketchtree.axes import NULL
from sketchtree.export.files import check_extension, write_whole
from sketchtree.export.skeletons.swc import swc_nodes
from sketchtree.skeleton import TreeSkeleton
from sketchtree.version import __version__

_FEATURES = ("XX", "YY", "ZZ", "radius")


def write_mtg(path: str | os.PathLike, tree: TreeSkeleton, *, header: dict | None = None) -> None:
    """Write the tree as MTG, all or nothing. Each entry of `header` (units, seed, …) becomes a comment."""
    check_extension(path, (".mtg",))
    write_whole(path, mtg_text(tree, header=header).encode())


def mtg_text(tree: TreeSkeleton, *, header: dict | None = None) -> str:
    """The file's text. Lengths have 9 significant digits."""
    node = swc_nodes(tree)
    parent = np.where(node["parent"] > 0, node["parent"] - 1, NULL)
    follows = _followers(parent, _limb_of_node(tree))
    rows, column = _in_order(parent, follows)
    width = 1 + int(column.max(initial=0))
    lines = [*_head(header or {}), "\t".join(["ENTITY-CODE", *[""] * (width - 1), *_FEATURES])]
    figures = np.column_stack([node["point"] + 0.0, node["radius"]])[rows].tolist()
    plant = 0
    for row, at, values in zip(rows.tolist(), column.tolist(), figures, strict=True):
        if parent[row] == NULL:
            plant += 1
            lines.append(f"/P{plant}")
        code = f"^/N{row + 1}" if parent[row] == NULL else f"^<N{row + 1}" if follows[row] else f"+N{row + 1}"
        lines.append("\t" * at + code + "\t" * (width - at) + "\t".join("%.9g" % value for value in values))
    return "\n".join(lines) + "\n"


def _head(header: dict) -> list[str]:
    """Everything above the entities."""
    told = [f"# SketchTree {__version__}", *(f"# {name}: {str(value).splitlines()[0] if str(value) else ''}" for name, value in header.items())]
    symbols = ["$\t0\tFREE\tFREE\tIMPLICIT", "P\t1\tFREE\tFREE\tEXPLICIT", "N\t2\tFREE\tFREE\tEXPLICIT"]
    return [
        *told, "CODE:\tFORM-A", "",
        "CLASSES:", "SYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION", *symbols, "",
        "DESCRIPTION:", "LEFT\tRIGHT\tRELTYPE\tMAX", "N\tN\t+\t?", "N\tN\t<\t?", "",
        "FEATURES:", "NAME\tTYPE", *(f"{name}\tREAL" for name in _FEATURES), "", "MTG:",
    ]  # fmt: skip


def _limb_of_node(tree: TreeSkeleton):
    """The limb of every node: of drawn points, that of the segment they lie on."""
    return np.repeat(tree.limb, np.diff(tree.curve_start) + 1)


def _followers(parent, limb):
    """Which nodes go on along their parent's limb: at most one a parent, the first of that limb; of a base, the first child if none has its limb."""
    child = np.flatnonzero(parent != NULL)
    above = parent[child]
    claims = limb[child] == limb[above]
    rank = np.lexsort((child, ~claims, above))
    first = np.r_[True, np.diff(above[rank]) != 0][: len(rank)]
    best = child[rank[first]]
    follows = np.zeros(len(parent), bool)
    follows[best] = (limb[best] == limb[parent[best]]) | (parent[parent[best]] == NULL)
    return follows


def _in_order(parent, follows):
    """(the nodes as the file names them, the column of each): a node, its laterals with all they bear, then what goes on from it."""
    children: list[list[int]] = [[] for _ in range(len(parent))]
    for row in np.lexsort((np.arange(len(parent)), ~follows)).tolist():  # pushed first, popped last
        if parent[row] != NULL:
            children[parent[row]].append(row)
    rows, column = [], []
    todo = [(row, 0) for row in np.flatnonzero(parent == NULL)[::-1].tolist()]
    while todo:
        row, at = todo.pop()
        rows.append(row)
        column.append(at)
        todo += [(child, at if follows[child] else at + 1) for child in children[row]]
    return np.array(rows, np.int64), np.array(column, np.int64)
