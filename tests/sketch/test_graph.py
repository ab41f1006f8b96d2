"""The sketch graph checks its columns."""

import numpy as np
import pytest
from hands import EXAMPLES

from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.reading import sketch_graph

ROWS = ("parent", "xy", "limb", "stroke", "tree", "width", "joined", "root")


@pytest.fixture(scope="module")
def oak():
    return sketch_graph(read_sketch(EXAMPLES / "oak.svg"))


@pytest.mark.parametrize("name", ROWS)
def test_a_column_of_another_length_is_refused(oak, name):
    with pytest.raises(AssertionError):
        oak.replace(**{name: getattr(oak, name)[:-1]})


def test_a_limb_without_an_id_is_refused(oak):
    with pytest.raises(AssertionError, match="every limb has an id"):
        oak.replace(limb_id=oak.limb_id[:-1])


def test_roots_stand_last(oak):
    root = np.zeros(len(oak), bool)
    root[3] = True
    with pytest.raises(AssertionError, match="roots stand after"):
        oak.replace(root=root)


def test_columns_are_frozen(oak):
    with pytest.raises(ValueError, match="read-only"):
        oak.xy[0] = 0.0
