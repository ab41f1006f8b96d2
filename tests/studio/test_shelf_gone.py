"""The folder of journals, or that of the project, goes away, is read-only or full: the page is told what to do, drawing goes on, and nothing is missing after."""

import asyncio
import errno
import os
import shutil

import pytest
from talking import drawn, talking

from sketchtree.studio import messages, recovery, scribe
from sketchtree.studio.folder import Folder
from sketchtree.studio.recovery import journal_of


@pytest.fixture(autouse=True)
def shelf(tmp_path, monkeypatch):
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path / "shelf"))
    return tmp_path / "shelf"


def run(test):
    """Plays the test, and gives what the journal holds then."""
    asyncio.run(test())
    journal = journal_of(None)
    try:
        return list(journal.play().history.document.strokes)
    finally:
        journal.close()


def test_a_folder_that_was_removed_is_made_again_with_all_that_was_in_the_journal(shelf):
    async def test():
        async with talking(journal=journal_of(None)) as talk:
            await talk.say(drawn("a"), drawn("b"))
            shutil.rmtree(shelf)
            await talk.say(drawn("c"))
            assert talk.all("trouble") == [] and shelf.stat().st_mode & 0o077 == 0

    assert run(test) == ["a", "b", "c"]


def test_so_is_one_that_was_removed_before_the_first_step(shelf):
    async def test():
        async with talking(journal=journal_of(None)) as talk:
            shutil.rmtree(shelf)
            await talk.say(drawn("a"))
            other = journal_of(None)
            assert other.path.name == "untitled-2.jsonl"  # ours is locked in the new folder too
            other.close()

    assert run(test) == ["a"]


def test_while_it_cannot_be_made_the_page_is_told_and_once_it_can_all_steps_are_there(shelf, tmp_path, monkeypatch):
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path / "disk" / "shelf"))
    shelf = tmp_path / "disk" / "shelf"

    async def test():
        async with talking(journal=journal_of(None)) as talk:
            await talk.say(drawn("a"))
            os.rename(tmp_path / "disk", tmp_path / "away")
            await talk.say(drawn("b"), drawn("c"))
            (trouble,) = talk.all("trouble")
            assert trouble["message"] == "Steps can't be kept for recovery: no such file or directory." and trouble["about"] == "program"
            assert trouble["remedy"] == f"Save the drawing. They are kept again once {shelf} can be written to."
            assert talk.strokes() == ["a", "b", "c"]
            os.rename(tmp_path / "away", tmp_path / "disk")
            await talk.say(drawn("d"))
            assert talk.last("trouble")["message"] == "Steps are kept for recovery again." and len(talk.all("trouble")) == 2

    assert run(test) == ["a", "b", "c", "d"]


def test_nobody_has_to_draw_for_it_to_be_tried_again(monkeypatch):
    monkeypatch.setattr(scribe, "AGAIN", 0.01)
    fsync = recovery.os.fsync
    monkeypatch.setattr(recovery.os, "fsync", _full)

    async def test():
        async with talking(journal=journal_of(None)) as talk:
            await talk.session.take(talk.page, drawn("a"))
            await _until(lambda: len(talk.all("trouble")) == 1)
            assert talk.last("trouble")["remedy"] == "Free some space, and save the drawing."
            monkeypatch.setattr(recovery.os, "fsync", fsync)
            await _until(lambda: len(talk.all("trouble")) == 2)
            assert talk.last("trouble") | {"stroke": None} == {
                "type": "trouble", "message": "Steps are kept for recovery again.", "remedy": "None is missing.", "stroke": None, "about": "program",
            }  # fmt: skip

    assert run(test) == ["a"]


def test_a_page_that_joins_meanwhile_is_told_too(monkeypatch):
    monkeypatch.setattr(recovery.os, "fsync", _full)

    async def test():
        async with talking(journal=journal_of(None)) as talk:
            await talk.say(drawn("a"))
            told = []
            talk.session.leave(talk.page)
            page = talk.session.join(told.append)
            await talk.session.take(page, messages.Hello(version=messages.VERSION))
            await _until(lambda: any("Steps can't be kept" in one for one in told if isinstance(one, str)))

    asyncio.run(test())


def test_a_journal_that_another_program_put_in_its_place_is_kept_beside(shelf):
    async def test():
        async with talking(journal=journal_of(None)) as talk:
            await talk.say(drawn("a"))
            (shelf / "untitled.jsonl").unlink()
            (shelf / "untitled.jsonl").write_text("another\n")
            await talk.say(drawn("b"))

    assert run(test) == ["a", "b"] and (shelf / "untitled.kept-1.jsonl").read_text() == "another\n"


def test_a_torn_line_that_could_not_be_taken_away_goes_before_the_next_is_written(monkeypatch):
    write, room = recovery._write_all, []

    def torn(file, data):
        write(file, data[: len(data) // 2])
        if not room:
            raise OSError(errno.EIO, "Input/output error")
        write(file, data[len(data) // 2 :])

    journal = journal_of(None)

    class Stuck:
        """A file that can't be cut while the disk fails."""

        def __init__(self, file):
            self._file = file

        def truncate(self, size):
            if not room:
                raise OSError(errno.EIO, "Input/output error")
            return self._file.truncate(size)

        def __getattr__(self, name):
            return getattr(self._file, name)

    async def test():
        async with talking(journal=journal) as talk:
            await talk.say(drawn("a"))
            journal._file = Stuck(journal._file)
            monkeypatch.setattr(recovery, "_write_all", torn)
            await talk.say(drawn("b"))
            assert not journal.path.read_bytes().endswith(b"\n")
            room.append(True)
            await talk.say(drawn("c"))

    assert run(test) == ["a", "b", "c"]


def test_saving_where_the_folder_is_gone_says_so_and_what_can_be_done(tmp_path, shelf):
    work = tmp_path / "work"
    work.mkdir()

    async def test():
        async with talking(journal=journal_of(None), folder=Folder(work)) as talk:
            await talk.say(drawn("a"))
            shutil.rmtree(work)
            await talk.say(messages.Save(name="oak"), messages.Open(name="oak.sketchtree"), drawn("b"))
            assert [event["message"] for event in talk.all("trouble")] == [
                f"Can't write {work}/oak.sketchtree: the folder {work} does not exist.", "oak.sketchtree can't be read: no such file or directory.",
            ]  # fmt: skip
            assert talk.all("trouble")[0]["remedy"] == "Put that right and save again, or download the project."
            assert talk.strokes() == ["a", "b"] and not talk.last("changed")["saved"]
            work.mkdir()
            await talk.say(messages.Save(name="oak"))
            assert talk.last("saved")["name"] == "oak"

    asyncio.run(test())
    assert not list(shelf.glob("*.jsonl"))


def test_saving_while_the_shelf_cannot_be_used_saves_nevertheless(tmp_path, shelf, monkeypatch):
    async def test():
        async with talking(journal=journal_of(tmp_path / "oak.sketchtree"), folder=Folder(tmp_path)) as talk:
            await talk.say(drawn("a"))
            unlink = recovery.Path.unlink
            monkeypatch.setattr(recovery.Path, "unlink", lambda path, **how: _read_only() if path.suffix == ".jsonl" else unlink(path, **how))
            await talk.say(messages.Save(name="oak"))
            assert talk.last("saved")["name"] == "oak" and talk.all("trouble") == []
            await talk.say(drawn("b"))
        journal = journal_of(tmp_path / "oak.sketchtree")
        assert list(journal.play().history.document.strokes) == ["a", "b"] and journal.notes == []
        journal.close()

    asyncio.run(test())


def _full(_):
    raise OSError(errno.ENOSPC, "No space left on device")


def _read_only(*_, **__):
    raise PermissionError(errno.EACCES, "Permission denied")


async def _until(holds) -> None:
    for _ in range(2000):
        if holds():
            return
        await asyncio.sleep(0.01)
    raise AssertionError("it did not come")
