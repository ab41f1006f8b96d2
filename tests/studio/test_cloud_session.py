"""Points behind the page, as a session has them: laid there, moved, hidden, taken away, and all of it undone, recovered, or asked about."""

import asyncio
import json

import numpy as np
import pytest
from fake_engine import FakeEngine
from talking import drawn, talking

from sketchtree.editing.document import Document
from sketchtree.editing.laid_cloud import CloudChoices, LaidCloud
from sketchtree.editing.settled import Settled
from sketchtree.errors import SeveralTrees, SketchError
from sketchtree.options import TreeOptions
from sketchtree.sketch.strokes import Stroke
from sketchtree.studio import filing, journal_lines, messages
from sketchtree.studio.cloud_files import is_cloud
from sketchtree.studio.exports import Export, command_line
from sketchtree.studio.growth import Grown
from sketchtree.studio.recovery import journal_of

CLOUD = LaidCloud(np.array([(0, 0, 0), (0, 4, 1)], "<f4").tobytes(), False, 0.0, 0.0, 100.0, 0.1, ("3 points were there twice; they were merged.",))
TRUNK = Stroke("trunk", np.array([(20.0, 10.0), (20.0, 210.0)]))


class WithClouds(FakeEngine):
    """Reads every file that is called so as points; `several` stand in `wood.ply`."""

    def __init__(self):
        super().__init__()
        self.readings = []

    async def read(self, data, name, cloud=messages.CloudReading()):
        self.readings.append(cloud)
        if name == "wood.ply" and cloud.tree is None:
            raise SeveralTrees("2 trees stand in wood.ply.", remedy="Choose one of them.", trees=("9.0 m high, at x 1.0, z 2.0", "4.0 m high, at x 5.0, z 2.0"))
        return Document.blank(cloud=CLOUD) if name.endswith(".ply") else await super().read(data, name, cloud)

    async def with_traced(self, document):
        return document.replace(strokes={"trunk": TRUNK}, settled=Settled(asked="measured"), points=document.points.drawn)


def scene(document=None, **options):
    return talking(document or Document(cloud=CLOUD), engine=WithClouds(), **options)


def test_a_page_is_told_where_they_lie_and_how_many():
    async def test():
        async with scene() as talk:
            said = talk.last("changed")
            assert said["cloud"] == {
                "digest": CLOUD.digest, "x": 0.0, "y": 0.0, "unit": 100.0, "count": 2, "coloured": False, "height": 4.0, "remarks": list(CLOUD.remarks),
            }  # fmt: skip
            assert said["points"] == {"shown": True, "size": 2.0, "traced": False, "turn": 0.0}
            assert talk.session.desk.clouds[CLOUD.digest].points == CLOUD.points

    asyncio.run(test())


def test_an_uploaded_cloud_lies_behind_the_drawing_that_is_there_and_undo_takes_it_away():
    async def test():
        async with scene(Document({"trunk": TRUNK})) as talk:
            await filing.lay(talk.session.desk, b"", "scan.ply")
            await talk.hear()
            cloud = talk.session.document.cloud
            assert (cloud.x, cloud.y, cloud.height * cloud.unit) == (20, 10, 200) and "trunk" in talk.session.document.strokes
            assert talk.engine.made[-1][1].cloud == cloud
            await talk.say(messages.Undo())
            assert talk.session.document.cloud is None and talk.last("changed")["cloud"] is None and talk.last("changed")["cloud_changed"]

    asyncio.run(test())


def test_what_is_no_cloud_is_not_laid_behind_a_drawing():
    async def test():
        async with scene(Document({"trunk": TRUNK})) as talk:
            with pytest.raises(SketchError, match="^sketch.svg is no point cloud. Give PLY, LAS, LAZ, XYZ, NPZ or NPY.$"):
                await filing.lay(talk.session.desk, b"", "sketch.svg")

    asyncio.run(test())


def test_hiding_them_or_their_size_makes_no_other_tree_but_moving_them_does():
    async def test():
        async with scene(Document({"trunk": TRUNK}, cloud=CLOUD)) as talk:
            await talk.say(messages.ChoosePoints(points=messages.Points(shown=False, size=3.0)))
            assert len(talk.engine.made) == 1 and talk.session.document.points == CloudChoices(False, 3.0)
            moved = messages.Cloud(digest=CLOUD.digest, x=5.0, y=-7.0, unit=50.0)
            await talk.say(messages.SetCloud(cloud=moved))
            assert len(talk.engine.made) == 2 and talk.session.document.cloud.place == (5.0, 7.0, 50.0)
            await talk.say(messages.SetCloud(cloud=messages.Cloud(digest="0" * 32, x=0, y=0, unit=1)))
            assert talk.last("trouble")["message"] == "Those points are not here any more."

    asyncio.run(test())


def test_tracing_is_a_step_that_undo_takes_back_and_taking_them_away_ends_it():
    async def test():
        async with scene() as talk:
            await talk.say(messages.ChoosePoints(points=messages.Points(traced=True), label="trace points"))
            assert talk.engine.grows[-1][1].points.traced and talk.last("changed")["undo"] == "trace points"
            await talk.say(messages.SetCloud())
            assert not talk.session.document.points.traced
            await talk.say(messages.Undo(), messages.Undo())
            assert talk.session.document.cloud is not None and not talk.session.document.points.traced

    asyncio.run(test())


def test_one_tree_at_a_time_stands_in_the_place_of_the_strokes():
    from sketchtree.editing.document import Underlay

    async def test():
        photo = Underlay(b"\x89PNG" + bytes(40), 0, 0, 10, 10, photo=True)
        async with scene(Document(cloud=CLOUD, underlay=photo)) as talk:
            await talk.say(messages.ChoosePoints(points=messages.Points(traced=True)))
            assert not talk.session.document.underlay.photo
            await talk.say(messages.SetUnderlay(underlay=messages.Underlay(**talk.last("changed")["underlay"] | {"photo": True})))
            assert talk.session.document.underlay.photo and not talk.session.document.points.traced

    asyncio.run(test())


def test_traced_limbs_become_strokes_with_the_depths_of_the_points():
    async def test():
        async with scene(Document(cloud=CLOUD, points=CloudChoices(traced=True))) as talk:
            await talk.say(messages.UseTraced())
            await asyncio.sleep(0.01)
            document = talk.session.document
            assert list(document.strokes) == ["trunk"] and document.cloud is CLOUD and not document.points.traced
            assert talk.engine.made[-1][1].settled.asked == "measured"

    asyncio.run(test())


def test_which_of_several_trees_is_asked(tmp_path):
    from sketchtree.studio.folder import Folder

    (tmp_path / "wood.ply").write_bytes(b"ply\n")

    async def test():
        async with scene(Document({"trunk": TRUNK}), folder=Folder(tmp_path)) as talk:
            await talk.say(messages.Open(name="wood.ply"))
            assert talk.last("several") == {"type": "several", "name": "wood.ply", "trees": ["9.0 m high, at x 1.0, z 2.0", "4.0 m high, at x 5.0, z 2.0"]}
            assert talk.session.document.cloud is None and not talk.all("trouble")
            await talk.say(messages.Open(name="wood.ply", cloud=messages.CloudReading(tree=2)))
            assert talk.session.document.cloud == CLOUD

    asyncio.run(test())


def test_it_is_read_as_it_was_asked_and_a_page_that_waits_is_answered_where_nothing_is_different(tmp_path):
    from sketchtree.studio.folder import Folder

    (tmp_path / "scan.ply").write_bytes(b"ply\n")
    wanted = messages.CloudReading(up="z", height=3.0)

    async def test():
        async with scene(folder=Folder(tmp_path)) as talk:
            await talk.say(messages.Open(name="scan.ply", cloud=wanted))
            assert talk.engine.readings == [wanted]
            told = len(talk.all("changed"))
            await talk.say(messages.Open(name="scan.ply", cloud=wanted))
            assert len(talk.all("changed")) == told + 1

    asyncio.run(test())


def test_over_points_the_tree_is_not_mirrored_until_they_are_taken_away():
    async def test():
        async with scene(Document({"trunk": TRUNK}, cloud=CLOUD)) as talk:
            await talk.say(messages.Mirror())
            assert talk.last("trouble")["message"] == "The points behind the drawing say on which side each limb is: a mirrored tree would lie beside them."
            assert talk.last("trouble")["remedy"] == "Flip single limbs, or take the points away first."
            before = talk.session.document.settled
            await talk.say(messages.SetCloud(), messages.Mirror())
            assert talk.session.document.settled is not before and talk.last("changed")["undo"] == "mirror"

    asyncio.run(test())


def test_the_side_that_the_page_faces_is_remembered_and_is_no_step(tmp_path, monkeypatch):
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path))

    async def test():
        async with scene(Document(cloud=CLOUD), journal=journal_of(None)) as talk:
            await talk.say(messages.Turned(turn=15))
            assert talk.session.document.points == CloudChoices(turn=15) and talk.desk.revision == 1 and talk.last("changed")["undo"] is None
            await talk.say(drawn("a"), messages.Turned(turn=-75))
            late = type(talk)(talk.session)
            await late.say(messages.Hello(version=messages.VERSION))
            assert late.last("changed")["points"]["turn"] == -75 and len(talk.engine.made) == 2

    asyncio.run(test())
    journal = journal_of(None)
    found = journal.play()
    journal.close()
    assert found.history.document.points.turn == -75 and found.history.undo() and not found.history.undo()


def test_without_points_no_side_is_remembered():
    async def test():
        async with scene(Document({"trunk": TRUNK})) as talk:
            await talk.say(messages.Turned(turn=15))
            assert talk.session.document.points == CloudChoices()

    asyncio.run(test())


def test_they_come_back_after_a_crash_with_the_steps(tmp_path, monkeypatch):
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path))

    async def test():
        async with scene(Document(name="scan"), journal=journal_of(None)) as talk:
            await filing.open_bytes(talk.session.desk, b"", "scan.ply")
            await talk.say(drawn("a"), messages.ChoosePoints(points=messages.Points(shown=False)))

    asyncio.run(test())
    journal = journal_of(None)
    found = journal.play()
    journal.close()
    assert found.history.document.cloud == CLOUD and found.history.document.points == CloudChoices(shown=False)
    assert [found.history.undo() for _ in range(4)] == [True, True, True, False] and found.history.document.cloud is None


def test_the_journal_has_their_bytes_once(tmp_path, monkeypatch):
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path))

    async def test():
        async with scene(journal=journal_of(None)) as talk:
            await talk.say(drawn("a"), drawn("b"), messages.SetCloud(cloud=messages.Cloud(digest=CLOUD.digest, x=1, y=1, unit=2)))

    asyncio.run(test())
    lines = [journal_lines.decode(line) for line in (tmp_path / "untitled.jsonl").read_bytes().splitlines()]
    assert [type(line).__name__ for line in lines].count("Picture") == 1


def test_several_trees_of_an_upload_are_told_with_the_refusal():
    from sketchtree.studio.server import _cannot

    error = SeveralTrees("2 trees stand in wood.ply.", remedy="Choose one of them.", trees=("one", "other"))
    answer = asyncio.run(_cannot(None, error))
    assert answer.status_code == 422 and json.loads(answer.body) == {"message": error.message, "remedy": error.remedy, "trees": ["one", "other"]}


@pytest.mark.parametrize(
    ("data", "name", "is_one"),
    [(b"ply\nformat", "a", True), (b"LASF", "a.bin", True), (b"1 2 3", "a.xyz", True), (b"PK\x03\x04", "a.npz", True), (b"PK\x03\x04", "a.zip", False), (b"<svg/>", "a.svg", False)],
)  # fmt: skip
def test_clouds_are_told_by_their_bytes_or_their_names(data, name, is_one):
    assert is_cloud(data, name) == is_one


@pytest.mark.parametrize(
    ("traced", "export", "said"),
    [
        (True, {"tree": "photo"}, "sketchtree build scan.sketchtree -o scan.glb"),
        (True, {"tree": "drawn"}, "sketchtree build scan.sketchtree -o scan.glb --as-drawn --season autumn"),
        (False, {"tree": "drawn"}, "sketchtree build scan.sketchtree -o scan.glb --season autumn"),
        (True, {"tree": "photo", "growth": Grown()}, "sketchtree grow scan.sketchtree -o scan.glb"),
    ],
)
def test_the_command_line_makes_the_tree_that_is_shown(traced, export, said):
    document = Document({"trunk": TRUNK}, cloud=CLOUD, points=CloudChoices(traced=traced), tree=TreeOptions(season="autumn"), name="scan")
    assert command_line(document, Export(format=".glb", **export)) == said
