"""Which levels of detail does a tree get, and where do their triangles go?"""

from types import SimpleNamespace

import numpy as np
import pytest

from benchmarks.levels import leaf_area
from sketchtree import keys
from sketchtree.dressing import Dress
from sketchtree.errors import OptionError
from sketchtree.fidelity.sampled import along
from sketchtree.fidelity.scan_distance import scan_to_mesh
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.populate import populate
from sketchtree.geometry.wood import wood_meshes
from sketchtree.levels import make, spend
from sketchtree.levels.impostor import impostor
from sketchtree.levels.make import SHARES, level_of_detail, make_levels, within_triangles
from sketchtree.levels.outline_error import overlap, views_round
from sketchtree.levels.raster import silhouette
from sketchtree.options import FEWEST_TRIANGLES
from tests.foliage.trees import HABIT, crown

KEY = keys.root_key(0)
BARS = (0.94, 0.84, 0.6)
"""Of a few limbs whose every leaf is seen singly, which is harder than a crown; what whole trees keep stands in docs/levels.md."""


def tree(model="oak", season="summer"):
    skeleton = crown(limbs=14, reach=1.2)
    leaves = populate(skeleton, HABIT, key=KEY, model=model, season=season)
    meshes = [*wood_meshes(skeleton, bark="oak", habit=HABIT, key=KEY, wood="tubes")] + ([leaf_mesh(leaves, season=season)] if len(leaves) else [])
    return SimpleNamespace(skeleton=skeleton, leaves=leaves, blossom=None, meshes=tuple(meshes), dress=Dress("oak", model, season, HABIT))


@pytest.fixture(scope="module")
def made():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(make, "impostor", lambda meshes: impostor(meshes, pixels=64))
        patch.setattr(make, "_PIXELS", 128)
        patch.setattr(spend, "_PIXELS", 120)
        model = tree()
        yield model, make_levels(model)


def test_each_level_keeps_its_budget_and_uses_most_of_it(made):
    model, levels = made
    full = levels[0].triangle_count
    assert len(levels) == 5 and full == sum(mesh.triangle_count for mesh in model.meshes)
    for share, level in zip(SHARES, levels[1:4], strict=True):
        assert 0.7 * share * full < level.triangle_count <= share * full


def test_a_tree_is_to_be_had_with_so_many_triangles_at_most(made):
    model, _ = made
    full = sum(mesh.triangle_count for mesh in model.meshes)
    some = within_triangles(model, full // 3)
    assert 0.6 * full // 3 < sum(mesh.triangle_count for mesh in some) <= full // 3
    assert some[0].name == "wood"
    assert within_triangles(model, full) == model.meshes
    with pytest.raises(OptionError) as told:
        within_triangles(model, FEWEST_TRIANGLES - 1)
    assert str(told.value) == "11 triangles are too few for a tree. Give 12 or more."


def test_bare_wood_of_so_few_triangles_keeps_its_surface_rather_than_its_outline():
    bare = tree(season="bare")
    assert len(bare.leaves) == 0
    wood, outlines = along(bare.skeleton, 0.02)[0], make._budget(bare).meshes(60)
    assert scan_to_mesh(wood, within_triangles(bare, 60)).mean < 0.3 * scan_to_mesh(wood, outlines).mean


def test_outlines_stay_the_trees(made):
    _, levels = made
    views = views_round(levels[0].parts, 8, 160)
    for bar, level in zip(BARS, levels[1:4], strict=True):
        found = [overlap(silhouette(levels[0].parts, view), silhouette(level.parts, view)) for view in views]
        assert np.mean(found) > bar, found


def test_the_area_of_the_leaves_stays_within_ten_percent(made):
    _, levels = made
    full = leaf_area(levels[0].parts)
    assert [leaf_area(level.parts) / full for level in levels[1:4]] == pytest.approx([1, 1, 1], abs=0.1)


def test_each_level_has_wood_first_and_then_leaves(made):
    _, levels = made
    for level in levels[:4]:
        names = [part.name for part in level.parts]
        assert names[0] == "wood" and names[-1] == "leaf"


def test_coverages_fall_and_a_larger_error_moves_them_up(made):
    model, levels = made
    coverage = [level.coverage for level in levels]
    assert coverage == sorted(coverage, reverse=True) and coverage[-1] == 0.0
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(make, "_PIXELS", 128)
        patch.setattr(spend, "_PIXELS", 120)
        bold = make_levels(model, pixel_error=3.0, with_impostor=False)
    assert len(bold) == 4 and bold[2].coverage == 0 or bold[2].coverage >= levels[2].coverage
    assert bold[1].coverage == pytest.approx(min(3 * levels[1].coverage, 1.0), rel=1e-6)


def test_one_level_alone_is_that_of_the_set(made):
    model, levels = made
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(spend, "_PIXELS", 120)
        alone = level_of_detail(model, 1)
    assert [part.triangle_count for part in alone] == [part.triangle_count for part in levels[1].parts]
    assert all((one.position == other.position).all() for one, other in zip(alone, levels[1].parts, strict=True))


def test_a_bare_tree_spends_all_on_its_wood():
    model = tree(season="bare")
    full = sum(mesh.triangle_count for mesh in model.meshes)
    few = level_of_detail(model, 2)
    assert all(part.name.startswith("wood") for part in few) and 0.8 * 0.2 * full < sum(part.triangle_count for part in few) <= 0.2 * full


def test_the_same_tree_gets_the_same_levels():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(spend, "_PIXELS", 96)
        model = tree("spruce")
        one, two = (level_of_detail(model, 3) for _ in range(2))
    assert all(a.position.tobytes() == b.position.tobytes() for a, b in zip(one, two, strict=True))
