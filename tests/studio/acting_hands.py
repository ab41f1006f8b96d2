"""Processes that make trees, played: a chunk of a limb is known by what was drawn, and everything takes as long as it likes."""

import asyncio
import hashlib
import json
import random

import numpy as np

from sketchtree.editing.document import Document
from sketchtree.editing.edits import Adopted
from sketchtree.editing.settled import COURSE, Depths, Settled
from sketchtree.errors import OptionError
from sketchtree.limb_ids import stroke_limb_id
from sketchtree.studio import messages
from sketchtree.studio.hand import Ended
from sketchtree.studio.making.basis import Basis
from sketchtree.studio.making.worker import NEWEST


class ActingHand:
    """As `hand.Hand`. Like a real one it may finish a job just after it was stopped."""

    chance = random.Random(0)
    all: dict[str, "ActingHand"] = {}

    def __init__(self, role, database, tell, ended=lambda: None):
        self.role, self.tell, self.on_end = role, tell, ended
        self.number, self.stopped, self.newest = 0, -1, {}
        self.made: dict[int, tuple] = {}
        self.asked: dict[int, asyncio.Future] = {}
        self.runs, self.begun, self.kills = False, 0, 0
        ActingHand.all[role] = self

    def begin(self):
        self.runs, self.begun = True, self.begun + 1

    def ready(self):
        if not self.runs:
            self.begin()

    def end(self):
        self.runs = False

    def stop(self):
        self.stopped = self.number

    def ask(self, kind, *arguments):
        self.ready()
        self.number += 1
        self.newest[kind] = self.number
        answer = asyncio.get_running_loop().create_future()
        self.asked[self.number] = answer
        asyncio.get_running_loop().create_task(self._work(self.number, kind, arguments, answer))
        return self.number, answer

    def kill(self):
        """The process ends; what it knew is gone."""
        self.kills += 1
        self.made, asked, self.asked, self.runs = {}, self.asked, {}, False
        for answer in asked.values():
            if not answer.done():
                answer.set_exception(Ended("A process that makes the tree ended.", remedy="It is begun again with the next step."))
        self.on_end()

    async def _work(self, number, kind, arguments, answer):
        wanted = kind not in NEWEST
        for _ in range(self.chance.randrange(1, 12)):
            await asyncio.sleep(0)
            if self.chance.random() < 0.3:  # said, perhaps, before it heard that it was stopped
                self.tell(number, ("working", self.chance.choice(("infer", "mesh")), self.chance.random()))
            if not wanted and (number <= self.stopped or number < self.newest[kind]) and self.chance.random() < 0.7:
                self._answer(number, answer, None)
                return
        try:
            self._answer(number, answer, getattr(self, f"_{kind}")(number, *arguments))
        except OptionError as error:
            if not answer.done():
                answer.set_exception(error)

    def _answer(self, number, answer, value):
        self.asked.pop(number, None)
        if not answer.done():
            answer.set_result(value)

    def _full(self, number, revision, document: Document, known, shown):
        if not answerable(document):
            raise OptionError("There is no trunk.", remedy="Draw one.")
        self.tell(number, ("event", messages.Read(revision=revision, marks=[], roles={}, warnings=[])))
        chunks = chunks_of(document)
        self.made = {job: made for job, made in self.made.items() if job == shown} | {number: (revision, chunks)}
        return framed(revision, "full", chunks, known), chunks, basis(document, chunks)

    def _frame(self, number, shown):
        made = self.made.get(shown)
        return None if made is None else framed(made[0], "full", made[1], {})

    def _find(self, number, shown, limb):
        if shown not in self.made or not 1000 <= limb < 2000 or not self.made[shown][1]:
            raise OptionError("That branch is not there any more.", remedy="Pick it again on the tree as it is now.")
        parent = int(sorted(self.made[shown][1])[0])
        return Adopted(limb, parent, 0.5, np.array([[0.0, 0, 0], [1, 1, 1]]), 0.1, was=limb, foot=np.zeros(3))

    def _quick(self, number, revision, document: Document, before):
        if before is None or not answerable(document) or self.chance.random() < 0.2:
            return None
        chunks = chunks_of(document)
        touched = {owner: digest for owner, digest in chunks.items() if self.chance.random() < 0.6 or owner not in before.owners}
        if self.chance.random() < 0.5:  # it may come out just as in full, or coarser
            touched = {owner: f"coarse {digest}" for owner, digest in touched.items()}
        return framed(revision, "quick", touched, {}, owners=list(chunks)), touched, settled(document)

    def _ghost(self, number, revision, *_):
        return framed(revision, "full", {}, {}, kind="ghost")

    def _catalogue(self, number):
        return messages.Welcome(version=0, templates=[], leaves=[], barks=[], seasons=[], examples=[], formats=[], folder="", files=[])

    def _glance(self, number, revision, *_):
        return framed(revision, "glance", {}, {})


def answerable(document: Document) -> bool:
    return len(document.strokes) % 7 != 6


def chunks_of(document: Document) -> dict[str, str]:
    """Limb → digest of its chunk."""

    def told(limb: int, name: str) -> str:
        held, depths = document.edits.held.get(limb), document.settled.limbs.get(limb)
        depth = None if depths is None else depths.depth.tolist()
        said = (document.strokes[name].points.tolist(), document.seed, None if held is None else held.depth.tolist(), depth, sorted(document.edits.cleared))
        return hashlib.blake2b(repr(said).encode(), digest_size=6).hexdigest()

    return {str(stroke_limb_id(name)): told(stroke_limb_id(name), name) for name in document.strokes}


def settled(document: Document) -> Settled:
    """All strokes are limbs, straight, the first bears the others; depths that are known stay."""
    share, first, limbs = np.array([0.0, 1.0]), None, {}
    for name in document.strokes:
        limb = stroke_limb_id(name)
        known = document.settled.limbs.get(limb)
        depth = np.array([0.0, limb % 9 + 1.0]) if known is None else known.depth
        limbs[limb] = Depths(share, depth, depth * np.nan, np.zeros((COURSE, 2)), first, (name,))
        first = limb if first is None else first
    return Settled(limbs)


def basis(document: Document, chunks: dict[str, str]) -> Basis:
    return Basis(1.0, (0.0, 0.0, 0.0), tuple(chunks), settled(document), 1.0, (0.0,) * 3, (1.0,) * 3, 1, 1, (1, 1))


def framed(revision: int, phase: str, chunks: dict[str, str], known: dict[str, str], *, kind: str = "tree", owners: list[str] | None = None) -> bytes:
    """A frame whose head is all there is."""
    new = {owner: digest for owner, digest in chunks.items() if known.get(owner) != digest}
    head = json.dumps({"type": kind, "phase": phase, "revision": revision, "owners": list(chunks) if owners is None else owners, "chunks": new}).encode()
    return len(head).to_bytes(4, "little") + head
