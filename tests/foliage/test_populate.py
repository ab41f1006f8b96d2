from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from sketchtree import keys
from sketchtree.errors import OptionError
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.models import leaf_names
from sketchtree.foliage.populate import populate
from sketchtree.geometry.limbs import centre_lines
from sketchtree.skeleton import TreeSkeleton
from tests.foliage.trees import HABIT, single_twig, small_tree

KEY = keys.root_key(3)
COLUMNS = ("position", "direction", "normal", "size", "tint", "segment")


def columns(leaves: Leaves, keep=slice(None)):
    return {name: getattr(leaves, name)[keep] for name in COLUMNS}


def gap_to_wood(position, tree):
    """How far outside the rendered wood each place lies, metres (negative: inside)."""
    lines = centre_lines(tree)
    first = np.flatnonzero(np.diff(lines.of_point) == 0)
    a, b = lines.point[first], lines.point[first + 1]
    along = np.einsum("lsk,sk->ls", position[:, None] - a, b - a) / np.einsum("sk,sk->s", b - a, b - a)
    at = np.clip(along, 0, 1)[..., None]
    distance = np.linalg.norm(position[:, None] - a - at * (b - a), axis=2)
    radius = lines.radius[first] + at[..., 0] * (lines.radius[first + 1] - lines.radius[first])
    return np.min(distance - radius, axis=1)


def gap_to_shoots(leaves):
    """How far each leaf starts from the nearest short shoot's line, metres."""
    a, b = leaves.shoot[:, 0], leaves.shoot[:, 1]
    along = np.einsum("lsk,sk->ls", leaves.position[:, None] - a, b - a) / np.einsum("sk,sk->s", b - a, b - a)
    at = np.clip(along, 0, 1)[..., None]
    return np.linalg.norm(leaves.position[:, None] - a - at * (b - a), axis=2).min(axis=1, initial=np.inf)


@pytest.mark.parametrize("name", leaf_names())
def test_every_leaf_starts_on_the_woods_surface_or_on_a_short_shoot(name):
    tree = small_tree()
    leaves = populate(tree, HABIT, key=KEY, model=name)
    gap = gap_to_wood(leaves.position, tree)
    on_shoot = gap_to_shoots(leaves) < 1e-9
    assert len(leaves) and gap[~on_shoot].max() <= 1e-6 and gap.min() > -0.2 * 0.012


def test_every_short_shoot_starts_on_the_woods_surface_and_is_short():
    tree = small_tree(twigs=12)
    leaves = populate(tree, HABIT, key=KEY)
    gap = gap_to_wood(leaves.shoot[:, 0], tree)
    assert len(leaves.shoot) and gap.max() <= 1e-6 and gap.min() > -0.2 * 0.012
    assert np.linalg.norm(leaves.shoot[:, 1] - leaves.shoot[:, 0], axis=1).max() < 0.4


def test_short_shoots_stand_on_old_wood_and_leaves_on_young():
    tree = single_twig(length=1.0, count=10)
    leaves = populate(tree, HABIT, key=KEY)
    x = leaves.shoot[:, 0, 0]
    assert len(x) > 2 and x.max() < leaves.position[gap_to_shoots(leaves) > 1e-9][:-1, 0].max()


@pytest.mark.parametrize("name", leaf_names())
def test_directions_and_normals_are_orthonormal(name):
    leaves = populate(small_tree(), HABIT, key=KEY, model=name)
    assert np.allclose(np.linalg.norm(leaves.direction, axis=1), 1)
    assert np.allclose(np.linalg.norm(leaves.normal, axis=1), 1)
    assert np.abs(np.einsum("ij,ij->i", leaves.direction, leaves.normal)).max() < 1e-9


def test_no_leaf_on_thick_wood():
    tree = small_tree()
    leaves = populate(tree, HABIT, key=KEY)
    assert tree.radius[leaves.segment].max() <= 8.0 * HABIT.twig_radius
    assert not np.isin(leaves.segment, np.flatnonzero(tree.order == 0)).any()


def test_alternate_leaves_stand_on_both_sides_in_turn():
    tree = single_twig()
    leaves = populate(tree, replace(HABIT, leaf="willow", twig_radius=0.006), key=KEY)
    side = np.sign(leaves.position[:, 2])
    order = np.argsort(-leaves.position[:, 0])
    assert (side[order][:-1] * side[order][1:] == -1).all()


def test_decussate_pairs_cross_on_the_twig():
    tree = single_twig()
    habit = replace(HABIT, leaf="palm", leaf_arrangement="decussate", leaf_spacing=0.06, twig_radius=0.005)
    leaves = populate(tree, habit, key=KEY)
    centre = tree.tip[1]
    offset = (leaves.position - centre)[:, 1:]
    pairs = (offset / np.linalg.norm(offset, axis=1, keepdims=True)).reshape(-1, 2, 2)
    assert np.allclose(np.einsum("nk,nk->n", pairs[:, 0], pairs[:, 1]), -1, atol=1e-6)
    by_place = pairs[np.argsort(leaves.position[::2, 0])]
    assert np.abs(np.einsum("nk,nk->n", by_place[:-1, 0], by_place[1:, 0])).max() < 1e-6


def test_nodes_stand_a_leaf_spacing_apart():
    tree = single_twig(length=0.8)
    leaves = populate(tree, replace(HABIT, leaf="palm", leaf_spacing=0.05, twig_radius=0.005), key=KEY)
    x = np.sort(leaves.position[:, 0])
    assert np.isclose(np.mean(np.diff(x)), 0.05, atol=0.005)
    assert np.diff(x).max() < 0.05 * 1.6


def test_a_leaf_stands_at_the_tip():
    tree = single_twig()
    leaves = populate(tree, HABIT, key=KEY)
    assert np.linalg.norm(leaves.position - tree.tip[-1], axis=1).min() < 0.004


def test_density_scales_the_count():
    tree = small_tree(twigs=12, twig_length=0.8)
    once, twice = (len(populate(tree, HABIT, key=KEY, density=d)) for d in (1.0, 2.0))
    assert abs(twice / once - 2) < 0.3


def test_leaves_face_the_sky_more_than_the_ground():
    leaves = populate(small_tree(twigs=12), HABIT, key=KEY)
    assert leaves.normal[:, 1].mean() > 0.4


def test_willow_leaves_droop_more_than_oak_leaves():
    tree = small_tree(twigs=12)
    oak, willow = (populate(tree, HABIT, key=KEY, model=name) for name in ("oak", "willow"))
    assert willow.direction[:, 1].mean() < oak.direction[:, 1].mean()


def test_the_cap_keeps_the_leaf_area_and_says_so():
    tree = small_tree(twigs=20, twig_length=0.8)
    every, capped = populate(tree, HABIT, key=KEY), populate(tree, HABIT, key=KEY, max_leaves=100)
    assert every.kept == 1.0 and len(capped) == 100
    assert np.isclose(capped.kept, 100 / len(every))
    assert np.isclose(np.sum(capped.size**2), np.sum(every.size**2), rtol=0.05)


def test_the_same_key_gives_the_same_bytes_and_another_key_others():
    tree = small_tree()
    one, two, other = (populate(tree, HABIT, key=k) for k in (KEY, KEY, keys.root_key(4)))
    assert all(getattr(one, name).tobytes() == getattr(two, name).tobytes() for name in COLUMNS)
    assert one.tint.tobytes() != other.tint.tobytes()


def test_adding_a_limb_leaves_the_other_limbs_leaves_unchanged():
    few, many = small_tree(twigs=4), small_tree(twigs=5)
    before, after = populate(few, HABIT, key=KEY), populate(many, HABIT, key=KEY)
    old = np.isin(after.segment, np.arange(len(few)))
    assert old.sum() == len(before) < len(after)
    for name in ("direction", "size", "tint", "segment"):
        assert np.allclose(getattr(before, name), getattr(after, name)[old], atol=1e-12), name


def test_a_bare_tree_has_no_leaf():
    assert len(populate(small_tree(), HABIT, key=KEY, season="bare")) == 0


def test_evergreens_keep_their_needles_when_others_are_bare():
    summer, bare = (populate(small_tree(), HABIT, key=KEY, model="spruce", season=s) for s in ("summer", "bare"))
    assert len(bare) == len(summer) > 0
    assert len(populate(small_tree(), HABIT, key=KEY, model="larch", season="bare")) == 0


def test_a_fan_stands_at_the_end_of_every_stalk_and_opens_in_one_plane():
    tree = single_twig(length=1.0, count=6)
    leaves = populate(tree, replace(HABIT, leaf="fan_palm", leaf_arrangement="frond", leaf_size=0.6), key=KEY)
    assert len(leaves) == 34 and np.allclose(leaves.position, leaves.position[0])
    flat = leaves.direction + [0, 0.10, 0]  # without its droop
    assert np.abs(flat[:, 1] / np.linalg.norm(flat, axis=1)).max() < 0.15
    spread = np.degrees(np.arccos(np.clip(leaves.direction[0] @ leaves.direction[-1], -1, 1)))
    assert 80 < spread < 125  # 128 degrees to either side leave a gap of 104


def test_two_ranked_leaves_of_a_level_twig_lie_in_a_flat_spray():
    for name in ("beech", "elm", "lime", "hazel", "hornbeam"):
        leaves = populate(single_twig(), replace(HABIT, leaf=name, leaf_arrangement="alternate", twig_radius=0.006), key=KEY)
        assert np.abs(leaves.normal[:, 1]).mean() > 0.75, name


def test_autumn_has_fewer_leaves_and_spring_smaller_ones():
    tree = small_tree(twigs=20)
    spring, summer, autumn = (populate(tree, HABIT, key=KEY, season=s) for s in ("spring", "summer", "autumn"))
    assert 0.7 < len(autumn) / len(summer) < 0.93
    assert np.allclose(spring.size / summer.size, 0.82)


def test_evergreens_are_the_same_all_year():
    tree = small_tree()
    summer, autumn = (populate(tree, HABIT, key=KEY, model="spruce", season=s) for s in ("summer", "autumn"))
    assert len(summer) == len(autumn) and np.array_equal(summer.size, autumn.size)


def test_another_model_brings_its_own_size_and_arrangement():
    tree = small_tree()
    own, maple = populate(tree, HABIT, key=KEY), populate(tree, HABIT, key=KEY, model="maple")
    assert maple.model == "maple" and own.model == "oak"
    assert np.median(maple.size) > np.median(own.size)


def test_leaflets_of_a_frond_shorten_towards_its_tip_and_leave_its_foot_bare():
    tree = single_twig(length=3.0, count=12)
    habit = replace(HABIT, leaf="palm", leaf_arrangement="frond", leaf_size=0.4, leaf_spacing=0.03)
    leaves = populate(tree, habit, key=KEY)
    x = leaves.position[:, 0]
    assert x.min() > 0.14 * 3.0 - 0.03
    assert leaves.size[x > 2.9].mean() < 0.7 * leaves.size[(x > 1.2) & (x < 1.8)].mean()
    assert (leaves.position[:, 2] > 0).sum() == (leaves.position[:, 2] < 0).sum()


def test_drawn_limbs_alone_carry_leaves_on_their_outer_parts():
    tips = np.array([[0, 0, 0], [0, 2, 0], [1, 3, 0], [2, 3.5, 0]], float)
    tree = TreeSkeleton.from_columns([-1, 0, 1, 2], tips, [0.1, 0.06, 0.02, 0.003], limb=[1, 1, 7, 7], order=[0, 0, 1, 1], kind=[0] * 4)
    leaves = populate(tree, HABIT, key=KEY)
    assert len(leaves) > 5 and leaves.position[:, 0].min() > 0.8


def test_a_tree_without_a_segment_has_no_leaf():
    assert len(populate(TreeSkeleton.from_columns([-1], [[0, 0, 0]], [0.1]), HABIT, key=KEY)) == 0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"density": 0.0}, "The leaf density is 0.0, but it must be above 0. Use 1 for the species' own."),
        ({"max_leaves": 0}, "At most 0 leaves were allowed. Allow at least 1, or use season 'bare'."),
        ({"season": "dry"}, "There is no season called 'dry'. Choose one of: spring, summer, autumn, bare."),
    ],
)
def test_wrong_options_are_refused(options, message):
    with pytest.raises(OptionError) as caught:
        populate(small_tree(), HABIT, key=KEY, **options)
    assert str(caught.value) == message


@pytest.mark.skipif(not Path("template_db/exemplars.h5").exists(), reason="the template database is not built")
@pytest.mark.parametrize("name", ["english_oak", "norway_spruce", "date_palm"])
def test_an_exemplar_wears_its_leaves_on_its_wood(name):
    from sketchtree.templates.store.database import Database

    exemplar = Database.open().exemplar(name)
    leaves = populate(exemplar.skeleton, exemplar.habit, key=KEY)
    assert len(leaves) > 500
    some = np.random.default_rng(0).permutation(len(leaves))[:150]
    chosen = Leaves(leaves.model, **columns(leaves, some), shoot=leaves.shoot)
    on_shoot = gap_to_shoots(chosen) < 1e-9
    assert gap_to_wood(chosen.position[~on_shoot], exemplar.skeleton).max() < 1e-6


def test_capped_leaves_take_their_short_shoots_with_them():
    tree = small_tree()
    every, few = populate(tree, HABIT, key=KEY), populate(tree, HABIT, key=KEY, max_leaves=40)
    assert 0 < len(few.shoot) < 0.7 * len(every.shoot)
    a, b = few.shoot[:, 0], few.shoot[:, 1]
    t = np.einsum("lsi,si->ls", few.position[:, None] - a, b - a) / np.sum((b - a) ** 2, axis=1)
    near = np.linalg.norm(few.position[:, None] - a - np.clip(t, 0, 1)[..., None] * (b - a), axis=2)
    assert (near.min(axis=0) < 1e-9).all()  # no bare shoot


def test_without_a_cap_every_short_shoot_bears_leaves():
    leaves = populate(small_tree(), HABIT, key=KEY)
    assert leaves.kept == 1 and len(leaves.shoot) > 5


def palm(radius):
    """A trunk with two fronds at 2 m, its stroke going on for a metre; the end as thick as `radius`."""
    parent = np.array([-1, 0, 1, 1, 1, 4, 5])
    tips = np.array([[0, 0, 0], [0, 2, 0], [1, 2.3, 0], [-1, 2.3, 0], [0, 2.4, 0], [0.1, 2.7, 0], [0.2, 3.0, 0]], float)
    thick = np.array([0.1, 0.1, 0.01, 0.01, radius, radius, radius])
    return TreeSkeleton.from_columns(parent, tips, thick, limb=np.array([1, 1, 2, 3, 1, 1, 1]), order=np.array([0, 0, 1, 1, 0, 0, 0]))


def test_a_frond_drawn_in_one_stroke_with_the_trunk_bears_leaflets():
    frond = replace(HABIT, leaf="palm", leaf_arrangement="frond", leaf_size=0.3, leaf_spacing=0.03, max_order=1)
    leaves = populate(palm(0.01), frond, key=KEY)
    on_end = np.isin(leaves.segment, [4, 5, 6])
    assert on_end.sum() > 30 and leaves.position[on_end, 1].min() > 2.0
    assert not np.isin(leaves.segment, [0, 1]).any()


def test_a_thick_end_of_a_palms_trunk_is_no_frond():
    frond = replace(HABIT, leaf="palm", leaf_arrangement="frond", leaf_size=0.3, leaf_spacing=0.03, max_order=1)
    assert not np.isin(populate(palm(0.1), frond, key=KEY).segment, [4, 5, 6]).any()
