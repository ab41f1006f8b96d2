import numpy as np
import pytest
from tests.propagate.after.crossings import crossing, drawn, post_with, twig
from tests.propagate.after.hanging import grown, shuffled

from sketchtree.propagate.after.nearest import nearest
from sketchtree.propagate.after.overlaps import FORK, capsule_radius, overlapping, share_overlapping
from sketchtree.skeleton import Kind, TreeSkeleton


@pytest.fixture(scope="module")
def tree():
    """A grown tree whose wood is thick, so that much of it overlaps; its drawn limbs are curved."""
    made = grown(generations=2)
    return made.replace(radius=3.0 * made.radius)


def paths(tree):
    return [tree.curve(row) for row in range(len(tree))]


def node_of_limb(tree, row):
    while tree.parent[row] >= 0 and tree.limb[tree.parent[row]] == tree.limb[row]:
        row = tree.parent[row]
    return row if tree.parent[row] < 0 else tree.parent[row]


def kin(tree, i, j):
    def line(row):
        above = tree.parent[row]
        return row, above, tree.parent[above] if above >= 0 else -1

    (_, above_i, over_i), (_, above_j, over_j) = line(i), line(j)
    return (
        tree.limb[i] == tree.limb[j] or above_i == above_j or above_i == j or above_j == i
        or over_i in (j, above_j) or over_j in (i, above_i)
    )  # fmt: skip


def in_fork(tree, i, at, j):
    node = node_of_limb(tree, i)
    near = np.linalg.norm(at - tree.tip[node]) < FORK * tree.radius[node]
    return near and tree.limb[node] in (tree.limb[j], tree.limb[node_of_limb(tree, j)])


def slowly(tree):
    """{pair of rows: depth}, of all pairs of all pieces. Pieces as long as rows: forks are judged by their nearest points."""
    found, path, radius = {}, paths(tree), capsule_radius(tree)
    rows = np.flatnonzero(~tree.is_base)
    for i in rows:
        for j in rows[rows > i]:
            if kin(tree, i, j):
                continue
            for a, b in zip(path[i][:-1], path[i][1:], strict=True):
                for c, d in zip(path[j][:-1], path[j][1:], strict=True):
                    s, t = nearest(a[None], (b - a)[None], c[None], (d - c)[None])
                    p, q = a + s[0] * (b - a), c + t[0] * (d - c)
                    depth = radius[i] + radius[j] - np.linalg.norm(p - q)
                    if depth > 0 and not in_fork(tree, i, p, j) and not in_fork(tree, j, q, i):
                        found[i, j] = max(depth, found.get((i, j), 0.0))
    return found


def few(tree, rows=150):
    """The first rows of a tree."""
    keep = np.arange(len(tree)) < rows
    return tree.select(keep)


def test_it_agrees_with_the_slow_twin_pair_by_pair(tree, monkeypatch):
    small = few(tree)
    monkeypatch.setattr("sketchtree.propagate.after.overlaps.usual_length", lambda tree: 100.0)
    fast, slow = overlapping(small), slowly(small)
    assert len(slow) > 10 and set(zip(fast.one.tolist(), fast.other.tolist(), strict=True)) == {(int(i), int(j)) for i, j in slow}
    np.testing.assert_allclose(fast.depth, [slow[pair] for pair in zip(fast.one.tolist(), fast.other.tolist(), strict=True)], atol=1e-12)


def test_how_pieces_are_cut_for_the_search_changes_nothing_outside_forks(tree, monkeypatch):
    usual = overlapping(tree)
    monkeypatch.setattr("sketchtree.propagate.after.overlaps.usual_length", lambda tree: 0.05)
    fine = overlapping(tree)
    both = {pair: depth for *pair, depth in zip(usual.one, usual.other, usual.depth, strict=True) for pair in [tuple(pair)]}
    same = [abs(both[i, j] - depth) < 1e-9 for i, j, depth in zip(fine.one, fine.other, fine.depth, strict=True) if (i, j) in both]
    assert len(same) == len(usual) and np.mean(same) > 0.95


def test_the_nearest_points_are_as_far_apart_as_the_depth_says(tree):
    found, radius = overlapping(tree), capsule_radius(tree)
    apart = np.linalg.norm(found.at_one - found.at_other, axis=1)
    np.testing.assert_allclose(radius[found.one] + radius[found.other] - apart, found.depth, atol=1e-12)
    assert (found.one < found.other).all() and (found.depth > 0).all()


def test_two_limbs_that_cross_overlap_and_two_that_pass_do_not():
    found = overlapping(crossing())
    assert (len(found), found.depth[0]) == (1, pytest.approx(0.04, abs=1e-12))
    np.testing.assert_allclose(found.at_one, found.at_other, atol=1e-12)
    assert len(overlapping(crossing(0.035))) == 1 and len(overlapping(crossing(0.045))) == 0
    assert len(overlapping(crossing(0.045), swell=1.2)) == 1


def test_rows_that_meet_in_a_fork_do_not_count():
    fork = post_with(twig(3, [0.2, 3.1, 0], [1, 3.5, 0]), twig(3, [0.2, 3.12, 0], [1, 3.3, 0]), radius=0.05, thick=0.3)
    assert len(overlapping(fork)) == 0
    apart = fork.replace(radius=np.where(fork.order == 0, 0.05, fork.radius))
    assert len(overlapping(apart)) > 0


def test_drawn_points_count_between_start_and_tip():
    straight = crossing(other=drawn)
    rows = np.flatnonzero(straight.limb == 100)
    start = np.zeros(len(straight) + 1, int)
    start[rows[0] + 1 :] = 1
    bowed = straight.replace(curve_points=[[0.8, 3.0, 0.3]], curve_start=start)
    assert len(overlapping(straight)) == 1 and len(overlapping(bowed)) == 0


def test_shares_count_undrawn_segments_only():
    undrawn, half = crossing(), crossing(other=drawn)
    assert share_overlapping(undrawn) == (2 / 5, 2 / 5)
    assert share_overlapping(half) == (0.0, 1 / 2)
    assert share_overlapping(crossing(1.0)) == (0.0, 0.0)


def test_the_order_of_rows_does_not_matter(tree):
    other, rows = shuffled(tree.replace(curve_points=np.zeros((0, 3)), curve_start=np.zeros(len(tree) + 1, int)), 1)
    straight = tree.replace(curve_points=np.zeros((0, 3)), curve_start=np.zeros(len(tree) + 1, int))
    named = {frozenset(pair) for pair in zip(rows[overlapping(other).one].tolist(), rows[overlapping(other).other].tolist(), strict=True)}
    found = overlapping(straight)
    assert named == {frozenset(pair) for pair in zip(found.one.tolist(), found.other.tolist(), strict=True)}


def test_an_empty_tree_and_one_of_a_base_alone_have_none():
    for rows in (0, 1):
        tree = TreeSkeleton.from_columns(np.full(rows, -1), np.zeros((rows, 3)), np.ones(rows), kind=np.full(rows, int(Kind.DRAWN)))
        assert len(overlapping(tree)) == 0 and share_overlapping(tree) == (0.0, 0.0)
