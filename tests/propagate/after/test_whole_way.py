"""Sag, shedding, pruning and levels as the pipeline puts them together."""

from pathlib import Path

import numpy as np
import pytest

from sketchtree.geometry.radii import PipeRadii
from sketchtree.keys import root_key, stage_key
from sketchtree.options import ReadingOptions, TreeOptions, options_as_dict
from sketchtree.pipeline import complete, draw_out
from sketchtree.propagate.after.overlaps import share_overlapping
from sketchtree.propagate.generations import Propagate
from sketchtree.skeleton import Kind
from sketchtree.traverse import is_tip

KEY = root_key(0)
APPLE = Path(__file__).resolve().parents[3] / "examples" / "apple.json"
COLUMNS = ("parent", "tip", "radius", "order", "limb", "stroke", "tree", "kind", "curve_points", "curve_start")


@pytest.fixture(scope="module")
def drawn():
    return draw_out(APPLE, key=KEY, options=ReadingOptions(method="okabe"))


@pytest.fixture(scope="module")
def plain(drawn):
    """The wood with all at its default."""
    return build(drawn, leaf="none")


def build(drawn, **options):
    return complete(drawn, key=KEY, options=TreeOptions(**({"generations": 3} | options)))


def same(one, two):
    return all(np.array_equal(getattr(one, name), getattr(two, name)) for name in COLUMNS)


def test_without_untangling_and_all_else_at_its_default_the_tree_is_what_grew_to_the_last_bit(drawn):
    outline = tuple(drawn.similarity.to_world(line) for line in drawn.graph.crown)
    stage = Propagate(drawn.habit, drawn.theta, crown=outline, generations=3, exemplar=drawn.exemplar.skeleton)
    grown = stage.run(drawn.skeleton, key=stage_key(KEY, "propagate"))
    radius = np.full(len(grown.skeleton), np.nan)
    radius[grown.drawn_row] = drawn.radius
    assert same(PipeRadii(drawn.habit, radius)(grown.skeleton), build(drawn, untangle=False, leaf="none").skeleton)


@pytest.mark.parametrize("options", [{"untangle": False}, {"sag": 2.0}, {"shed": 0.4}, {"shed_twigs": 1.5}, {"prune": ("y<2.5",)}, {"generations": 2.5}])
def test_every_option_changes_the_tree_and_the_same_one_gives_the_same_tree(drawn, plain, options):
    one, two = (build(drawn, leaf="none", **options).skeleton for _ in range(2))
    assert same(one, two) and not same(one, plain.skeleton)


@pytest.mark.parametrize("options", [{"sag": 5.0}, {"shed": 0.9, "shed_twigs": 5.0}, {"generations": 1.4, "sag": 1.0, "shed": 0.3}])
def test_only_pruning_touches_what_was_drawn(drawn, options):
    tree = build(drawn, leaf="none", **options).skeleton
    kept = {tuple(tip) for tip in tree.tip[tree.kind == Kind.DRAWN]}
    assert {tuple(tip) for tip in drawn.skeleton.tip} <= kept


@pytest.mark.parametrize("options", [{}, {"sag": 1.0, "shed": 0.3}, {"generations": 2.5}])
def test_less_than_1_percent_of_the_undrawn_segments_run_through_others_in_the_end(drawn, options):
    before, after = (share_overlapping(build(drawn, leaf="none", untangle=on, **options).skeleton) for on in (False, True))
    assert before[1] > 0.01 and max(after) < 0.01


def test_pruning_tells_how_many_strokes_it_cut(drawn, plain):
    model = build(drawn, prune=("y<2.5",))
    assert any(warning.startswith("Pruning cut ") and warning.endswith(" drawn strokes.") for warning in model.warnings)
    assert not any("Pruning" in warning for warning in plain.warnings)


def test_thick_cut_ends_bear_no_leaves(drawn):
    model = build(drawn, prune=("y<2.5",))
    tree = model.skeleton
    stumps = np.flatnonzero(is_tip(tree.parent) & (tree.radius > 8 * drawn.habit.twig_radius))
    assert len(stumps) and len(model.leaves) > 100
    assert not np.isin(model.leaves.segment, stumps).any()
    assert model.leaves.position[:, 1].max() < 2.5 + 0.3


def test_radii_never_grow_towards_the_tips(drawn):
    tree = build(drawn, generations=2.5, sag=2.0, shed=0.4, shed_twigs=1.0, leaf="none").skeleton
    rows = np.flatnonzero(~tree.is_base)
    assert (tree.radius[rows] <= tree.radius[tree.parent[rows]] * (1 + 1e-12)).all()


def test_options_are_recorded_and_whole_levels_are_integers():
    record = options_as_dict(TreeOptions(generations=3.0, sag=1.0, shed=0.2, shed_twigs=1.0, prune=("y<3",)))
    assert (record["sag"], record["shed"], record["shed_twigs"], record["prune"]) == (1.0, 0.2, 1.0, ("y<3",))
    assert record["generations"] == 3 and isinstance(record["generations"], int)
