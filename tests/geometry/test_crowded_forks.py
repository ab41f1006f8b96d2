import numpy as np
from growing import fork

from sketchtree.geometry.detail import Detail
from sketchtree.geometry.limbs import centre_lines
from sketchtree.geometry.one_piece.joints import joined
from sketchtree.geometry.one_piece.plan import plan_one_piece


def collars(children: int, thickness: float):
    tree = fork(60.0, thickness, children)
    lines = joined(centre_lines(tree, onward=True), tree)
    return plan_one_piece(lines, Detail(), 3.0).collars


def test_a_limb_that_stands_alone_keeps_its_collar():
    assert np.all(collars(1, 0.8).ease == 0.0)


def test_limbs_with_room_round_their_parent_keep_their_collars():
    assert np.all(collars(2, 0.3).ease == 0.0)


def test_where_limbs_crowd_those_that_had_to_move_have_longer_collars():
    crowded, alone = collars(4, 0.8), collars(1, 0.8)
    assert np.any(crowded.ease > 0.2) and np.all(crowded.ease < 1.0)
    assert crowded.top[crowded.ease > 0].min() > alone.top[0]


def test_no_collar_is_longer_than_its_limb_allows():
    tree = fork(60.0, 0.8, 5)
    lines = joined(centre_lines(tree, onward=True), tree)
    found = plan_one_piece(lines, Detail(), 3.0).collars
    assert np.all(found.top <= 0.85 * lines.length[found.limb] + 1e-9)
