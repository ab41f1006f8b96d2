"""`sketchtree studio` as a person meets it: a real browser, a mouse, a keyboard.

All of it is in one file so that one browser and one studio serve it all.
"""

import json
import math

import pytest

pytest.importorskip("msgspec", reason="the studio is not installed: pip install 'sketchtree[studio]'")

from browser import Page, Studio, launch
from wire_ear import Ear

TRUNK = ((0.5, 0.8), (0.5, 0.62), (0.51, 0.35))
LEFT = ((0.5, 0.62), (0.4, 0.5), (0.33, 0.4))
SMALL = {
    "sketchtree": 1, "units": "px", "y": "down",
    "strokes": [
        {"id": name, "kind": "branch", "points": points}
        for name, points in (("trunk", [[300, 500], [302, 380], [298, 250]]), ("left", [[301, 400], [240, 330], [200, 270]]), ("right", [[301, 340], [350, 290], [400, 250]]))
    ],
}  # fmt: skip
RIGHT = ((0.5, 0.55), (0.6, 0.45), (0.68, 0.36))


@pytest.fixture(scope="module")
def browser():
    playwright, browser = launch()
    yield browser
    browser.close()
    playwright.stop()


@pytest.fixture(scope="module")
def studio(tmp_path_factory, browser):
    folder = tmp_path_factory.mktemp("studio")
    (folder / "work").mkdir()
    (folder / "work" / "small.json").write_text(json.dumps(SMALL))
    studio = Studio(folder, "small.json")
    yield studio
    if studio.alive:
        assert studio.stop() == 0, studio.trouble()


@pytest.fixture(scope="module")
def context(browser, studio):
    context = browser.new_context(viewport={"width": 1280, "height": 720}, accept_downloads=True)
    yield context
    context.close()


@pytest.fixture
def page(context, studio):
    """A page of the studio; whatever is odd in it is a failure."""
    page = Page(context, studio.address)
    page.settle()
    yield page
    faults, outside = list(page.odd), list(page.outside)
    page.page.close()
    assert not faults and not outside
    assert studio.alive, studio.trouble()


@pytest.fixture
def ear(page, context, studio):
    """A second one that listens: what the program itself says."""
    ear = Ear(studio.address, context.cookies())
    yield ear
    ear.close()


@pytest.fixture
def small_tree(page):
    """A trunk and two branches, drawn with the mouse."""
    page.get("new").click()
    page.wait(lambda status: status["segments"] == 0, "an empty page")
    for line in (TRUNK, LEFT, RIGHT):
        page.draw(*line)
    page.wait(lambda status: status["segments"] > 0 and status["triangles"] > 0, "the first tree")
    return page.settle()


def test_an_example_is_there_at_once_and_a_hint_says_what_to_draw(browser, tmp_path):
    own = Studio(tmp_path)
    context = browser.new_context(viewport={"width": 1280, "height": 720})
    page = Page(context, own.address)
    page.get("hint").get_by_text("Draw a trunk").wait_for()
    ear = Ear(own.address, context.cookies())
    assert len(ear.strokes) > 10
    page.get("gallery").click()
    page.page.locator("[data-testid^=example-]").nth(3).wait_for()
    ear.close()
    context.close()
    assert own.stop() == 0
    assert own.trouble() == ""


def test_the_token_leaves_the_address_bar(page):
    assert "token" not in page.page.url


def test_a_line_of_the_mouse_is_a_branch_of_the_tree(page, small_tree, ear):
    before, after = page.change(lambda: page.draw((0.5, 0.48), (0.42, 0.36), (0.4, 0.28)))
    assert after["segments"] != before["segments"] and after["triangles"] != before["triangles"]
    drawn = ear.limb_of(ear.strokes[-1]["id"])
    assert drawn["parent"] == ear.limb_of(ear.strokes[0]["id"])["id"], "it grows on the trunk"


def test_undo_and_redo_by_button_and_by_key(page, small_tree, ear):
    before, drawn = page.change(lambda: page.draw((0.5, 0.48), (0.42, 0.36), (0.4, 0.28)))
    _, undone = page.change(lambda: page.get("undo").click())
    assert (undone["segments"], undone["triangles"]) == (before["segments"], before["triangles"]), "the very tree that was there before"
    _, redone = page.change(lambda: page.get("redo").click())
    assert (redone["segments"], redone["triangles"]) == (drawn["segments"], drawn["triangles"])
    page.change(lambda: page.page.keyboard.press("Control+z"))
    assert len(ear.strokes) == 3
    page.change(lambda: page.page.keyboard.press("Control+Shift+z"))
    assert len(ear.strokes) == 4


def test_undo_has_no_limit(page, small_tree, ear):
    for _ in range(4):
        page.change(lambda: page.get("undo").click())
    assert len(ear.strokes) > 3, "back before the empty page, to the example"


def test_a_crown_is_an_outline_that_the_tree_fills(page, small_tree, ear):
    page.get("tool-crown").click()
    circle = [(0.5 + 0.27 * math.cos(turn), 0.42 + 0.3 * math.sin(turn)) for turn in [0.4 * step for step in range(16)]]
    page.change(lambda: page.draw(*circle, steps=2))
    crown = ear.strokes[-1]
    assert (crown["kind"], crown["closed"]) == ("crown", True)
    with_crown = page.settle()
    page.change(lambda: page.get("crown-toggle").click())
    assert ear.options["crown"] == "off"
    assert page.settle()["segments"] != with_crown["segments"]


def test_an_obstacle_is_drawn_and_erased(page, small_tree, ear):
    page.get("tool-obstacle").click()
    page.change(lambda: page.draw((0.6, 0.3), (0.7, 0.3), (0.7, 0.2), (0.6, 0.2)))
    assert [stroke["kind"] for stroke in ear.strokes] == ["branch", "branch", "branch", "obstacle"]
    page.get("tool-erase").click()
    page.change(lambda: page.draw((0.7, 0.27), (0.7, 0.23)))
    assert len(ear.strokes) == 3


def test_another_template_is_one_click(page, small_tree, ear):
    strip = page.get("template-strip")
    assert strip.locator("[data-testid^=template-]").count() > 10
    wanted = page.get("template-lombardy_poplar")
    wanted.scroll_into_view_if_needed()
    page.change(wanted.click)
    assert ear.options["template"] == "lombardy_poplar"
    page.change(lambda: page.get("template-auto").click())
    assert ear.options["template"] == "auto"


def test_hovering_a_template_only_shows_it(page, small_tree, ear):
    wanted = page.get("template-lombardy_poplar")
    wanted.scroll_into_view_if_needed()
    seen = ear.count("tree")
    wanted.hover()
    ear.wait(lambda: ear.options["template"] == "auto", "the template as it was")
    page.page.wait_for_timeout(600)
    page.page.mouse.move(640, 200)
    assert ear.options["template"] == "auto" and ear.count("tree") >= seen


def _pick_other(page, test_id: str) -> None:
    page.get(test_id).get_by_role("radio", checked=False).nth(2).click()


@pytest.mark.parametrize(("test_id", "option"), [("leaf-picker", "leaf"), ("season-picker", "season"), ("bark-picker", "bark")])
def test_leaf_season_and_bark_are_picked(page, small_tree, ear, test_id, option):
    before = ear.options[option]
    page.change(lambda: _pick_other(page, test_id))
    assert ear.options[option] != before


@pytest.mark.parametrize("name", ["generations", "density", "gravity", "light"])
def test_a_slider_moves_by_the_arrow_keys(page, small_tree, ear, name):
    before = ear.options[name]
    page.get(name).focus()
    page.change(lambda: page.page.keyboard.press("ArrowRight"))
    assert ear.options[name] != before


def test_the_seed_is_rolled_and_theta_is_fixed(page, small_tree, ear):
    page.get("seed").fill("7")
    page.change(lambda: page.page.keyboard.press("Enter"))
    assert ear.options["seed"] == 7
    page.change(lambda: page.get("theta-fixed").click())
    assert ear.options["theta"] == "fixed"


def test_a_limb_is_flipped_locked_and_stays_so_whatever_changes(page, small_tree, ear):
    page.get("tool-select").click()
    page.click_page(0.4, 0.5)
    page.change(lambda: page.get("tool-flip").click())
    limb = ear.limb_of(ear.strokes[1]["id"])
    held = ear.edits[limb["id"]]
    page.get("seed").fill("11")
    page.change(lambda: page.page.keyboard.press("Enter"))
    wanted = page.get("template-lombardy_poplar")
    wanted.scroll_into_view_if_needed()
    page.change(wanted.click)
    page.change(lambda: _pick_other(page, "leaf-picker"))
    assert ear.edits[limb["id"]] == held, "seed, template and leaves change; what was done by hand does not"
    page.change(lambda: page.get("tool-lock").click())
    assert limb["id"] not in ear.edits, "what is locked is let go by the same button"


def test_a_depth_is_dragged_and_held(page, small_tree, ear):
    page.get("tool-select").click()
    page.click_page(0.4, 0.5)
    limb = ear.limb_of(ear.strokes[1]["id"])
    before = limb["path"]
    page.get("tree-view").focus()
    page.page.keyboard.press("Enter")
    page.change(lambda: page.page.keyboard.press("ArrowUp"))
    after = ear.limb_of(ear.strokes[1]["id"])
    assert limb["id"] in ear.edits
    assert after["path"] != before
    assert after["path"][0::3] == pytest.approx(before[0::3], abs=1e-4) and after["path"][1::3] == pytest.approx(before[1::3], abs=1e-4), "on the page it stays"


def test_the_status_has_the_height_and_other_readings_are_offered(page, small_tree):
    assert " m" in page.get("status").inner_text()
    assert page.get("alternatives").count() == 1 and page.get("uncertainty").count() == 1


def test_a_reload_brings_everything_back(page, small_tree, ear):
    before = ear.state
    page.page.reload()
    page.settle()
    assert ear.state == before
    assert page.status["segments"] == small_tree["segments"]


def test_two_pages_on_one_project_agree(page, small_tree, context, studio):
    other = Page(context, studio.address)
    other.settle()
    page.change(lambda: page.draw((0.5, 0.48), (0.42, 0.36), (0.4, 0.28)))
    here = page.settle()
    there = other.wait(lambda status: status["revision"] == here["revision"] and status["state"] == "idle", "the same tree on the other page")
    assert (there["segments"], there["triangles"]) == (here["segments"], here["triangles"])
    other.page.close()


def test_an_exported_glb_is_a_tree_with_wood_and_leaves(page, small_tree, tmp_path):
    from sketchtree.export.read import read_contents

    page.get("export").click()
    with page.page.expect_download() as waiting:
        page.get("export-glb").click()
    path = tmp_path / "tree.glb"
    waiting.value.save_as(path)
    contents = read_contents(path)
    names = [part.name for part in contents.asset.parts]
    assert any(name.startswith("wood") for name in names) and any(name.startswith("leaf") for name in names)
    assert contents.skeleton.segment_count == page.settle()["segments"]


def test_all_is_done_by_the_keyboard_alone(page, small_tree, ear):
    keys = page.page.keyboard
    page.page.evaluate("document.activeElement?.blur()")
    reached = set()
    for _ in range(250):
        keys.press("Tab")
        reached.add(page.page.evaluate("document.activeElement?.closest('[data-testid]')?.dataset.testid ?? ''"))
    for needed in ("new", "open", "save", "undo", "tool-branch", "page-canvas", "tree-view", "generations", "seed", "gallery"):
        assert needed in reached, f"{needed} is not reached by Tab"
    page.page.evaluate("document.activeElement?.blur()")
    keys.press("e")
    assert page.get("tool-erase").get_attribute("aria-pressed") == "true" or page.get("tool-erase").get_attribute("aria-checked") == "true"
    keys.press("b")
    assert page.get("tool-branch").get_attribute("aria-pressed") == "true" or page.get("tool-branch").get_attribute("aria-checked") == "true"


def test_hostile_messages_are_refused_and_nothing_else_happens(page, small_tree, ear):
    before = ear.state
    for nonsense in ("", "{", "[]", '{"type": "undo", "more": 1}', '{"type": "nonsense"}', "[" * 5000, '{"type": "strokes", "label": "x", "put": [{"id": "../..", "kind": "tree", "xy": [1]}]}',
                     '{"type": "open", "name": "../../etc/passwd"}', '{"type": "choose", "options": {"seed": -1}}', '{"type": "choose", "options": {"height": 1e400}}'):  # fmt: skip
        ear.throw(nonsense)
    ear.throw(b"\x00" * 100)
    ear.sync()
    assert ear.state == before
    page.change(lambda: page.draw((0.5, 0.48), (0.42, 0.36), (0.4, 0.28)))


def test_ten_thousand_rapid_strokes_leave_it_alive(page, small_tree, ear):
    for number in range(10_000):
        ear.ask({"type": "strokes", "label": "branch", "put": [{"id": f"rapid-{number % 50}", "kind": "branch", "xy": [300 + number % 7, 300, 320, 200 + number % 50]}]})
    ear.wait(lambda: f"rapid-{9_999 % 50}" in {stroke["id"] for stroke in ear.strokes} and ear.quiet, "the last stroke", patience=60)
    status = page.settle()
    assert status["segments"] > 0
    page.change(lambda: page.get("new").click())


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_text_is_read_on_its_ground(page, theme):
    page.page.emulate_media(color_scheme=theme)
    page.page.reload()
    page.settle()
    assert page.weak_contrasts() == []


def test_a_killed_studio_loses_nothing_that_was_drawn(page, small_tree, ear, studio, context):
    before = ear.state
    page.expect("WebSocket", "Failed to load resource", "net::ERR")
    studio.kill()
    page.page.wait_for_timeout(300)
    studio.start()
    again = Page(context, studio.address)
    status = again.settle()
    assert status["segments"] == small_tree["segments"]
    listener = Ear(studio.address, context.cookies())
    assert listener.state == before
    listener.close()
    again.page.close()
