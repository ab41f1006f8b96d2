"""The engine that is there at once: what was made at an earlier start is shown, and made again all the same."""

import asyncio

import numpy as np
import pytest

from sketchtree.editing.document import Document
from sketchtree.editing.settled import Settled
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.sketch.strokes import Stroke
from sketchtree.studio import messages
from sketchtree.studio.crew import Crew
from sketchtree.studio.engine import Engine, Outcome
from sketchtree.studio.kept_tree import KeptTree, is_whole
from sketchtree.studio.making.basis import Basis
from sketchtree.studio.making.frames import Arrays, beheaded, opened
from sketchtree.studio.stock import Stock
from sketchtree.studio.stocked import Stocked

PATIENCE = 90.0


def _line(name, *points):
    return Stroke(name, np.array(points, float), labelled=True)


STROKES = (_line("trunk", (0, 0), (2, 50), (0, 100)), _line("left", (0, 40), (-20, 60), (-30, 80)))
DOCUMENT = Document({stroke.id: stroke for stroke in STROKES}, reading=ReadingOptions(template="english_oak"), tree=TreeOptions(generations=1))
BASIS = Basis(2.0, (0.1, 0.2, 0.3), (), Settled(template="english_oak", axis=0.1), 7.0, (-1.0, 0.0, -1.0), (1.0, 7.0, 1.0), 9, 8, (7, 6))


def frame(revision: int) -> bytes:
    """A tree of one chunk."""
    arrays = Arrays()
    arrays.put("1/w0/position", "f4", np.eye(3))
    head = messages.Tree(
        revision=revision, phase="full", scale=2.0, root=[0.0, 0.0], owners=["1"], chunks=[messages.Chunk(owner="1", digest="d", wood=[], leaves=[])], cards=[], materials=[],
        limbs=[], segments=9, drawn=2, leaves=8, triangles=[7, 6], height=7.0, low=[0.0] * 3, high=[0.0] * 3, template=None, leaf=None, bark="", warnings=[], arrays=[],
    )  # fmt: skip
    return arrays.frame(head)


class FakeCrew:
    """Tells a tree when it is told to."""

    def __init__(self, digests=None):
        self.on_outcome = lambda outcome: None
        self.shown, self.digests, self.asked, self.had = ({}, None), digests or {}, [], []
        for name in (
            "cancel", "refresh", "ghost", "glance", "alternatives", "read", "export", "project", "trace", "with_traced", "grow", "stop_growing", "grown", "marks", "proposed",
            "aged", "moving",
        ):  # fmt: skip
            setattr(self, name, None)

    def make(self, revision, document):
        self.on_outcome(Outcome(revision, messages.Working(state="working", revision=revision, stage="read")))

    def has_shown(self, revision, digests, basis):
        self.had.append(revision)

    def answer(self, revision):
        self.shown = self.digests, BASIS
        self.on_outcome(Outcome(revision, messages.Matches(revision=revision, used="english_oak", ranked=[])))
        self.on_outcome(Outcome(revision, frame(revision), settled=BASIS.settled))
        self.on_outcome(Outcome(revision, messages.Working(state="idle", revision=revision)))

    async def frame(self):
        return b"the crew's"

    async def texture(self, key, kind):
        self.asked.append((key, kind))
        return b"a texture" if key == "wood" else None

    async def picture(self, what, name):
        self.asked.append((what, name))
        return b"a picture"

    async def catalogue(self):
        self.asked.append("catalogue")
        return messages.Welcome(
            version=1, templates=[], leaves=[], barks=[], seasons=[], examples=[], formats=[], folder="", files=[], recovered=False
        )


def _run(work):
    return asyncio.run(asyncio.wait_for(work, PATIENCE))


def _started(folder, crew):
    engine, told = Stocked(crew, Stock(folder, "this program")), []
    engine.on_outcome = told.append
    return engine, told


async def _kept(folder, document=DOCUMENT) -> None:
    """As after an earlier start."""
    crew = FakeCrew()
    engine, _ = _started(folder, crew)
    engine.make(1, document)
    crew.answer(1)
    await asyncio.gather(*engine._puts)


def _said(told) -> list:
    return ["tree" if isinstance(one.event, bytes) else getattr(one.event, "state", type(one.event).__name__) for one in told]


def test_it_does_all_that_an_engine_does(tmp_path):
    async def made():
        engine, _ = _started(tmp_path, FakeCrew())
        assert [name for name, what in vars(Engine).items() if callable(what) and not name.startswith("_") and not hasattr(engine, name)] == []

    _run(made())


def test_a_drawing_that_was_opened_before_has_its_tree_at_once_with_where_its_depths_are(tmp_path):
    async def again():
        await _kept(tmp_path)
        crew = FakeCrew()
        engine, told = _started(tmp_path, crew)
        engine.make(5, DOCUMENT)
        assert _said(told) == ["working", "Matches", "tree", "idle"] and crew.had == [5]
        tree = told[2]
        assert tree.revision == beheaded(tree.event)[0].revision == 5 and tree.settled.template == "english_oak" and tree.settled.axis == 0.1
        assert await engine.frame() == tree.event  # a page that joins
        crew.on_outcome(Outcome(5, messages.Working(state="working", revision=5, stage="mesh")))
        assert len(told) == 4  # nobody waits for what is there
        crew.answer(5)
        assert _said(told[4:]) == ["Matches", "tree", "idle"] and await engine.frame() == b"the crew's"

    _run(again())


@pytest.mark.parametrize(
    "other",
    [
        DOCUMENT.replace(seed=1),
        DOCUMENT.replace(tree=TreeOptions(generations=2)),
        DOCUMENT.replace(reading=ReadingOptions(template="silver_birch")),
        DOCUMENT.replace(strokes={"trunk": STROKES[0]}),
        DOCUMENT.replace(settled=Settled(axis=1.0)),
    ],
)
def test_of_any_other_drawing_there_is_none(tmp_path, other):
    async def again():
        await _kept(tmp_path)
        engine, told = _started(tmp_path, FakeCrew())
        engine.make(5, other)
        assert _said(told) == ["working"]

    _run(again())


def test_its_name_does_not_matter_and_a_step_of_a_drawing_is_not_looked_for(tmp_path):
    async def again():
        await _kept(tmp_path)
        engine, told = _started(tmp_path, FakeCrew())
        engine.make(5, DOCUMENT.replace(name="another"))
        assert "tree" in _said(told)
        engine.make(6, DOCUMENT.replace(seed=1))
        told.clear()
        engine.make(7, DOCUMENT)
        assert _said(told) == ["working"]

    _run(again())


def test_a_tree_that_comes_out_differently_is_not_kept_on(tmp_path):
    async def again():
        await _kept(tmp_path)
        crew = FakeCrew(digests={"1": "another"})
        engine, _ = _started(tmp_path, crew)
        engine.make(5, DOCUMENT)
        crew.answer(5)
        engine, told = _started(tmp_path, FakeCrew())
        engine.make(6, DOCUMENT)
        assert _said(told) == ["working"]

    _run(again())


def test_what_the_tree_wears_is_asked_once_and_what_there_is_none_of_each_time(tmp_path):
    async def asked():
        crew = FakeCrew()
        engine, _ = _started(tmp_path, crew)
        for _ in range(2):
            assert await engine.texture("wood", "color") == b"a texture" and await engine.texture("no such", "color") is None
            await asyncio.gather(*engine._puts)
        assert crew.asked == [("wood", "color"), ("no such", "color"), ("no such", "color")]

    _run(asked())


def test_pictures_that_have_to_be_made_wait_for_the_first_tree(tmp_path):
    async def asked():
        crew = FakeCrew()
        engine, _ = _started(tmp_path, crew)
        engine.make(1, DOCUMENT)
        picture = asyncio.create_task(engine.picture("leaf", "oak"))
        await asyncio.sleep(0.05)
        assert not crew.asked
        crew.answer(1)
        assert await picture == b"a picture"
        await asyncio.gather(*engine._puts)
        engine, _ = _started(tmp_path, FakeCrew())
        assert await engine.picture("leaf", "oak") == b"a picture"  # which waits for nothing

    _run(asked())


def test_what_there_is_to_choose_from_is_asked_once(tmp_path):
    async def asked():
        crew = FakeCrew()
        for _ in range(2):
            engine, _ = _started(tmp_path, crew)
            first = await engine.catalogue()
            await asyncio.gather(*engine._puts)
        assert crew.asked == ["catalogue"] and first.version == 1

    _run(asked())


@pytest.mark.parametrize("spoil", [lambda data: data[:3], lambda data: b"\xff\xff\xff\xff" + data[4:], lambda data: data.replace(b'"scale"', b'"metre"')])
def test_bytes_that_are_no_kept_tree_are_none(spoil):
    kept = KeptTree({}, BASIS, None, None, frame(1))
    assert KeptTree.decoded(kept.encoded()).basis.translate == BASIS.translate
    assert KeptTree.decoded(spoil(kept.encoded())) is None


def test_the_tree_that_is_kept_is_the_one_that_is_made(tmp_path):
    async def started():
        engine, told = _started(tmp_path, Crew())
        await engine.start()
        try:
            engine.make(1, DOCUMENT)
            while not (isinstance(told[-1].event, messages.Working) and told[-1].event.state == "idle" and engine._shown is None and engine._missed is None):
                await asyncio.sleep(0.02)
            await asyncio.gather(*engine._puts)
        finally:
            await engine.stop()
        return [one.event for one in told if isinstance(one.event, bytes)]

    (made,) = _run(started())
    kept, again = _run(started())
    assert is_whole(made) and kept == made and not beheaded(again)[0].chunks
    head, arrays = opened(kept)
    assert len(head.chunks) == 2 and all(np.array_equal(arrays[name], column) for name, column in opened(made)[1].items())
