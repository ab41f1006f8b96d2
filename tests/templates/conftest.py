"""Small worlds that the tests of this room share."""

import numpy as np
import pytest

from sketchtree.sketch.graph import SketchGraph
from sketchtree.templates.store.database import Database
from sketchtree.templates.making.regenerate import recipe_folder

MINIMAL = """
name = "stick"
title = "A stick with arms"
source = "estimated"
seed = 1

[crown]
height = 4.0
envelope = 9.0
levels = 2

[[limbs]]
ratio = 1.0
ratio_sd = 0.0
segment = 0.5
bend = 0.0
spacing = 1.0
bare = 0.25

[[limbs]]
ratio = 0.3
ratio_sd = 0.0
angle = 60.0
angle_sd = 0.0
segment = 0.4
bend = 0.0

[habit]
trunk_ratio = 0.05
twig_radius = 0.01
"""


def make_graph(parent, xy, limb, crown=()) -> SketchGraph:
    """A sketch graph from its geometry alone."""
    n, limbs = len(parent), int(max(limb)) + 1
    return SketchGraph(
        parent=parent, xy=xy, limb=limb, stroke=limb, tree=np.zeros(n), width=np.full(n, np.nan),
        joined=np.zeros(n, bool), curve_points=np.zeros((0, 2)), curve_start=np.zeros(n + 1),
        limb_id=np.arange(limbs), stroke_ids=tuple(f"s{i}" for i in range(limbs)), crown=crown,
    )  # fmt: skip


@pytest.fixture
def minimal() -> str:
    """The text of a small valid recipe."""
    return MINIMAL


@pytest.fixture(scope="session")
def graph_of():
    """`make_graph`."""
    return make_graph


@pytest.fixture(scope="session")
def shipped() -> Database:
    """The committed database."""
    return Database(recipe_folder() / "exemplars.h5")
