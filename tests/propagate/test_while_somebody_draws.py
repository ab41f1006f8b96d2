"""One stroke more leaves what grows elsewhere alone; in a hurry only some limbs grow."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from sketchtree.keys import root_key
from sketchtree.limb_ids import stroke_limb_id
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.pipeline import draw_out, grow
from sketchtree.skeleton import Kind
from sketchtree.sketch.formats import read_sketch
from sketchtree.studio.making.chunks import owners

KEY, OPTIONS = root_key(0), ReadingOptions(template="english_oak")
SKETCH = read_sketch(Path(__file__).parents[2] / "examples" / "oak.svg")
MORE = "r2_7"


@pytest.fixture(scope="module")
def before_and_after():
    """The oak without one limb, and then with it; the second begins with what the first settled."""


    less = dataclasses.replace(SKETCH, strokes=tuple(stroke for stroke in SKETCH.strokes if stroke.id != MORE))
    first = draw_out(less, key=KEY, options=OPTIONS)
    return first, draw_out(SKETCH, key=KEY, options=OPTIONS, settled=first.settled)


def _ends(tree) -> dict[int, np.ndarray]:
    rows = np.flatnonzero((tree.kind == Kind.PROPAGATED) & ~tree.is_base)
    return {int(tree.limb[row]): tree.tip[row] for row in rows}


def test_a_stroke_more_leaves_what_grows_elsewhere_where_it_was(before_and_after):
    first, second = before_and_after
    assert second.touched == {stroke_limb_id(MORE)} and second.theta == first.theta
    before, after = (grow(one, TreeOptions(), key=KEY).skeleton for one in (first, second))
    old, new, grown_on = _ends(before), _ends(after), dict(zip(after.limb.tolist(), owners(after).tolist(), strict=True))
    both = [limb for limb in old if limb in new]
    moved = np.array([np.linalg.norm(old[limb] - new[limb]) for limb in both]) / after.height
    assert len(both) >= 0.97 * len(old) and np.mean(moved < 1e-3) >= 0.97
    elsewhere = [limb for limb in new if limb not in old and grown_on[limb] != stroke_limb_id(MORE)]
    assert len(elsewhere) <= 0.01 * len(new)


def test_in_a_hurry_only_the_limbs_named_bear_and_mostly_as_they_will(before_and_after):
    _, second = before_and_after
    one = stroke_limb_id(MORE)
    whole, part = (grow(second, TreeOptions(), key=KEY, only=only).skeleton for only in (None, frozenset({one})))
    grown_on = owners(part)[part.kind == Kind.PROPAGATED]
    assert len(grown_on) and set(grown_on.tolist()) == {one}
    mine = {limb for limb, owner in zip(whole.limb.tolist(), owners(whole).tolist(), strict=True) if owner == one}
    in_hurry, later = _ends(part), {limb: tip for limb, tip in _ends(whole).items() if limb in mine}
    same = [limb for limb in in_hurry if limb in later and np.linalg.norm(in_hurry[limb] - later[limb]) < 0.02 * whole.height]
    assert len(same) >= 0.6 * len(in_hurry)


def test_growth_can_be_stopped_between_generations(before_and_after):
    class Enough(Exception):
        pass

    def pulse() -> None:
        raise Enough

    with pytest.raises(Enough):
        grow(before_and_after[1], TreeOptions(), key=KEY, pulse=pulse)
