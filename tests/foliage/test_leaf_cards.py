import numpy as np
import pytest

from sketchtree import keys
from sketchtree.errors import OptionError
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.leaf_cards import leaf_cards
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.populate import populate
from sketchtree.foliage.sprays import layouts, sprays
from sketchtree.levels.raster import View, silhouette
from tests.foliage.trees import HABIT, crown, small_tree

KEY = keys.root_key(1)
SHARES = (0.5, 0.2, 0.06)


def drawn_area(mesh):
    """Area of what the pictures show, m², from places spread evenly over every triangle."""
    a, b, c = (mesh.position[mesh.triangle[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    solid = mesh.material.base_color_texture[..., 3] >= 255 * mesh.material.alpha_cutoff
    rng, seen = np.random.default_rng(0), np.zeros(len(area))
    for _ in range(60):
        uv = np.einsum("tc,tcd->td", rng.dirichlet([1, 1, 1], len(area)), mesh.uv[mesh.triangle])
        row, column = (np.clip((uv[:, k] * solid.shape[1 - k]).astype(int), 0, solid.shape[1 - k] - 1) for k in (1, 0))
        seen += solid[row, column] / 60
    return float(area @ seen)


@pytest.fixture(scope="module", params=["oak", "ash", "spruce", "fan_palm"])
def levels(request):
    leaves = populate(small_tree(twigs=30, twig_length=1.2), HABIT, key=KEY, model=request.param)
    full = leaf_mesh(leaves)
    return leaves, full, [leaf_cards(leaves, triangles=int(share * full.triangle_count)) for share in SHARES]


def test_no_level_has_more_triangles_than_allowed_and_none_wastes_them(levels):
    _, full, cards = levels
    for share, mesh in zip(SHARES, cards, strict=True):
        assert 0.35 * share * full.triangle_count <= mesh.triangle_count <= share * full.triangle_count


def test_the_leaf_area_stays_within_ten_percent(levels):
    _, full, cards = levels
    for mesh in cards:
        assert drawn_area(mesh) == pytest.approx(drawn_area(full), rel=0.10)


def test_columns_are_finite_unit_and_within_range(levels):
    _, _, cards = levels
    for mesh in cards:
        assert all(np.isfinite(column).all() for column in (mesh.position, mesh.normal, mesh.uv, mesh.color))
        assert np.allclose(np.linalg.norm(mesh.normal, axis=1), 1)
        assert mesh.uv.min() >= 0 and mesh.uv.max() <= 1 and mesh.color.max() <= 1
        assert mesh.triangle.min() == 0 and mesh.triangle.max() == len(mesh.position) - 1
        assert mesh.name == "leaf" and mesh.material.name.startswith("leaf_")


def overlap(full, mesh):
    """Mean over two sides of the silhouettes' intersection over their union, from where a leaf is four pixels long."""
    centre = (full.position.min(axis=0) + full.position.max(axis=0)) / 2
    half = 1.05 * float(np.abs(full.position - centre).max())
    found = []
    for azimuth in (0.0, 1.1):
        view = View.round(azimuth, centre, half, int(4 * 2 * half / 0.09))
        a, b = silhouette([full], view), silhouette([mesh], view)
        found.append((a & b).sum() / (a | b).sum())
    return float(np.mean(found))


@pytest.mark.parametrize(("model", "least"), [("oak", (0.88, 0.84, 0.41)), ("spruce", (0.945, 0.575, 0.47))])
def test_the_leaves_alone_keep_their_silhouette(model, least):
    """Of a few limbs whose every leaf is seen singly, which is harder than a crown: what whole trees keep stands in docs/foliage.md."""
    leaves = populate(crown(limbs=40, reach=1.5), HABIT, key=KEY, model=model)
    full = leaf_mesh(leaves)
    kept = [overlap(full, leaf_cards(leaves, triangles=int(share * full.triangle_count))) for share in SHARES]
    assert all(one >= bar for one, bar in zip(kept, least, strict=True)), kept


def test_leaves_in_fewer_and_fewer_triangles_down_to_one():
    leaves = populate(small_tree(), HABIT, key=KEY)
    for most in (1, 2, 7, 40, len(leaves), 2 * len(leaves), 6 * len(leaves)):
        assert 1 <= leaf_cards(leaves, triangles=most).triangle_count <= most


def test_sprays_hold_every_leaf_once_and_no_more_than_allowed():
    rng = np.random.default_rng(2)
    foot = np.concatenate([rng.uniform(-9, 9, 3) + np.linspace(0, 1, n)[:, None] * [1.0, 0.2, 0] * n / 10 for n in (7, 3, 1, 12)])
    table = sprays(np.stack([foot, foot + [0, 0.3, 0], foot + [0.05, 0.1, 0.05]], axis=1), 7, 4)
    assert sorted(table[table >= 0]) == list(range(23))
    spread = [np.ptp(foot[row[row >= 0]], axis=0).max() for row in table]
    assert max(spread) < 0.5  # none holds leaves of two stems


def test_the_layout_of_flat_sprays_is_their_own_from_wherever_they_are_seen():
    rng = np.random.default_rng(3)
    foot = np.array([[0.0, 0.0, 0], [0.0, -0.5, 0]])
    ahead = np.array([[0.5, 0.866, 0], [-0.5, 0.866, 0]])
    turn = np.linalg.qr(rng.normal(size=(20, 3, 3)))[0]
    (found,), _ = layouts(foot @ turn, (foot + ahead) @ turn, 1.0)
    assert np.allclose(np.degrees(found.heading), [30, -30], atol=0.1)
    assert np.allclose(found.foot[0] - found.foot[1], [0, 0.5], atol=1e-3)


def test_the_same_leaves_give_the_same_cards():
    leaves = populate(small_tree(), HABIT, key=KEY)
    one, two = (leaf_cards(leaves, triangles=90) for _ in range(2))
    assert one.position.tobytes() == two.position.tobytes() and np.array_equal(one.material.base_color_texture, two.material.base_color_texture)


def test_no_leaf_gives_an_empty_mesh():
    assert leaf_cards(Leaves.none("oak"), triangles=10).triangle_count == 0
    assert leaf_cards(Leaves.none("pine"), triangles=10).triangle_count == 0


def test_no_triangle_at_all_is_refused():
    with pytest.raises(OptionError) as caught:
        leaf_cards(Leaves.none("oak"), triangles=0)
    assert str(caught.value) == "The leaves were to have 0 triangles. Allow at least 1, or leave the leaves out."


def test_an_unknown_season_is_refused():
    with pytest.raises(OptionError, match="There is no season called 'noon'"):
        leaf_cards(Leaves.none("oak"), season="noon", triangles=10)
