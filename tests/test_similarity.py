import numpy as np

from sketchtree.similarity import Similarity

PAGE = Similarity(0.01, (-2.0, 3.0, 0.0))


def test_there_and_back_again_is_where_one_was():
    points = np.random.default_rng(0).normal(size=(5, 3)) * 100
    np.testing.assert_allclose(PAGE.to_sketch(PAGE.to_world(points)), points, atol=1e-9)


def test_flat_points_use_the_first_two_shifts():
    np.testing.assert_allclose(PAGE.to_world(np.array([[100.0, 200.0]])), [[-1.0, 5.0]])
