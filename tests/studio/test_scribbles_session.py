"""What is scribbled over a photo is a step like any stroke: undone, done again, and found again after a sudden end."""

import asyncio

import pytest
from talking import talking

from sketchtree.sketch.strokes import SCRIBBLES
from sketchtree.studio import messages
from sketchtree.studio.recovery import journal_of


@pytest.fixture(autouse=True)
def shelf(tmp_path, monkeypatch):
    """Journals of this test."""
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path / "shelf"))


def brush(kind: str) -> messages.Strokes:
    line = messages.Stroke(id=f"s-{kind}", kind=kind, xy=[0.0, 0.0, 10.0, -20.0, 12.0, -60.0], width=7.5)
    return messages.Strokes(label=kind, put=[line])


def test_every_scribble_is_found_again_with_its_brush():
    async def test():
        async with talking(journal=journal_of(None)) as talk:
            for kind in sorted(SCRIBBLES):
                await talk.say(brush(kind))
            await talk.say(messages.Undo())
            await talk.say(messages.Redo())
            await talk.say(messages.Undo())

    asyncio.run(test())
    journal = journal_of(None)
    try:
        found = journal.play().history.document
    finally:
        journal.close()
    assert [(stroke.kind.value, stroke.width, stroke.labelled) for stroke in found.strokes.values()] == [(kind, 7.5, True) for kind in sorted(SCRIBBLES)[:-1]]
