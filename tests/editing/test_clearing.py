"""Nothing grows where a limb was deleted by hand."""

import numpy as np
import pytest
from drawn_by_hand import document, made

from sketchtree.editing import operations
from sketchtree.keys import root_key
from sketchtree.options import TreeOptions
from sketchtree.pipeline import grow
from sketchtree.skeleton import Kind
from sketchtree.studio.making.found import found_limb

OPTIONS = TreeOptions(generations=2)


@pytest.fixture(scope="module")
def grown():
    """(document, drawn, what grew) of the little drawing."""
    drawn, after = made(document())
    return after, drawn, grow(drawn, OPTIONS, key=root_key(0)).skeleton


def _longest(tree) -> int:
    """The longest undrawn limb that grows on a drawn one."""
    rows = np.flatnonzero((tree.kind == Kind.PROPAGATED) & ~tree.is_base)
    first = [row for row in rows if tree.limb[tree.parent[row]] != tree.limb[row] and tree.kind[tree.parent[row]] == Kind.DRAWN]
    return int(max((tree.limb[row] for row in first), key=lambda limb: tree.length[tree.limb == limb].sum()))


def test_an_undrawn_limb_is_found_as_it_stands(grown):
    after, drawn, tree = grown
    limb = _longest(tree)
    found = found_limb(drawn, tree, limb)
    assert found.parent in after.settled.limbs and found.was == limb and found.on is None
    np.testing.assert_allclose(drawn.similarity.to_world(found.path[-1] + found.foot), tree.tip[np.flatnonzero(tree.limb == limb)[-1]], atol=1e-9)


@pytest.mark.parametrize("seed", [0, 3])
def test_a_room_stays_clear_with_any_seed(grown, seed):
    after, drawn, tree = grown
    limb = _longest(tree)
    found = found_limb(drawn, tree, limb)
    cleared, _ = made(operations.clear(after, found))
    again = grow(cleared, OPTIONS, key=root_key(seed)).skeleton
    path = drawn.similarity.to_world(found.path + found.foot)
    middle = path[len(path) // 2]
    own = again.tip[(again.kind == Kind.PROPAGATED) & (again.limb == limb)]
    assert not len(own) or np.linalg.norm(own - middle, axis=1).min() > cleared.edits.cleared[limb].radius * drawn.similarity.scale
    assert len(again) < len(grow(drawn, OPTIONS, key=root_key(seed)).skeleton) or seed


def test_drawn_limbs_are_never_cleared(grown):
    after, drawn, tree = grown
    cleared, _ = made(operations.clear(after, found_limb(drawn, tree, _longest(tree))))
    again = grow(cleared, OPTIONS, key=root_key(0))
    np.testing.assert_array_equal(again.skeleton.tip[again.drawn_row], drawn.skeleton.tip)


def test_an_adopted_limb_stands_where_it_grew(grown):
    after, drawn, tree = grown
    limb = _longest(tree)
    found = found_limb(drawn, tree, limb)
    again, kept = made(operations.adopt(after, found))
    assert found.limb in kept.settled.limbs
    tip = again.skeleton.tip[np.flatnonzero(again.skeleton.limb == found.limb)[-1]]
    assert np.linalg.norm(tip - tree.tip[np.flatnonzero(tree.limb == limb)[-1]]) < 0.02 * tree.height
