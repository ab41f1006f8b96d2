"""Draw a tree in a cell of a notebook.

    drawing = draw()            a page and a tree appear under the cell; `draw("oak.svg")` begins with a drawing
    drawing.sketch              what is drawn now
    drawing.tree                the tree of it, as `sketch_to_tree` makes it: what was done by hand is kept
    drawing.observe(f, "revision")      f is called whenever the drawing changes

The page is that of the studio (`sketchtree studio`), so all that can be drawn and edited there can be here. Needs the extra `studio`.
"""

import asyncio
import weakref
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from sketchtree.errors import OptionError, SketchTreeError

try:
    import anywidget
    import msgspec  # noqa: F401
    import traitlets
except ImportError as error:
    raise OptionError(f"Drawing in a notebook needs {error.name}.", remedy="Install it: pip install 'sketchtree[studio]'.") from error

from sketchtree.editing.document import Document
from sketchtree.editing.project import hand_work
from sketchtree.sketch.strokes import Sketch
from sketchtree.studio import messages
from sketchtree.studio.built import widget_file
from sketchtree.studio.cell import Cell
from sketchtree.studio.engine import Engine
from sketchtree.studio.ids import fitting


def crew() -> Engine:
    """The processes that make trees for the studio."""
    from sketchtree.studio.crew import Crew

    return Crew(None)


class DrawingWidget(anywidget.AnyWidget):
    """A page to draw on and the tree that follows. Raises SketchTreeError where the page was not built, or `sketch` can't be read.

    `height` is that of the cell in CSS pixels. `revision` rises with every change of the drawing, `segments` and `leaves` are those of the tree on screen
    (0 until a page shows it)."""

    height = traitlets.Int(480, min=320, max=4000).tag(sync=True)
    revision = traitlets.Int(0)
    segments = traitlets.Int(0)
    leaves = traitlets.Int(0)
    trouble = traitlets.Unicode("")  # what can't be done, and what to do; empty: all is well
    _esm = traitlets.Unicode().tag(sync=True)
    _ender: weakref.finalize | None = None  # ends the session, at the latest with the program

    def __init__(self, sketch: Sketch | Document | str | Path | None = None, *, engine: Callable[[], Engine] = crew, **traits):
        document = document_of(sketch)
        source = widget_file().read_text("utf-8")
        super().__init__(_esm=source, **traits)
        self._home = _running_loop()
        self._cell = Cell(engine, document, self._say, self._heard_by_page)
        self.revision = self._cell.revision
        self.on_msg(lambda _, content, buffers: self._cell.hear(content))
        self._ender = weakref.finalize(self, self._cell.end)

    @property
    def document(self) -> Document:
        """The drawing, what was done by hand, and the options."""
        return self._cell.document

    @property
    def sketch(self) -> Sketch:
        """What is drawn now; y up."""
        return self.document.sketch

    @property
    def tree(self):
        """The tree of the drawing as it is now (`TreeModel`), made here and now: some seconds. Raises SketchTreeError."""
        return tree_of(self.document)

    def add(self, points: Iterable[tuple[float, float]], kind: str = "branch", *, id: str | None = None, closed: bool = False) -> str:
        """Draw a line from Python: points in the sketch's units, y up. Gives its id. Raises SketchTreeError."""
        name = id or _free(self.document)
        xy = [coordinate for x, y in points for coordinate in (float(x), 0.0 - float(y))]
        if len(xy) < 2:
            raise SketchTreeError("A line without a point can't be drawn.", remedy="Give at least one (x, y).")
        self._ask(messages.Strokes(label=kind, put=[messages.Stroke(id=name, kind=kind, xy=xy, closed=closed)]))
        return name

    def choose(self, **options) -> None:
        """Other options: template, season, seed … as in `messages.Options`. Raises OptionError."""
        self._ask(messages.Choose(options=options))

    def undo(self) -> None:
        """One step back."""
        self._ask(messages.Undo())

    def redo(self) -> None:
        """One step on."""
        self._ask(messages.Redo())

    def close(self) -> None:
        """Away with the page, and with the processes that make its tree; `sketch` and `tree` stay."""
        if self._ender is not None:
            self._ender()
        super().close()

    def _ask(self, request: messages.Request) -> None:
        self._cell.ask(request)
        self.revision = self._cell.revision

    # From the session's thread to that of the notebook

    def _say(self, content: dict, buffers: list[bytes]) -> None:
        self._at_home(lambda: self.send(content, buffers))

    def _heard_by_page(self, event: dict) -> None:
        self._at_home(lambda: self._take(event))

    def _take(self, event: dict) -> None:
        match event["type"]:
            case "changed" if event["revision"] > self.revision:
                self.revision, self.trouble = event["revision"], ""
            case "tree" if event["phase"] != "glance":
                self.segments, self.leaves = event.get("segments", 0), event.get("leaves", 0)
            case "trouble":
                self.trouble = f"{event['message']} {event['remedy']}"

    def _at_home(self, work: Callable[[], Any]) -> None:
        if self._home is not None and not self._home.is_closed():
            self._home.call_soon_threadsafe(work)
            return
        try:
            work()
        except Exception:  # a listener's fault must not end the session
            self.log.exception("A listener of the drawing failed.")


def draw(sketch: Sketch | Document | str | Path | None = None, **traits) -> DrawingWidget:
    """A page to draw on, under the cell; begins with `sketch` if given."""
    return DrawingWidget(sketch, **traits)


def document_of(sketch: Sketch | Document | str | Path | None) -> Document:
    """What the page begins with. Raises SketchTreeError."""
    if sketch is None:
        return Document.blank()
    if isinstance(sketch, Document):
        return sketch
    by_hand = None
    if not isinstance(sketch, Sketch):
        from sketchtree.sketch.formats import read_sketch

        by_hand = hand_work(sketch)
        sketch = read_sketch(sketch)
    document = Document(strokes={stroke.id: stroke for stroke in sketch.strokes}, name=sketch.name, units=sketch.units, page=sketch.page)
    return fitting(document if by_hand is None else document.replace(edits=by_hand[0], settled=by_hand[1]))


def tree_of(document: Document):
    """The tree of a document (`TreeModel`), with what was done by hand. Raises SketchTreeError."""
    from sketchtree.keys import root_key
    from sketchtree.pipeline import complete, draw_out

    key = root_key(document.seed)
    drawn = draw_out(document.sketch, key=key, options=document.reading, edits=document.edits, settled=document.settled, cloud=document.cloud)
    return complete(drawn, key=key, options=document.tree)


def _free(document: Document) -> str:
    """An id that no stroke has."""
    number = len(document.strokes) + 1
    while f"line-{number}" in document.strokes:
        number += 1
    return f"line-{number}"


def _running_loop() -> asyncio.AbstractEventLoop | None:
    try:
        return asyncio.get_running_loop()
    except RuntimeError:
        return None
