import numpy as np
import pytest
import trimesh
from tests.propagate.space.solids import ball, box, meets, open_below, wall
from tests.propagate.worlds import HABIT, drawn_tree

from sketchtree.errors import OptionError
from sketchtree.propagate.space.domain import Domain
from sketchtree.propagate.space.obstacle import refuse_around
from sketchtree.propagate.space.obstacles import Obstacles

TREE = drawn_tree()
DOMAIN = Domain.of(TREE, None, HABIT, 8.0)
MESHES = {
    "a ball": (ball((2.5, 5, 0.5), 1.3),),
    "a box": (box((1.5, 0, -2), (5, 5, 2)),),
    "a wall": (wall(1.5),),
    "two": (wall(1.5), ball((-2, 5, 0), 1.0)),
    "a house without its floor": (open_below(box((1.5, 0, -2), (5, 5, 2))),),
}
SQUARE = np.array([[1, 1], [3, 1], [3, 4], [1, 4]], float)


def built(meshes=(), regions=(), domain=DOMAIN):
    return Obstacles.build(meshes, regions, domain)


def ways(count=4000, longest=3.0, seed=0):
    """(start, end) of segments all about the tree."""
    rng = np.random.default_rng(seed)
    start = rng.uniform([-4, 0, -4], [5, 9, 4], (count, 3))
    way = rng.normal(size=(count, 3))
    return start, start + way / np.linalg.norm(way, axis=1)[:, None] * rng.uniform(0.01, longest, (count, 1))


def away(mesh, point, reach):
    """How far points are from a mesh; infinitely, if they are farther than that from its box."""
    near = ((point > mesh.bounds[0] - reach) & (point < mesh.bounds[1] + reach)).all(axis=1)
    found = np.full(len(point), np.inf)
    found[near] = trimesh.proximity.closest_point_naive(mesh, point[near])[1]
    return found


@pytest.mark.parametrize("name", MESHES)
def test_the_free_part_of_no_way_meets_the_mesh(name):
    start, end = ways()
    fraction = built(MESHES[name]).exit_fraction(start, end)
    stop = start + fraction[:, None] * (end - start)
    for mesh in MESHES[name]:
        assert meets(start, end, mesh).sum() > 40
        assert not meets(start, stop, mesh)[fraction > 0].any()


@pytest.mark.parametrize("name", [name for name in MESHES if "floor" not in name])
def test_ways_that_stay_well_off_are_free_and_those_that_stop_stop_near(name):
    obstacles = built(MESHES[name])
    start, end = ways()
    fraction = obstacles.exit_fraction(start, end)
    stop = start + fraction[:, None] * (end - start)
    near = np.min([away(mesh, stop, 3 * obstacles.clearance) for mesh in MESHES[name]], axis=0)
    cut = (fraction > 0) & (fraction < 1)
    assert cut.sum() > 40
    assert near[cut].max() < 2.2 * obstacles.clearance and near[fraction > 0].min() > 0.4 * obstacles.clearance


def test_a_sheet_is_met_by_steps_much_longer_than_its_thickness():
    start, end = np.array([[-3.0, 5, 0]]), np.array([[4.0, 5.5, 0.3]])
    fraction = built((wall(1.5),)).exit_fraction(start, end)[0]
    assert 1.2 < -3.0 + 7.0 * fraction < 1.5


def test_what_starts_inside_grows_nothing():
    obstacles = built(MESHES["a box"])
    inside = np.array([[3.0, 2.5, 0], [2.5, 4.0, 1.0]])
    assert not obstacles.inside(inside).any()
    assert (obstacles.exit_fraction(inside, inside + [0, 9.0, 0]) == 0).all()


def test_a_house_without_its_floor_is_solid_and_both_sides_of_a_wall_are_free():
    assert not built(MESHES["a house without its floor"]).inside(np.array([[3.0, 2.0, 0.0]])).any()
    assert built(MESHES["a wall"]).inside(np.array([[0.5, 2.0, 0.0], [3.0, 2.0, 0.0]])).all()


def test_in_a_glasshouse_without_a_floor_the_tree_may_grow():
    house = built((open_below(box((-3, -0.05, -3), (3, 12, 3))),))
    start = np.array([[0.0, 4.0, 0.0]])
    assert house.inside(start).all()
    assert 2.5 < 9.0 * house.exit_fraction(start, start + [9.0, 0, 0])[0] < 3.0


def test_a_region_counts_through_all_depths():
    obstacles = built(regions=(SQUARE,))
    depth = np.linspace(-5, 5, 11)
    middle, beside = (np.column_stack([np.full(11, x), np.full(11, 2.0), depth]) for x in (2.0, 0.5))
    assert not obstacles.inside(middle).any() and obstacles.inside(beside).all()
    stop = beside + obstacles.exit_fraction(beside, beside + [4.0, 0, 1.0])[:, None] * [4.0, 0, 1.0]
    assert (stop[:, 0] < 1.0).all() and (stop[:, 0] > 0.8).all()


def test_a_region_that_crosses_itself_or_runs_the_other_way_round_is_one_too():
    for outline in (SQUARE[::-1], np.array([[1, 1], [3, 4], [3, 1], [1, 4]], float)):
        assert not built(regions=(outline,)).inside(np.array([[1.25, 2.5, 1.0]])).any()


def headings(count=3000, seed=1):
    rng = np.random.default_rng(seed)
    start = rng.uniform([-1.5, 1, -2], [1.4, 7, 2], (count, 3))
    way = rng.normal(size=(count, 3))
    return start, way / np.linalg.norm(way, axis=1)[:, None], np.full(count, 0.3), rng.integers(1, 2**62, count)


def test_headings_turn_away_from_a_wall_the_more_the_nearer():
    """The angle to the wall's normal grows; d ← (1 − s) d + s t."""
    start, heading, step, limb = headings()
    turned = built((wall(1.5),)).turned(start, heading, step, limb)
    np.testing.assert_allclose(np.linalg.norm(turned, axis=1), 1.0)
    towards = heading[:, 0] > 0.05
    angle, after = (np.arccos(np.clip(d[:, 0], -1, 1)) for d in (heading, turned))
    assert (after[towards] >= angle[towards] - 0.05).all() and np.mean(after[towards] >= angle[towards]) > 0.99
    gap = 1.5 - start[:, 0]
    gain = [np.mean((after - angle)[towards & (gap > a) & (gap <= b)]) for a, b in ((0, 0.4), (0.4, 0.8), (0.8, 1.2), (1.2, 1.6), (1.8, 9))]
    assert gain == sorted(gain, reverse=True) and gain[0] > np.radians(25) and gain[-1] == 0


def test_headings_that_lead_away_or_are_far_off_stay_to_the_last_bit():
    start, heading, step, limb = headings()
    turned = built((wall(1.5),)).turned(start, heading, step, limb)
    stays = (heading[:, 0] < -1e-6) | (start[:, 0] < -0.4)
    assert stays.sum() > 1000
    np.testing.assert_array_equal(turned[stays], heading[stays])


def test_what_heads_straight_for_a_wall_turns_up_and_each_limb_to_its_own_side():
    count = 200
    start, heading = np.tile([1.3, 4.0, 0.0], (count, 1)), np.tile([1.0, 0.0, 0.0], (count, 1))
    limb = np.arange(1, count + 1)
    turned = built((wall(1.5),)).turned(start, heading, np.full(count, 0.3), limb)
    assert (turned[:, 1] > 0.5).all() and np.ptp(turned[:, 2]) > 0.5
    np.testing.assert_array_equal(turned, built((wall(1.5),)).turned(start, heading, np.full(count, 0.3), limb))


def test_turning_is_smooth():
    start = np.column_stack([np.linspace(-0.8, 1.35, 2000), np.full(2000, 4.0), np.zeros(2000)])
    heading = np.tile([0.8, 0.6, 0.0], (2000, 1))
    turned = built((wall(1.5),)).turned(start, heading, np.full(2000, 0.3), np.ones(2000, int))
    assert np.abs(np.diff(turned, axis=0)).max() < 0.02


def test_a_path_is_led_round_a_ball_and_cut_at_a_wall():
    path = np.column_stack([np.linspace(-1, 4, 40), np.full(40, 5.2), np.full(40, 0.4)])
    mesh = ball((2.0, 5, 0.5), 0.8)
    led = built((mesh,)).clear(path)
    assert len(led) == 40 and (led[0] == path[0]).all() and not meets(led[:-1], led[1:], mesh).any()
    assert meets(path[:-1], path[1:], mesh).any()
    cut = built((wall(1.5),)).clear(path)
    assert 2 <= len(cut) < 40 and cut[:, 0].max() < 1.5


def test_a_path_in_the_open_stays_to_the_last_bit():
    path = np.column_stack([np.full(20, -3.0), np.linspace(0, 8, 20), np.zeros(20)])
    np.testing.assert_array_equal(built((wall(1.5),)).clear(path), path)


def test_what_goes_on_beyond_the_domain_ends_growth_there():
    large, small = built((wall(1.5, half=500.0),)), built((ball((2.5, 5, 0.5), 1.3),))
    far = DOMAIN.high[None] + [-9.0, -1.0, 1.0]
    assert large.cut_off and not large.inside(far)[0] and large.exit_fraction(far - [0, 0, 2.0], far)[0] == 0
    assert not small.cut_off and small.inside(far)[0] and small.exit_fraction(far - [0, 0, 2.0], far)[0] == 1


def test_obstacles_out_of_reach_are_named_and_change_nothing():
    mesh = ball((100, 5, 0), 2.0)
    mesh.metadata["name"] = "far.glb"
    obstacles = built((mesh,), (SQUARE + 100,))
    assert len(obstacles) == 0 and obstacles.out_of_reach == ("The obstacle far.glb",)


def test_limbs_that_touch_are_counted():
    assert built((ball((20, 5, 0), 1.0),)).touched(TREE) == 0
    assert 1 <= built((wall(1.0),)).touched(TREE) < len(np.unique(TREE.limb))
    assert built((box((-9, 1, -9), (9, 20, 9)),)).touched(TREE) == len(np.unique(TREE.limb))
    assert built((box((-50, -2, -50), (50, 0.0, 50)),)).touched(TREE) == 0  # the ground it stands on


AROUND = (
    "encloses the root of the tree, so nothing could grow. Move it beside the trunk. Its file counts in metres, y up, and the root is "
    "its origin: a mesh in millimetres is a thousand times too large."
)


def test_a_closed_mesh_around_the_root_is_refused_by_its_file():
    mesh = box((-4000, -10, -4000), (4000, 9000, 4000))
    with pytest.raises(OptionError) as caught:
        built((wall(1.5), mesh))
    assert str(caught.value) == f"The obstacle 2 {AROUND}"
    mesh.metadata["name"] = "house.stl"
    with pytest.raises(OptionError) as caught:
        refuse_around((mesh,), np.zeros((1, 3)))
    assert str(caught.value) == f"The obstacle house.stl {AROUND}"


def test_ground_beneath_the_root_is_no_enclosure():
    refuse_around((box((-50, -2, -50), (50, 0.03, 50)),), np.zeros((1, 3)))
    ground = built((box((-50, -2, -50), (50, 0.03, 50)),))
    assert ground.inside(np.array([[0, 1.0, 0]]))[0] and not ground.inside(np.array([[3.0, -1.0, 0]]))[0]


def test_a_region_around_the_root_and_one_without_area_are_refused():
    with pytest.raises(OptionError) as caught:
        built(regions=(SQUARE, SQUARE - [2, 2]))
    assert str(caught.value) == (
        "The obstacle region 2 of the drawing is drawn around the root of the tree, so nothing could grow. Draw it beside the trunk."
    )
    for outline in ([[1, 1], [2, 2]], [[1, 1], [2, 2], [3, 3]], [[1, 1], [2, np.nan], [3, 1]]):
        with pytest.raises(OptionError) as caught:
            built(regions=(np.array(outline, float),))
        assert str(caught.value) == (
            "The obstacle region 1 of the drawing encloses no area. Draw it as a closed curve of three points or more, or leave it out."
        )
