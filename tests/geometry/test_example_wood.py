"""The wood of every example in one piece: closed, and made of triangles that are no slivers."""

import pytest

from benchmarks.wood_audit import EXAMPLES, audit, together
from sketchtree.keys import root_key
from sketchtree.options import TreeOptions
from sketchtree.pipeline import sketch_to_tree

NAMES = sorted(path.name for path in EXAMPLES.iterdir() if path.suffix in (".svg", ".json"))


def test_there_are_examples():
    assert len(NAMES) >= 8


@pytest.mark.parametrize("name", NAMES)
def test_an_examples_wood_is_one_closed_surface_a_base(name):
    """As it is grown, welded at 1e-6 of its extent: no open edge, none of more than two triangles, all turned one way, at most 2 % with an aspect above 50."""
    model = sketch_to_tree(EXAMPLES / name, key=root_key(0), tree=TreeOptions(leaf="none", wood="one-piece"))
    assert model.wood_used == "one-piece"
    found = audit(*together([mesh for mesh in model.meshes if mesh.name.startswith("wood")]))
    bases = int(model.skeleton.is_base.sum())
    assert (found["parts"], found["open"], found["nonmanifold"], found["turned"]) == (bases, 0, 0, 0)
    assert found["thin"] <= 0.02 and found["volume"] > 0
