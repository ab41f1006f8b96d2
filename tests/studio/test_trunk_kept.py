"""How a tree is taken from scribbles is part of the drawing: undone, found again after a sudden end, and in its project, which needs no drawn branch."""

import asyncio
import io
from typing import get_args

import msgspec
import numpy as np
import pytest
from PIL import Image
from talking import talking

from sketchtree.editing.document import Document, Underlay
from sketchtree.errors import OptionError
from sketchtree.matting import matte
from sketchtree.sketch.strokes import Stroke, StrokeKind
from sketchtree.studio import messages, wire
from sketchtree.studio.making.documents import document_of
from sketchtree.studio.making.jobs import Jobs
from sketchtree.studio.recovery import journal_of
from sketchtree.trunk.edits import VertexEdits
from sketchtree.trunk.wanted import LIFTS, MATTINGS, TrunkChoices

CHOSEN = TrunkChoices(on=True, vertices=24, gap=5.0, levels=2, remove=((3.0, 4.5),), add=((9.0, 1.0), (8.0, 2.0)), merge=(((1.0, 2.0), (3.0, 4.0)),), root=(20.0, 55.5), matting="closed-form", lift="elevation")


@pytest.fixture(autouse=True)
def shelf(tmp_path, monkeypatch):
    """Journals of this test."""
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path / "shelf"))


def picture() -> bytes:
    whole = io.BytesIO()
    Image.fromarray(np.full((60, 40, 3), 220, np.uint8)).save(whole, "PNG")
    return whole.getvalue()


def scribbled() -> Document:
    lines = {StrokeKind.FOREGROUND: 20.0, StrokeKind.BACKGROUND: 5.0, StrokeKind.MATTE_ADD: 26.0}
    strokes = {kind.value: Stroke(kind.value, np.array([(x, -10.0), (x, -50.0)]), kind, labelled=True, width=x / 5) for kind, x in lines.items()}
    return Document(strokes, trunk=CHOSEN, seed=7, underlay=Underlay(picture(), 0.0, 0.0, 40.0, 60.0, photo=True))


def test_what_is_chosen_is_told_undone_and_found_again():
    async def test():
        async with talking(journal=journal_of(None)) as talk:
            await talk.say(messages.ChooseTrunk(trunk=wire.trunk_out(CHOSEN)))
            await talk.say(messages.ChooseTrunk(trunk=messages.Trunk(on=True, levels=5), label="levels"))
            await talk.say(messages.Undo())
            return [event["trunk"] for event in talk.all("changed") if event["trunk"] is not None]

    told = asyncio.run(test())
    assert [one["levels"] for one in told[-3:]] == [2, 5, 2] and told[-1]["merge"] == [[[1.0, 2.0], [3.0, 4.0]]]
    journal = journal_of(None)
    try:
        found = journal.play().history.document
    finally:
        journal.close()
    assert found.trunk == CHOSEN


def test_a_project_of_scribbles_alone_gives_back_all_that_was_done():
    document = scribbled()
    again = document_of(Jobs(None, None)._project(0, None, document), "tree.sketchtree")
    assert (again.trunk, again.seed, again.underlay.photo, again.underlay.picture) == (CHOSEN, 7, True, document.underlay.picture)
    assert [(one.kind, one.width, one.points.tolist()) for one in again.strokes.values()] == [(one.kind, one.width, one.points.tolist()) for one in document.strokes.values()]


def test_what_is_chosen_is_the_edits_of_the_contour_and_those_that_find_nothing_are_passed_over():
    assert CHOSEN.edits == VertexEdits(24, CHOSEN.remove, CHOSEN.add, CHOSEN.merge, exact=False)


def test_there_are_as_many_ways_to_choose_as_the_program_has():
    assert MATTINGS == tuple(sorted(matte.MATTINGS, key=MATTINGS.index)) and MATTINGS[0] == matte.DEFAULT
    told = {field.name: get_args(field.type) for field in msgspec.structs.fields(messages.Trunk)}
    assert (told["matting"], told["lift"]) == (MATTINGS, LIFTS)


@pytest.mark.parametrize(
    "fields, said",
    [
        ({"vertices": 2}, "A contour of 2 vertices is out of range. Ask for 3 to 10,000, or let the number be found."),
        ({"gap": -1.0}, "A gap of -1 pixels is out of range. Give 0 to 1000 pixels."),
        ({"levels": 6}, "6 levels of branches are out of range. Give 0 to 5: 0 grafts nothing on, a full crown has 3."),
        ({"add": ((0.0, float("inf")),)}, "An edit of the contour lies on no picture. Take it back."),
        ({"root": (0.0, 2e6)}, "The foot of the trunk lies on no picture. Put it on the trunk."),
        ({"matting": "magic"}, "There is no matting called 'magic'. Choose one of: layered, closed-form, normalised."),
        ({"lift": "up"}, "There is no lift called 'up'. Choose one of: siblings, elevation."),
    ],
)
def test_what_can_not_be_asked_for_is_refused(fields, said):
    with pytest.raises(OptionError) as told:
        TrunkChoices(**fields)
    assert str(told.value) == said
