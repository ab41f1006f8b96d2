"""The limbs of a photo, from the processes that make trees: traced at each stroke, apart from leaves as soon as those are known."""

import asyncio

import painted_photo as painted
import pytest

from sketchtree.errors import SketchError
from sketchtree.sketch.strokes import StrokeKind
from sketchtree.studio import messages
from sketchtree.studio.crew import Crew

PATIENCE = 120.0
CROWN, TRUNK, LEFT = painted.mark("crown", painted.CROWN, crown=True), painted.mark("trunk", painted.TRUNK), painted.mark("left", painted.LEFT)


class Traces:
    """A crew of which only the photo is asked, and all that it told."""

    def __init__(self):
        self.loop = asyncio.new_event_loop()
        self.crew, self.told, self.revision, self.picture = Crew(), [], 0, painted.photo()
        self.crew.on_outcome = lambda outcome: self.told.append(outcome.event)
        self.run(self.crew.start())

    def run(self, work):
        return self.loop.run_until_complete(asyncio.wait_for(work, PATIENCE))

    def document(self, *strokes, **options):
        return painted.document(*strokes, picture=self.picture, **options)

    def trace(self, *strokes, until, **options):
        """What was told since, once something is."""
        begun, self.revision = len(self.told), self.revision + 1

        async def traced():
            self.crew.trace(self.revision, self.document(*strokes, **options))
            while not any(until(event) for event in self.told[begun:]):
                await asyncio.sleep(0.01)

        self.run(traced())
        return self.told[begun:]

    def limbs(self, *strokes):
        """The first answer to these strokes."""
        return next(event for event in self.trace(*strokes, until=lambda event: isinstance(event, messages.Traced)) if isinstance(event, messages.Traced))


@pytest.fixture(scope="module")
def traces():
    one = Traces()
    yield one
    one.run(one.crew.stop())
    one.loop.close()


def test_limbs_come_first_and_once_more_when_the_foliage_is_known(traces):
    told = traces.trace(CROWN, TRUNK, until=lambda event: isinstance(event, messages.Foliage))
    assert [type(event) for event in told] == [messages.Traced, messages.Traced, messages.Foliage]
    assert [event.waits for event in told[:2]] == [True, False]
    assert all(event.revision == traces.revision for event in told) and told[-1].png and told[0].trees and told[1].trees


def test_another_stroke_in_the_same_crown_asks_for_no_foliage(traces):
    limbs = traces.limbs(CROWN, TRUNK, LEFT)
    assert len(limbs.trees) == 1 and limbs.remark == ""
    told = traces.trace(CROWN, TRUNK, until=lambda event: isinstance(event, messages.Traced))
    traces.run(asyncio.sleep(0.3))
    assert not any(isinstance(event, messages.Foliage) for event in traces.told[-len(told) - 1 :])


def test_the_process_begins_again_with_all_that_it_knew(traces):
    before = traces.limbs(CROWN, TRUNK)
    traces.crew._tracer._hand._process.kill()
    traces.run(asyncio.sleep(0.5))
    assert traces.limbs(CROWN, TRUNK).trees == before.trees


def test_looking_for_foliage_can_be_stopped_and_the_next_stroke_looks_again(traces):
    other = painted.mark("crown", [(x + 3, y + 3) for x, y in painted.CROWN], crown=True)
    traces.trace(other, TRUNK, until=lambda event: isinstance(event, messages.Traced) and event.waits)
    begun = len(traces.told)
    traces.crew.cancel()

    async def stopped():
        while not any(isinstance(event, messages.Traced) for event in traces.told[begun:]):
            await asyncio.sleep(0.01)

    traces.run(stopped())
    told = next(event for event in traces.told[begun:] if isinstance(event, messages.Traced))
    assert not told.waits and told.trees and told.remark == "Stopped looking for the foliage. The next stroke looks again."
    assert traces.trace(other, TRUNK, LEFT, until=lambda event: isinstance(event, messages.Foliage) and event.png != "")


def test_strokes_are_proposed_where_a_tree_stands_out(traces):
    made, why = traces.run(traces.crew.proposed(traces.document(LEFT)))
    assert sorted(stroke.kind.value for stroke in made.strokes.values()) == ["branch", "crown"] and isinstance(why, str)
    box = made.strokes["crown"].points
    left, top, width = painted.AT
    assert (box.min(axis=0) > (left - 1, top - width - 1)).all() and (box.max(axis=0) < (left + width + 1, top + 1)).all()


def test_without_the_photo_nothing_shows(traces):
    told = traces.trace(CROWN, TRUNK, is_photo=False, until=lambda event: isinstance(event, messages.Foliage))
    assert [type(event) for event in told] == [messages.Traced, messages.Foliage]
    assert told[0].trees == [] and told[0].remark == "" and told[1].png == ""


def test_traced_limbs_stand_for_the_strokes_that_mark_them(traces):
    document = traces.document(CROWN, TRUNK, LEFT)
    made = traces.run(traces.crew.with_traced(document))
    assert not made.underlay.photo and made.underlay.picture == document.underlay.picture and made.strokes["crown"] is document.strokes["crown"]
    limbs = [stroke for stroke in made.strokes.values() if stroke.kind == StrokeKind.BRANCH]
    assert {"trunk", "left"} < {stroke.id for stroke in limbs} and all(stroke.wood for stroke in limbs)
    with pytest.raises(SketchError, match="^No stroke marks a limb in the photo. Draw along the trunk, from its foot.$"):
        traces.run(traces.crew.with_traced(traces.document(CROWN)))


def test_crowns_that_come_while_foliage_is_looked_for_are_looked_at_after_it(traces):
    outlines = [painted.mark(f"crown {k}", [(x + 7 * k, y) for x, y in painted.CROWN], crown=True) for k in range(1, 5)]
    begun = len(traces.told)

    async def hurried():
        for outline in outlines:
            traces.revision += 1
            traces.crew.trace(traces.revision, traces.document(outline, TRUNK))
            await asyncio.sleep(0.2)
        while not any(isinstance(event, messages.Foliage) and event.png and event.revision == traces.revision for event in traces.told[begun:]):
            await asyncio.sleep(0.02)

    traces.run(hurried())
    last = [event for event in traces.told[begun:] if isinstance(event, messages.Traced)][-1]
    assert last.revision == traces.revision and not last.waits
