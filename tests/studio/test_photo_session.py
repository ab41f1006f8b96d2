"""A photo under the page, as a session has it: what is asked of the engine, what pages are told, and what can be undone."""

import asyncio
import io

import painted_photo as painted
from PIL import Image
from talking import Talk, drawn, talking

from sketchtree.editing.document import Document
from sketchtree.studio import filing, messages
from sketchtree.studio.recovery import journal_of
from sketchtree.studio.underlays import placed

TRUNK = painted.mark("trunk", painted.TRUNK)
PICTURE = b"\x89PNG" + bytes(100)


def page_with(*strokes, is_photo=True):
    return painted.document(*strokes, picture=PICTURE, is_photo=is_photo)


def switched(talk, on):
    said = talk.last("changed")["underlay"] or talk.all("changed")[0]["underlay"]
    return talk.say(messages.SetUnderlay(underlay=messages.Underlay(**said | {"photo": on})))


def test_a_picture_is_a_photo_when_a_page_says_so_and_undo_takes_it_back():
    async def test():
        async with talking(page_with(TRUNK, is_photo=False)) as talk:
            assert talk.all("traced") == [] and not talk.last("changed")["underlay"]["photo"]
            await switched(talk, True)
            assert talk.session.document.underlay.photo and talk.last("changed")["underlay"]["photo"]
            assert talk.last("traced") == {"type": "traced", "revision": 2, "trees": [], "remark": "1 strokes", "waits": False}
            await talk.say(messages.Undo())
            assert not talk.session.document.underlay.photo and talk.engine.traced[-1][1] is talk.session.document

    asyncio.run(test())


def test_every_stroke_is_traced_and_the_tree_is_made_as_ever():
    async def test():
        async with talking(page_with(TRUNK)) as talk:
            await talk.say(drawn("a"), drawn(gone=("trunk",), label="erase"), messages.Undo())
            assert [event["remark"] for event in talk.all("traced")][-3:] == ["2 strokes", "1 strokes", "2 strokes"]
            assert [revision for revision, _ in talk.engine.traced] == [1, 2, 3, 4] == [revision for revision, _ in talk.engine.made]
            await talk.say(messages.Choose(options={"season": "autumn"}))
            assert len(talk.engine.traced) == 4
            await talk.say(messages.Choose(options={"seed": 7}))
            assert len(talk.engine.traced) == 5

    asyncio.run(test())


def test_a_page_that_joins_later_is_told_what_shows():
    async def test():
        async with talking(page_with(TRUNK)) as talk:
            other = Talk(talk.session)
            await other.say(messages.Hello(version=messages.VERSION))
            assert other.last("traced") == talk.last("traced")

    asyncio.run(test())


def test_traced_limbs_are_taken_over_as_one_step():
    async def test():
        async with talking(page_with(TRUNK)) as talk:
            await talk.say(messages.UseTraced())
            assert list(talk.session.document.strokes) == ["limb"] == talk.strokes() and not talk.session.document.underlay.photo
            assert talk.last("changed")["undo"] == "traced limbs"
            await talk.say(messages.Undo())
            assert list(talk.session.document.strokes) == ["trunk"] == talk.strokes() and talk.session.document.underlay.photo

    asyncio.run(test())


def test_strokes_go_on_while_limbs_are_traced_and_those_of_the_newest_drawing_are_taken_over():
    async def test():
        async with talking(page_with(TRUNK)) as talk:
            asked, traced = [], asyncio.Event()
            taken_over = talk.engine.with_traced

            async def slowly(document):
                asked.append(list(document.strokes))
                await traced.wait()
                return await taken_over(document)

            talk.engine.with_traced = slowly
            await talk.say(messages.UseTraced(), drawn("a"))
            assert talk.strokes() == ["trunk", "a"] and asked == [["trunk"]]
            traced.set()
            await talk.hear()
            assert asked == [["trunk"], ["trunk", "a"]] and talk.strokes() == ["limb"] and talk.last("changed")["undo"] == "traced limbs"

    asyncio.run(test())


def test_what_is_being_taken_over_is_taken_back_by_undo_or_cancelled():
    async def test():
        async with talking(page_with(TRUNK)) as talk:

            async def never(document):
                await asyncio.Event().wait()

            talk.engine.with_traced = never
            for end in (messages.Undo(), messages.Cancel()):
                await talk.say(messages.UseTraced(), end)
                assert talk.strokes() == ["trunk"] and talk.session.document.underlay.photo
                assert not [task for task in talk.desk.tasks if task.get_name() == "traced"] and not talk.desk.pending

    asyncio.run(test())


def test_the_tree_grows_anew_with_every_choice_and_a_page_that_joins_later_has_it():
    async def test():
        async with talking(page_with(TRUNK)) as talk:
            await talk.say(messages.Choose(options={"leaf_size": 2.0, "library": "II,visible"}))
            photo = talk.engine.grows[-1][1].photo
            assert (photo.leaf_size, photo.library) == (2.0, ("II", "visible")) and len(talk.engine.made) == 1  # the drawing's tree is as it was
            assert talk.last("changed")["options"]["library"] == "II,visible"
            await talk.say(messages.Grow(), messages.Grow(on=False))
            assert talk.engine.grows[-1][2] and talk.engine.stopped == 1 and talk.last("growing")["state"] == "ready"
            other = Talk(talk.session)
            await other.say(messages.Hello(version=messages.VERSION))
            assert other.last("growing") == talk.last("growing") and any(b'"phase": "photo"' in one for one in other.told if isinstance(one, bytes))
            await talk.say(messages.Undo())
            assert talk.session.document.photo.leaf_size == 1.0

    asyncio.run(test())


def test_strokes_are_proposed_as_one_step_and_what_speaks_against_them_is_told():
    async def test():
        async with talking(page_with(TRUNK)) as talk:
            await talk.say(messages.Propose())
            assert talk.strokes() == ["crown", "trunk"] and talk.last("changed")["undo"] == "proposed strokes"
            assert talk.last("proposed") == {"type": "proposed", "revision": talk.session.revision, "why": "the trunk is hardly seen"}
            await talk.say(messages.Undo())
            assert talk.strokes() == ["trunk"]

    asyncio.run(test())


def test_a_library_of_nothing_is_refused():
    async def test():
        async with talking(page_with(TRUNK)) as talk:
            await talk.say(messages.Choose(options={"library": ""}))
            assert talk.last("trouble")["message"].startswith("The option library can't be that")

    asyncio.run(test())


def test_where_nothing_is_marked_nothing_is_taken_over():
    async def test():
        async with talking(page_with()) as talk:
            await talk.say(messages.UseTraced())
            assert talk.last("trouble")["message"] == "No stroke marks a limb in the photo." and talk.desk.history.undo_label is None

    asyncio.run(test())


def test_a_photo_has_an_empty_page_of_its_own_and_undo_brings_the_drawing_back():
    async def test():
        async with talking(page_with(TRUNK, is_photo=False)) as talk:
            await filing.open_photo(talk.desk, painted.photo(), "elm.png")
            await talk.hear()
            under = talk.last("changed")["underlay"]
            assert talk.strokes() == [] and talk.session.document.name == "elm" and under["photo"] and under["opacity"] == 1.0
            await talk.say(messages.Undo())
            assert talk.strokes() == ["trunk"] and not talk.session.document.underlay.photo

    asyncio.run(test())


def test_a_photo_that_a_phone_took_upright_lies_as_the_page_shows_it():
    data, image = io.BytesIO(), Image.new("RGB", (60, 40))
    image.getexif()[0x0112] = 6
    image.save(data, "JPEG", exif=image.getexif())
    under = placed(data.getvalue(), "phone.jpg", Document())
    assert under.height / under.width == 1.5


def test_it_is_found_again_after_a_crash(tmp_path, monkeypatch):
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path))

    async def test():
        journal = journal_of(None)
        async with talking(page_with(TRUNK, is_photo=False), journal=journal) as talk:
            await switched(talk, True)
            await talk.say(messages.Choose(options={"leaf_density": 0.5, "library": "I"}))

    asyncio.run(test())
    again = journal_of(None)
    document = again.play().history.document
    assert document.underlay.photo and document.photo.leaf_density == 0.5 and document.photo.library == ("I",)
    again.close()
