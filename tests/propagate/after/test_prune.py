import numpy as np
import pytest
import trimesh
from tests.propagate.after.hanging import grown, rod
from tests.propagate.worlds import drawn_tree

from sketchtree.errors import OptionError
from sketchtree.propagate.after.cutting import path_length, pieces
from sketchtree.propagate.after.prune import Prune, share_inside
from sketchtree.propagate.after.shears import Hedge, Plane, plane, shears
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.stage import SkeletonStage

FIX = "Write a plane like `y<4.5`, `x>-1` or `1,1,0<3` (metres), a mesh file's name, or `outside:` and a mesh file's name."


@pytest.fixture(scope="module")
def tree():
    return grown()


def box(tmp_path, low, high, name="box.stl"):
    mesh = trimesh.creation.box(bounds=np.array([low, high], float))
    mesh.export(tmp_path / name)
    return str(tmp_path / name)


def inside_of(tree, low, high):
    return ((tree.tip >= np.array(low) - 1e-5) & (tree.tip <= np.array(high) + 1e-5)).all(axis=1)


def test_it_is_a_stage():
    assert isinstance(Prune(("y<4",)), SkeletonStage)


def test_without_shapes_the_tree_is_as_it_was(tree):
    assert Prune()(tree) is tree


@pytest.mark.parametrize(
    ("text", "normal", "distance"),
    [("y<4.5", (0, 1, 0), 4.5), ("x>-1", (-1, 0, 0), 1), (" z <= 0.5 ", (0, 0, 1), 0.5), ("1,1,0<3", (1, 1, 0), 3), ("0,-2,1e0>1", (0, 2, -1), -1)],
)
def test_a_plane_is_written_as_a_comparison(text, normal, distance):
    assert plane(text) == Plane(tuple(float(part) for part in normal), float(distance))


@pytest.mark.parametrize("text", ["y<", "<3", "w<3", "y<three", "y<nan", "0,0,0<1", "1,1<3", "1,1,0,0<3", "y<3<4", "1,inf,0<2", "x,y,z<1", "y<>3"])
def test_a_misspelt_plane_is_refused(text):
    with pytest.raises(OptionError) as caught:
        Prune((text,))
    assert str(caught.value) == f"`--prune {text}` is no plane. {FIX}"


@pytest.mark.parametrize(
    ("text", "cause"),
    [("", "names nothing to prune by."), ("outside:", "names nothing to prune by."), ("no.stl", None), ("outside:no.stl", None)],
)
def test_a_file_that_is_not_there_is_refused(text, cause):
    with pytest.raises(OptionError) as caught:
        shears(text)
    said = f"`--prune {text}` {cause}" if cause else f"`--prune {text}`: there is no mesh file no.stl."
    assert str(caught.value) == f"{said} {FIX}"


def test_a_mesh_that_is_not_closed_is_refused(tmp_path):
    mesh = trimesh.creation.box((1, 1, 1))
    mesh.update_faces(np.arange(12) > 1)
    mesh.export(tmp_path / "open.stl")
    with pytest.raises(OptionError) as caught:
        Prune((str(tmp_path / "open.stl"),))
    assert str(caught.value) == (
        "open.stl is not closed, so that it has no inside to prune by. Close its holes, or prune by planes such as `y<4.5`."
    )


@pytest.mark.parametrize("text", ["y<5.2", "x>-0.5", "1,1,0.5<5"])
def test_nothing_is_left_beyond_a_plane_and_cut_ends_lie_on_it(tree, text):
    side = plane(text)
    pruned = Prune((text,)).run(tree)
    left = pruned.skeleton
    height = left.tip @ np.array(side.normal) - side.distance
    assert height.max() <= 1e-9
    shorter = path_length(left) < path_length(tree)[pruned.rows] - 1e-9
    assert shorter.sum() > 2 and np.abs(height[shorter]).max() < 1e-9
    inner = left.curve_points @ np.array(side.normal) - side.distance
    assert inner.max(initial=-1.0) <= 1e-9


def test_what_is_left_is_not_moved(tree):
    pruned = Prune(("y<5.2",)).run(tree)
    whole = path_length(pruned.skeleton) > path_length(tree)[pruned.rows] - 1e-12
    np.testing.assert_array_equal(pruned.skeleton.tip[whole], tree.tip[pruned.rows][whole])
    np.testing.assert_array_equal(pruned.skeleton.radius[whole], tree.radius[pruned.rows][whole])


def test_the_cut_end_keeps_the_radius_the_wood_had_there():
    tree = rod([[1, 3, 0], [2, 3, 0]]).replace(radius=np.array([0.1, 0.1, 0.04, 0.02]))
    left = Prune(("x<1.5",))(tree)
    assert left.radius[-1] == pytest.approx(0.03)


def test_what_comes_back_beyond_the_cut_is_gone():
    tree = rod([[1, 3, 0], [1, 5, 0], [2, 5, 0], [2, 3, 0]])
    left = Prune(("y<4",))(tree)
    np.testing.assert_allclose(left.tip[3:], [[1, 4, 0]])


def test_drawn_curves_are_cut_where_they_first_leave():
    tree = drawn_tree(6)
    pruned = Prune(("1,0,1<0.8",)).run(tree)
    _, start, end, _ = pieces(pruned.skeleton)
    assert (np.vstack([start, end]) @ [1, 0, 1]).max() <= 0.8 + 1e-9
    assert pruned.strokes_cut > 0


def test_the_strokes_that_were_cut_are_counted():
    tree = drawn_tree(6)
    assert Prune(("y<100",)).run(tree).strokes_cut == 0
    top = tree.tip[:, 1].max()
    assert Prune((f"y<{top - 1e-3}",)).run(tree).strokes_cut == 1


def test_hedge_shears_leave_the_inside_of_a_mesh(tree, tmp_path):
    low, high = (-1, 0, -1), (1, 6, 1)
    left = Prune((box(tmp_path, low, high),))(tree)
    assert inside_of(left, low, high).all()
    assert len(left) > 20 and left.tip[:, 1].max() == pytest.approx(6.0, abs=1e-5)


def test_a_hole_leaves_the_outside(tree, tmp_path):
    low, high = (0.3, 4.0, -3.0), (3.0, 7.0, 3.0)
    left = Prune(("outside:" + box(tmp_path, low, high),))(tree)
    assert len(left) < len(tree)
    inner = ((left.tip > np.array(low) + 1e-5) & (left.tip < np.array(high) - 1e-5)).all(axis=1)
    assert not inner.any()


def test_a_box_that_stands_on_the_ground_holds_the_foot(tmp_path):
    """Whatever rounding makes of a foot that lies on the bottom face."""
    tree = rod([[1, 3, 0]])
    assert len(Prune((box(tmp_path, (-2, 0, -2), (2, 4, 2)),))(tree)) == len(tree)


def test_several_shapes_leave_what_all_of_them_leave(tree):
    both = Prune(("y<6", "x<1"))(tree)
    np.testing.assert_allclose(both.tip, Prune(("x<1",))(Prune(("y<6",))(tree)).tip, atol=1e-9)


def test_a_piece_is_cut_at_a_mesh_to_a_millionth():
    ball = Hedge.from_mesh(trimesh.creation.icosphere(4, 1.0))
    share = ball.exit_fraction(np.zeros((2, 3)), np.array([[2.0, 0, 0], [0.1, 0.1, 0.1]]))
    assert share[0] == pytest.approx(0.5, abs=0.01) and share[1] == 1.0
    hole = Hedge(ball.solid, hole=True)
    share = hole.exit_fraction(np.array([[2.0, 0.01, 0], [0, 0, 0]]), np.array([[0.0, 0.01, 0], [3.0, 0, 0]]))
    assert share[0] == pytest.approx(0.5, abs=0.01) and share[1] == 0.0


@pytest.mark.parametrize("text", ["y<-1", "x>3"])
def test_cutting_the_foot_is_refused(tree, text):
    with pytest.raises(OptionError) as caught:
        Prune((text,)).run(tree)
    assert str(caught.value) == (
        "Pruning cuts the tree off at its foot, so nothing is left. Turn the plane's `<` round, or let the mesh reach down "
        "to the ground (the trunk's root is at the origin)."
    )


def test_of_two_stems_one_may_go():
    tree = rod([[1, 3, 0]])
    other = TreeSkeleton.from_columns(
        np.r_[tree.parent, np.where(tree.parent < 0, -1, tree.parent + 3)], np.vstack([tree.tip, tree.tip + [9, 0, 0]]), np.r_[tree.radius, tree.radius]
    )
    np.testing.assert_array_equal(Prune(("x<5",)).run(other).rows, np.arange(3))


def test_a_foot_that_bears_nothing_any_more_goes_too():
    """The second stem leans out of the shape right from its foot."""
    tree = rod([[1, 3, 0]])
    other = TreeSkeleton.from_columns(
        np.r_[tree.parent, -1, 3], np.vstack([tree.tip, [[5, 0, 0], [6, 1, 0]]]), np.r_[tree.radius, 0.1, 0.1]
    )
    np.testing.assert_array_equal(Prune(("x<5",)).run(other).rows, np.arange(3))


def rooted():
    tree = rod([[1, 3, 0]])
    root = {"parent": np.array([0, 3]), "tip": np.array([[0.5, -0.5, 0], [2.0, -1.0, 0]]), "radius": np.array([0.05, 0.03]), "limb": np.array([7, 7]),
            "kind": np.full(2, int(Kind.ROOT)), "stroke": np.array([3, 3])}  # fmt: skip
    return tree.append(root)


def test_roots_are_cut_by_a_plane_that_they_cross_and_by_no_other(tmp_path):
    tree = rooted()
    assert len(Prune(("y<2.9",))(tree)) == 4
    left = Prune(("x<1.25",))(tree)
    np.testing.assert_allclose(left.tip[left.kind == Kind.ROOT], [[0.5, -0.5, 0], [1.25, -0.75, 0]])
    np.testing.assert_array_equal(share_inside(tree, shears(box(tmp_path, (-3, 0, -3), (3, 9, 3))))[3:], 1.0)


def test_an_empty_tree_stays_empty():
    empty = TreeSkeleton.from_columns(np.zeros(0, int), np.zeros((0, 3)), np.zeros(0))
    assert len(Prune(("y<1",))(empty)) == 0
