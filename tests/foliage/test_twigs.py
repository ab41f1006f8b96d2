import numpy as np

from sketchtree.foliage.twigs import leafy, level_side, transport, wood_pieces
from sketchtree.skeleton import TreeSkeleton
from tests.foliage.trees import single_twig, small_tree


def bent_tree():
    """One stem that winds like a corkscrew."""
    t = np.linspace(0, 1, 40)
    tips = np.stack([0.5 * np.cos(9 * t) - 0.5, 4 * t, 0.5 * np.sin(9 * t)], axis=1)
    return TreeSkeleton.from_columns(np.arange(-1, 39), tips, np.full(40, 0.003), limb=np.full(40, 5))


def test_frames_are_orthonormal():
    pieces = wood_pieces(bent_tree())
    assert np.allclose(np.linalg.norm(pieces.tangent, axis=1), 1)
    assert np.allclose(np.linalg.norm(pieces.side, axis=1), 1)
    assert np.abs(np.einsum("ij,ij->i", pieces.tangent, pieces.side)).max() < 1e-9


def test_frames_do_not_jump_along_a_bending_limb():
    pieces = wood_pieces(bent_tree())
    turn = np.einsum("ij,ij->i", pieces.side[:-1], pieces.side[1:])
    assert turn.min() > np.cos(np.radians(25))


def test_transport_is_the_smallest_rotation():
    rng = np.random.default_rng(0)
    before, after, side = (v / np.linalg.norm(v, axis=1, keepdims=True) for v in rng.normal(size=(3, 50, 3)))
    side = side - np.einsum("ij,ij->i", side, before)[:, None] * before
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    moved = transport(side, before, after)
    assert np.abs(np.einsum("ij,ij->i", moved, after)).max() < 1e-9
    axis = np.cross(before, after)
    assert np.allclose(np.einsum("ij,ij->i", moved, axis), np.einsum("ij,ij->i", side, axis), atol=1e-9)


def test_a_turn_right_back_keeps_the_side():
    ahead, side = np.array([[1.0, 0, 0]]), np.array([[0, 0, 1.0]])
    assert np.allclose(transport(side, ahead, -ahead), side)


def test_the_side_of_a_level_twig_is_level_and_of_an_upright_one_defined():
    side = level_side(np.array([[1.0, 0, 0], [0, 1.0, 0]]))
    assert np.allclose(side[:, 1], 0) and np.allclose(np.linalg.norm(side, axis=1), 1)


def test_every_piece_knows_its_row_and_its_way_to_the_tip():
    tree = small_tree()
    pieces = wood_pieces(tree)
    assert not tree.is_base[pieces.row].any()
    assert set(pieces.row) == set(np.flatnonzero(~tree.is_base))
    for row in np.flatnonzero(tree.limb == 11):
        own = np.flatnonzero(pieces.row == row)
        assert np.allclose(pieces.end[own[-1]], tree.tip[row])
    last = np.flatnonzero(tree.limb == 11)[-1]
    assert np.isclose(pieces.to_tip[pieces.row == last].min(), 0)
    assert np.allclose(pieces.to_tip + pieces.length + pieces.from_foot, pieces.limb_length)


def test_pieces_follow_the_drawn_curve():
    tree = TreeSkeleton.from_columns([-1, 0], [[0, 0, 0], [0, 2, 0]], [0.003, 0.003], limb=[3, 3], kind=[0, 0],
                                     curve_points=[[0.4, 1, 0]], curve_start=[0, 0, 1])  # fmt: skip
    pieces = wood_pieces(tree)
    assert np.linalg.norm(pieces.end - [0.4, 1, 0], axis=1).min() < 1e-9


def test_leafy_wood_is_thin_and_near_the_tip():
    tree = small_tree(twig_length=2.0)
    chosen = leafy(wood_pieces(tree), tree.order, thickest=0.0045, reach=0.3, share=0.0)
    assert len(chosen) and chosen.end_radius.max() <= 0.0045 and chosen.to_tip.max() < 0.3


def test_a_lonely_base_has_no_wood():
    assert len(wood_pieces(TreeSkeleton.from_columns([-1], [[0, 0, 0]], [0.1]))) == 0


def test_a_limb_knows_the_wood_it_stands_on():
    pieces = wood_pieces(single_twig())
    assert np.allclose(pieces.foot_radius[pieces.row > 1], 0.05, rtol=0.3)


def test_limbs_drawn_end_to_end_are_one_line_and_all_of_its_pieces_are_known():
    tips = np.array([[0, 0, 0], [0, 1, 0], [0.1, 1.5, 0], [0.2, 2, 0]], float)
    tree = TreeSkeleton.from_columns([-1, 0, 1, 2], tips, [0.01] * 4, limb=[1, 1, 7, 7], order=[0, 0, 1, 1])
    assert set(wood_pieces(tree).row) == {1, 2, 3}
