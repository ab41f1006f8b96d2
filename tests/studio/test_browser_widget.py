"""The widget's page in a real browser, with the widget itself behind it: what a notebook does between the two is done here by a few lines."""

import base64
import queue
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread

import pytest

pytest.importorskip("anywidget", reason="the studio is not installed: pip install 'sketchtree[studio]'")

from browser import Page, open_window, without
from fake_engine import FakeEngine

from sketchtree.studio import built
from sketchtree.studio.widget import DrawingWidget

HOST = """<!doctype html><meta charset="utf-8"><title>A notebook</title><link rel="icon" href="data:,">
<body style="margin: 0; font-family: serif"><h1>A cell</h1><div id="cell"></div>
<script type="module">
  import widget from "./widget.js";
  const listeners = new Set();
  const model = {
    get: (name) => ({ height: 480 })[name],
    on: (name, listener) => listeners.add(listener),
    off: (name, listener) => listeners.delete(listener),
    send: (content) => window.toKernel(content),
  };
  const bytes = (text) => new DataView(Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer);
  window.fromKernel = (content, buffers) => listeners.forEach((listener) => listener(content, buffers.map(bytes)));
  window.keysHeard = 0;
  addEventListener("keydown", () => { window.keysHeard += 1; });
  window.unmount = widget.render({ model, el: document.getElementById("cell") });
</script>"""


@pytest.fixture(scope="module")
def host(tmp_path_factory):
    """Serves the notebook's page and the widget's file."""
    if not (built.DIST / "widget.js").is_file():
        without("the page was not built")
    folder = tmp_path_factory.mktemp("notebook")
    (folder / "index.html").write_text(HOST)
    (folder / "widget.js").write_bytes((built.DIST / "widget.js").read_bytes())

    class Quiet(SimpleHTTPRequestHandler):
        def __init__(self, *arguments):
            super().__init__(*arguments, directory=folder)

        def log_message(self, *_):
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Quiet)
    Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/index.html"
    server.shutdown()
    server.server_close()


class NoTree(FakeEngine):
    """Makes no trees: here it is about the drawing."""

    def __init__(self):
        super().__init__()
        self.answers = False

    def ghost(self, revision, document, stroke, hold):
        """Nothing."""


class Notebook:
    """Messages between a page and its widget."""

    def __init__(self, browser, address: str):
        self.widget = DrawingWidget(engine=NoTree)
        self._waiting: queue.Queue = queue.Queue()
        self.widget.send = lambda content, buffers=(): self._waiting.put((content, [base64.b64encode(one).decode() for one in buffers]))
        self.context = open_window(browser, 1000, 620)
        self.context.expose_function("toKernel", lambda content: self.widget._handle_custom_msg(content, []))
        self.page = Page(self.context, address)

    def until(self, holds) -> None:
        """Carry messages until this holds."""
        for _ in range(500):
            while not self._waiting.empty():
                self.page.page.evaluate("([content, buffers]) => window.fromKernel(content, buffers)", list(self._waiting.get()))
            if holds():
                return
            self.page.page.wait_for_timeout(20)
        raise AssertionError(f"it did not come; {self.page.odd}")

    def close(self) -> None:
        self.context.close()
        self.widget.close()


@pytest.fixture
def notebook(browser, host):
    notebook = Notebook(browser, host)
    notebook.until(lambda: notebook.page.get("page-canvas").count() and "Waiting" not in notebook.page.get("status").inner_text())
    yield notebook
    odd = list(notebook.page.odd)
    notebook.close()
    assert not odd


def test_a_line_drawn_in_the_cell_is_a_stroke_of_the_sketch(notebook):
    notebook.page.draw((0.5, 0.8), (0.5, 0.4))
    notebook.until(lambda: len(notebook.widget.sketch) == 1)
    points = notebook.widget.sketch.strokes[0].points
    assert points[-1, 1] > points[0, 1], "y is up in a sketch"


def test_a_line_from_python_is_on_the_page_and_is_undone_there(notebook):
    notebook.widget.add([(0, 0), (0, 200)])
    notebook.until(lambda: "Draw a trunk" not in notebook.page.get("status").inner_text())
    notebook.page.get("page-canvas").focus()
    notebook.page.page.keyboard.press("Control+z")
    notebook.until(lambda: len(notebook.widget.sketch) == 0)


def test_keys_pressed_in_the_cell_are_not_the_notebook_s(notebook):
    notebook.page.get("page-canvas").focus()
    notebook.page.page.keyboard.press("e")
    assert notebook.page.page.evaluate("window.keysHeard") == 0
    assert notebook.page.page.locator("[data-lm-suppress-shortcuts]").count() == 1


def test_the_notebook_s_styles_and_the_cell_s_stay_apart(notebook):
    assert notebook.page.page.evaluate("getComputedStyle(document.querySelector('h1')).fontFamily") == "serif"
    assert notebook.page.get("status").evaluate("(element) => getComputedStyle(element).fontFamily") != "serif"
    assert notebook.page.page.evaluate("document.styleSheets.length + document.adoptedStyleSheets.length") == 0


def test_a_cell_that_goes_says_where_the_drawing_is(notebook):
    notebook.page.page.evaluate("window.unmount()")
    assert notebook.page.page.get_by_text("This drawing is shown in another cell.").is_visible()
