"""The processes that make the trees, as the server sees them."""

import asyncio
import dataclasses
import json

import numpy as np
import pytest

from sketchtree import pipeline
from sketchtree.editing import operations
from sketchtree.editing.document import Document
from sketchtree.errors import SketchTreeError
from sketchtree.keys import root_key
from sketchtree.limb_ids import stroke_limb_id
from sketchtree.options import FileOptions, ReadingOptions, TreeOptions
from sketchtree.sketch.strokes import Stroke
from sketchtree.studio import messages
from sketchtree.studio.crew import Crew
from sketchtree.studio.making.documents import document_of
from sketchtree.studio.making.frames import opened
from sketchtree.tree_output import Made, write_output


def _line(name, *points):
    return Stroke(name, np.array(points, float), labelled=True)


STROKES = (_line("trunk", (0, 0), (2, 50), (0, 100)), _line("left", (0, 40), (-20, 60), (-30, 80)), _line("right", (0, 50), (30, 85)), _line("high", (0, 70), (-15, 95)))
DOCUMENT = Document({stroke.id: stroke for stroke in STROKES}, reading=ReadingOptions(template="english_oak"), tree=TreeOptions(generations=2))
PATIENCE = 60.0


class Watched:
    """A crew, and all that it told."""

    def __init__(self):
        self.loop = asyncio.new_event_loop()
        self.crew, self.told, self.revision = Crew(), [], 0
        self.crew.on_outcome = lambda outcome: self.told.append(outcome)
        self.run(self.crew.start())

    def run(self, work):
        return self.loop.run_until_complete(asyncio.wait_for(work, PATIENCE))

    def make(self, document: Document) -> list:
        """Outcomes of the next revision, until its full tree or its trouble is there."""
        self.revision += 1
        begun = len(self.told)
        self.crew_make(document)
        return self.told[begun:]

    def crew_make(self, document: Document) -> None:
        async def made():
            self.crew.make(self.revision, document)
            while not any(_ends(outcome, self.revision) for outcome in self.told):
                await asyncio.sleep(0.02)

        self.run(made())


def _ends(outcome, revision: int) -> bool:
    event = outcome.event
    return outcome.revision == revision and isinstance(event, messages.Working) and event.state in ("idle", "error")


def _trees(outcomes) -> list:
    """(head, arrays, what settled) of every tree told."""
    found = [(*opened(outcome.event), outcome.settled) for outcome in outcomes if isinstance(outcome.event, bytes)]
    return [one for one in found if isinstance(one[0], messages.Tree)]


@pytest.fixture(scope="module")
def watched():
    """A crew that has made the first tree."""
    one = Watched()
    one.first = one.make(DOCUMENT)
    one.settled = _trees(one.first)[-1][2]
    yield one
    one.run(one.crew.stop())
    one.loop.close()


def test_a_document_becomes_a_tree_with_what_was_read_and_matched(watched):
    head, arrays, settled = _trees(watched.first)[-1]
    assert head.phase == "full" and head.template == "english_oak" and head.segments > head.drawn >= 4 and head.leaves > 0
    assert len(head.owners) == len(head.chunks) == len(head.limbs) == 4 and set(map(int, head.owners)) == set(settled.limbs)
    assert all(np.isfinite(arrays[chunk.wood[0].array + "position"]).all() for chunk in head.chunks)
    kinds = [type(outcome.event) for outcome in watched.first]
    assert messages.Read in kinds and messages.Matches in kinds


def test_a_stroke_more_is_answered_in_a_hurry_with_its_own_chunk_then_in_full(watched):
    more = _line("more", (0, 60), (20, 95))
    document = DOCUMENT.replace(strokes={**DOCUMENT.strokes, "more": more}, settled=watched.settled)
    trees = _trees(watched.make(document))
    quick, full = trees[0], trees[-1]
    assert (quick[0].phase, full[0].phase) == ("quick", "full")
    assert [chunk.owner for chunk in quick[0].chunks] == [str(stroke_limb_id("more"))]
    assert set(quick[0].owners) == set(full[0].owners)
    sides = [next(limb.path[-1] for limb in head.limbs if limb.strokes == ["more"]) for head in (quick[0], full[0])]
    assert np.sign(sides[0]) == np.sign(sides[1])


def test_a_drawing_that_is_opened_is_the_tree_that_build_makes_of_it_whatever_was_there_before(watched, tmp_path):
    data = json.dumps({"sketchtree": 1, "strokes": [{"id": one.id, "kind": "branch", "points": one.points.tolist()} for one in STROKES]}).encode()
    (tmp_path / "small.json").write_bytes(data)
    built = pipeline.sketch_to_tree(tmp_path / "small.json", key=root_key(0), reading=ReadingOptions(), tree=TreeOptions())
    for _ in range(2):
        watched.make(DOCUMENT.replace(settled=watched.settled))
        head, *_ = _trees(watched.make(document_of(data, "small.json")))[-1]
        assert (head.phase, head.segments, head.leaves) == ("full", built.skeleton.segment_count, len(built.leaves))


def test_the_newest_wins(watched):
    begun = len(watched.told)

    async def hurry():
        for seed in range(5):
            watched.revision += 1
            watched.crew.make(watched.revision, DOCUMENT.replace(seed=seed, settled=watched.settled))
        while not any(_ends(outcome, watched.revision) for outcome in watched.told):
            await asyncio.sleep(0.02)

    watched.run(hurry())
    full = [head.revision for head, *_ in _trees(watched.told[begun:]) if head.phase == "full"]
    assert full == [watched.revision]


def test_what_can_not_be_read_is_told_and_the_next_drawing_is_made(watched):
    dot = Document({"dot": _line("dot", (0, 0))}, reading=DOCUMENT.reading)
    (trouble,) = [outcome.event for outcome in watched.make(dot) if isinstance(outcome.event, messages.Trouble)]
    assert trouble.message == "untitled has no branch strokes: only dots or round shapes." and trouble.remedy == "Draw at least a trunk, as a line."
    assert _trees(watched.make(DOCUMENT.replace(settled=watched.settled)))


def test_an_empty_page_is_no_tree(watched):
    head, _, settled = _trees(watched.make(Document()))[-1]
    assert head.segments == 0 and head.owners == [] and not settled.limbs
    watched.make(DOCUMENT.replace(settled=watched.settled))


def test_an_undrawn_limb_is_kept_through_another_seed(watched):
    head, *_ = _trees(watched.make(DOCUMENT.replace(settled=watched.settled, seed=1)))[-1]
    names = [name for chunk in head.chunks for wood in chunk.wood for name in wood.limbs if name not in head.owners]
    found = watched.run(watched.crew.find(DOCUMENT, int(names[0])))
    kept = operations.adopt(DOCUMENT.replace(settled=watched.settled, seed=1), found)
    paths = [next(limb.path for limb in _trees(watched.make(kept.replace(seed=seed)))[-1][0].limbs if limb.was == names[0]) for seed in (1, 9)]
    assert paths[0] == pytest.approx(paths[1], abs=1e-9)
    with pytest.raises(SketchTreeError, match="^That branch is not there any more. Pick it again on the tree as it is now.$"):
        watched.run(watched.crew.find(DOCUMENT, 12345))


def test_the_stroke_in_hand_has_a_ghost(watched):
    begun = len(watched.told)

    async def shown():
        watched.crew.ghost(watched.revision, DOCUMENT.replace(settled=watched.settled), messages.Stroke(id="hand", kind="branch", xy=[0, -60, 10, -80, 25, -95]), None)
        while len(watched.told) == begun:
            await asyncio.sleep(0.02)

    watched.run(shown())
    head, arrays = opened(watched.told[-1].event)
    assert isinstance(head, messages.Ghost) and arrays["0/path"].shape[1] == 3 and head.radius[0] > 0


def test_other_readings_begin_with_the_present_one_and_can_be_picked(watched):
    event, settled = watched.run(watched.crew.alternatives(3, DOCUMENT.replace(settled=watched.settled)))
    assert len(event.readings) == len(settled) >= 1 and event.revision == 3 and 0 < sum(one.odds for one in event.readings) <= 1 + 1e-9
    picked = DOCUMENT.replace(settled=settled[-1])
    head, _, now = _trees(watched.make(picked))[-1]
    for limb, depths in now.limbs.items():
        np.testing.assert_allclose(depths.depth, settled[-1].limbs[limb].depth, atol=1e-6)


def test_exported_is_what_the_command_line_makes_of_the_saved_project(watched, tmp_path):
    document = DOCUMENT.replace(settled=watched.settled)
    exported = watched.run(watched.crew.export(document, "tree.glb", {}))
    (tmp_path / "tree.sketchtree").write_bytes(watched.run(watched.crew.project(document)))
    model = pipeline.sketch_to_tree(tmp_path / "tree.sketchtree", key=root_key(0), reading=document.reading, tree=document.tree)
    write_output(model, tmp_path / "tree.glb", Made(0, {}), FileOptions())
    assert exported["tree.glb"] == (tmp_path / "tree.glb").read_bytes()


def test_an_export_that_is_not_to_be_had_says_why(watched):
    with pytest.raises(SketchTreeError, match="hold one level of detail"):
        watched.run(watched.crew.export(DOCUMENT, "tree.obj", {"levels": "together"}))


def _kill(watched, role: str) -> None:
    watched.crew._hands[role]._process.kill()
    watched.crew._hands[role]._process.join()


def test_processes_that_are_killed_are_begun_again_and_the_next_step_is_made(watched):
    for role in ("quick", "full", "side"):
        _kill(watched, role)
    outcomes = watched.make(DOCUMENT.replace(settled=watched.settled, seed=3))
    assert _trees(outcomes)[-1][0].phase == "full"
    assert all(outcome.event.about == "program" for outcome in outcomes if isinstance(outcome.event, messages.Trouble))
    assert watched.run(watched.crew.picture("bark", "oak")).startswith(b"\x89PNG")
    assert all(watched.crew._hands[role].runs for role in ("quick", "full", "side"))


def test_a_process_that_is_killed_while_it_has_nothing_to_do_makes_its_tree_again_for_pages_that_join(watched):
    watched.make(DOCUMENT.replace(settled=watched.settled))
    begun = len(watched.told)
    _kill(watched, "full")

    async def again():
        while not any(_ends(outcome, watched.revision) for outcome in watched.told[begun:]):
            await asyncio.sleep(0.02)
        return await watched.crew.frame()

    frame = watched.run(again())
    (trouble,) = [outcome.event for outcome in watched.told[begun:] if isinstance(outcome.event, messages.Trouble)]
    assert (trouble.message, trouble.remedy) == ("A process that makes the tree ended.", "It is begun again by itself; nothing of the drawing is lost.")
    assert len(opened(frame)[0].chunks) == 4


def test_a_drawing_that_ends_its_process_twice_is_told_and_does_not_go_round_and_round(watched, monkeypatch):
    ask = watched.crew._hands["full"].ask

    def dying(kind, *arguments):
        number, answer = ask(kind, *arguments)
        if kind == "full":
            _kill(watched, "full")
        return number, answer

    monkeypatch.setattr(watched.crew._hands["full"], "ask", dying)
    outcomes = watched.make(DOCUMENT.replace(settled=watched.settled, seed=5))
    monkeypatch.undo()
    first, second = [outcome.event for outcome in outcomes if isinstance(outcome.event, messages.Trouble)]
    assert second.remedy == "It ended twice at this step: undo it. Should that not help, save, and start the studio again."
    assert _trees(watched.make(DOCUMENT.replace(settled=watched.settled)))


def test_what_an_ended_process_was_asked_is_not_mixed_up_with_what_the_next_one_is(watched):
    async def asked():
        hand = watched.crew._hands["side"]
        _, lost = hand.ask("picture", "bark", "oak")
        hand._process.kill()
        hand._process.join()
        _, answer = hand.ask("picture", "bark", "oak")  # the end was not heard of yet
        with pytest.raises(SketchTreeError, match="^A process that makes the tree ended"):
            await lost
        return await answer, hand.runs

    picture, runs = watched.run(asked())
    assert picture.startswith(b"\x89PNG") and runs
