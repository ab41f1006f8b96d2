"""Every step is in the journal before it is answered; playing it gives the same drawing with the same steps."""

import asyncio
import json
import os

import numpy as np
import pytest
from fake_engine import FakeEngine
from talking import drawn, talking

from sketchtree.editing.document import Document, Underlay
from sketchtree.editing.settled import Manner, Settled
from sketchtree.parameters import GENERIC
from sketchtree.propagate.blocks.block import Blocks
from sketchtree.sketch.strokes import Stroke
from sketchtree.studio import journal_lines, messages, recovery
from sketchtree.studio.folder import Folder
from sketchtree.studio.recovery import StudioError, journal_of


@pytest.fixture(autouse=True)
def shelf(tmp_path, monkeypatch):
    """Journals of this test."""
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path / "shelf"))
    return tmp_path / "shelf"


def told(*requests, document=None, project=None, **options):
    """A session that says these and ends; what the journal gives then."""

    async def test():
        async with talking(document, journal=journal_of(project), **options) as talk:
            for request in requests:
                await (request(talk) if callable(request) else talk.say(request))
            return talk.session.document

    document = asyncio.run(test())
    journal = journal_of(project)
    try:
        return document, journal.play(), journal
    finally:
        journal.close()


def played():
    """What the journal of a drawing without a name gives."""
    journal = journal_of(None)
    try:
        return journal.play()
    finally:
        journal.close()


def alike(one: Document, other: Document) -> None:
    assert list(one.strokes) == list(other.strokes)
    for name, stroke in one.strokes.items():
        twin = other.strokes[name]
        assert np.array_equal(stroke.points, twin.points) and (stroke.kind, stroke.closed, stroke.view_deg) == (twin.kind, twin.closed, twin.view_deg)
    for name in ("reading", "tree", "seed", "name", "units", "page", "underlay"):
        assert getattr(one, name) == getattr(other, name), name
    for kind in ("held", "cleared", "adopted"):
        assert getattr(one.edits, kind).keys() == getattr(other.edits, kind).keys()
    assert one.settled.limbs.keys() == other.settled.limbs.keys()
    for limb, depths in one.settled.limbs.items():
        assert np.array_equal(depths.depth, other.settled.limbs[limb].depth) and np.array_equal(depths.sd, other.settled.limbs[limb].sd, equal_nan=True)


STEPS = (
    drawn("a", "b"), messages.Hold(limb="1", share=1.0, depth=4.5), messages.Lock(limb="1001", on=True), messages.Delete(limb="1002"),
    messages.Choose(options={"gravity": 0.5}), messages.Choose(options={"gravity": 0.75}), messages.Choose(options={"template": "oak", "seed": 3}),
    drawn("ä", gone=("a",)), messages.Mirror(), messages.Undo(), messages.Undo(), messages.Redo(),
)  # fmt: skip


def test_playing_the_journal_gives_the_drawing_and_all_its_steps():
    document, found, _ = told(*STEPS, document=Document(strokes={"z": Stroke("z", [[0, 0], [1, 5]])}, name="oak"))
    alike(found.history.document, document)
    assert found.history.redo_label == "mirror" and found.history.undo_label == "branch"
    while found.history.undo():
        pass
    assert list(found.history.document.strokes) == ["z"] and not found.history.document.edits


def test_a_recovered_session_goes_on_and_can_be_recovered_again():
    told(*STEPS)
    journal = journal_of(None)
    found = journal.play()

    async def test():
        async with talking(journal=journal, recovered=found) as talk:
            assert talk.last("welcome")["recovered"] and talk.strokes() == ["b", "ä"]
            await talk.say(messages.Undo(), messages.Undo(), drawn("c"))
            return talk.session.document

    document = asyncio.run(test())
    journal = journal_of(None)
    alike(journal.play().history.document, document)
    journal.close()


def test_a_drawing_that_was_only_looked_at_leaves_no_journal(shelf):
    _, found, journal = told(document=Document(strokes={"z": Stroke("z", [[0, 0], [1, 5]])}))
    assert found is None and not journal.path.exists()


def test_a_line_is_on_the_disk_before_the_answer():
    seen = []

    async def test():
        async with talking(journal=journal_of(None)) as talk:
            path = talk.desk.scribe.journal.path
            tell = talk.desk.tell
            talk.desk.tell = lambda event: (seen.append(path.read_text()) if isinstance(event, messages.Changed) else None, tell(event))
            await talk.say(drawn("a"))
            await talk.say(drawn("b"))

    asyncio.run(test())
    assert '"id":"a"' in seen[0] and '"id":"b"' not in seen[0] and '"id":"b"' in seen[1]


def test_a_torn_last_line_is_skipped(shelf):
    document, _, journal = told(drawn("a"), drawn("b"))
    whole = journal.path.read_bytes()
    for cut in (1, 10, 60):
        journal.path.write_bytes(whole[:-cut])
        again = journal_of(None)
        found = again.play()
        assert list(found.history.document.strokes) in (["a"], ["a", "b"]) and again.notes == []
        again.close()
        assert journal.path.read_bytes().endswith(b"}\n")


def test_a_journal_that_cannot_be_read_is_set_aside_and_told(shelf):
    _, _, journal = told(drawn("a"))
    journal.path.write_text("nonsense\nmore of it\n")
    again = journal_of(None)
    assert again.play() is None
    kept = shelf / "untitled.kept-1.jsonl"
    assert again.notes == [f"A journal of an earlier session can't be read; it is kept as {kept}."] and kept.read_text().startswith("nonsense")

    async def test():
        async with talking(journal=again) as talk:
            assert talk.last("trouble")["message"] == again.notes[0] and talk.last("trouble")["remedy"] == "Nothing of it was deleted."

    asyncio.run(test())


def test_what_is_before_a_line_that_cannot_be_read_is_recovered_and_the_rest_kept(shelf):
    _, _, journal = told(drawn("a"), drawn("b"))
    lines = journal.path.read_bytes().splitlines(keepends=True)
    journal.path.write_bytes(b"".join([*lines[:2], b'{"type":"step","label":1}\n', *lines[2:]]))
    again = journal_of(None)
    assert list(again.play().history.document.strokes) == ["a"]
    assert again.notes == [f"The last part of a journal of an earlier session can't be read; it is kept as {shelf / 'untitled.kept-1.jsonl'}."]
    again.close()


def test_the_picture_to_trace_over_is_written_once(shelf):
    def place(talk):
        return talk.say(messages.SetUnderlay(underlay=messages.Underlay(digest=next(iter(talk.desk.pictures)), x=1, y=2, width=3, height=4, opacity=0.1)))

    document, found, journal = told(place, drawn("a"), document=Document(underlay=Underlay(b"\x89PNG" + bytes(500), 0.0, 0.0, 1.0, 1.0)))
    alike(found.history.document, document)
    assert found.history.document.underlay.y == -2
    assert [json.loads(line)["type"] for line in journal.path.read_bytes().splitlines()].count("picture") == 1


def test_saving_empties_the_journal_and_undo_beyond_it_is_recovered(tmp_path):
    save = messages.Save(name="birch")
    document, found, _ = told(drawn("a"), drawn("b"), save, project=None, folder=Folder(tmp_path))
    assert found is None and (tmp_path / "birch.sketchtree").exists()


def test_steps_after_saving_go_to_the_journal_of_the_project(tmp_path):
    async def test():
        async with talking(journal=journal_of(None), folder=Folder(tmp_path)) as talk:
            await talk.say(drawn("a"), drawn("b"), messages.Save(name="birch"), messages.Undo(), messages.Redo(), messages.Undo(), messages.Undo(), messages.Redo())
            return talk.session.document

    document = asyncio.run(test())
    project = tmp_path / "birch.sketchtree"
    journal = journal_of(project)
    found = journal.play()
    alike(found.history.document, document)
    assert list(document.strokes) == ["a"] and found.signature == Folder(tmp_path).signature(project.name) and found.saved_state == 0
    journal.close()


def test_a_second_studio_on_one_project_is_refused_and_without_a_project_has_a_journal_of_its_own(tmp_path):
    project = tmp_path / "oak.sketchtree"
    first = journal_of(project)
    with pytest.raises(StudioError, match=rf"^oak\.sketchtree is open in another studio \(process {os.getpid()}\)\. Go on there, or stop it and start again\.$"):
        journal_of(project)
    first.close()
    journal_of(project).close()
    one, two = journal_of(None), journal_of(None)
    assert one.path != two.path
    one.close(), two.close()


def test_a_crashed_drawing_without_a_name_is_found_though_another_is_open(shelf):
    told(drawn("a"))
    first = journal_of(None)
    assert list(first.play().history.document.strokes) == ["a"]
    second = journal_of(None)
    assert second.play() is None
    first.close(), second.close()


def test_saving_over_a_project_that_another_studio_has_is_refused(tmp_path):
    other = journal_of(tmp_path / "oak.sketchtree")

    async def test():
        async with talking(journal=journal_of(None), folder=Folder(tmp_path)) as talk:
            await talk.say(drawn("a"), messages.Save(name="oak"))
            assert talk.last("trouble")["message"].startswith("oak.sketchtree is open in another studio") and talk.last("trouble")["remedy"] == "Save under another name."
            assert not (tmp_path / "oak.sketchtree").exists()

    asyncio.run(test())
    other.close()


def test_a_full_disk_is_told_once_and_drawing_goes_on(monkeypatch):
    async def test():
        async with talking(journal=journal_of(None)) as talk:

            def full(_):
                raise OSError(28, "No space left on device")

            monkeypatch.setattr(recovery.os, "fsync", full)
            await talk.say(drawn("a"), drawn("b"))
            await talk.say(drawn("c"))
            assert [event["message"] for event in talk.all("trouble")] == ["Steps can't be kept for recovery: no space left on device."]
            assert talk.strokes() == ["a", "b", "c"]

    asyncio.run(test())


def test_steps_of_the_time_when_the_disk_was_full_are_kept_once_there_is_room(monkeypatch):
    """As on a real disk: of the line that finds it full a part is written."""
    write, room = recovery._write_all, []

    def filling(file, data):
        if room:
            return write(file, data)
        write(file, data[: len(data) // 2])
        raise OSError(28, "No space left on device")

    async def test():
        journal = journal_of(None)
        async with talking(journal=journal) as talk:
            room.append(True)
            await talk.say(drawn("a"))
            room.clear()
            monkeypatch.setattr(recovery, "_write_all", filling)
            await talk.say(drawn("b"), drawn("c"))
            assert journal.path.read_bytes().endswith(b"}\n") and b'"b"' not in journal.path.read_bytes()
            room.append(True)
            await talk.say(drawn("d"))
        return played()

    assert list(asyncio.run(test()).history.document.strokes) == ["a", "b", "c", "d"]


def test_what_the_full_disk_did_not_take_is_tried_again_at_the_end(monkeypatch):
    fsync = recovery.os.fsync

    def full(_):
        raise OSError(28, "No space left on device")

    async def test():
        async with talking(journal=journal_of(None)) as talk:
            monkeypatch.setattr(recovery.os, "fsync", full)
            await talk.say(drawn("a"))
            monkeypatch.setattr(recovery.os, "fsync", fsync)
        return played()

    assert list(asyncio.run(test()).history.document.strokes) == ["a"]


def test_a_shelf_that_cannot_be_made_is_told(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path / "file" / "shelf"))
    with pytest.raises(StudioError, match=r"^Can't keep the studio's journal in .*: not a directory\. Name a folder you may write to in SKETCHTREE_RECOVERY\.$"):
        journal_of(None)


def test_journals_are_the_users_own(shelf):
    _, _, journal = told(drawn("a"))
    assert journal.path.stat().st_mode & 0o077 == 0 and shelf.stat().st_mode & 0o077 == 0
    assert FakeEngine  # the engine is not asked to recover anything


def test_the_manner_of_growing_comes_back_as_it_was():
    blocks = Blocks(
        id=np.array([3]), order=np.array([0]), position=np.array([0.5]), zone=np.array([1.0]), start=np.array([0, 1]), apical=np.array([True]),
        **{name: np.array([0.25]) for name in ("scale", "divergence", "orientation", "reach", "length", "droop")},
    )  # fmt: skip
    document = Document(settled=Settled({}, manner=Manner(GENERIC, blocks, frozenset({7}), 2.0)))
    line = journal_lines.Keep(different=journal_lines.different(Document(), document))
    found = journal_lines.differing(Document(), journal_lines.decode(journal_lines.encode(line)).different, {}).settled.manner
    assert (found.theta, found.limbs, found.scale) == (GENERIC, frozenset({7}), 2.0)
    for name in ("id", "order", "position", "zone", "start", "apical", "scale"):
        one, other = getattr(found.blocks, name), getattr(blocks, name)
        assert one.dtype == other.dtype and one.tolist() == other.tolist()
