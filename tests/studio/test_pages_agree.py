"""Several pages show one drawing, and each does what it likes: at rest all have the same, as one that joins then."""

import asyncio
import json
import random

import pytest
from acting_hands import ActingHand
from talking import stroke

from sketchtree.editing.document import Document
from sketchtree.limb_ids import stroke_limb_id
from sketchtree.sketch.strokes import Stroke
from sketchtree.studio import crew, messages
from sketchtree.studio.session import Session


class Paper:
    """A page that keeps what it is told, as the real one does (`page/src/store.ts`); its line may be slow, and may be cut."""

    def __init__(self, session: Session, chance: random.Random):
        self.session, self.chance = session, chance
        self.unsaid: list[messages.Strokes] = []  # not confirmed yet: said again on another line
        self.fault: Exception | None = None
        self.begin()

    def begin(self) -> None:
        self.revision, self.strokes, self.options, self.edits, self.ways = 0, {}, None, None, None
        self.chunks, self.missing, self.tree, self.working = {}, set(), None, None
        self.kills = ActingHand.all["full"].kills
        self.page = self.session.join(self._hear)

    async def connect(self) -> None:
        await self.session.take(self.page, messages.Hello(version=messages.VERSION))
        for request in tuple(self.unsaid):
            await self.session.take(self.page, request)

    async def cut(self) -> None:
        """The line is cut, and there is another."""
        self.session.leave(self.page)
        self.begin()
        await self.connect()

    async def say(self, request) -> None:
        if isinstance(request, messages.Strokes):
            self.unsaid.append(request)
        await self.session.take(self.page, request)

    async def _hear(self, said) -> None:
        page = self.page
        for _ in range(self.chance.choice((0, 0, 1, 6))):
            await asyncio.sleep(0)
        if page is self.page:
            try:
                self._told(json.loads(said[4 : 4 + int.from_bytes(said[:4], "little")] if isinstance(said, bytes) else said))
            except (AssertionError, ValueError) as error:
                self.fault = error

    def _told(self, event: dict) -> None:
        if event["type"] == "changed":
            self._changed(event)
        elif event["type"] == "tree" and event["phase"] != "glance":
            if event["phase"] == "full":
                assert event["revision"] >= (self.tree or 0), "an older tree after a newer one"
                self.tree = event["revision"]
            self.chunks = {owner: digest for owner, digest in (self.chunks | dict(event["chunks"])).items() if owner in event["owners"]}
            self.missing = set(event["owners"]) - set(self.chunks)
            lost = ActingHand.all["full"].kills > self.kills  # who knew the rest of the tree ended before this page had it: it is made again
            assert event["phase"] == "quick" or not self.missing or lost, "a chunk that the page never got"
        elif event["type"] == "working":
            self.working = event["state"]

    def _changed(self, event: dict) -> None:
        assert event["since"] in (0, self.revision), "a change is missing"
        if event["since"] == 0:
            self.strokes = {}
        for name in event["gone"]:
            self.strokes.pop(name, None)
        self.strokes |= {one["id"]: one["xy"] for one in event["put"]}
        if event["order"] is not None:
            self.strokes = {name: self.strokes[name] for name in event["order"]}
        self.revision, self.ways = event["revision"], (event["undo"], event["redo"])
        self.options = event["options"] or self.options
        self.edits = self.edits if event["edits"] is None else event["edits"]
        self.unsaid = [one for one in self.unsaid if not all(name.id in self.strokes for name in one.put)]

    @property
    def all(self) -> dict:
        strokes = list(self.strokes.items())  # their order too
        return {"revision": self.revision, "strokes": strokes, "options": self.options, "edits": self.edits, "ways": self.ways, "tree": self.tree, "chunks": self.chunks}


def request(paper: Paper, chance: random.Random, step: int):
    """Whatever somebody may do."""
    names = list(paper.strokes)
    limb = str(stroke_limb_id(chance.choice(names))) if names else "5"
    new = stroke(f"s{step}", *(chance.uniform(-9, 9) for _ in range(6)))
    moved = stroke(chance.choice(names), 0, 0, 1, chance.uniform(1, 9)) if names else new
    return chance.choice(
        [messages.Strokes(label="branch", put=[new])] * 5
        + [messages.Strokes(label="move", put=[moved]), messages.Strokes(label="erase", gone=names[:1]), messages.Strokes(label="cut", put=[new], gone=names[-1:])]
        + [messages.Hold(limb=limb, share=1.0, depth=chance.uniform(-9, 9), live=chance.random() < 0.5)] * 3
        + [messages.Undo(), messages.Undo(), messages.Redo(), messages.Mirror(), messages.Flip(limb=limb), messages.Lock(limb=limb, on=chance.random() < 0.5)]
        + [messages.Delete(limb=chance.choice((limb, "1001", "1002"))), messages.Delete(limb="1003"), messages.Lock(limb="1004", on=True), messages.Sketching(stroke=new)]
        + [messages.Choose(options={"seed": chance.randrange(9)}), messages.Glance(template="oak"), messages.Glance(), messages.Cancel(), messages.Settle()]
    )


async def rest(session: Session, papers: list[Paper]) -> None:
    """Until nobody has anything to do."""
    quiet = 0
    while quiet < 200:
        await asyncio.sleep(0)
        for paper in papers:
            if paper.fault is not None:
                raise paper.fault
        busy = session.desk.pending or any(len(paper.page.outbox) or paper.working == "working" or paper.revision != session.revision for paper in papers)
        quiet = 0 if busy else quiet + 1


@pytest.mark.parametrize("seed", range(6))
def test_whatever_two_pages_do_at_once_they_have_the_same_at_rest_as_one_that_joins_then(seed, monkeypatch):
    monkeypatch.setattr(crew, "Hand", ActingHand)
    monkeypatch.setattr(ActingHand, "chance", random.Random(1000 + seed))

    async def test():
        chance, made = random.Random(seed), crew.Crew()
        await made.start()
        session = Session(made)
        session.begin()
        papers = [Paper(session, chance) for _ in range(2)]
        for paper in papers:
            await paper.connect()
        for step in range(500):
            paper, what = chance.choice(papers), chance.random()
            if what < 0.04:
                await paper.cut()
            elif what < 0.06:
                ActingHand.all[chance.choice(("quick", "full", "side"))].kill()
            else:
                await paper.say(request(paper, chance, step))
            for _ in range(chance.choice((0, 0, 1, 3, 30))):
                await asyncio.sleep(0)
        await asyncio.wait_for(rest(session, papers), 60)
        for k in range(2):  # what was cancelled, or had no trunk, has no tree of its own
            await papers[0].say(messages.Strokes(label="branch", put=[stroke(f"last {k}")]))
            await asyncio.wait_for(rest(session, papers), 60)
            if papers[0].working == "idle":
                break
        third = Paper(session, chance)
        await third.connect()
        await asyncio.wait_for(rest(session, [*papers, third]), 60)
        assert third.working == papers[0].working == papers[1].working == "idle", (third.working, papers[0].working, papers[1].working)
        assert third.tree == session.revision and list(third.strokes) == list(session.document.strokes)
        assert papers[0].all == third.all and papers[1].all == third.all and not third.missing
        await session.end()
        await made.stop()

    asyncio.run(test())


def test_a_limb_that_was_erased_in_a_hurry_and_came_back_has_its_chunk_again(monkeypatch):
    monkeypatch.setattr(crew, "Hand", ActingHand)
    quick = ActingHand._quick
    monkeypatch.setattr(ActingHand, "_quick", lambda hand, number, revision, *rest: None if revision == 3 else quick(hand, number, revision, *rest))

    async def test(seed: int):
        monkeypatch.setattr(ActingHand, "chance", random.Random(seed))
        made, heads = crew.Crew(), []

        def told(outcome):
            if isinstance(outcome.event, bytes):
                heads.append(json.loads(outcome.event[4 : 4 + int.from_bytes(outcome.event[:4], "little")]))
                if heads[-1]["revision"] == 2 and heads[-1]["phase"] == "quick":
                    made.make(3, both)

        made.on_outcome = told
        await made.start()
        both = Document({name: Stroke(name, [[0, 0], [0, 10]]) for name in "ab"})
        for revision, document in ((1, both), (2, both.replace(strokes={"a": both.strokes["a"]}))):
            made.make(revision, document)
            for _ in range(100):
                await asyncio.sleep(0)
        await made.stop()
        shown = set()
        for head in heads:
            shown = (shown | set(head["chunks"])) & set(head["owners"])
        return heads[-1]["revision"] == 3 and shown == set(heads[-1]["owners"]), heads[-1]["revision"]

    ends = [asyncio.run(test(seed)) for seed in range(12)]
    assert all(whole for whole, revision in ends if revision == 3) and any(revision == 3 for _, revision in ends)
