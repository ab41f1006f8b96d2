"""A job ends soon after it is not wanted any more, wherever it is; and tells how far it is."""

import dataclasses

import numpy as np
import pytest

from sketchtree.editing.document import Document
from sketchtree.keys import root_key
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.sketch.strokes import Stroke
from sketchtree.studio.making import work
from sketchtree.studio.making.chunks import chunks_of
from sketchtree.studio.making.watching import Stopped, pulses, watching
from sketchtree.templates.store.database import Database

LINES = {"trunk": [(0, 0), (2, 50), (0, 100)], "left": [(0, 40), (-20, 60), (-30, 80)], "right": [(0, 50), (30, 85)]}
STROKES = {name: Stroke(name, np.array(points, float), labelled=True) for name, points in LINES.items()}
DOCUMENT = Document(STROKES, reading=ReadingOptions(template="english_oak"), tree=TreeOptions(generations=2, untangle=True, season="spring"))


def made(document: Document, watch) -> None:
    """All that a full job does."""
    bench = work.Bench(Database.open(None))
    tree = work.leafy_tree(bench, document, work.drawn_tree(bench, document, watch), watch)
    with watch("mesh"):
        chunks_of(tree, key=root_key(0), pulse=pulses(watch, 0.0, 1.0))


class Stops:
    """Not wanted any more from the given pulse of a stage on."""

    def __init__(self, stage: str = "", count: int = 0):
        self.stage, self.count, self.told = stage, count, []

    def tell(self, stage: str, done: float) -> None:
        self.told.append((stage, done))

    def stopped(self) -> bool:
        return sum(stage == self.stage for stage, _ in self.told) > self.count


@pytest.fixture(scope="module")
def whole():
    """What is told of a job that is let be."""
    one = Stops()
    made(DOCUMENT, watching(one.tell, lambda: False))
    return one.told


def test_how_much_is_done_only_rises_and_every_stage_is_told_in_order(whole):
    done = [share for _, share in whole]
    assert all(np.diff(done) >= 0) and 0 <= done[0] and done[-1] <= 1
    assert list(dict.fromkeys(stage for stage, _ in whole)) == ["read", "match", "infer", "propagate", "foliage", "mesh"]


@pytest.mark.parametrize("stage", ["propagate", "foliage", "mesh"])
def test_a_job_ends_in_the_middle_of_a_stage(whole, stage):
    pulses_of_it = sum(one == stage for one, _ in whole)
    assert pulses_of_it > 8
    one = Stops(stage, pulses_of_it // 2)
    with pytest.raises(Stopped):
        made(DOCUMENT, watching(one.tell, one.stopped))
    assert sum(said == stage for said, _ in one.told) == pulses_of_it // 2 + 1


def test_a_job_that_was_ended_leaves_nothing_half_made_on_the_bench():
    bench, one = work.Bench(Database.open(None)), Stops("foliage", 3)
    watch = watching(one.tell, one.stopped)
    drawn = work.drawn_tree(bench, DOCUMENT, watch)
    with pytest.raises(Stopped):
        work.leafy_tree(bench, DOCUMENT, drawn, watch)
    assert bench.standing is not None and bench.leafy is None
    bare = dataclasses.replace(DOCUMENT.tree, season="bare")
    let_be = watching(lambda stage, done: None, lambda: False)
    assert len(work.leafy_tree(bench, DOCUMENT.replace(tree=bare), drawn, let_be).leaves) == 0
