"""Depths that were seen in points, or on a second view, are a factor of the same graph."""

import jax.numpy as jnp
import numpy as np
import pytest

import sketchtree as st
from sketchtree.errors import InferenceError
from sketchtree.mrf.assignment import page
from sketchtree.mrf.depths import depth_of, elevation_of
from sketchtree.mrf.factors.own import is_ours
from sketchtree.mrf.factors.seen_depths import SecondView, SeenPoints

TURNS = np.radians([40, 140, 60, 125, 50, 130])  # where laterals leave the trunk, seen from above
HEIGHT = 10.0


def limbs() -> list[np.ndarray]:
    """A trunk and six laterals in space, from the foot."""
    up = np.linspace(0, HEIGHT, 11)
    lines = [np.stack([0 * up, up, 0 * up], axis=1)]
    for k, turn in enumerate(TURNS):
        out = np.linspace(0, 3.0, 7)
        lines.append(np.stack([out * np.cos(turn), 3.0 + k + 0.8 * out, out * np.sin(turn)], axis=1))
    return lines


@pytest.fixture(scope="module")
def graph():
    strokes = tuple(st.Stroke(f"s{k}", line[:, :2]) for k, line in enumerate(limbs()))
    return st.factor_graph(st.sketch_graph(st.Sketch(strokes)))


def true_depth(graph) -> np.ndarray:
    """z of every tip, H: of the nearest place of any limb on the page."""
    fine = np.concatenate([np.stack([np.interp(np.linspace(0, 1, 400), np.linspace(0, 1, len(line)), line[:, k]) for k in range(3)], axis=1) for line in limbs()])
    nearest = np.linalg.norm(graph.xy[:, None] - fine[None, :, :2] / graph.scale, axis=2).argmin(axis=1)
    return fine[nearest, 2] / graph.scale


def scan(spread: float = 0.05, seed: int = 0) -> np.ndarray:
    """Points all along the limbs."""
    chance = np.random.default_rng(seed)
    lines = [np.stack([np.interp(np.linspace(0, 1, 300), np.linspace(0, 1, len(line)), line[:, k]) for k in range(3)], axis=1) for line in limbs()]
    points = np.concatenate(lines)
    return points + chance.normal(0, spread, points.shape)


def found(graph, factor) -> np.ndarray:
    return st.infer(graph, st.Prior(), st.Elevation(factors={"seen": factor}), key=st.root_key(0)).depth / graph.scale


def tips(graph) -> np.ndarray:
    return graph.limb_tip[graph.limb_parent >= 0]


def test_strokes_over_a_cloud_take_their_depth_from_its_points(graph):
    off = np.abs(found(graph, SeenPoints(scan())) - true_depth(graph))[tips(graph)]
    assert off.max() < 0.03


def test_without_points_the_same_strokes_could_be_elsewhere(graph):
    free = st.infer(graph, st.Prior(), st.Elevation(), key=st.root_key(0)).depth / graph.scale
    assert np.abs(free - true_depth(graph))[tips(graph)].max() > 0.1


def test_where_there_are_no_points_the_prior_speaks(graph):
    half = scan()
    half = half[(half[:, 0] > -0.05) | (half[:, 1] < 3.0)]
    z, truth = found(graph, SeenPoints(half)), true_depth(graph)
    seen = graph.xy[tips(graph), 0] > 0.05
    assert np.abs(z - truth)[tips(graph)][seen].max() < 0.03
    assert np.isfinite(z).all()


def test_a_second_view_says_on_which_side_limbs_are(graph):
    side = [np.stack([-line[:, 2], line[:, 1]], axis=1) for line in limbs()]  # from 90 degrees: x' = −z
    z, truth = found(graph, SecondView(side, 90.0)), true_depth(graph)
    deep = np.abs(truth[tips(graph)]) > 0.1
    assert (np.sign(z[tips(graph)])[deep] == np.sign(truth[tips(graph)])[deep]).mean() >= 0.8


def assignment(graph, depth):
    psi = elevation_of(graph, depth)
    return page(graph, len(graph), graph.limb_count).assign(jnp.asarray(psi, jnp.float32))


def test_the_potential_is_highest_where_points_are(graph):
    truth = true_depth(graph)
    factor = SeenPoints(scan(0.01))(graph)
    at = float(jnp.sum(factor.log_potential(assignment(graph, truth), None)))
    for moved in (0.02, 0.05, 0.2, -0.2):
        assert float(jnp.sum(factor.log_potential(assignment(graph, truth + np.where(graph.is_base, 0, moved)), None))) < at


def test_it_never_rules_anything_out(graph):
    factor = SeenPoints(scan())(graph)
    far = factor.log_potential(assignment(graph, np.where(graph.is_base, 0.0, 3.0)), None)
    assert np.isfinite(np.asarray(far)).all()
    assert float(far.min()) > -1.0


def test_places_without_points_near_them_say_nothing(graph):
    few = scan()[scan()[:, 1] < 4.5]
    factor = SeenPoints(few)(graph)
    at, says = np.asarray(factor.row), np.asarray(factor.table).any(axis=1)
    height = graph.xy[graph.parent[at], 1] + np.asarray(factor.share) * (graph.xy[at, 1] - graph.xy[graph.parent[at], 1])
    assert says.sum() > 5
    assert height[says].max() < 0.45 + 0.03


def test_what_tells_no_depth_is_refused(graph):
    with pytest.raises(InferenceError, match="No point of the cloud lies near any drawn branch. Check that both have the same foot and scale"):
        SeenPoints(scan() + [50.0, 0, 0])(graph)
    with pytest.raises(InferenceError, match="A view turned by 5 degrees tells no depth. Turn it by 12 to 168 degrees to either side."):
        SecondView([limbs()[0][:, :2]], 5.0)(graph)
    with pytest.raises(InferenceError, match="No stroke of the second view is as high as any drawn branch."):
        SecondView([np.array([[0.0, -5.0], [0.0, -4.0]])], 90.0)(graph)


def test_depths_and_elevations_are_each_others_inverse(graph):
    z = 0.1 * np.sin(np.arange(len(graph))) * ~graph.is_base
    assert depth_of(graph, elevation_of(graph, z)) == pytest.approx(z)


def test_where_points_are_not_needed_strokes_away_from_them_are_left_to_the_prior(graph):
    silent = SeenPoints(scan() + [50.0, 0, 0], needed=False)(graph)
    assert not np.asarray(silent.log_potential(assignment(graph, true_depth(graph)), None)).any()


def test_it_is_a_factor_of_ours_whose_program_may_be_kept():
    assert is_ours(SeenPoints(scan())) and not is_ours(test_it_is_a_factor_of_ours_whose_program_may_be_kept)
