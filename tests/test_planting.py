"""Where trees stand, and what makes two of the same drawing differ."""

from types import SimpleNamespace

import numpy as np
import pytest

from sketchtree import planting
from sketchtree.errors import OptionError
from sketchtree.keys import root_key, stage_key
from sketchtree.similarity import Similarity
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.strokes import Sketch, Stroke
from tests.propagate.worlds import circle, drawn_tree


def drawn(crown=()):
    return SimpleNamespace(skeleton=drawn_tree(), similarity=Similarity(1.0, (0.0, 0.0, 0.0)), graph=SimpleNamespace(crown=crown))


def test_trees_stand_a_spacing_apart_along_x_from_the_origin():
    np.testing.assert_array_equal(planting.places([drawn()] * 3, 4.0), [[0, 0, 0], [4, 0, 0], [8, 0, 0]])


def test_without_a_spacing_neighbouring_drawings_just_touch():
    one, wide = drawn(), drawn((circle(x=0.5, radius=5.0),))
    place = planting.places([one, wide], None)
    assert planting.sides(wide) == (pytest.approx(4.5, abs=1e-3), pytest.approx(5.5, abs=1e-3))
    assert place[1, 0] == pytest.approx(one.skeleton.tip[:, 0].max() + 4.5, abs=1e-3)


def test_a_bare_trunk_still_has_room():
    trunk = SimpleNamespace(skeleton=drawn_tree(limbs=0), similarity=None, graph=SimpleNamespace(crown=()))
    assert min(planting.sides(trunk)) >= planting.LEAST * 8.0


@pytest.mark.parametrize("spacing", [0.0, -1.0, np.nan, np.inf])
def test_a_spacing_that_is_none_is_refused(spacing):
    with pytest.raises(OptionError, match=r"is no distance between trees. Give metres above 0, from trunk to trunk."):
        planting.check_stand(2, spacing)


def test_no_tree_and_too_many_are_refused():
    with pytest.raises(OptionError, match="There is no sketch to make a forest of. Name one or several sketch files."):
        planting.check_stand(0, None)
    with pytest.raises(OptionError, match="1001 trees are more than a forest may have. Give 1000 at most; instance them in your 3D program."):
        planting.check_stand(1001, 4.0)
    planting.check_stand(1000, 4.0)


def test_copies_are_counted_by_content():
    assert planting.copy_numbers(["a", "b", "a", "a", "b"]) == [0, 0, 1, 2, 1]


def test_drawings_are_the_same_by_what_was_read_of_them():
    one, same, other = (sketch_graph(Sketch((Stroke("a", [[0, 0], [0, y]]),))) for y in (1.0, 1.0, 2.0))
    assert planting.digest(one) == planting.digest(same) != planting.digest(other)


def test_the_first_of_its_kind_has_the_runs_own_key():
    key = root_key(3)
    assert planting.tree_key(key, 0) is key
    assert (planting.tree_key(key, 2) == stage_key(key, "copy 2")).all() and (planting.tree_key(key, 2) != planting.tree_key(key, 1)).all()


def test_trunks_that_stand_in_each_other_are_told():
    place = np.array([[0.0, 0, 0], [0.3, 0, 0], [5.0, 0, 0]])
    told = planting.crowded(("a.svg", "b.svg", "c.svg"), place, np.array([0.2, 0.2, 0.2]))
    assert told == (
        "The trunks of a.svg and b.svg stand 0.30 m apart, nearer than they are thick (0.40 m), so they run into each other. Raise --spacing.",
    )
