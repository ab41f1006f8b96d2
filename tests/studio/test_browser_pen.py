"""The pen on the page, in a real browser: what shaky hands, palms and broken lines do to a drawing. No tree is made here; the server's document is looked at."""

import pytest

pytest.importorskip("msgspec", reason="the studio is not installed: pip install 'sketchtree[studio]'")

from browser import Page, open_window, without
from running import running

from sketchtree.studio import built

DISPATCH = """([type, events]) => {
  const canvas = document.querySelector('[data-testid=page-canvas]');
  const box = canvas.getBoundingClientRect();
  for (const [what, id, x, y, more] of events) {
    const up = what === 'pointerup', move = what === 'pointermove';
    canvas.dispatchEvent(new PointerEvent(what, { bubbles: true, cancelable: true, composed: true, pointerId: id, pointerType: type, button: move ? -1 : 0,
      buttons: up ? 0 : 1, clientX: box.left + x, clientY: box.top + y, pressure: 0.5, width: 1, height: 1, isPrimary: true, ...more }));
  }
}"""

KEPT = """() => new Promise((done) => {
  const opening = indexedDB.open('sketchtree-studio', 1);
  opening.onsuccess = () => {
    const count = opening.result.transaction('strokes-on-their-way').objectStore('strokes-on-their-way').count();
    count.onsuccess = () => done(count.result);
  };
})"""  # how many strokes the page keeps that the program has not confirmed


@pytest.fixture(scope="module")
def dist():
    if not (built.DIST / "index.html").is_file():
        without("the page was not built")
    return built.DIST


@pytest.fixture
def work(tmp_path, monkeypatch):
    """The folder of the drawings."""
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path / "recovery"))
    folder = tmp_path / "work"
    folder.mkdir()
    return folder


@pytest.fixture
def desk(browser, dist, work):
    """An empty page and the server behind it."""
    context = open_window(browser)
    with running(work, page=dist) as server:
        server.engine.answers = False
        yield Desk(Page(context, server.url), server)
    context.close()


class Desk:
    """A page that was emptied, and what its server knows."""

    def __init__(self, page: Page, server):
        self.page, self.server = page, server
        self.until(lambda: server.engine.made)
        page.get("new").click()
        self.until(lambda: not self.strokes)

    @property
    def strokes(self) -> list:
        """The newest drawing's."""
        return list(self.server.engine.made[-1][1].strokes.values())

    def until(self, holds) -> None:
        for _ in range(400):
            if holds():
                return
            self.page.page.wait_for_timeout(25)
        raise AssertionError(f"it did not come; odd: {self.page.odd}")

    def dispatch(self, kind: str, *events) -> None:
        self.page.page.evaluate(DISPATCH, [kind, [[*event, {}][:5] for event in events]])

    def line(self, kind: str, pointer: int = 1, twice: bool = False, **more) -> None:
        """Twenty places to the lower right; `twice`: each told two times."""
        moves = [("pointermove", pointer, 100 + 8 * k, 100 + 5 * k + k % 2, more) for k in range(1, 21)]
        events = [("pointerdown", pointer, 100, 100, more), *moves, ("pointerup", pointer, 260, 200, more)]
        self.dispatch(kind, *(event for event in events for _ in range(2 if twice else 1)))


def test_a_line_is_one_stroke_of_few_points_from_where_the_pen_came_down_to_where_it_was_lifted(desk):
    desk.line("pen")
    desk.until(lambda: desk.strokes)
    [stroke] = desk.strokes
    assert 2 <= len(stroke.points) <= 200
    x, y = (stroke.points[-1] - stroke.points[0]).tolist()
    assert x / 160 == pytest.approx(-y / 100, rel=0.02), "the page's y points down, the document's up"


def test_events_told_twice_count_once(desk):
    desk.line("pen", twice=True)
    desk.until(lambda: desk.strokes)
    [stroke] = desk.strokes
    assert len(stroke.points) == len({tuple(point) for point in stroke.points.tolist()})


def test_a_pen_tells_its_pressure_and_a_mouse_has_none(desk):
    desk.line("pen", pressure=0.8)
    desk.line("mouse", pointer=2)
    desk.until(lambda: len(desk.strokes) == 2)
    with_pen, with_mouse = desk.strokes
    assert with_pen.pressure.max() == pytest.approx(0.8)
    assert with_mouse.pressure is None


def test_a_palm_draws_nothing_and_after_a_pen_fingers_move_the_page(desk):
    desk.line("touch", pointer=3, width=90, height=70)
    desk.line("touch", pointer=4)
    desk.line("pen", pointer=5)
    desk.line("touch", pointer=6)
    desk.line("pen", pointer=7)
    desk.until(lambda: len(desk.strokes) == 3)
    finger, first, second = desk.strokes
    assert (second.points[0] - first.points[0])[0] < 0, "the second pen line lies where the finger moved the page away from"


def test_a_second_finger_takes_back_what_the_first_began_and_zooms(desk):
    before = desk.page.get("page-zoom").inner_text()
    desk.dispatch("touch", ("pointerdown", 1, 100, 200), ("pointerdown", 2, 200, 200), *(("pointermove", 1, 100 - 5 * k, 200) for k in range(10)),
                  ("pointerup", 1, 55, 200), ("pointerup", 2, 200, 200))  # fmt: skip
    desk.line("touch", pointer=3)
    desk.until(lambda: len(desk.strokes) == 1)
    assert desk.page.get("page-zoom").inner_text() != before


def test_a_crown_closes_itself_and_an_obstacle_too(desk):
    for tool in ("tool-crown", "tool-obstacle"):
        desk.page.get(tool).click()
        desk.page.draw((0.3, 0.3), (0.6, 0.3), (0.6, 0.6), (0.3, 0.5))
    desk.until(lambda: len(desk.strokes) == 2)
    assert [(stroke.kind.value, stroke.closed) for stroke in desk.strokes] == [("crown", True), ("obstacle", True)]


def test_with_alt_a_part_is_erased_and_the_piece_at_the_root_keeps_its_name(desk):
    desk.page.draw((0.5, 0.8), (0.5, 0.2))
    desk.until(lambda: desk.strokes)
    [whole] = desk.strokes
    desk.page.get("tool-erase").click()
    desk.page.page.keyboard.down("Alt")
    desk.page.draw((0.45, 0.5), (0.55, 0.5))
    desk.page.page.keyboard.up("Alt")
    desk.until(lambda: len(desk.strokes) == 2)
    lower, upper = desk.strokes
    assert lower.id == whole.id
    assert upper.points[0][1] > lower.points[-1][1]


def test_a_line_drawn_on_a_turned_page_says_so(desk):
    for _ in range(6):
        desk.page.page.keyboard.press("ArrowRight")
    desk.page.draw((0.5, 0.8), (0.5, 0.2))
    desk.until(lambda: desk.strokes)
    assert desk.strokes[0].view_deg == 90


def test_a_line_is_pulled_moved_and_deleted_with_the_select_tool(desk):
    desk.page.draw((0.3, 0.8), (0.3, 0.2), steps=20)
    desk.until(lambda: desk.strokes)
    [drawn] = desk.strokes
    desk.page.page.keyboard.press("v")
    desk.page.draw((0.3, 0.5), (0.4, 0.5))
    desk.until(lambda: abs(desk.strokes[0].points[:, 0] - drawn.points[0, 0]).max() > 1)
    [pulled] = desk.strokes
    assert pulled.points[0].tolist() == drawn.points[0].tolist()
    assert pulled.id == drawn.id
    desk.page.page.keyboard.press("Alt+ArrowRight")
    desk.until(lambda: desk.strokes[0].points[0, 0] > pulled.points[0, 0])
    desk.page.page.keyboard.press("Delete")
    desk.until(lambda: not desk.strokes)


def test_lines_drawn_while_the_program_was_away_come_to_it_in_order(browser, dist, work):
    context = open_window(browser)
    with running(work, page=dist) as server:
        server.engine.answers = False
        desk = Desk(Page(context, server.url), server)
        desk.line("pen")
        desk.until(lambda: desk.strokes)
    desk.page.expect("WebSocket")
    desk.line("mouse", pointer=2)
    desk.line("mouse", pointer=3)
    desk.until(lambda: desk.page.page.evaluate(KEPT) == 2)
    with running(work, port=server.port, page=dist) as again:
        again.engine.answers = False
        desk.server = again
        desk.page.page.goto(again.url)
        desk.until(lambda: again.engine.made and len(desk.strokes) == 3)
        assert [stroke.pressure is None for stroke in desk.strokes] == [False, True, True]
        desk.until(lambda: desk.page.page.evaluate(KEPT) == 0)
    context.close()
