"""One drawing, its pages, and what each request does to it."""

import asyncio

import numpy as np
import pytest
from fake_engine import FakeEngine, frame, settled
from talking import Talk, drawn, stroke, talking

from sketchtree.editing import operations
from sketchtree.editing.document import Document
from sketchtree.sketch.strokes import Stroke
from sketchtree.studio import messages
from sketchtree.studio.engine import Outcome
from sketchtree.studio.session import Session


def run(test):
    """A test on an event loop of its own."""

    def wrapped():
        asyncio.run(test())

    wrapped.__name__, wrapped.__doc__ = test.__name__, test.__doc__
    return wrapped


@run
async def test_hello_is_answered_with_everything():
    async with talking(Document(strokes={"a": Stroke("a", [[1, 2], [3, 4]])}, name="oak")) as talk:
        welcome, whole = talk.last("welcome"), talk.last("changed")
        assert welcome["version"] == messages.VERSION and not welcome["recovered"] and {choice["name"] for choice in welcome["examples"]} >= {"oak.svg", "palm.svg"}
        assert whole["since"] == 0 and whole["name"] == "oak" and whole["put"][0]["xy"] == [1.0, -2.0, 3.0, -4.0]
        assert whole["options"]["density"] == 1.0 and whole["undo"] is None and whole["edits"] == []
        assert talk.engine.refreshed == 1 and talk.told.count(talk.engine.whole) == 1


@run
async def test_a_page_of_another_version_is_told_to_load_again():
    session = Session(FakeEngine())
    session.begin()
    talk = Talk(session)
    await talk.say(messages.Hello(version=999), messages.Undo())
    assert talk.last("trouble")["message"] == "The first message must be a `hello`." and talk.all("trouble")[0]["message"] == "This page is of another version of the program."
    assert talk.all("changed") == []


@run
async def test_a_stroke_is_a_step_with_y_up():
    async with talking() as talk:
        await talk.say(messages.Strokes(label="branch", put=[stroke("a", 0, 0, 5, -7, pressure=[0.5, 1.0], time=[0, 8.5], width=2.5, view_deg=90)]))
        one = talk.session.document.strokes["a"]
        assert one.points.tolist() == [[0, 0], [5, 7]] and one.pressure.tolist() == [0.5, 1.0] and one.time.tolist() == [0, 8.5]
        assert one.view_deg == 90 and one.width == 2.5 and one.labelled
        told = talk.last("changed")
        assert told["since"] == 1 and told["revision"] == 2 and told["undo"] == "branch" and not told["saved"]
        assert told["put"][0]["xy"] == [0.0, 0.0, 5.0, -7.0] and told["options"] is None and told["edits"] is None
        assert talk.engine.made[-1][0] == 2


@run
async def test_undo_and_redo_are_told_as_differences():
    async with talking() as talk:
        await talk.say(drawn("a"), drawn("b"), drawn("c", gone=("a",), label="cut"))
        assert talk.strokes() == ["b", "c"]
        await talk.say(messages.Undo())
        assert talk.strokes() == ["a", "b"] and talk.last("changed")["redo"] == "cut"
        await talk.say(messages.Undo(), messages.Undo(), messages.Undo())
        assert talk.strokes() == [] and talk.last("changed")["undo"] is None
        await talk.say(messages.Redo(), messages.Redo(), messages.Redo(), messages.Redo())
        assert talk.strokes() == ["b", "c"] == list(talk.session.document.strokes)


@run
async def test_a_page_that_joins_is_told_why_there_is_no_tree_until_there_is_one():
    async with talking() as talk:
        talk.session.desk.on_outcome(Outcome(1, messages.Trouble(message="The trunk can't be found.", remedy="Draw one.")))
        other = Talk(talk.session)
        await other.say(messages.Hello(version=messages.VERSION))
        assert other.last("trouble")["message"] == "The trunk can't be found."
        await talk.say(drawn("a"))
        third = Talk(talk.session)
        await third.say(messages.Hello(version=messages.VERSION))
        assert third.all("trouble") == []


@run
async def test_two_pages_stay_as_one_and_the_last_writer_of_a_stroke_wins():
    async with talking() as talk:
        other = Talk(talk.session)
        await other.say(messages.Hello(version=messages.VERSION))
        await talk.say(drawn("a", "b"))
        await other.say(drawn("c", gone=("a",)))
        await talk.say(messages.Strokes(label="move", put=[stroke("b", 7, 7, 8, 8)], gone=["a", "nobody"]))
        await other.hear()
        assert talk.strokes() == other.strokes() == ["b", "c"]
        assert other.last("changed")["put"][0]["xy"] == [7.0, 7.0, 8.0, 8.0]
        third = Talk(talk.session)
        await third.say(messages.Hello(version=messages.VERSION))
        assert third.strokes() == ["b", "c"]


@run
async def test_a_stroke_said_twice_is_one_step_and_is_answered():
    async with talking() as talk:
        await talk.say(drawn("a"), drawn("a"))
        told = talk.all("changed")[-2:]
        assert [event["revision"] for event in told] == [2, 2] and told[1]["put"] == []
        await talk.say(messages.Undo())
        assert talk.strokes() == []


@pytest.mark.parametrize(
    ("one", "said"),
    [
        (stroke("a", 1, 2, 3), "Stroke a: it has an x without a y."),
        (stroke("a", 1, 2, 3, 4, pressure=[1.0]), "Stroke a: it has 2 points and 1 pressures."),
        (stroke("a", 1, 2, time=[1.0, 2.0]), "Stroke a: it has 1 points and 2 times."),
    ],
)
def test_a_stroke_that_is_none_is_refused_by_name_and_nothing_happens(one, said):
    async def test():
        async with talking() as talk:
            await talk.say(drawn("b"), messages.Strokes(label="branch", put=[stroke("c"), one]))
            trouble = talk.last("trouble")
            assert trouble["message"] == said and trouble["stroke"] == "a" and trouble["remedy"] == "Draw it again."
            assert talk.strokes() == ["b"] == list(talk.session.document.strokes)

    asyncio.run(test())


@run
async def test_what_a_page_cannot_say_of_a_stroke_stays():
    old = Stroke("a", [[0, 0], [1, 1]], layer="ink", filled=True, wood=True)
    async with talking(Document(strokes={"a": old})) as talk:
        await talk.say(messages.Strokes(label="move", put=[stroke("a", 2, 2, 3, 3)]))
        new = talk.session.document.strokes["a"]
        assert (new.layer, new.filled, new.wood, new.labelled) == ("ink", True, True, False)
        await talk.say(messages.Strokes(label="crown", put=[stroke("a", 2, 2, 3, 3, kind="crown")]))
        assert talk.session.document.strokes["a"].labelled


@run
async def test_more_strokes_than_a_drawing_may_have_are_refused():
    async with talking() as talk:
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(messages, "MAX_STROKES", 3)
            await talk.say(drawn("a", "b", "c"), drawn("d"))
        assert talk.last("trouble")["message"] == "The drawing would have 4 strokes; 3 is the most." and talk.strokes() == ["a", "b", "c"]


@run
async def test_options_are_chosen_by_name_and_a_dragged_slider_is_one_step():
    async with talking() as talk:
        for k in range(5):
            talk.clock.now += 0.1
            await talk.say(messages.Choose(options={"gravity": 0.1 * k + 0.1}))
        assert talk.session.document.tree.sag == 0.5 and talk.last("changed")["options"]["gravity"] == 0.5 and talk.last("changed")["undo"] == "gravity"
        talk.clock.now += 2
        await talk.say(messages.Choose(options={"template": "oak", "seed": 7, "generations": None}))
        assert talk.session.document.reading.template == "oak" and talk.session.document.seed == 7
        await talk.say(messages.Undo(), messages.Undo())
        assert talk.session.document.tree.sag == 0 and talk.last("changed")["undo"] is None


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"density": 11}, "The option density can't be that: expected `float` <= 10.0."),
        ({"season": "monsoon"}, "The option season can't be that: invalid enum value 'monsoon'."),
        ({"planar": "yes"}, "The option planar can't be that: expected `bool`, got `str`."),
        ({"colour": 1}, "There is no option of that name."),
    ],
)
def test_an_option_that_cannot_be_is_refused(options, said):
    async def test():
        async with talking() as talk:
            await talk.say(messages.Choose(options=options))
            assert talk.last("trouble")["message"] == said and talk.session.revision == 1

    asyncio.run(test())


@run
async def test_a_new_page_can_be_undone():
    async with talking() as talk:
        await talk.say(drawn("a"), messages.New())
        assert talk.strokes() == [] and talk.last("changed")["undo"] == "new"
        await talk.say(messages.Undo())
        assert talk.strokes() == ["a"]


# Edits by hand


@run
async def test_a_drawn_limb_is_held_flipped_locked_and_deleted():
    async with talking() as talk:
        await talk.say(drawn("a", "b"))
        await talk.say(messages.Hold(limb="2", share=1.0, depth=4.0))
        assert talk.last("changed")["edits"] == [{"what": "held", "limb": "2", "share": [1.0], "depth": [4.0]}] and talk.last("changed")["undo"] == "depth"
        await talk.say(messages.Flip(limb="2"), messages.Lock(limb="2", on=False))
        assert talk.last("changed")["edits"] == [] and talk.last("changed")["undo"] == "unlock"
        await talk.say(messages.Lock(limb="1", on=True), messages.Mirror(), messages.Settle())
        assert talk.last("changed")["undo"] == "settle"
        await talk.say(messages.Delete(limb="2"))
        assert talk.strokes() == ["a"]


@run
async def test_an_undrawn_limb_is_adopted_by_an_edit_and_cleared_by_delete():
    async with talking(Document(strokes={"a": Stroke("a", [[0, 0], [0, 9]])})) as talk:
        await talk.say(messages.Lock(limb="1001", on=True))
        assert [edit["what"] for edit in talk.last("changed")["edits"]] == ["adopted"]
        await talk.say(messages.Hold(limb="1002", share=1.0, depth=2.0), messages.Delete(limb="1003"))
        assert [(edit["what"], edit["limb"]) for edit in talk.last("changed")["edits"]] == [("adopted", "1001"), ("adopted", "1002"), ("cleared", "1003")]


@run
async def test_an_edit_of_no_limb_is_refused():
    async with talking() as talk:
        await talk.say(messages.Flip(limb="77"))
        assert talk.last("trouble")["message"] == "That limb is not there any more." and talk.session.revision == 1


@run
async def test_an_edit_of_a_limb_just_drawn_is_done_when_its_depth_is_known_and_nothing_waits_for_it():
    async with talking() as talk:
        talk.engine.answers = False
        await talk.say(drawn("a"), messages.Hold(limb="1", share=1.0, depth=4.0), drawn("b"))
        assert talk.session.document.edits.held == {} and talk.strokes() == ["a", "b"]
        talk.engine.answer(*talk.engine.made[-1])
        await talk.hear()
        assert 1 in talk.session.document.edits.held and talk.all("trouble") == []


@run
async def test_an_edit_of_a_limb_that_a_hurried_tree_shows_is_done_at_once():
    async with talking(Document(strokes={"a": Stroke("a", [[0, 0], [0, 9]])})) as talk:
        talk.engine.answers = False
        await talk.say(drawn("b"))
        rough = settled(talk.session.document, depth=3.0)
        talk.session.desk.on_outcome(Outcome(2, frame(2, phase="quick"), rough=rough))
        known = talk.session.document.settled
        await talk.say(messages.Flip(limb="2"))
        document = talk.session.document
        assert document.edits.held[2].depth.tolist() == [0, -3] and document.settled.limbs[1] is known.limbs[1] and talk.last("changed")["undo"] == "flip"
        await talk.say(messages.Undo(), messages.Undo())
        assert talk.session.document.settled is known and talk.strokes() == ["a"]


@run
async def test_depths_of_a_hurried_tree_whose_stroke_is_gone_are_no_limb():
    async with talking(Document(strokes={"a": Stroke("a", [[0, 0], [0, 9]])})) as talk:
        talk.engine.answers = False
        await talk.say(drawn("b"))
        talk.session.desk.on_outcome(Outcome(2, frame(2, phase="quick"), rough=settled(talk.session.document)))
        await talk.say(messages.Undo(), messages.Flip(limb="2"))
        assert talk.session.document.edits.held == {} and talk.session.document.settled.limbs.keys() == {1}


@run
async def test_an_undrawn_limb_is_deleted_and_strokes_are_drawn_while_the_whole_tree_is_never_ready():
    async with talking(Document(strokes={"a": Stroke("a", [[0, 0], [0, 9]])})) as talk:
        talk.engine.answers = False
        await talk.say(drawn("b"), messages.Delete(limb="1001"), messages.Lock(limb="1002", on=True), drawn("c"))
        assert talk.strokes() == ["a", "b", "c"] and {edit["limb"] for edit in talk.last("changed")["edits"] or ()} <= {"1001", "1002"}
        assert set(talk.session.document.edits.cleared) == {1001} and set(talk.session.document.edits.adopted) == {1002}


class Searching(FakeEngine):
    """Finds an undrawn limb only when it is told to."""

    def __init__(self):
        super().__init__()
        self.found = asyncio.Event()

    async def find(self, document, limb):
        await self.found.wait()
        return await super().find(document, limb)


@run
async def test_nobody_waits_for_a_limb_that_is_being_looked_for():
    async with talking(Document(strokes={"a": Stroke("a", [[0, 0], [0, 9]])}), engine=Searching()) as talk:
        await talk.say(messages.Delete(limb="1001"), drawn("b"), messages.Choose(options={"seed": 5}), messages.Flip(limb="2"))
        assert talk.strokes() == ["a", "b"] and talk.session.document.seed == 5 and 2 in talk.session.document.edits.held
        talk.engine.found.set()
        await talk.hear()
        assert set(talk.session.document.edits.cleared) == {1001} and talk.last("changed")["undo"] == "delete"


@run
async def test_undo_takes_back_an_edit_that_is_not_done_yet_but_only_if_it_was_the_last():
    async with talking(Document(strokes={"a": Stroke("a", [[0, 0], [0, 9]])}), engine=Searching()) as talk:
        await talk.say(messages.Delete(limb="1001"), messages.Undo())
        talk.engine.found.set()
        await talk.hear()
        assert not talk.session.document.edits and talk.strokes() == ["a"]
        talk.engine.found.clear()
        await talk.say(messages.Delete(limb="1001"), drawn("b"), messages.Undo())
        assert talk.strokes() == ["a"]
        talk.engine.found.set()
        await talk.hear()
        assert set(talk.session.document.edits.cleared) == {1001}


@run
async def test_edits_that_wait_are_no_growing_heap():
    async with talking(Document(strokes={"a": Stroke("a", [[0, 0], [0, 9]])}), engine=Searching()) as talk:
        await talk.say(*(messages.Delete(limb=str(1000 + k)) for k in range(40)))
        assert talk.last("trouble")["message"] == "Too many edits wait for the tree." and len(talk.desk.pending) == 32


@run
async def test_a_drag_is_shown_and_not_kept():
    async with talking(Document(strokes={"a": Stroke("a", [[0, 0], [0, 9]])})) as talk:
        hold = messages.Hold(limb="1", share=1.0, depth=4.0, live=True)
        await talk.say(hold, messages.Sketching(stroke=stroke("x")), messages.Sketching(), messages.Glance(template="oak"), messages.Glance(), messages.Cancel())
        assert [ghost[1] for ghost in talk.engine.ghosts] == [hold, None, None] and talk.session.revision == 1
        assert talk.engine.glances[0].reading.template == "oak" and talk.engine.glances[1] is None and talk.engine.cancelled == 1


@run
async def test_other_readings_are_picked_from_until_the_drawing_is_another():
    async with talking(Document(strokes={"a": Stroke("a", [[0, 0], [0, 9]])})) as talk:
        await talk.say(messages.Pick(reading=1, revision=1))
        assert talk.last("trouble")["message"] == "Those readings are not the newest."
        await talk.say(messages.Readings())
        revision = talk.last("alternatives")["revision"]
        await talk.say(messages.Pick(reading=5, revision=revision))
        assert talk.last("trouble")["message"] == "There are 2 readings."
        await talk.say(messages.Pick(reading=1, revision=revision))
        assert talk.engine.made[-1][1].settled.limbs[1].depth.tolist() == [0, 9] and talk.last("changed")["undo"] == "reading"
        await talk.say(messages.Pick(reading=0, revision=revision), drawn("b"), messages.Pick(reading=1, revision=revision))
        assert talk.last("trouble")["message"] == "The drawing is another since those readings were made."


# What comes of it


@run
async def test_settled_depths_are_kept_without_a_step():
    async with talking() as talk:
        await talk.say(drawn("a"))
        assert talk.session.revision == 2 and 1 in talk.session.document.settled.limbs and talk.last("changed")["undo"] == "branch"


@run
async def test_depths_of_before_a_step_that_set_them_are_not_taken():
    async with talking(Document(strokes={"a": Stroke("a", [[0, 0], [0, 9]])})) as talk:
        talk.engine.answers = False
        await talk.say(messages.Mirror())
        flipped = talk.session.document.settled
        talk.session.desk.on_outcome(Outcome(1, frame(1), settled=settled(talk.session.document)))
        assert talk.session.document.settled is flipped


@run
async def test_depths_that_are_no_others_stay_the_same_objects():
    async with talking(Document(strokes={"a": Stroke("a", [[0, 0], [0, 9]])})) as talk:
        before = talk.session.document.settled
        talk.session.desk.on_outcome(Outcome(1, frame(1), settled=settled(talk.session.document)))
        assert talk.session.document.settled is before


@run
async def test_a_page_that_joins_late_is_told_what_was_found():
    async with talking() as talk:
        talk.session.desk.on_outcome(Outcome(1, messages.Matches(revision=1, used="oak", ranked=[])))
        talk.session.desk.on_outcome(Outcome(1, messages.Read(revision=1, marks=[], roles={}, warnings=["w"])))
        other = Talk(talk.session)
        await other.say(messages.Hello(version=messages.VERSION))
        assert other.last("matches")["used"] == "oak" and other.last("read")["warnings"] == ["w"] and other.last("working")["state"] == "idle"


@run
async def test_a_page_whose_sending_fails_is_let_go():
    async with talking() as talk:

        def broken(said):
            raise OSError("gone")

        page = talk.session.join(broken)
        await talk.session.take(page, messages.Hello(version=messages.VERSION))
        await talk.say(drawn("a"))
        assert page not in talk.desk._pages and talk.strokes() == ["a"]


@run
async def test_thousands_of_rapid_strokes_share_what_they_do_not_change():
    async with talking() as talk:
        talk.engine.answers = False
        for k in range(2_000):
            await talk.session.take(talk.page, drawn(f"s{k}"))
        await talk.hear()
        assert len(talk.session.document.strokes) == 2_000 and len(talk.strokes()) == 2_000
        steps = talk.desk.history._back
        assert len(steps) == 2_000 and all(not step.change.put and len(step.change.gone) == 1 and step.change.order is None for step in steps)


def test_a_zero_is_no_negative_zero_on_the_way():
    from sketchtree.studio.wire import flipped

    assert not np.signbit(flipped(np.zeros((1, 2)))).any()


def test_a_fault_of_the_program_is_told_and_the_page_keeps_its_line(monkeypatch, capsys):
    async def test():
        async with talking() as talk:

            def faulty(*_, **__):
                raise ZeroDivisionError("a fault")

            monkeypatch.setattr(operations, "mirror", faulty)
            await talk.say(messages.Mirror(), drawn("a"))
            trouble = talk.last("trouble")
            assert (trouble["message"], trouble["remedy"], trouble["about"]) == (
                "Something went wrong in the program; nothing of the drawing is different.", "The terminal that runs the studio has the details.", "program",
            )  # fmt: skip
            assert talk.strokes() == ["a"]

    asyncio.run(test())
    assert "ZeroDivisionError: a fault" in capsys.readouterr().err
