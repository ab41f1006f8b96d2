"""Whoever saves or opens draws on meanwhile: what is written is the drawing as it was when that was asked, and nothing of what came since is lost."""

import asyncio
import json

import pytest
from fake_engine import FakeEngine
from talking import Talk, drawn, stroke, talking

from sketchtree.studio import messages
from sketchtree.studio.folder import Folder
from sketchtree.studio.recovery import journal_of

SAVE, OPEN = messages.Save(name="oak"), messages.Open(name="f.json")


class Slow(FakeEngine):
    """Reads and writes files when it is let."""

    def __init__(self):
        super().__init__()
        self.gate, self.asked = asyncio.Event(), 0

    async def project(self, document):
        await self._late()
        return await super().project(document)

    async def read(self, data, name, tree=None):
        await self._late()
        return await super().read(data, name)

    async def _late(self) -> None:
        self.asked += 1
        await self.gate.wait()


class Files:
    """A session in a folder, whose engine is slow with files."""

    def __init__(self, folder):
        self.folder = folder
        (folder / "f.json").write_bytes(b'{"strokes": ["p", "q"]}')

    def talking(self, project=None):
        return talking(engine=Slow(), journal=journal_of(project), folder=Folder(self.folder))

    async def ask(self, talk: Talk, *requests) -> None:
        """Asked of the program, which is at it, and no more."""
        asked = talk.engine.asked
        for request in requests:
            await asyncio.wait_for(talk.session.take(talk.page, request), 10)
        while talk.engine.asked == asked:
            await asyncio.sleep(0.001)

    async def let(self, talk: Talk) -> None:
        talk.engine.gate.set()
        await talk.hear()

    @property
    def saved(self) -> list[str]:
        return json.loads((self.folder / "oak.sketchtree").read_bytes())["strokes"]


@pytest.fixture
def files(tmp_path, monkeypatch):
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path / "recovery"))
    return Files(tmp_path)


async def _draw(talk: Talk, *names: str) -> None:
    """Strokes that are answered at once."""
    for name in names:
        await asyncio.wait_for(talk.session.take(talk.page, drawn(name)), 10)
        await talk.session.desk.scribe.rest()
        await asyncio.sleep(0)
    assert set(names) <= set(talk.strokes())


def test_strokes_are_answered_while_a_file_is_written_which_has_the_drawing_as_it_was(files):
    async def test():
        async with files.talking() as talk:
            await talk.say(drawn("a"))
            await files.ask(talk, SAVE)
            await _draw(talk, "b", "c")
            assert not talk.all("saved") and not (files.folder / "oak.sketchtree").exists()
            await files.let(talk)
            told = talk.last("saved")
            assert (told["name"], told["drawing"], told["saved"]) == ("oak", "oak", False) and files.saved == ["a"]
            await talk.say(messages.Undo(), messages.Undo())
            assert talk.last("changed")["saved"] and talk.strokes() == ["a"]

    asyncio.run(test())


@pytest.mark.parametrize("since", [[], [drawn("b"), messages.Undo()]])
def test_where_nothing_is_different_since_the_drawing_is_as_in_its_file_and_its_journal_empty(files, since):
    async def test():
        async with files.talking() as talk:
            await talk.say(drawn("a"))
            await files.ask(talk, SAVE)
            for request in since:
                await talk.session.take(talk.page, request)
            await files.let(talk)
            assert talk.last("saved")["saved"] and files.saved == ["a"]
            assert not talk.desk.scribe.journal.holds_something

    asyncio.run(test())


@pytest.mark.parametrize("own", [False, True])
@pytest.mark.parametrize("since", [[drawn("b")], [drawn("b"), drawn("c")], [messages.Undo()], [drawn("b"), messages.Undo(), messages.Undo()], [drawn(gone=("a",))]])
def test_ended_after_it_the_drawing_comes_back_with_what_was_done_meanwhile_and_undo_leads_to_the_file(files, own, since):
    project = files.folder / "oak.sketchtree"

    async def test():
        async with files.talking(project if own else None) as talk:
            await talk.say(drawn("a"), drawn("z"))
            await files.ask(talk, SAVE)
            for request in since:
                await talk.session.take(talk.page, request)
            await files.let(talk)
            return talk.session.document

    document = asyncio.run(test())
    journal = journal_of(project)
    found = journal.play()
    journal.close()
    assert list(found.history.document.strokes) == list(document.strokes) and found.history.document.name == "oak"
    assert found.saved_state == 0 and found.signature == Folder(files.folder).signature(project.name)
    found.history.undo()
    assert found.history.state == 0 and list(found.history.document.strokes) == ["a", "z"] == files.saved


def test_a_drawing_opened_while_another_is_saved_keeps_its_name(files):
    async def test():
        async with files.talking() as talk:
            await talk.say(drawn("a"))
            await files.ask(talk, SAVE)
            talk.desk.step(talk.session.document.replace(name="other"), "open")
            await files.let(talk)
            assert (talk.last("saved")["name"], talk.last("saved")["drawing"], talk.last("saved")["saved"]) == ("oak", "other", False)
            assert talk.session.document.name == "other"
            await talk.say(messages.Undo())
            assert talk.last("changed")["saved"]

    asyncio.run(test())


def test_strokes_are_answered_while_a_file_is_read_which_then_takes_the_place_of_all_as_one_step(files):
    async def test():
        async with files.talking() as talk:
            await talk.say(drawn("a"))
            await files.ask(talk, OPEN)
            await _draw(talk, "b")
            await files.let(talk)
            assert talk.strokes() == ["p", "q"] and talk.last("changed")["undo"] == "open"
            await talk.say(messages.Undo())
            assert talk.strokes() == ["a", "b"]

    asyncio.run(test())


def test_undo_takes_back_an_opening_that_is_not_done_yet_and_nothing_else(files):
    async def test():
        async with files.talking() as talk:
            await talk.say(drawn("a"))
            await files.ask(talk, OPEN)
            await talk.session.take(talk.page, messages.Undo())
            await files.let(talk)
            assert talk.strokes() == ["a"] and talk.last("changed")["undo"] == "branch"

    asyncio.run(test())


def test_files_are_opened_and_saved_in_the_order_that_was_asked(files):
    async def test():
        async with files.talking() as talk:
            await talk.say(drawn("a"))
            await files.ask(talk, OPEN, SAVE, messages.Open(name="no.svg"))
            await files.let(talk)
            assert files.saved == ["p", "q"] and talk.last("saved")["saved"]
            assert talk.last("trouble")["about"] == "file"

    asyncio.run(test())


def test_what_can_not_be_written_is_told_as_of_the_file_and_the_drawing_is_not_saved(files):
    async def test():
        async with files.talking() as talk:
            await talk.say(drawn("a"))
            files.folder.joinpath("oak.sketchtree").write_bytes(b"other")
            talk.engine.gate.set()
            await talk.say(SAVE)
            assert talk.last("trouble")["message"] == "oak.sketchtree is there already." and talk.last("trouble")["about"] == "file"
            assert not talk.all("saved") and not talk.desk.saved

    asyncio.run(test())


def test_a_fault_while_saving_is_told(files, monkeypatch, capsys):
    async def test():
        async with files.talking() as talk:

            async def broken(document):
                raise RuntimeError("broken pen")

            monkeypatch.setattr(talk.engine, "project", broken)
            await talk.say(drawn("a"), SAVE)
            assert talk.last("trouble")["message"] == "Something went wrong in the program; nothing of the drawing is different."
            await talk.say(messages.Strokes(label="branch", put=[stroke("b")]))
            assert talk.strokes() == ["a", "b"]

    asyncio.run(test())
    assert "broken pen" in capsys.readouterr().err


def test_no_more_files_wait_than_anybody_needs(files):
    async def test():
        async with files.talking() as talk:
            for _ in range(40):
                await talk.session.take(talk.page, OPEN)
            await asyncio.sleep(0)
            assert talk.last("trouble")["message"] == "Too many files wait to be opened or saved."
            assert sum(task.get_name() == "file" for task in talk.desk.tasks) == 32
            await files.let(talk)

    asyncio.run(test())
