"""A photo in the studio, as a person meets it: the crown with the left button, a branch with the right; limbs appear on the photo, become the drawing, and the tree grows."""

import base64

import painted_photo as painted
import pytest

pytest.importorskip("msgspec", reason="the studio is not installed: pip install 'sketchtree[studio]'")

from browser import Page, Studio, open_window
from wire_ear import Ear

UPLOAD = "async (data) => (await fetch('upload?name=elm.png&as=photo', { method: 'POST', body: Uint8Array.from(atob(data), (c) => c.charCodeAt(0)) })).status"


@pytest.fixture(scope="module")
def studio(tmp_path_factory):
    studio = Studio(tmp_path_factory.mktemp("studio"), "elm.sketchtree")
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
    assert page.page.evaluate(UPLOAD, base64.b64encode(painted.photo()).decode()) == 200
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


class Photo:
    """Where the photo's pixels are on the screen: a line drawn across it says so, and is taken back."""

    def __init__(self, page: Page, ear: Ear):
        self.page = page
        box = page.get("page-canvas").bounding_box()
        start, end = ((box["x"] + share * box["width"], box["y"] + share * box["height"]) for share in (0.4, 0.6))
        self.draw_at([start, end], "right")
        ear.wait(lambda: ear.strokes, "the line")
        xy, under = ear.strokes[0]["xy"], ear.state["underlay"]
        self.scale = (end[0] - start[0]) / (xy[-2] - xy[0]) * under["width"] / painted.SIZE[0]
        self.left = start[0] - (xy[0] - under["x"]) * self.scale * painted.SIZE[0] / under["width"]
        self.top = start[1] - (xy[1] - under["y"]) * self.scale * painted.SIZE[0] / under["width"]
        page.get("undo").click()
        ear.wait(lambda: not ear.strokes, "an empty page")

    def draw(self, pixels, button: str) -> None:
        self.draw_at([(self.left + x * self.scale, self.top + y * self.scale) for x, y in pixels], button)

    def draw_at(self, places, button: str) -> None:
        mouse = self.page.page.mouse
        mouse.move(*places[0])
        mouse.down(button=button)
        for place in places[1:]:
            mouse.move(*place, steps=6)
        mouse.up(button=button)


@pytest.fixture(scope="module")
def photo(page, ear):
    return Photo(page, ear)


def limbs(page) -> int:
    """Joints that the page shows on the photo."""
    return int(page.get("photo-card").get_attribute("data-limbs"))


def wait_until(page, state: str) -> None:
    """The photo's tree is so."""
    page.page.locator(f"[data-testid=photo-card][data-grown={state}]").wait_for()


def test_the_page_says_what_to_mark_first(page):
    assert page.get("photo-words").inner_text() == "Left button: the crown. Right button: a branch."
    assert page.get("tool-crown").get_attribute("aria-pressed") == "true" and page.get("photo-mode").get_attribute("aria-checked") == "true"
    assert page.get("use-traced").is_hidden() and page.get("photo-grow").is_hidden()


def test_left_is_the_crown_and_right_a_branch_and_limbs_appear(page, ear, photo):
    photo.draw([*painted.CROWN, painted.CROWN[0]], "left")
    photo.draw(painted.TRUNK, "right")
    ear.wait(lambda: len(ear.strokes) == 2, "two strokes")
    assert sorted(stroke["kind"] for stroke in ear.strokes) == ["branch", "crown"]
    page.get("photo-tint").wait_for()  # the foliage is known
    assert limbs(page) > 8 and page.get("use-traced").get_attribute("aria-disabled") is None
    assert page.page.evaluate("getComputedStyle(document.documentElement).getPropertyValue('--traced') !== ''")
    assert page.weak_contrasts() == []


def test_the_photos_tree_grows_by_itself_and_its_files_are_of_that_tree(page, ear):
    wait_until(page, "ready")
    assert page.get("photo-words").inner_text() == "Grown from the photo." and page.get("photo-grow").is_hidden()
    assert int(page.get("status").get_attribute("data-segments")) > 500 and page.get("generations").is_hidden()
    assert page.weak_contrasts() == []
    with page.page.expect_download() as kept:
        page.get("photo-strokes").click()
    drawing = kept.value.path().read_text()
    assert kept.value.suggested_filename == "elm.svg" and 'viewBox="0.0 -0.0 600.0 600.0"' in drawing and drawing.count("<path") == 2
    command = page.page.evaluate("""fetch('command?export=' + encodeURIComponent('{"format": ".glb", "tree": "photo"}')).then((answer) => answer.text())""")
    assert command == "sketchtree photo elm.png --strokes elm.svg -o elm.glb"


def test_another_choice_grows_it_anew_and_it_can_be_stopped(page, ear):
    page.get("library-visible").click()
    wait_until(page, "grows")
    page.get("photo-grow").click()
    wait_until(page, "stopped")
    assert ear.options["library"] == "I,II" and page.get("photo-grow").inner_text() == "Grow the tree"
    page.get("undo").click()
    wait_until(page, "ready")


def test_traced_limbs_become_the_drawing_and_the_tree_follows(page, ear):
    _, after = page.change(lambda: page.get("use-traced").click())
    ear.rest()
    strokes = ear.strokes
    assert sum(stroke["kind"] == "branch" for stroke in strokes) > 1 and sum(stroke["kind"] == "crown" for stroke in strokes) == 1
    page.get("photo-card").wait_for(state="hidden")
    assert after["segments"] > 100 and not ear.state["underlay"]["photo"]
    assert ear.undo == "traced limbs"


def test_undo_brings_the_marks_back(page, ear):
    page.change(lambda: page.get("undo").click())
    ear.rest()
    assert len(ear.strokes) == 2 and ear.state["underlay"]["photo"]
    page.get("photo-card").wait_for()
    page.get("photo-leave").click()
    page.get("photo-card").wait_for(state="hidden")
    ear.wait(lambda: not ear.state["underlay"]["photo"], "a picture to trace over")
