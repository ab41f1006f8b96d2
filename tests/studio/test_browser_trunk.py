"""A bare tree in a photo, as a person scribbles on it: the matte appears, then the trunk with its contour's points, then the tree; points go, come and merge; all of it is kept."""

import base64

import pytest

pytest.importorskip("msgspec", reason="the studio is not installed: pip install 'sketchtree[studio]'")

from browser import Page, Studio, open_window
from wire_ear import Ear

from tests.trunk.painted_tree import SIZE, painted_tree

UPLOAD = "async (data) => (await fetch('upload?name=bare.png&as=photo', { method: 'POST', body: Uint8Array.from(atob(data), (c) => c.charCodeAt(0)) })).status"
SLIDE = "(input, value) => { input.value = value; input.dispatchEvent(new Event('input')); input.dispatchEvent(new Event('change')); }"
TRUNK, BESIDE = [(40, 92), (40, 20)], [(5, 60), (5, 95), (30, 96)]
SCRIBBLING = ("tool-foreground", "tool-background", "tool-matte_add", "tool-matte_erase", "tool-vertices", "tool-foot")


@pytest.fixture(scope="module")
def studio(tmp_path_factory):
    studio = Studio(tmp_path_factory.mktemp("studio"), "bare.sketchtree")
    yield studio
    if studio.alive:
        assert studio.stop() == 0, studio.trouble()


@pytest.fixture(scope="module")
def context(browser, studio):
    context = open_window(browser, 1400, 900)
    yield context
    context.close()


@pytest.fixture(scope="module")
def page(context, studio):
    """The page with the photo under it; whatever is odd in it is a failure."""
    page = Page(context, studio.address)
    page.settle()
    assert page.page.evaluate(UPLOAD, base64.b64encode(painted_tree()).decode()) == 200
    page.get("photo-card").wait_for()
    yield page
    faults, outside = list(page.odd), list(page.outside)
    page.page.close()
    assert faults == [] and outside == []


@pytest.fixture(scope="module")
def ear(page, context, studio):
    ear = Ear(studio.address, context.cookies())
    yield ear
    ear.close()


class Hand:
    """Does things at pixels of the photo."""

    def __init__(self, page: Page, ear: Ear):
        self.page, self.ear, self.mouse = page, ear, page.page.mouse

    def at(self, x: float, y: float) -> tuple[float, float]:
        """A pixel of the photo on the screen."""
        canvas, under = self.page.get("page-canvas"), self.ear.state["underlay"]
        box, unit = canvas.bounding_box(), under["width"] / SIZE[0]
        scale, left, top = map(float, canvas.get_attribute("data-camera").split())
        return box["x"] + left + scale * (under["x"] + x * unit), box["y"] + top + scale * (under["y"] + y * unit)

    def draw(self, pixels, button: str = "left") -> None:
        places = [self.at(*pixel) for pixel in pixels]
        self.mouse.move(*places[0])
        self.mouse.down(button=button)
        for place in places[1:]:
            self.mouse.move(*place, steps=5)
        self.mouse.up(button=button)

    def drag(self, line) -> None:
        """Along the contour, a step at each of its points."""
        self.mouse.move(*self.at(*line[0]))
        self.mouse.down()
        for pixel in line[1:]:
            self.mouse.move(*self.at(*pixel))
        self.mouse.up()

    def scribble(self, pixels, button: str = "left") -> None:
        """A stroke more, and the page lies still after it."""
        before = len(self.ear.strokes)
        self.draw(pixels, button)
        self.ear.wait(lambda: len(self.ear.strokes) == before + 1, "a stroke")
        self.page.page.wait_for_timeout(300)  # what stands over the page may become larger, and the page smaller

    def hover(self, x: float, y: float) -> str:
        """What the page says would happen there."""
        self.mouse.move(*self.at(x, y))
        return self.page.get("point-tip").inner_text()

    def click(self, x: float, y: float) -> None:
        self.mouse.click(*self.at(x, y))


@pytest.fixture(scope="module")
def hand(page, ear):
    return Hand(page, ear)


def trunk(ear) -> dict:
    return ear.state["trunk"]


def points(ear) -> list[tuple[float, float]]:
    """Of the contour's outer ring, as it was found last."""
    xy = ear.latest("trunks")["vertices"][0]
    return list(zip(xy[::2], xy[1::2], strict=True))


def found_anew(page, ear, do) -> None:
    """The trunk, after something that makes it another."""
    before = ear.latest("trunks")["revision"]
    do()
    ear.wait(lambda: ear.latest("trunks")["state"] == "ready" and ear.latest("trunks")["revision"] > before, "a trunk")
    page.page.locator(f"[data-testid=trunk-card][data-points='{len(points(ear))}']").wait_for()


def grown(page, state: str) -> None:
    """The tree is so."""
    page.page.locator(f"[data-testid=trunk-card][data-grown={state}]").wait_for()


def tip_of(ear) -> tuple[float, float]:
    """The point of the contour at the tip of the trunk."""
    return min(points(ear), key=lambda point: point[1])


def test_scribbles_have_tools_of_their_own(page):
    assert page.get("tool-crown").is_visible() and not any(page.get(name).is_visible() for name in SCRIBBLING)
    page.get("photo-way-scribbles").click()
    page.get("trunk-card").wait_for()
    assert all(page.get(name).is_visible() for name in (*SCRIBBLING, "tool-erase", "tool-pan"))
    assert not any(page.get(f"tool-{name}").is_visible() for name in ("branch", "crown", "obstacle", "select", "flip", "lock"))
    assert page.get("tool-foreground").get_attribute("aria-pressed") == "true"
    assert page.get("photo-card").is_hidden() and page.get("leaf_size").is_hidden() and page.get("trunk-gap").is_visible()
    assert page.get("trunk-words").inner_text() == "Left button: on the tree. Right button: on what is not tree."
    assert page.weak_contrasts() == []


def test_what_is_missing_is_said(page, ear, hand):
    page.get("trunk-levels").evaluate(SLIDE, "0")
    ear.wait(lambda: trunk(ear)["levels"] == 0, "no levels")
    hand.scribble(TRUNK)
    assert page.get("trunk-words").inner_text() == "Now on what is not tree: sky, ground, what stands behind."
    assert page.get("trunk-grow").is_hidden() and page.get("trunk-progress").is_hidden()
    (stroke,) = ear.strokes
    assert stroke["kind"] == "foreground" and stroke["width"] > 0 and not stroke["closed"]


def test_scribbles_on_both_sides_become_matte_trunk_and_tree(page, ear, hand):
    hand.scribble(BESIDE, "right")
    assert [stroke["kind"] for stroke in ear.strokes] == ["foreground", "background"]
    grown(page, "ready")
    assert page.get("trunk-words").inner_text() == "Grown from the scribbles."
    assert page.get("trunk-card").get_attribute("data-matte") != "" and page.get("trunk-matte").is_visible()
    assert int(page.get("trunk-card").get_attribute("data-points")) == len(points(ear)) >= 6
    assert int(page.get("status").get_attribute("data-segments")) >= 5  # the trunk, in pieces, and two limbs
    assert page.weak_contrasts() == []


def test_it_is_said_what_a_press_would_do(page, ear, hand):
    page.page.keyboard.press("p")
    x, y = tip_of(ear)
    assert hand.hover(x, y) == "Remove this point"
    assert hand.hover(36, 80) == "Add a point"
    hand.mouse.move(*hand.at(10, 80))
    page.get("point-tip").wait_for(state="hidden")


def test_a_point_that_is_clicked_goes_and_undo_brings_it_back(page, ear, hand):
    before, tip = points(ear), tip_of(ear)
    found_anew(page, ear, lambda: hand.click(*tip))
    ((x, y),) = trunk(ear)["remove"]
    assert (x, y) == pytest.approx(tip, abs=0.01) and points(ear) == [point for point in before if point != tip]
    assert page.get("trunk-edits").inner_text().startswith("Point removed at") and ear.undo == "remove point 1"
    found_anew(page, ear, lambda: page.get("undo").click())
    assert trunk(ear)["remove"] == [] and points(ear) == before and page.get("trunk-edits").is_hidden()


def test_a_click_on_the_contour_adds_a_point_and_one_more_takes_it_away(page, ear, hand):
    before = points(ear)
    found_anew(page, ear, lambda: hand.click(36, 80))
    ((x, y),) = trunk(ear)["add"]
    assert (x, y) == pytest.approx((36, 80), abs=2) and len(points(ear)) == len(before) + 1
    found_anew(page, ear, lambda: hand.click(x, y))
    assert trunk(ear)["add"] == [] and trunk(ear)["remove"] == [] and points(ear) == before


def test_a_drag_along_the_contour_merges_what_lies_between(page, ear, hand):
    before, (x, y) = points(ear), tip_of(ear)
    found_anew(page, ear, lambda: hand.drag([(x - 6, y + 9), (x, y), (x + 6, y + 9)]))
    assert len(trunk(ear)["merge"]) == 1 and (x, y) not in points(ear) and len(points(ear)) < len(before)
    found_anew(page, ear, lambda: page.get("trunk-back").click())
    assert trunk(ear)["merge"] == [] and page.get("trunk-edits").is_hidden() and points(ear) == before


def test_two_clicks_with_shift_merge_as_a_drag_does(page, ear, hand):
    x, y = tip_of(ear)
    page.page.keyboard.down("Shift")
    hand.click(x - 6, y + 9)
    assert hand.hover(x, y + 3).startswith("Merge: ")
    hand.click(x + 6, y + 9)
    page.page.keyboard.up("Shift")
    ear.wait(lambda: len(trunk(ear)["merge"]) == 1, "a merge")
    page.get("undo").click()
    ear.wait(lambda: trunk(ear)["merge"] == [], "no merge")


def test_points_can_be_reached_by_the_keyboard(page, ear):
    page.get("page-canvas").focus()
    page.page.keyboard.press("PageDown")
    assert page.get("point-tip").inner_text() == "Remove this point"
    page.page.keyboard.press("Delete")
    ear.wait(lambda: len(trunk(ear)["remove"]) == 1, "a point removed")
    page.page.keyboard.press("Control+z")
    ear.wait(lambda: trunk(ear)["remove"] == [], "the point")


def test_wood_is_painted_into_the_matte_and_the_eraser_takes_it_off(page, ear, hand):
    page.page.keyboard.press("a")
    png = ear.latest("matte")["png"]
    found_anew(page, ear, lambda: hand.scribble([(40, 40), (62, 52)]))
    painted = ear.strokes[-1]
    assert painted["kind"] == "matte_add" and ear.latest("matte")["png"] != png
    page.page.keyboard.press("x")
    hand.scribble([(62, 52), (60, 51)])
    assert ear.strokes[-1]["kind"] == "matte_erase"
    page.page.keyboard.press("e")
    hand.draw([(50, 42), (50, 50)])
    ear.wait(lambda: painted["id"] not in {stroke["id"] for stroke in ear.strokes}, "one stroke less")
    page.get("undo").click()
    ear.wait(lambda: len(ear.strokes) == 4, "the stroke again")


def test_the_matte_is_seen_as_a_tint_alone_or_not(page):
    page.get("matte-alone").click()
    assert page.get("matte-strength").is_hidden()
    page.get("page-canvas").focus()
    page.page.keyboard.press("m")
    assert page.get("matte-off").get_attribute("aria-checked") == "true" and page.get("trunk-matte").get_attribute("aria-checked") == "false"
    page.page.keyboard.press("m")
    assert page.get("matte-tint").get_attribute("aria-checked") == "true" and page.get("matte-strength").is_visible()


def test_a_page_that_is_loaded_again_has_all_of_it(page, ear):
    grown(page, "ready")
    kept = ear.state
    page.page.reload()
    page.get("trunk-card").wait_for()
    grown(page, "ready")
    assert page.get("tool-foreground").get_attribute("aria-pressed") == "true" and page.get("trunk-levels").input_value() == "0"
    page.page.locator(f"[data-testid=trunk-card][data-points='{len(points(ear))}']").wait_for()
    assert page.get("trunk-card").get_attribute("data-matte") != "" and ear.state == kept


def test_on_a_phone_the_photo_and_what_is_said_are_seen_whole(page, hand):
    page.page.set_viewport_size({"width": 390, "height": 844})
    page.page.wait_for_timeout(500)
    card, canvas, words = (page.get(name).bounding_box() for name in ("trunk-card", "page-canvas", "trunk-words"))
    left, top = hand.at(0, 0)
    right, foot = hand.at(*SIZE)
    assert words["width"] > 150 and card["y"] + card["height"] <= top + 1 and foot < page.get("brush-brush").bounding_box()["y"]
    assert foot - top > 120 and left > canvas["x"] and right < canvas["x"] + canvas["width"] and page.weak_contrasts() == []
    page.page.set_viewport_size({"width": 1400, "height": 900})
    page.page.wait_for_timeout(500)


def test_the_other_way_hides_scribbles_and_keeps_them(page, ear):
    page.get("photo-way-crown").click()
    page.get("photo-card").wait_for()
    assert page.get("tool-crown").get_attribute("aria-pressed") == "true" and page.get("trunk-card").is_hidden() and page.get("leaf_size").is_visible()
    ear.wait(lambda: not trunk(ear)["on"], "the other way")
    assert len(ear.strokes) == 4 and ear.undo == "crown and limbs"
    page.get("undo").click()
    page.get("trunk-card").wait_for()
    grown(page, "ready")
