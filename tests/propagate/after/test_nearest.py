import numpy as np
import pytest

from sketchtree.propagate.after.nearest import nearest

FINE = np.linspace(0.0, 1.0, 401)


def distance(p, d, q, e, s, t):
    return np.linalg.norm(p + s[:, None] * d - q - t[:, None] * e, axis=1)


def pieces(kind, count=60):
    rng = np.random.default_rng(3)
    p, d, q, e = rng.normal(size=(4, count, 3))
    if kind == "parallel":
        e = d * rng.choice([-2.0, 0.5, 1.0], count)[:, None]
    if kind == "in one line":
        e, q = d * 0.7, p + rng.uniform(-2, 2, count)[:, None] * d
    if kind == "crossing":
        q = p + rng.uniform(0, 1, count)[:, None] * d - rng.uniform(0, 1, count)[:, None] * e
    if kind == "a point":
        e = 0.0 * e
    if kind == "two points":
        d, e = 0.0 * d, 0.0 * e
    return p, d, q, e


@pytest.mark.parametrize("kind", ["askew", "parallel", "in one line", "crossing", "a point", "two points"])
def test_ericson_5_1_9_no_two_points_of_the_pieces_are_nearer(kind):
    p, d, q, e = pieces(kind)
    s, t = nearest(p, d, q, e)
    assert ((s >= 0) & (s <= 1) & (t >= 0) & (t <= 1)).all()
    for k in range(len(p)):
        apart = np.linalg.norm((p[k] + FINE[:, None] * d[k])[:, None] - (q[k] + FINE[:, None] * e[k])[None], axis=2)
        assert distance(p, d, q, e, s, t)[k] <= apart.min() + 1e-9


def test_crossing_pieces_have_no_distance():
    p, d, q, e = pieces("crossing")
    np.testing.assert_allclose(distance(p, d, q, e, *nearest(p, d, q, e)), 0.0, atol=1e-9)


def test_it_does_not_matter_which_is_first():
    p, d, q, e = pieces("askew")
    s, t = nearest(p, d, q, e)
    np.testing.assert_allclose(nearest(q, e, p, d), (t, s), atol=1e-9)
