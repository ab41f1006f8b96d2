"""Whatever is asked, in whatever order, and whenever the trees come: at each line of its journal a killed studio comes back as its pages saw it, with every step.

Sessions are random, but the same each time.
"""

import asyncio
import random
from dataclasses import dataclass, field, replace
from itertools import pairwise

import msgspec
import numpy as np
import pytest
from fake_engine import FakeEngine, frame, settled
from talking import drawn, talking

from sketchtree.editing import kept
from sketchtree.editing.document import Document
from sketchtree.editing.settled import Manner, Settled
from sketchtree.parameters import GENERIC
from sketchtree.propagate.blocks.block import Blocks
from sketchtree.studio import journal_lines, messages
from sketchtree.studio.engine import Outcome
from sketchtree.studio.folder import Folder
from sketchtree.studio.history import History
from sketchtree.studio.recovery import Journal, journal_of

NAMES = [f"s{k}" for k in range(8)]
_JSON = msgspec.json.Encoder(enc_hook=journal_lines._plain)


class Late(FakeEngine):
    """Its trees come when the test says so, those of older revisions too, and settle anyhow."""

    def __init__(self, chance: random.Random):
        super().__init__()
        self.answers, self.chance, self.count = False, chance, 0

    def come(self) -> None:
        revision, document = self.chance.choice(self.made[-3:])
        self.count += 1
        limbs = list(settled(document, depth=self.chance.choice([1.0, float(self.count)])).limbs.items())
        self.chance.shuffle(limbs)
        found = Settled(dict(limbs), self.chance.choice(["oak", None]), self.chance.choice(["", "a"]), self.chance.choice([None, self._manner()]), self.chance.choice([0.0, 1.5]))
        self.on_outcome(Outcome(revision, frame(revision), settled=found))
        self.on_outcome(Outcome(revision, messages.Working(state="idle", revision=revision)))

    def _manner(self) -> Manner:
        columns = {name: np.array([0.25 * self.count]) for name in ("scale", "divergence", "orientation", "reach", "length", "droop")}
        blocks = Blocks(id=np.array([3]), order=np.array([0]), position=np.array([0.5]), zone=np.array([np.nan]), start=np.array([0, 1]), apical=np.array([True]), **columns)
        return Manner(GENERIC, blocks, frozenset({7, self.count}), 2.0)


@dataclass
class Seen:
    """What there was when the journal had so many bytes."""

    size: int
    whole: bytes
    steps: bytes


@dataclass
class Told:
    """One session, until it was killed."""

    journal: Journal | None = None
    seen: list[Seen] = field(default_factory=list)

    def look(self, history: History, journal: Journal) -> None:
        if journal is not self.journal:
            self.journal, self.seen = journal, []
        self.seen.append(Seen(journal.path.stat().st_size if journal.path.exists() else 0, canonical(history.document), steps(history)))


def canonical(document: Document) -> bytes:
    """All of a document that a project keeps."""
    plain = [getattr(document, name) for name in ("reading", "tree", "seed", "name", "units", "page", "warnings", "underlay")]
    by_hand = [list(kind.items()) for kind in (document.edits.held, document.edits.cleared, document.edits.adopted)]
    return _JSON.encode([list(document.strokes.values()), by_hand, of_depths(document.settled), plain])


def of_depths(found: Settled) -> list:
    return [kept.settled_as_json(replace(found, limbs={})), list(found.limbs.items())]


def steps(history: History) -> bytes:
    """What can be undone and done again, and where the depths were then."""
    return _JSON.encode([[(way.label, of_depths(way.settled)) for way in ways] for ways in (history._back, history._on)])


def request(chance: random.Random, limb: str, revision: int) -> messages.Request | None:
    """Anything; None: a tree comes."""
    hold = messages.Hold(limb=limb, share=chance.random(), depth=chance.random())
    options = {"gravity": chance.random()}, {"template": chance.choice(["oak", "auto", "silver_birch"])}, {"seed": chance.randrange(9)}
    return chance.choice([
        drawn(*chance.sample(NAMES, 2)), drawn(chance.choice(NAMES), gone=tuple(chance.sample(NAMES, 2))), messages.Undo(), messages.Undo(), messages.Redo(),
        messages.Open(name="f.json"), messages.Open(name="g.svg"), messages.New(), hold, messages.Flip(limb=limb), messages.Lock(limb=limb, on=chance.random() < 0.5),
        messages.Lock(limb="1001", on=True), messages.Delete(limb=limb), messages.Delete(limb="1002"), messages.Mirror(), messages.Settle(), messages.Readings(),
        messages.Pick(reading=1, revision=revision), *(messages.Choose(options=option) for option in options), *[None] * 5,
    ])  # fmt: skip


async def session(chance: random.Random, folder, *, saves: bool, length: int = 60) -> Told:
    """A session that is killed: nothing is done at its end."""
    told, engine = Told(), Late(chance)
    (folder / "f.json").write_bytes(b'{"strokes": ["p", "q", "r"]}')
    (folder / "g.svg").write_bytes(b"g")
    async with talking(engine=engine, journal=journal_of(None), folder=Folder(folder)) as talk:
        desk = talk.desk
        for number in range(length):
            talk.clock.now += chance.choice([0.1, 3.0])
            asked = request(chance, str(chance.choice(list(desk.document.settled.limbs) or [1001])), desk.revision)
            if saves and number in (length // 3, length // 2):
                await talk.say(messages.Save(name="birch", over=True))
                told.journal = None
            elif asked is None:
                engine.come()
                await talk.hear()
            else:
                await talk.say(asked)
            told.look(desk.history, desk.scribe.journal)
    return told


@pytest.mark.parametrize("saves", [False, True])
@pytest.mark.parametrize("number", range(6))
def test_killed_at_any_line_it_comes_back_as_it_was_seen(tmp_path, monkeypatch, number, saves):
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path / "shelf"))
    told = asyncio.run(session(random.Random(number), tmp_path, saves=saves))
    whole = told.journal.path.read_bytes() if told.journal.path.exists() else b""
    assert told.seen[-1].size == len(whole)
    for one in told.seen:
        if one.size:
            assert canonical(played(told.journal, whole[: one.size]).document) == one.whole
            assert saves or steps(played(told.journal, whole[: one.size])) == one.steps


@pytest.mark.parametrize("number", range(100, 103))
def test_killed_in_a_line_it_comes_back_as_it_was_before_it(tmp_path, monkeypatch, number):
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path / "shelf"))
    chance = random.Random(number)
    told = asyncio.run(session(chance, tmp_path, saves=False))
    whole = told.journal.path.read_bytes()
    ends = [0, *(at + 1 for at, byte in enumerate(whole) if byte == ord("\n"))]
    known = {one.size: one for one in told.seen}
    for start, end in pairwise(ends):
        if start in known and start:
            found = played(told.journal, whole[: chance.randrange(start + 1, end)])
            assert (canonical(found.document), steps(found)) == (known[start].whole, known[start].steps)


def played(journal: Journal, data: bytes) -> History:
    """What a start finds in such a journal."""
    journal.path.write_bytes(data)
    again = journal_of(journal.project)
    try:
        found = again.play()
        assert again.notes == []
        return found.history
    finally:
        again.close()
