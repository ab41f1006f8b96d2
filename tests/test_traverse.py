import numpy as np

from sketchtree import traverse

PARENT = np.array([-1, 0, 1, 1, 3, -1, 5])


def test_generation_counts_rows_to_the_base():
    assert traverse.generation(PARENT).tolist() == [0, 1, 2, 2, 3, 0, 1]


def test_generations_list_parents_before_children():
    assert [rows.tolist() for rows in traverse.generations(PARENT)] == [[0, 5], [1, 6], [2, 3], [4]]


def test_children_are_found_row_by_row():
    child, start = traverse.children(PARENT)
    assert [child[start[i] : start[i + 1]].tolist() for i in range(len(PARENT))] == [[1], [2, 3], [], [4], [], [6], []]


def test_tips_have_no_children():
    assert np.flatnonzero(traverse.is_tip(PARENT)).tolist() == [2, 4, 6]


def test_sum_to_root_adds_up_descendants():
    assert traverse.sum_to_root(PARENT, np.ones(7)).tolist() == [5, 4, 1, 2, 1, 2, 1]


def test_sum_from_root_adds_up_ancestors():
    assert traverse.sum_from_root(PARENT, np.ones(7)).tolist() == [1, 2, 3, 3, 4, 1, 2]


def test_passes_agree_with_a_walk_over_a_random_tree():
    rng = np.random.default_rng(0)
    parent = np.r_[-1, [rng.integers(0, row) for row in range(1, 200)]]
    value = rng.normal(size=200)
    expected = value.copy()
    for row in range(199, 0, -1):
        expected[parent[row]] += expected[row]
    np.testing.assert_allclose(traverse.sum_to_root(parent, value), expected)


def test_limb_chains_follow_the_order_of_first_rows():
    limb = np.array([9, 9, 9, 4, 4, 7, 7])
    assert [rows.tolist() for rows in traverse.limb_chains(PARENT, limb)] == [[0, 1, 2], [3, 4], [5, 6]]


def test_an_empty_table_has_no_generations():
    assert traverse.generations(np.zeros(0, int)) == []
