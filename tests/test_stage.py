"""One contract for every source and stage that is installed: types, requirements, same key same tree."""

from pathlib import Path

import numpy as np
import pytest

from sketchtree import keys, stage
from sketchtree.growth.grafting import Graft
from sketchtree.geometry.radii import PipeRadii
from sketchtree.parameters import GENERIC, Habit
from sketchtree.options import ReadingOptions
from sketchtree.drawn_tree import SketchSource
from sketchtree.propagate.after.prune import Prune
from sketchtree.propagate.after.sag import Sag
from sketchtree.propagate.after.shed import Shed
from sketchtree.propagate.after.untangle import Untangle
from sketchtree.propagate.attractors.stage import Attract
from sketchtree.propagate.attractors.target import Target
from sketchtree.propagate.generations import Propagate
from sketchtree.skeleton import Kind, TreeSkeleton

CURVY = Path(__file__).resolve().parents[1] / "examples" / "curvy.svg"
KEY = keys.root_key(5)
STAGES = {
    "propagate": Propagate(Habit(), GENERIC, generations=2),
    "attract": Attract(targets=Target(np.ones((50, 50), bool), -5.0, 12.0, 0.2), iterations=4, twigs=False),
    "radii": PipeRadii(Habit()),
    "sag": Sag(1.0),
    "shed": Shed(0.3, 1.0),
    "untangle": Untangle(),
    "prune": Prune(("y<1000",)),
    "graft": Graft(levels=2, most_segments=4_000),
}


@pytest.fixture(scope="module")
def drawn() -> TreeSkeleton:
    return SketchSource(ReadingOptions(method="okabe"))(CURVY, key=KEY)


def test_built_in_sources_and_stages_come_through_the_plug_in_door():
    assert stage.sources()["sketch"] is SketchSource
    assert {name: stage.stages()[name] for name in STAGES} == {name: type(one) for name, one in STAGES.items()}


def test_a_source_gives_a_skeleton_of_what_was_drawn(drawn):
    assert isinstance(SketchSource(), stage.SkeletonSource)
    assert (drawn.kind == Kind.DRAWN).all() and drawn.segment_count > 20


@pytest.mark.parametrize("name", STAGES)
def test_a_stage_gives_a_skeleton_and_leaves_the_drawing_where_it_was(drawn, name):
    assert isinstance(STAGES[name], stage.SkeletonStage)
    tree = STAGES[name](drawn, key=KEY)
    assert isinstance(tree, TreeSkeleton)
    kept = {tuple(tip) for tip in tree.tip[tree.kind == Kind.DRAWN]}
    assert {tuple(tip) for tip in drawn.tip} <= kept


@pytest.mark.parametrize("name", STAGES)
def test_the_same_key_gives_the_same_tree(drawn, name):
    one, two = (STAGES[name](drawn, key=KEY) for _ in range(2))
    for column in ("parent", "tip", "radius", "limb", "order", "curve_points"):
        np.testing.assert_array_equal(getattr(one, column), getattr(two, column))


@pytest.mark.parametrize("name", STAGES)
def test_an_empty_tree_stays_empty(name):
    empty = TreeSkeleton.from_columns(np.zeros(0, int), np.zeros((0, 3)), np.zeros(0))
    assert len(STAGES[name](empty, key=KEY)) == 0


@pytest.mark.parametrize("name", STAGES)
def test_a_grown_tree_keeps_its_drawing_through_every_stage(drawn, name):
    grown = PipeRadii(Habit())(Propagate(Habit(), GENERIC, generations=2)(drawn, key=KEY))
    tree = STAGES[name](grown, key=KEY)
    kept = {tuple(tip) for tip in tree.tip[tree.kind == Kind.DRAWN]}
    assert {tuple(tip) for tip in drawn.tip} <= kept
