"""A cell of a notebook: drawn on by page and Python alike, read back as a `Sketch`, made into a tree."""

import importlib
import sys
import threading
import time

import numpy as np
import pytest

pytest.importorskip("anywidget", reason="the studio is not installed: pip install 'sketchtree[studio]'")

from fake_engine import FakeEngine

from sketchtree.errors import OptionError, SketchTreeError
from sketchtree.sketch.strokes import Sketch, Stroke
from sketchtree.studio import built, messages, widget

LINE = {"type": "strokes", "label": "branch", "put": [{"id": "one", "kind": "branch", "xy": [0, 0, 0, -100]}]}


@pytest.fixture(autouse=True)
def page(tmp_path, monkeypatch):
    """A built page, whatever is installed."""
    (tmp_path / "widget.js").write_text("export default { render() {} };")
    monkeypatch.setattr(widget, "widget_file", lambda: built.widget_file(tmp_path))


@pytest.fixture
def drawing():
    """A widget whose messages to the page are kept in `sent`."""
    made = widget.DrawingWidget(engine=FakeEngine)
    made.sent = []
    made.send = lambda content, buffers=(): made.sent.append((content, list(buffers)))
    yield made
    made.close()


def says(drawing, *requests):
    """As if the page said these, and the program had nothing more to do."""
    for request in requests:
        drawing._handle_custom_msg({"say": request}, [])


def until(holds):
    end = time.monotonic() + 20
    while not holds():
        assert time.monotonic() < end, "it did not come"
        time.sleep(0.005)


HELLO = {"type": "hello", "version": messages.VERSION}


def test_what_is_drawn_on_the_page_is_a_sketch_with_y_up(drawing):
    says(drawing, HELLO, LINE)
    until(lambda: len(drawing.sketch) == 1)
    stroke = drawing.sketch.strokes[0]
    assert (stroke.id, stroke.kind) == ("one", "branch")
    np.testing.assert_array_equal(stroke.points, [[0, 0], [0, 100]])


def test_a_line_from_python_is_told_to_the_page(drawing):
    says(drawing, HELLO)
    name = drawing.add([(0, 0), (5, 90)])
    assert [stroke.id for stroke in drawing.sketch.strokes] == [name]
    until(lambda: any(content.get("say", {}).get("put") for content, _ in drawing.sent))
    put = next(content["say"]["put"] for content, _ in drawing.sent if content.get("say", {}).get("put"))
    assert put[0]["id"] == name and put[0]["xy"] == [0, 0, 5, -90], "y down on the wire"


def test_it_works_before_any_page_shows_it_and_starts_no_process():
    made = widget.DrawingWidget(engine=FakeEngine)
    made.add([(0, 0), (0, 50)])
    assert len(made.sketch) == 1
    assert not made._cell._session.desk.engine.running
    made.close()


def test_a_page_that_shows_it_starts_the_engine_and_closing_ends_it(drawing):
    engine = drawing._cell._session.desk.engine
    says(drawing, HELLO)
    until(lambda: engine.running)
    drawing.close()
    assert not engine.running
    assert not any(thread.name == "sketchtree-cell" for thread in threading.enumerate())


def test_changes_are_told_as_a_trait(drawing):
    seen = []
    drawing.observe(lambda change: seen.append(change["new"]), "revision")
    drawing.add([(0, 0), (0, 50)])
    assert seen == [drawing.revision]
    says(drawing, HELLO, LINE)
    until(lambda: drawing.revision > seen[0])


def test_frames_go_to_the_page_as_bytes(drawing):
    says(drawing, HELLO, LINE)
    until(lambda: any(content == {"frame": True} for content, _ in drawing.sent))
    _, buffers = next(message for message in drawing.sent if message[0] == {"frame": True})
    assert isinstance(buffers[0], bytes) and int.from_bytes(buffers[0][:4], "little") < len(buffers[0])


def test_pictures_come_by_message_and_a_missing_one_is_told(drawing):
    says(drawing, HELLO)
    drawing._handle_custom_msg({"fetch": 1, "path": "/texture/../../etc/color.png"}, [])
    until(lambda: ({"fetched": 1}, []) in drawing.sent)


def test_undo_redo_and_options_are_python_s_too(drawing):
    drawing.add([(0, 0), (0, 50)])
    drawing.undo()
    assert len(drawing.sketch) == 0
    drawing.redo()
    assert len(drawing.sketch) == 1
    drawing.choose(template="silver_birch", seed=3)
    assert (drawing.document.reading.template, drawing.document.seed) == ("silver_birch", 3)
    with pytest.raises(OptionError, match="There is no option of that name. The options are template,"):
        drawing.choose(colour="red")


def test_a_line_without_a_point_is_refused(drawing):
    with pytest.raises(SketchTreeError, match=r"^A line without a point can't be drawn\. Give at least one \(x, y\)\.$"):
        drawing.add([])


def test_what_is_no_message_is_told_and_nothing_else_happens(drawing):
    says(drawing, HELLO, {"type": "nonsense"})
    drawing._handle_custom_msg("nonsense", [])
    until(lambda: sum(content.get("say", {}).get("type") == "trouble" for content, _ in drawing.sent) == 2)
    assert drawing.trouble.startswith("A message of the page can't be read: ") and drawing.trouble.endswith(" Run the cell again.")
    assert len(drawing.sketch) == 0


def test_it_begins_with_a_sketch_and_ids_that_the_page_can_say():
    strokes = (Stroke("a" * 80, np.array([[0.0, 0.0], [0.0, 100.0]])), Stroke("b", np.array([[0.0, 40.0], [30.0, 70.0]])))
    made = widget.DrawingWidget(Sketch(strokes), engine=FakeEngine)
    assert [stroke.id for stroke in made.sketch.strokes] == ["stroke-1", "b"]
    made.close()
    assert len(made.sketch) == 2, "what was drawn stays when the page is gone"


def test_without_a_built_page_it_says_what_to_do(monkeypatch, tmp_path):
    monkeypatch.setattr(widget, "widget_file", lambda: built.widget_file(tmp_path / "nothing"))
    with pytest.raises(SketchTreeError, match="The studio's page is not in this installation"):
        widget.draw(engine=FakeEngine)


def test_without_the_extra_it_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "anywidget", None)
    monkeypatch.delitem(sys.modules, "sketchtree.studio.widget")
    with pytest.raises(OptionError) as told:
        importlib.import_module("sketchtree.studio.widget")
    assert str(told.value) == "Drawing in a notebook needs anywidget. Install it: pip install 'sketchtree[studio]'."


@pytest.mark.slow
def test_the_tree_keeps_what_was_done_by_hand(drawing):
    drawing.add([(0, 0), (0, 200), (2, 400)])
    branch = drawing.add([(0, 200), (80, 260), (120, 330)])
    tree = drawing.tree
    assert tree.skeleton.segment_count > 0 and len(tree.meshes) >= 1
    assert branch in {stroke.id for stroke in drawing.sketch.strokes}
