"""Wood in one closed piece: every fork is stitched, whatever grows out of what."""

import jax
import numpy as np
import pytest
from growing import bushy, drawn, fork, stick

from benchmarks.wood_audit import audit, off_forks, shrub, together
from sketchtree.errors import OptionError
from sketchtree.geometry.detail import Detail
from sketchtree.geometry.limbs import centre_lines
from sketchtree.geometry.one_piece.distinct import distinct
from sketchtree.geometry.one_piece.loops import free_column, loops_round, unrolled
from sketchtree.geometry.radii import PipeRadii
from sketchtree.geometry.wood import wood_meshes, wood_of
from sketchtree.parameters import Habit
from sketchtree.skeleton import Kind, TreeSkeleton

KEY = jax.random.key(0)


def made(tree, **options):
    return wood_of(tree, bark="oak", habit=Habit(), key=KEY, wood="one-piece", **options)


def tree_of(parent, tip, radius, **columns):
    return TreeSkeleton.from_columns(np.array(parent), np.array(tip, float), np.broadcast_to(radius, len(parent)).astype(float), **columns)


def star(directions, radius):
    """A trunk with a lateral of two rows in each direction, all from one node."""
    parent, tip, limb = [-1, 0, 1, 2], [(0, 0, 0), (0, 1, 0), (0, 2, 0), (0, 3, 0)], [0] * 4
    for k, way in enumerate(directions):
        way = np.array(way, float) / np.linalg.norm(way)
        parent += [1, len(parent)]
        tip += [np.array([0, 1, 0]) + way, np.array([0, 1, 0]) + 2 * way]
        limb += [k + 1] * 2
    return tree_of(parent, tip, [0.1, 0.1, 0.08, 0.05] + [radius, 0.7 * radius] * len(directions), limb=np.array(limb))


def any_tree(seed):
    """A random skeleton that no plant would grow: steps of no length, steps back, thick on thin, several bases."""
    rng = np.random.default_rng(seed)
    parent, tip, radius = [-1], [np.zeros(3)], [0.1]
    for _ in range(seed % 3):
        parent.append(-1)
        tip.append(rng.normal(0, 1, 3) * [1, 0, 1])
        radius.append(0.1)
    for _ in range(int(rng.integers(2, 40))):
        up = int(rng.integers(0, len(parent))) if rng.random() < 0.6 else len(parent) - 1
        step = rng.normal(0, 1, 3) * rng.choice([0.0, 0.02, 0.3, 1.0])
        if rng.random() < 0.2 and parent[up] >= 0:
            step = (tip[parent[up]] - tip[up]) * rng.uniform(0.5, 1.5)
        tip.append(tip[up] + step)
        parent.append(up)
        radius.append(10 ** rng.uniform(-3, -0.5) if seed % 2 else radius[up] * rng.uniform(0.4, 1.1))
    return tree_of(parent, tip, radius)


def ways(count):
    return np.random.default_rng(0).normal(0, 1, (count, 3))


TREES = {
    "stick": stick([(0, 0, 0), (0.1, 1, 0), (0, 3, 0.2)], [0.1, 0.08, 0.02]),
    "acute fork": fork(18, 0.8),
    "right fork": fork(90, 0.5),
    "backward fork": fork(140, 0.4),
    "thin on thick": fork(60, 0.05),
    "as thick as its parent": fork(45, 1.0),
    "whorl of four": fork(65, 0.4, 4),
    "whorl of nine": fork(60, 0.3, 9),
    "drawn": drawn(),
    "bushy": PipeRadii(Habit())(bushy(0)),
    "twenty laterals at one node": star(ways(20), 0.04),
    "twenty thick ones": star(ways(20), 0.09),
    "twenty thin ones": star(ways(20), 0.003),
    "three that coincide": star([(1, 1, 0)] * 3, 0.04),
    "along the parent and back": star([(0, 1, 0), (0, -1, 0)], 0.04),
    "thicker than the parent": star([(1, 0.3, 0)], 0.3),
    "nearly parallel": star([(0.05, 1, 0), (-0.05, 1, 0.02)], 0.04),
    "two at the very tip": tree_of([-1, 0, 1, 1], [(0, 0, 0), (0, 1, 0), (1, 1.1, 0), (-1, 1.1, 0)], [0.1, 0.1, 0.08, 0.08], limb=np.array([0, 0, 1, 2])),
    "rows of no length": tree_of(
        [-1, 0, 1, 1, 3, 3], [(0, 0, 0), (0, 1, 0), (0, 1, 0), (0, 1, 0), (1, 2, 0), (0, 2, 0)], 0.05, limb=np.array([0, 0, 1, 2, 3, 0])
    ),
    "drawn roots": tree_of(
        [-1, 0, 0, 0, 0],
        [(0, 0, 0), (0, 3, 0), (1, -0.4, 0), (-0.6, -0.4, 0.8), (-0.5, -0.5, -0.9)],
        [0.1, 0.1, 0.05, 0.05, 0.05],
        limb=np.arange(5),
        kind=np.array([0, 0] + [int(Kind.ROOT)] * 3),
    ),
    "five stems on a base": shrub(),
}


@pytest.mark.parametrize("tree", [*TREES.values(), *(any_tree(seed) for seed in range(24))], ids=[*TREES, *(f"random {k}" for k in range(24))])
def test_all_wood_of_a_base_is_one_closed_surface(tree):
    wood = made(tree)
    found = audit(*together(wood.meshes))
    assert (found["open"], found["nonmanifold"], found["turned"]) == (0, 0, 0)
    grown = np.zeros(len(tree), bool)
    base = np.where(tree.is_base, np.arange(len(tree)), tree.parent)
    for _ in range(len(tree)):
        base = base[base]
    grown[base[~tree.is_base & (tree.length > 1e-6)]] = True
    assert found["parts"] == grown.sum()
    assert found["volume"] > 0
    assert wood.warnings == ()


def test_two_bases_are_two_pieces():
    assert audit(*together(made(tree_of([-1, -1, 0, 1], [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], 0.1)).meshes))["parts"] == 2


@pytest.mark.parametrize("name", ["acute fork", "right fork", "thin on thick", "as thick as its parent", "whorl of four", "drawn", "bushy"])
def test_few_triangles_are_thin(name):
    assert audit(*together(made(TREES[name]).meshes))["thin"] <= 0.02


@pytest.mark.parametrize("name", ["right fork", "whorl of four", "drawn", "bushy"])
def test_away_from_forks_the_surface_and_its_bark_are_those_of_the_tubes(name):
    tree, lines = TREES[name], centre_lines(TREES[name])
    one, tubes = (off_forks(lines, wood_meshes(tree, bark="oak", habit=Habit(), key=KEY, wood=way)) for way in ("one-piece", "tubes"))
    assert one["off"] < tubes["off"] + 0.01  # of the radius
    assert one["stretched"] < tubes["stretched"] + 0.005 and one["stretched"] < 0.03
    assert one["tiles high"] == pytest.approx(tubes["tiles high"], rel=0.05)


@pytest.mark.parametrize("name", ["acute fork", "right fork", "whorl of four", "as thick as its parent"])
def test_the_light_does_not_break_at_a_joint(name):
    """Vertices that stand twice, for the bark's sake, have one normal."""
    position, _ = together(made(TREES[name]).meshes)
    normal = np.concatenate([mesh.normal for mesh in made(TREES[name]).meshes])
    _, same = np.unique(position, axis=0, return_inverse=True)
    mean = np.stack([np.bincount(same.reshape(-1), column) for column in normal.T], axis=1)[same.reshape(-1)]
    np.testing.assert_allclose(np.sum(mean * normal, axis=1) / np.linalg.norm(mean, axis=1), 1.0, atol=1e-6)


@pytest.mark.parametrize("name", ["right fork", "whorl of four", "as thick as its parent", "bushy"])
def test_triangles_face_the_way_their_normals_do(name):
    tree = PipeRadii(Habit())(bushy(0, levels=1)) if name == "bushy" else TREES[name]
    position, triangle = together(made(tree).meshes)
    normal = np.concatenate([mesh.normal for mesh in made(tree).meshes])
    corner = position[triangle]
    face = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    area = np.linalg.norm(face, axis=1)
    cosine = np.sum(face * normal[triangle].mean(axis=1), axis=1) / np.maximum(area, 1e-300)
    assert area[cosine < 0].sum() < 0.002 * area.sum()


def test_bark_of_the_parent_goes_on_across_the_joint():
    """The texture of each mesh's triangles is continuous: no triangle spans more than a tile or two."""
    for mesh in made(TREES["whorl of nine"]).meshes:
        assert np.ptp(mesh.uv[mesh.triangle], axis=1).max() < 2.0


def test_up_to_two_thousand_limbs_are_one_piece_unless_told_otherwise(monkeypatch):
    tree = TREES["bushy"]
    assert wood_of(tree, bark="oak", habit=Habit(), key=KEY).made == "one-piece"
    monkeypatch.setattr("sketchtree.geometry.wood.MOST_JOINED", 100)
    wood = wood_of(tree, bark="oak", habit=Habit(), key=KEY)
    assert wood.made == "tubes"
    assert wood.warnings == ("The wood has 186 limbs, more than 100, so each is a tube of its own. `--wood one-piece` joins them.",)
    assert made(tree).made == "one-piece" and made(tree).warnings == ()
    told = wood_of(tree, bark="oak", habit=Habit(), key=KEY, wood="tubes")
    assert told.made == "tubes" and told.warnings == ()


def test_limbs_that_cannot_be_joined_are_counted_and_closed(monkeypatch):
    from sketchtree.geometry.one_piece import bridge, piece

    def none(*arguments):
        whole = bridge.bridges(*arguments)
        return bridge.Bridges(whole.triangle[:0], whole.hole[:0], np.zeros_like(whole.bridged))

    monkeypatch.setattr(piece, "bridges", none)
    wood = made(TREES["right fork"])
    assert wood.warnings == ("1 of 2 limbs found no room on the limbs they grow from: each is a closed tube that stands in the wood.",)
    found = audit(*together(wood.meshes))
    assert (found["parts"], found["open"], found["nonmanifold"]) == (2, 0, 0)


def test_an_unknown_way_is_named():
    with pytest.raises(OptionError, match="There is no way `planks` to make wood. Choose one of: one-piece, tubes."):
        wood_meshes(TREES["stick"], bark="oak", habit=Habit(), key=KEY, wood="planks")


def test_the_same_key_gives_the_same_piece():
    for one, other in zip(made(TREES["bushy"]).meshes, made(TREES["bushy"]).meshes, strict=True):
        for name in ("position", "normal", "uv", "triangle"):
            np.testing.assert_array_equal(getattr(one, name), getattr(other, name))


def test_the_budget_of_triangles_is_kept():
    tree = TREES["bushy"]
    assert sum(len(mesh.triangle) for mesh in made(tree, detail=Detail(most_triangles=12_000)).meshes) <= 12_000


@pytest.mark.parametrize("points", [np.zeros((0, 3)), np.zeros((1, 3)), np.zeros((2, 3))], ids=["empty", "a point", "no length"])
def test_a_tree_without_wood_gives_an_empty_mesh(points):
    (mesh,) = made(stick(points, 0.1)).meshes
    assert len(mesh.triangle) == 0


def test_vertices_that_coincide_are_moved_apart():
    x = np.zeros((4, 3))
    x[3] = 1.0
    moved = distinct(x, np.tile([0.0, 1.0, 0.0], (4, 1)))
    gap = np.linalg.norm(moved[:, None] - moved[None], axis=-1)[np.triu_indices(4, 1)]
    assert gap.min() > 2e-6 and np.abs(moved - x).max() < 1e-4


def test_cells_that_meet_at_a_corner_have_two_loops():
    loops = loops_round({(0, 0), (1, 1)}, None)
    assert sorted(len(ring) for ring, _ in loops) == [4, 4]


def test_cells_that_go_round_a_limb_have_a_loop_at_either_end():
    cells = {(0, c) for c in range(5)}
    assert unrolled(cells, 5) is None
    assert sorted(int(ring[0]) for ring, _ in loops_round(cells, 5)) == [0, 1]
    assert unrolled(cells - {(0, 2)}, 5)[(0, 1)] - unrolled(cells - {(0, 2)}, 5)[(0, 3)] in (3, -2)


def test_a_cut_keeps_clear_of_every_outline():
    assert free_column(np.array([0.4, 3.3]), np.array([1.6, 4.5]), 6) in (0, 2, 3, 5)
    assert free_column(np.array([-0.5]), np.array([2.5]), 3) is None


def test_a_limb_goes_on_in_its_last_child_rather_than_end_in_a_stump():
    tree = tree_of([-1, 0, 1], [(0, 0, 0), (0, 1, 0), (0.5, 1.1, 0)], [0.1, 0.1, 0.05], limb=np.array([0, 0, 1]))
    assert len(centre_lines(tree)) == 2 and len(centre_lines(tree, onward=True)) == 1


def test_stems_of_one_base_grow_out_of_the_thickest_that_is_no_root():
    from sketchtree.geometry.one_piece.joints import joined

    lines = joined(centre_lines(TREES["drawn roots"]), TREES["drawn roots"])
    assert lines.parent.tolist() == [-1, 0, 0, 0] and lines.is_stem.tolist() == [True, False, False, False]
