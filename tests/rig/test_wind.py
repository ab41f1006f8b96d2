"""What the wind does to every vertex, and the formula that says how."""

import numpy as np
import pytest

from sketchtree.foliage.cards import leaf_mesh
from sketchtree.geometry.instances import Instances
from sketchtree.geometry.limbs import centre_lines
from sketchtree.geometry.wood import wood_mesh
from sketchtree.rig.boughs import boughs
from sketchtree.rig.islands import welded
from sketchtree.rig.place import Places, along
from sketchtree.rig.rigging import Rigging
from sketchtree.rig.sway import Sway, swayed
from sketchtree.rig.wind import CHANNELS, beam, hashed, instance_wind, wind_of
from tests.geometry.growing import stick
from tests.rig.rigged_trees import KEY, dressed, edges, grown, rigged

SWAY, BRANCH, PHASE, FLUTTER = range(4)


def column(mesh, k):
    return mesh.extra["COLOR_1"][:, k].astype(float)


def test_channels_are_shares():
    _, wood, leaf = rigged()
    for mesh in (wood, leaf):
        assert mesh.extra["COLOR_1"].min() >= 0.0 and mesh.extra["COLOR_1"].max() <= 1.0
    assert CHANNELS == ("sway", "branch", "phase", "flutter")


def test_the_trunks_foot_stands_still():
    _, wood, _ = rigged()
    low = wood.position[:, 1] <= 0.0
    assert low.sum() > 8 and np.all(wood.extra["COLOR_1"][low][:, [SWAY, BRANCH, FLUTTER]] == 0.0)


def test_sway_is_the_bending_of_a_beam_by_height():
    rigging, wood, _ = rigged()
    assert beam(np.array([-1.0, 0.0, 1.0, 2.0])).tolist() == [0.0, 0.0, 1.0, 1.0]
    u = np.linspace(0, 1, 101)
    assert np.allclose(np.gradient(np.gradient(beam(u), u), u)[2:-2], (4.0 * (1 - u) ** 2)[2:-2], atol=2e-3)  # w'' ∝ the load's moment, (1 − u)²
    assert np.allclose(column(wood, SWAY), beam(wood.position[:, 1] / rigging.tree.height), atol=1e-6)


def test_branch_is_nought_on_the_trunk_and_grows_outwards_on_a_bough():
    rigging, _, _ = rigged()
    lines, wind = rigging.lines, rigging.wind
    assert np.all(wind.branch[lines.of_point == 0] == 0.0) and wind.branch.max() == 1.0
    for limb in np.flatnonzero(rigging.limbs.depth == 1):
        assert np.all(np.diff(wind.branch[lines.start[limb] : lines.start[limb + 1]]) >= 0)


def test_a_limb_goes_on_from_its_parents_value_where_it_comes_out():
    rigging, _, _ = rigged()
    lines, limbs, wind = rigging.lines, rigging.limbs, rigging.wind
    child = np.flatnonzero(limbs.depth > 0)
    own = along(lines, wind.branch, Places(child, limbs.buried[child]))
    parents = along(lines, wind.branch, Places(lines.parent[child], limbs.exit_s[child]))
    assert np.allclose(own, parents, atol=0.01)


def test_copies_of_a_vertex_at_a_seam_have_the_same_columns():
    _, wood, _ = rigged()
    one = welded(wood.position)
    for name, values in wood.extra.items():
        assert np.array_equal(values, values[one]), name


@pytest.mark.parametrize("made", ["one-piece", "tubes"])
def test_the_surface_stays_in_one_piece_in_a_storm(made):
    """No edge of the wood grows by more than a centimetre and a tenth, at any of some moments."""
    rigging = rigged()[0]
    wood = rigging.wood(wood_mesh(rigging.tree, bark="oak", key=KEY, wood=made))
    pair = edges(wood)
    length = lambda position: np.linalg.norm(position[pair[:, 0]] - position[pair[:, 1]], axis=1)  # noqa: E731
    rest = length(wood.position)
    for moment in (0.0, 0.7, 1.9):
        blown = swayed(wood.position, wood.normal, wood.extra["COLOR_1"].astype(float), time=moment, height=rigging.wind.height, reach=rigging.wind.reach, strength=1.0)
        assert np.abs(blown - wood.position).max() > 0.2
        assert np.all(length(blown) <= 1.1 * rest + 0.01) and np.all(length(blown) >= 0.9 * rest - 0.01)


def test_all_of_a_bough_has_one_phase_and_neighbours_others():
    rigging, wood, leaf = rigged()
    phase = {}
    for limb in range(len(rigging.lines)):
        phase.setdefault(int(rigging.limbs.bough[limb]), set()).add(float(rigging.wind.phase[limb]))
    assert all(len(values) == 1 for values in phase.values()) and phase[-1] == {0.0}
    assert len(set().union(*phase.values())) == 6
    assert set(np.unique(column(leaf, PHASE))) <= set(np.unique(column(wood, PHASE)))


def test_phases_belong_to_limb_ids_not_to_rows():
    """A bough less, and the others swing as they did."""
    phases = []
    for tree in (grown(), grown(without=1)):
        lines = centre_lines(tree)
        wind = wind_of(tree, lines, boughs(tree, lines))
        phases.append(dict(zip(lines.limb_id.tolist(), wind.phase.tolist(), strict=True)))
    whole, less = phases
    assert len(less) < len(whole) and all(whole[limb] == less[limb] for limb in less)


def test_hashes_are_even_and_fixed():
    values = hashed(np.arange(4000))
    assert np.all((values >= 0) & (values < 1)) and np.all(np.abs(np.histogram(values, 10, (0, 1))[0] - 400) < 90)
    assert hashed(np.array([7])).tolist() == hashed(np.array([3, 7]))[1:].tolist()


def test_leaves_flutter_from_the_petiole_to_the_tip_and_wood_does_not():
    _, wood, leaf = rigged()
    _, _, _, leaves, _, _ = dressed()
    assert np.all(column(wood, FLUTTER) == 0.0)
    cards = len(leaf.position) - 6 * len(leaves.shoot)
    flutter = column(leaf, FLUTTER)[:cards].reshape(len(leaves), -1)
    assert np.all(flutter.min(axis=1) == 0.0) and np.all(flutter.max(axis=1) == 1.0)
    assert np.all(column(leaf, FLUTTER)[cards:] == 0.0)  # short shoots


def test_a_leaf_sways_as_one_and_with_its_twig():
    rigging, _, leaf = rigged()
    _, lines, limbs, leaves, _, _ = dressed()
    cards = len(leaf.position) - 6 * len(leaves.shoot)
    for k in (SWAY, BRANCH, PHASE):
        each = column(leaf, k)[:cards].reshape(len(leaves), -1)
        assert np.all(each == each[:, :1])
    ids = rigging.tree.limb[leaves.segment]
    bough = lines.limb_id[np.where(limbs.bough == -1, 0, limbs.bough)][np.argsort(lines.limb_id)][np.searchsorted(np.sort(lines.limb_id), ids)]
    expected = np.where(ids == 1, 0.0, hashed(bough))
    assert np.allclose(column(leaf, PHASE)[:cards].reshape(len(leaves), -1)[:, 0], expected, atol=1e-6)


def test_instances_have_three_numbers_each():
    rigging, _, leaf = rigged()
    tree, lines, _, leaves, _, _ = dressed()
    one = Instances(leaf, leaves.position, np.tile([[0.0, 0, 0, 1]], (len(leaves), 1)), np.ones((len(leaves), 3)))
    found = instance_wind(rigging.wind, tree, lines, leaves, one)
    cards = len(leaf.position) - 6 * len(leaves.shoot)
    assert np.allclose(found, leaf.extra["COLOR_1"][:cards].reshape(len(leaves), -1, 4)[:, 0, :3], atol=1e-6)


def test_cards_and_levels_that_leave_leaves_out_are_told_by_what_hangs_together():
    """Every second leaf only, in another order: its columns are those it had. A leaf whose edge touches a neighbour's foot may count to that."""
    tree, _, _, leaves, _, _ = dressed()
    rigging, _, whole = rigged()
    size = (len(whole.position) - 6 * len(leaves.shoot)) // len(leaves)
    kept = np.arange(0, len(leaves), 2)[::-1]
    rows = (kept[:, None] * size + np.arange(size)).ravel()
    mesh = leaf_mesh(leaves)
    number = np.full(len(mesh.position), -1)
    number[rows] = np.arange(len(rows))
    triangle = number[mesh.triangle]
    part = mesh.__class__("leaf", mesh.position[rows], mesh.normal[rows], mesh.uv[rows], triangle[(triangle >= 0).all(axis=1)], mesh.material, mesh.color[rows])
    found = rigging.leaves(part, leaves)
    off = np.abs(found.extra["COLOR_1"] - whole.extra["COLOR_1"][rows])
    assert np.all(off[:, PHASE] == 0) and np.all(off[:, :2] < 0.05) and np.mean(off.max(axis=1) > 1e-6) < 0.01


def test_an_impostor_only_sways():
    rigging, wood, _ = rigged()
    far = rigging.impostor(dressed()[4])
    assert np.array_equal(far.extra["COLOR_1"][:, SWAY], wood.extra["COLOR_1"][:, SWAY]) and not far.extra["COLOR_1"][:, 1:].any()
    assert "JOINTS_0" not in far.extra


def test_calm_air_moves_nothing_and_lengths_from_the_foot_are_kept():
    rigging, wood, _ = rigged()
    wind = wood.extra["COLOR_1"].astype(float)
    settings = dict(height=rigging.wind.height, reach=rigging.wind.reach, time=1.3)
    assert np.allclose(swayed(wood.position, wood.normal, wind, strength=0.0, **settings), wood.position, atol=1e-12)
    leant = swayed(wood.position, wood.normal, wind, strength=1.0, constants=Sway(bough=0.0), direction=(0.0, 2.0), **settings)
    assert np.allclose(np.linalg.norm(leant, axis=1), np.linalg.norm(wood.position, axis=1))
    top = wood.position[:, 1].argmax()
    assert leant[top, 2] - wood.position[top, 2] > 0.2 and leant[top, 1] < wood.position[top, 1]


def test_a_tree_without_boughs_only_sways():
    tree = stick([[0, 0, 0], [0, 1, 0], [0, 2, 0]], 0.1)
    mesh = Rigging.of(tree).wood(wood_mesh(tree, bark="oak", key=KEY))
    assert mesh.extra["COLOR_1"][:, SWAY].max() == 1.0 and not mesh.extra["COLOR_1"][:, 1:].any()


def test_roots_neither_sway_nor_swing():
    from sketchtree.skeleton import Kind

    tree = grown()
    rooted = tree.append({"parent": np.array([0, len(tree)]), "tip": np.array([[0.4, -0.2, 0.0], [0.9, -0.3, 0.1]]), "radius": np.array([0.06, 0.02]), "limb": np.array([7, 7]), "kind": np.full(2, int(Kind.ROOT))})
    rigging = Rigging.of(rooted)
    assert rigging.limbs.is_root.sum() == 1 and rigging.limbs.is_stem.sum() == 1
    root = int(np.flatnonzero(rigging.limbs.is_root)[0])
    mesh = rigging.wood(wood_mesh(rooted, bark="oak", key=KEY))
    below = mesh.position[:, 1] < -0.1
    assert below.sum() > 5 and not mesh.extra["COLOR_1"][below].any()
    assert rigging.bones.count[root] == 0 and np.all(mesh.extra["JOINTS_0"][below, 0] == 0)
