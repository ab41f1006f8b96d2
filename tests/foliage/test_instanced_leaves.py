import numpy as np
import pytest

from sketchtree import keys
from sketchtree.errors import OptionError
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.instanced import leaf_instances
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.models import leaf_model
from sketchtree.foliage.populate import populate
from tests.foliage.trees import HABIT, small_tree

KEY = keys.root_key(1)


def area(mesh):
    a, b, c = (mesh.position[mesh.triangle[:, k]] for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


@pytest.fixture(scope="module", params=["oak", "birch", "spruce", "palm", "horse_chestnut"])
def both(request):
    leaves = populate(small_tree(twigs=8), HABIT, key=KEY, model=request.param)
    return leaves, leaf_mesh(leaves), leaf_instances(leaves)


def test_merged_they_have_the_triangles_and_the_area_of_the_mesh(both):
    _, mesh, found = both
    merged = [one.merged() for one in found]
    assert sum(len(one.triangle) for one in merged) == mesh.triangle_count == sum(one.triangle_count for one in found)
    assert sum(map(area, merged)) == pytest.approx(area(mesh), rel=0.02)


def test_every_leaf_stands_where_it_stands_in_the_mesh_but_for_its_bend(both):
    """Corners by the place of their leaf: the petiole's are the same, the others differ by what curl and fold do."""
    leaves, mesh, found = both
    whole = mesh.position[: len(mesh.position) - 6 * len(leaves.shoot)].reshape(len(leaves), -1, 3)
    model = leaf_model(leaves.model)
    for one in (f for f in found if f.name != "leaf_stem"):
        row = [np.flatnonzero((leaves.position == at).all(axis=1) & (leaves.size == size[0])) for at, size in zip(one.translation, one.scale, strict=True)]
        row = np.array([r[0] for r in row if len(r) == 1]), np.array([k for k, r in enumerate(row) if len(r) == 1])
        own = one.merged().position.reshape(len(one), -1, 3)[row[1]]
        apart = np.linalg.norm(own - whole[row[0]], axis=2) / leaves.size[row[0], None]
        assert apart[:, :2].max() < 0.02 + 0.6 * np.radians(model.fold) * np.abs(one.mesh.position[:2, 0]).max()
        assert apart.max() < 0.22 * model.curl + 0.45 * np.radians(model.fold) + 1e-6


def test_short_shoots_are_one_stem_many_times():
    leaves = populate(small_tree(), HABIT, key=KEY)
    stem = leaf_instances(leaves)[-1]
    assert stem.name == "leaf_stem" and len(stem) == len(leaves.shoot) > 0
    tubes = leaf_mesh(leaves).position[-6 * len(stem) :]
    assert np.allclose(stem.merged().position, tubes, atol=1e-9)


def test_they_are_named_leaf_and_share_one_material(both):
    leaves, mesh, found = both
    assert all(one.name.startswith("leaf") for one in found)
    assert {id(one.mesh.material) for one in found} == {id(mesh.material)}
    assert len(found) <= 4


def test_rotations_are_unit_and_colours_factors(both):
    for one in both[2]:
        assert np.allclose(np.linalg.norm(one.rotation, axis=1), 1)
        assert one.color is None or (0 <= one.color.min() and one.color.max() <= 1)


def test_thirty_thousand_leaves_take_less_than_1700_kilobytes():
    leaves = populate(small_tree(twigs=8), HABIT, key=KEY)
    row = 12 + 16 + 4 + 4  # translation, rotation, one scale, tint as bytes
    assert 30_000 * row < 1_700_000
    assert all(np.allclose(one.scale, one.scale[:, :1]) for one in leaf_instances(leaves)[:-1])


def test_no_leaf_gives_no_instance():
    assert leaf_instances(Leaves.none("oak")) == ()


def test_an_unknown_season_is_refused():
    with pytest.raises(OptionError, match="There is no season called 'noon'"):
        leaf_instances(Leaves.none("oak"), season="noon")
