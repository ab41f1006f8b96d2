"""Small worlds of attachments with random costs, and the best of all their trees. Shared by the tests of `choices` and `moves`."""

from itertools import product

import numpy as np

from sketchtree.sketch.joining.choices import Choices


def world(seed: int, count: int, spread: float = 4.0) -> Choices:
    """Every line by either end on every other and on the ground; which end of the parent is its foot matters by about `spread`."""
    rng = np.random.default_rng(seed)
    pairs = [(tail, head, end) for head in range(count) for tail in range(count) for end in (0, 1) if tail != head]
    tail, head, end = np.array(pairs, int).reshape(-1, 3).T
    both = rng.uniform(0, 10, (len(pairs), 1)) + rng.uniform(0, spread, (len(pairs), 2))
    standing = np.repeat(rng.uniform(4, 20, 2 * count), 2).reshape(-1, 2)
    return Choices(
        np.r_[tail, np.full(2 * count, count)],
        np.r_[head, np.repeat(np.arange(count), 2)],
        np.r_[end, np.tile([0, 1], count)],
        np.vstack([both, standing]),
        count,
    )


def total(choices: Choices, chosen) -> float:
    """What a tree costs, each arc by its parent's foot in that tree: term by term."""
    feet = [int(choices.end[arc]) for arc in chosen] + [0]
    return sum(float(choices.both[arc, feet[choices.tail[arc]]]) for arc in chosen)


def is_tree(choices: Choices, chosen) -> bool:
    """Whether every line has an arc of its own and hangs, at last, on the ground."""
    up = [int(choices.tail[arc]) for arc in chosen]
    if [int(choices.head[arc]) for arc in chosen] != list(range(choices.count)):
        return False
    for line in range(choices.count):
        for _ in range(choices.count):
            line = up[line] if line != choices.count else line
        if line != choices.count:
            return False
    return True


def every_tree(choices: Choices):
    """All trees there are."""
    into = [np.flatnonzero(choices.head == line).tolist() for line in range(choices.count)]
    return (arcs for arcs in product(*into) if is_tree(choices, arcs))


def least(choices: Choices) -> float:
    """The cost of the best tree, all tried."""
    return min(total(choices, arcs) for arcs in every_tree(choices))


def random_tree(choices: Choices, rng) -> np.ndarray:
    """Some tree: every line on one that already hangs."""
    chosen, hung = np.full(choices.count, -1), [choices.count]
    for line in rng.permutation(choices.count):
        arcs = np.flatnonzero((choices.head == line) & np.isin(choices.tail, hung))
        chosen[line] = rng.choice(arcs)
        hung.append(int(line))
    return chosen
