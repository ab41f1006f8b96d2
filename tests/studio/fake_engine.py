"""An engine that makes nothing, at once: what it was asked is kept for tests to look at."""

import dataclasses
import json

import numpy as np

from sketchtree.editing.document import Document
from sketchtree.editing.edits import Adopted
from sketchtree.editing.settled import COURSE, Depths, Settled
from sketchtree.errors import OptionError, SketchError
from sketchtree.sketch.strokes import Stroke, StrokeKind
from sketchtree.studio import messages
from sketchtree.studio.engine import Outcome, untold


class FakeEngine:
    """Limb n is that of the n-th stroke; limbs from 1000 to 1999 are undrawn ones that grow on limb 1."""

    def __init__(self):
        self.on_outcome = lambda outcome: None
        self.made: list[tuple[int, Document]] = []
        self.ghosts: list[tuple] = []
        self.glances: list = []
        self.traced: list[tuple[int, Document]] = []
        self.grows: list[tuple[int, Document, bool]] = []
        self.stopped = 0
        self.cancelled = self.refreshed = 0
        self.size = 8  # bytes of a frame's arrays
        self.answers = True  # tells a tree for every document
        self.whole: bytes | None = None
        self.running = False

    async def start(self):
        self.running = True

    async def stop(self):
        self.running = False

    def make(self, revision, document):
        self.made.append((revision, document))
        if self.answers:
            self.answer(revision, document)

    def answer(self, revision, document):
        """As if the tree had been made."""
        self.whole = frame(revision, size=self.size)
        self.on_outcome(Outcome(revision, self.whole, settled=settled(document)))
        self.on_outcome(Outcome(revision, messages.Working(state="idle", revision=revision)))

    def trace(self, revision, document):
        self.traced.append((revision, document))
        if document.underlay is not None and document.underlay.photo:
            self.on_outcome(Outcome(revision, messages.Traced(revision=revision, trees=[], remark=f"{len(document.strokes)} strokes")))

    async def with_traced(self, document):
        if not document.strokes:
            raise SketchError("No stroke marks a limb in the photo.", remedy="Draw along the trunk, from its foot.")
        strokes = {"limb": Stroke("limb", [[0, 0], [0, 10]], wood=True)}
        return document.replace(strokes=strokes, underlay=dataclasses.replace(document.underlay, photo=False))

    def grow(self, revision, document, *, at_once=False):
        self.grows.append((revision, document, at_once))
        if document.underlay is not None and document.underlay.photo and at_once:
            self.on_outcome(Outcome(revision, frame(revision, phase="photo"), of_photo=True))
            self.on_outcome(Outcome(revision, messages.Growing(revision=revision, state="ready", done=1.0)))

    def stop_growing(self):
        self.stopped += 1

    async def grown(self, document, name, options, tell=untold):
        return {name: b"of the photo"}

    async def proposed(self, document):
        return document.replace(strokes={"crown": Stroke("crown", [[0, 0], [9, 0], [9, 9]], StrokeKind.CROWN), "trunk": Stroke("trunk", [[0, 0], [0, 10]])}), "the trunk is hardly seen"

    async def marks(self, document):
        return b"<svg/>"

    def refresh(self):
        self.refreshed += 1

    async def frame(self):
        return self.whole

    def ghost(self, revision, document, stroke, hold):
        self.ghosts.append((stroke, hold))
        self.on_outcome(Outcome(revision, frame(revision, "ghost")))

    def glance(self, revision, document):
        self.glances.append(document)

    async def alternatives(self, revision, document):
        readings = [messages.Reading(odds=0.5, log_posterior=0.0, paths=[]) for _ in range(2)]
        return messages.Alternatives(revision=revision, readings=readings), [settled(document), settled(document, depth=9.0)]

    def cancel(self):
        self.cancelled += 1

    async def find(self, document, limb):
        if not 1000 <= limb < 2000:
            raise OptionError("That limb is not there any more.", remedy="Wait until the tree is ready, then pick the limb again.")
        return Adopted(limb, 1, 0.5, np.array([[0.0, 0, 0], [1, 1, 1]]), 0.1)

    async def read(self, data, name, cloud=messages.CloudReading()):
        if data.startswith(b"bad"):
            raise SketchError(f"{name} is no drawing.", remedy="Draw one.")
        if data.startswith(b"{"):
            names = json.loads(data)["strokes"]
        else:
            names = [f"{name}-{k}" for k in range(2)]
        return Document(strokes={one: Stroke(one, [[0, 0], [0, 10]]) for one in names}, name=name)

    async def export(self, document, name, options, tell=untold):
        tell("mesh", 0.5)
        if options["solid"]:
            raise OptionError("`--solid` needs a package.", remedy="Install it.")
        return {name: b"one"} if options["levels"] != "apart" else {name: b"one", "räum/tree.png": b"two"}

    async def aged(self, document, growing, tell=untold):
        if not document.strokes:
            raise SketchError("There is no tree that could grow.", remedy="Draw a trunk first.")
        tell("grow", 0.5)
        return f"{growing.tree} {growing.mode} {growing.bend:g}".encode()

    async def moving(self, document, name, tree, grown, tell=untold):
        return {name: f"{tree} {grown.mode} {grown.bend:g} {grown.seconds:g}".encode()}

    async def project(self, document):
        return json.dumps({"strokes": list(document.strokes)}).encode()

    async def texture(self, key, kind):
        return b"\x89PNG" if key == "bark" else None

    async def picture(self, what, name):
        return b"\x89PNG" if what == "template" else None

    async def catalogue(self):
        return messages.Welcome(version=0, templates=[], leaves=[], barks=[], seasons=["summer"], examples=[], formats=[], folder="", files=[])


def frame(revision: int, kind: str = "tree", phase: str = "full", size: int = 8) -> bytes:
    """A binary frame with an empty body of `size` bytes."""
    head = json.dumps({"type": kind, "phase": phase, "revision": revision}).encode()
    start = 4 + len(head)
    return len(head).to_bytes(4, "little") + head + bytes(-start % 8) + bytes(size)


def settled(document: Document, depth: float = 1.0) -> Settled:
    """All strokes are limbs, straight, at one depth."""
    share, course = np.array([0.0, 1.0]), np.zeros((COURSE, 2))
    rising = np.array([0.0, depth])
    limbs = {number: Depths(share, rising, rising * np.nan, course, None if number == 1 else 1, (name,)) for number, name in enumerate(document.strokes, 1)}
    for adopted in document.edits.adopted.values():
        limbs[adopted.limb] = Depths(share, rising, rising, course, 1, ())
    return Settled(limbs)
