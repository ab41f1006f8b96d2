"""How do trees that grew each for itself become the one skeleton that their drawing is?

First all rows that were drawn, in the order of the drawing, each after the pieces it was split into; then generation after generation,
in each tree after tree.
"""

import numpy as np
from jaxtyping import Int

from sketchtree.propagate.growing import Growing
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_joined import joined, reordered


def assembled(
    growing: list[Growing], rows: list[Int[np.ndarray, " row"]]
) -> tuple[TreeSkeleton, Int[np.ndarray, " segment"], Int[np.ndarray, " drawn"]]:
    """(the skeleton, the generation of every row, where each row of the drawing is).

    `rows` are the rows of the drawing that each tree was made of; together all of them."""
    if len(growing) == 1:
        return growing[0].skeleton(), growing[0].generation_of_rows(), growing[0].drawn.row
    generation = np.concatenate([one.generation_of_rows() for one in growing])
    second = np.concatenate([_place(k, one, its) for k, (one, its) in enumerate(zip(growing, rows, strict=True))])
    order = np.lexsort((second, generation))
    tree = joined([one.skeleton() for one in growing])
    place = np.empty(len(order), np.int64)
    place[order] = np.arange(len(order))
    first = np.cumsum([0, *(one.rows for one in growing)])
    drawn = np.empty(sum(map(len, rows)), np.int64)
    for begins, one, its in zip(first, growing, rows, strict=False):
        drawn[its] = place[begins + one.drawn.row]
    return reordered(tree, order), generation[order], drawn


def _place(number: int, growing: Growing, rows) -> Int[np.ndarray, " segment"]:
    """What orders the rows of one generation: of drawn ones the row of the drawing they belong to, of others the tree."""
    drawn = np.searchsorted(growing.drawn.row, np.arange(len(growing.drawn.tree)))
    return np.r_[rows[drawn], np.full(growing.rows - len(drawn), number)]
