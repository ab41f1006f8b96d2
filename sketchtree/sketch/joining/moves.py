"""Would the whole tree cost less if one stroke hung otherwise? Moves made one by one, the best first, until none helps.

What an arc costs depends on which end of its parent is the parent's foot. So when line k is turned, its children's
costs change with it; for arc a of line k, which hangs it on parent p by end e,

    gain(a) = cost now of k − cost(a | foot of p) + [e ≠ foot of k] Σ_children c of k (cost now of c − cost of c if k is turned)

where p must not itself hang on k. The arborescence alone can't see the sum: it takes all directions as given.
"""

import numpy as np
from jaxtyping import Float, Int

LEAST = 1e-9  # a smaller gain is none


def improved(
    tail: Int[np.ndarray, " arc"],
    head: Int[np.ndarray, " arc"],
    end: Int[np.ndarray, " arc"],
    both: Float[np.ndarray, "arc 2"],
    chosen: Int[np.ndarray, " line"],
    moves: int,
) -> Int[np.ndarray, " line"]:
    """The arc of every line after at most `moves` moves. Node `len(chosen)` is the ground, whose foot is 0.

    `both`: cost of every arc, by which end of its tail is that line's foot.
    """
    count = len(chosen)
    chosen, every = chosen.copy(), np.arange(len(tail))
    for _ in range(moves):
        parent, foot = tail[chosen], np.append(end[chosen], 0)
        now = both[chosen, foot[parent]]
        turned = np.bincount(parent, now - both[chosen, 1 - foot[parent]], count + 1)
        gain = now[head] - both[every, foot[tail]] + (end != foot[head]) * turned[head]
        gain[chosen] = 0.0
        arc = _best(gain, tail, head, parent)
        if arc < 0:
            break
        chosen[head[arc]] = arc
    return chosen


def _best(gain, tail, head, parent) -> int:
    """The arc that gains most of those that make no circle; -1 if none gains. `gain` is used up."""
    while gain[arc := int(np.argmax(gain))] > LEAST:
        if not hangs(int(tail[arc]), int(head[arc]), parent, len(parent)):
            return arc
        gain[arc] = 0.0
    return -1


def hangs(line: int, on: int, parent, ground: int) -> bool:
    """Whether a line hangs on another, directly or not; a line hangs on itself."""
    while line != ground and line != on:
        line = int(parent[line])
    return line == on
