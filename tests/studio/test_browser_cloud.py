"""A point cloud in the browser: laid there, seen, hidden, traced, drawn over, and its limbs taken over."""

import time

import numpy as np
import pytest
from browser import PATIENCE, Page, Studio, open_window
from scanned_stick import points

AT = "[data-testid=cloud-card]"
INKED = """() => {
  const canvas = document.querySelector(".page-layer");
  const { data } = canvas.getContext("2d").getImageData(canvas.width * 0.3, 0, canvas.width * 0.4, canvas.height * 0.85);
  let dark = 0;
  for (let k = 0; k < data.length; k += 4) if (data[k + 3] > 0 && data[k] < 190) dark += 1;
  return dark;
}"""  # pixels of the page, in its middle, that are neither paper nor grid


def inked(page, holds) -> None:
    """Returns once this holds of the count."""
    end = time.monotonic() + PATIENCE
    while not holds(page.page.evaluate(INKED)):
        assert time.monotonic() < end, "the page did not change"
        page.page.wait_for_timeout(50)


@pytest.fixture(scope="module")
def studio(tmp_path_factory):
    made = Studio(tmp_path_factory.mktemp("cloud"), "blank.sketchtree")
    yield made
    assert made.stop() == 0


@pytest.fixture(scope="module")
def page(browser, studio):
    context = open_window(browser)
    page = Page(context, studio.address)
    page.get("empty-gallery").click()
    page.get("example-ash.ply").click()
    page.page.wait_for_selector(f"{AT}:not([hidden])")
    inked(page, lambda dark: dark > 500)
    yield page
    context.close()


def traced(page, state: str) -> None:
    page.page.wait_for_selector(f"{AT}[data-traced={state}]", timeout=3 * PATIENCE * 1000)


def test_the_example_lies_under_the_page_and_says_what_to_do(page):
    assert page.get("cloud-words").inner_text() == "Draw over the points: limbs take their depth from them."
    assert page.get("cloud-figures").inner_text() == "18,500 points, 19.4 m high"
    assert page.weak_contrasts() == []


def test_points_are_hidden_and_shown_by_either_switch(page):
    page.get("cloud-shown").click()
    inked(page, lambda dark: dark < 50)
    assert page.get("show-points").get_attribute("aria-pressed") == "false"
    page.get("show-points").click()
    inked(page, lambda dark: dark > 500)


def test_the_tree_in_them_is_traced_and_its_limbs_become_strokes(page):
    page.get("generations").press("Home")  # only what is drawn: what else grows is not tested here
    page.get("cloud-trace").click()
    traced(page, "ready")
    page.get("cloud-use").click()
    traced(page, "none")
    page.wait(lambda status: status["state"] == "idle" and (status["segments"] or 0) > 60, patience=3 * PATIENCE)
    assert page.get("cloud-card").is_visible() and not page.odd


def test_a_file_is_read_as_the_dialog_says_and_what_can_not_be_is_named_there(page, studio):
    path = studio.folder / "stick.xyz"
    np.savetxt(path, 1000 * points(), fmt="%.3f")
    page.get("open").click()
    page.get("open-file").set_input_files(path)
    page.get("cloud-up").get_by_text("y", exact=True).click()
    page.get("cloud-unit").get_by_text("By height").click()
    page.get("cloud-height").fill("900")
    page.get("cloud-alone").click()
    assert page.get("cloud-wrong-height").inner_text() == "A plant of 900 m is out of range: 0.05 to 150 m can be read."
    assert page.weak_contrasts() == []
    page.get("cloud-height").fill("12")
    page.get("cloud-alone").click()
    page.page.wait_for_function("() => document.querySelector('[data-testid=cloud-figures]').textContent === '2,100 points, 12.0 m high'", timeout=1000 * PATIENCE)
    assert not page.get("cloud-dialog").is_visible() and not page.odd
