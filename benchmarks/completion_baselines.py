"""What is growth compared with? Plain replication of the drawn part's own blocks, as Chen et al. 2008, §6 has it, without what our
growth adds.

    random      every child is turned to a random direction before it is attached (Tan et al. 2007, as Chen quotes it)
    no orders   children inherit the block's angles; which block is pure chance, whatever its order or place

Both attach a block to open branches generation by generation: first one block's laterals on every node of the drawn limbs that bears
none, then blocks on every open segment, each scaled to the segment it is attached to. The crown holds them as it holds ours,
and they stop at the number of tips that the true tree has.
"""

import numpy as np

from sketchtree.axes import NULL
from sketchtree.propagate.blocks.block import Blocks, blocks_of
from sketchtree.propagate.blocks.open_branch import direction, frames, turn
from sketchtree.propagate.space.envelope import Envelope
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import child_count, is_tip

_GENERATIONS = 12
_STARTS = 4  # nodes of the drawn limbs that begin a lateral, per tip wanted at the end: 1 in so many


def replicated(drawn: TreeSkeleton, envelope: Envelope | None, tips: int, *, random: bool, rng: np.random.Generator) -> TreeSkeleton:
    """The drawn tree with replicated blocks until it has about `tips` tips that were not drawn."""
    blocks = blocks_of(drawn)
    blocks = blocks.select(blocks.lateral_count > 0)
    frame = frames(drawn)
    rows = np.flatnonzero((drawn.order == 1) & ((child_count(drawn.parent) == 1) | is_tip(drawn.parent)))
    rows = rng.permutation(rows)[: max(tips // _STARTS, 1)]
    open_ = {"row": rows, "tip": drawn.tip[rows], "frame": frame[rows], "length": drawn.length[rows], "order": drawn.order[rows], "limb": drawn.limb[rows]}
    laterals_only, parts, total, next_limb = True, [], len(drawn), int(drawn.limb.max()) + 1
    ends = 0
    for _ in range(_GENERATIONS):
        made = _children(open_, blocks, envelope, laterals_only, random, rng)
        if len(made["row"]) == 0:
            break
        made["id"] = total + np.arange(len(made["row"]))
        fresh = ~made["apical"]
        made["limb"] = np.where(fresh, next_limb + np.cumsum(fresh), made["limb"])
        next_limb += int(fresh.sum()) + 1
        if len(parts) == 0 and np.sum(fresh) > tips:
            made = {name: column[:tips] for name, column in made.items()}
        parts.append(made)
        total += len(made["row"])
        ends = _tips(parts)
        if ends >= tips:
            break
        open_ = {"row": made["id"], "tip": made["tip"], "frame": made["frame"], "length": made["length"], "order": made["order"], "limb": made["limb"]}
        if ends * 2 > tips:  # the last generation: only as many as are still wanted
            keep = rng.permutation(len(open_["row"]))[: tips - ends]
            open_ = {name: column[keep] for name, column in open_.items()}
        laterals_only = False
    return _joined(drawn, parts)


def _children(open_, blocks: Blocks, envelope, laterals_only, random, rng):
    block = rng.integers(len(blocks), size=len(open_["row"]))
    first = blocks.start[block] + (blocks.apical[blocks.start[block]] if laterals_only else 0)
    count = blocks.start[block + 1] - first
    at = np.repeat(np.arange(len(block)), count)
    child = first[at] + np.arange(len(at)) - np.repeat(np.cumsum(count) - count, count)
    divergence, orientation = blocks.divergence[child], blocks.orientation[child]
    if random:
        divergence, orientation = np.arccos(rng.uniform(-1, 1, len(at))), rng.uniform(-np.pi, np.pi, len(at))
    apical = blocks.apical[child]
    frame = turn(open_["frame"][at], divergence, orientation, apical)
    length = open_["length"][at] * np.clip(blocks.scale[child], 0.2, 3.0)
    start = open_["tip"][at]
    heading = np.einsum("bij,bj->bi", open_["frame"][at], direction(divergence, orientation))
    end = start + length[:, None] * heading
    if envelope is not None:
        fraction = envelope.exit_fraction(start, end)
        end = start + fraction[:, None] * (end - start)
        length = length * fraction
    keep = length > 1e-4
    made = {"row": open_["row"][at], "tip": end, "frame": frame, "length": length, "apical": apical, "order": open_["order"][at] + ~apical, "limb": open_["limb"][at]}
    return {name: column[keep] for name, column in made.items()}


def _tips(parts) -> int:
    used = np.concatenate([part["row"] for part in parts])
    ids = np.concatenate([part["id"] for part in parts])
    return int(np.sum(~np.isin(ids, used)))


def _joined(drawn: TreeSkeleton, parts) -> TreeSkeleton:
    if not parts:
        return drawn
    columns = {name: np.concatenate([part[name] for part in parts]) for name in ("tip", "order", "limb")}
    parent = np.concatenate([part["row"] for part in parts])
    assert parent.min() > NULL
    size = len(parent)
    return drawn.append(columns | {"parent": parent, "radius": np.full(size, 1e-3), "kind": np.full(size, int(Kind.PROPAGATED))})
