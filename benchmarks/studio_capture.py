"""What does the studio look like? `python -m benchmarks.studio_capture [--only gif|pictures|photo|points] [--out docs/pictures]`

Plays a real `sketchtree studio` in a browser without a screen, and writes `studio.gif` and the pictures of `docs/studio.md`. Of each moment of the film a
picture is taken when the screen has come to rest: it shows every step, but not how long one waits (that is what `studio_latency` measures). Needs the extras
`studio` and `test`, and Chromium.
"""

import argparse
import base64
import contextlib
import io
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw
from playwright.sync_api import Browser, Page, sync_playwright

from benchmarks.studio_cloud import EXAMPLE, strokes_over
from sketchtree.photo.read_photo import read_photo
from sketchtree.photo.read_strokes import read_strokes

ARGUMENTS = ["--no-sandbox", "--enable-unsafe-swiftshader", "--use-gl=angle", "--use-angle=swiftshader", "--ignore-gpu-blocklist"]
PATIENCE = 120.0  # seconds
PHOTO = Path(__file__).parent.parent / "examples" / "photo" / "autumn_oak"  # a .jpg, and its strokes
UPLOAD = "async (data) => fetch('upload?name=autumn oak.jpg&as=photo', { method: 'POST', body: Uint8Array.from(atob(data), (c) => c.charCodeAt(0)) })"
SAY = """(said) => new Promise((done) => {
  const line = new WebSocket(location.origin.replace("http", "ws") + "/ws");
  line.onopen = () => {
    for (const one of [{ type: "hello", version: 1 }, ...JSON.parse(said)]) line.send(JSON.stringify(one));
    setTimeout(() => { line.close(); done(); }, 3000);
  };
})"""  # as another page of the same drawing would
PEN = {"width": 5.0, "pressure": None}  # page units: the points show beside a line
WIDE, FRAME = 800, 110  # of the film: pixels, milliseconds a picture
COLOURS = 160
TELLING = ("2f6b4f", "86c6a0", "f59a1b", "b45f00", "ffb347", "e5a11b", "cf7b2e", "f0c4cf", "c98ea0", "9cc069", "4f8a4c", "ffffff")  # of buttons, handles, seasons
TRUNK = ((0.5, 0.84), (0.504, 0.7), (0.496, 0.52), (0.5, 0.26))  # on the page, shares of its width and height
LIMBS = (
    ((0.5, 0.38), (0.46, 0.28), (0.41, 0.2), (0.38, 0.15)),
    ((0.5, 0.62), (0.61, 0.55), (0.73, 0.49), (0.82, 0.47)),
    ((0.5, 0.66), (0.4, 0.6), (0.29, 0.55), (0.19, 0.54)),
    ((0.499, 0.47), (0.57, 0.38), (0.66, 0.31), (0.74, 0.27)),
    ((0.498, 0.52), (0.42, 0.43), (0.33, 0.36), (0.25, 0.32)),
)


@dataclass
class Film:
    """Pictures, each with its time in milliseconds."""

    page: Page
    pictures: list[Image.Image] = field(default_factory=list)
    times: list[int] = field(default_factory=list)
    pen: tuple[float, float] | None = None

    def take(self, count: float = 1) -> None:
        """A picture of what is seen now, with the pointer, which browsers leave out; for so many times the usual time."""
        image = Image.open(io.BytesIO(self.page.screenshot())).convert("RGB")
        if self.pen is not None:
            x, y = self.pen
            brush = ImageDraw.Draw(image)
            brush.ellipse((x - 9, y - 9, x + 9, y + 9), outline=(255, 255, 255), width=4)
            brush.ellipse((x - 8, y - 8, x + 8, y + 8), outline=(47, 107, 79), width=2)
        self.pictures.append(image.resize((WIDE, round(WIDE * image.height / image.width)), Image.Resampling.LANCZOS))
        self.times.append(round(FRAME * count))

    def write(self, path: Path) -> None:
        """As a GIF, all pictures with the colours of some of them."""
        some = self.pictures[:: max(1, len(self.pictures) // 8)]
        sheet = Image.new("RGB", (some[0].width, sum(one.height for one in some)))
        for k, one in enumerate(some):
            sheet.paste(one, (0, k * one.height))
        colours = few(sheet, COLOURS)
        flat = [one.quantize(palette=colours, dither=Image.Dither.NONE) for one in self.pictures]
        flat[0].save(path, save_all=True, append_images=flat[1:], duration=self.times, loop=0, optimize=True)


@contextlib.contextmanager
def studio(*arguments: str) -> Iterator[tuple[Browser, str]]:
    """A browser, and the address of a studio that runs for as long."""
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        process = subprocess.Popen(
            [sys.executable, "-m", "sketchtree", "studio", "--no-browser", *arguments],
            cwd=folder, env={**os.environ, "SKETCHTREE_RECOVERY": str(Path(folder) / "recovery")}, stdout=subprocess.PIPE, text=True,
        )  # fmt: skip
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=ARGUMENTS)
        try:
            yield browser, process.stdout.readline().split()[-1]
        finally:
            browser.close()
            process.terminate()
            process.wait(20)


def opened(browser: Browser, address: str, wide: int, high: int, theme: str = "light") -> Page:
    """A page of the studio, with its first tree."""
    page = browser.new_context(viewport={"width": wide, "height": high}, color_scheme=theme).new_page()
    page.goto(address)
    settle(page)
    return page


def settle(page: Page) -> None:
    """Until the tree is made, and the picture of it does not change any more."""
    until, quiet, last = time.monotonic() + PATIENCE, 0, b""
    time.sleep(0.3)
    while quiet < 3 and time.monotonic() < until:
        state = page.get_by_test_id("status").get_attribute("data-state")
        now = page.locator("#tree").screenshot()
        quiet = quiet + 1 if state == "idle" and now == last else 0
        last = now
        time.sleep(0.25)


def line(page: Page, points) -> np.ndarray:
    """A smooth line through these points of the page, as a hand would draw it, in pixels of the window."""
    box = page.get_by_test_id("page-canvas").bounding_box()
    points = np.asarray(points) * [box["width"], box["height"]] + [box["x"], box["y"]]
    at, fine = np.arange(len(points)), np.linspace(0, len(points) - 1, 46)
    smooth = np.stack([np.polyval(np.polyfit(at, points[:, axis], len(points) - 1), fine) for axis in (0, 1)], axis=1)
    return smooth + np.random.default_rng(round(points[0, 1])).normal(0, 0.35, smooth.shape)


def draw(film: Film, points, shots: int) -> None:
    """With the pen; `shots` pictures on its way, and one of what came of it at once."""
    page, way = film.page, line(film.page, points)
    page.mouse.move(*way[0])
    page.mouse.down()
    for k, (x, y) in enumerate(way):
        page.mouse.move(x, y)
        film.pen = (x, y)
        if shots and k % (len(way) // shots) == len(way) // shots - 1:
            time.sleep(0.12)
            film.take()
    page.mouse.up()
    time.sleep(0.35)
    film.take()


def pressed(film: Film, test_id: str, hold: float) -> None:
    """A button, and what comes of it."""
    at = film.page.get_by_test_id(test_id)
    at.scroll_into_view_if_needed()
    box = at.bounding_box()
    film.pen = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    film.take(3)
    at.click()
    film.page.mouse.move(300, 5)
    settle(film.page)
    film.take(hold)


def turned(film: Film, pictures: int, pixels: float) -> None:
    """The tree, by hand."""
    box = film.page.get_by_test_id("tree-view").bounding_box()
    x, y = box["x"] + 0.35 * box["width"], box["y"] + 0.5 * box["height"]
    film.page.mouse.move(x, y)
    film.page.mouse.down()
    for _ in range(pictures):
        x += pixels
        film.page.mouse.move(x, y)
        film.pen = (x, y)
        time.sleep(0.9)  # the sharp picture comes when it rests
        film.take()
    time.sleep(0.2)
    film.page.mouse.up()


def film(path: Path) -> None:
    """A new page, a trunk, limbs, the tree that follows, round it, another template, autumn."""
    with studio() as (browser, address):
        page = opened(browser, address, 1280, 760)
        page.get_by_test_id("hint-new").click()
        with contextlib.suppress(Exception):
            page.locator(".toast button").last.click(timeout=2000)
        page.mouse.move(300, 5)
        settle(page)
        made = Film(page)
        made.take(8)
        draw(made, TRUNK, 6)
        settle(page)
        made.take(4)
        for limb in LIMBS:
            draw(made, limb, 4)
            settle(page)
            made.take(2)
        made.pen = None
        made.take(6)
        turned(made, 9, 26)
        made.pen = None
        made.take(4)
        pressed(made, "template-silver_birch", 9)
        pressed(made, "season-autumn", 8)
        turned(made, 8, 26)
        made.pen = None
        made.take(14)
        made.write(path)


def few(picture: Image.Image, count: int) -> Image.Image:
    """A palette of this picture's colours, and of the small but telling ones of the page that the many greens would push out."""
    common = picture.quantize(count - len(TELLING), method=Image.Quantize.MEDIANCUT).getpalette()[: 3 * (count - len(TELLING))]
    palette = Image.new("P", (1, 1))
    palette.putpalette([*common, *(part for colour in TELLING for part in bytes.fromhex(colour))])
    return palette


def still(page: Page, path: Path) -> None:
    """What is seen now, in few colours: a picture of a page must not weigh more than the page."""
    image = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
    image.quantize(palette=few(image, 256), dither=Image.Dither.FLOYDSTEINBERG).save(path, optimize=True)


def taken(page: Page) -> None:
    """A limb, by the keyboard."""
    page.get_by_test_id("tool-select").click()
    page.get_by_test_id("tree-view").focus()
    for _ in range(4):
        page.keyboard.press("Tab")


def pictures(out: Path) -> None:
    """Side by side in the light, over the tree in the dark, a limb in hand, a page that is turned."""
    with studio() as (browser, address):
        page = opened(browser, address, 1280, 760)
        page.get_by_test_id("hint-close").click()
        page.get_by_test_id("page-zoom").click()
        page.locator(".template:nth-child(-n + 9) .thumbnail:not([data-picture])").first.wait_for(state="detached", timeout=1000 * PATIENCE)
        settle(page)
        still(page, out / "studio_first.png")
        taken(page)
        page.get_by_test_id("handle-1").focus()
        page.keyboard.press("Shift+ArrowDown")
        settle(page)
        page.reload()  # what is seen next is what anyone sees who comes back
        settle(page)
        taken(page)
        settle(page)
        still(page, out / "studio_edit.png")
        page.get_by_test_id("limb-side").click()
        settle(page)
        still(page, out / "studio_turned.png")
        page.close()
        dark = opened(browser, address, 1280, 760, "dark")
        if dark.get_by_test_id("hint-close").is_visible():
            dark.get_by_test_id("hint-close").click()
        dark.get_by_test_id("layout").click()
        dark.get_by_test_id("page-zoom").click()
        settle(dark)
        still(dark, out / "studio_dark.png")


def photo(out: Path) -> None:
    """A photo under the page, with the strokes that mark it, what was traced, and the tree."""
    picture = PHOTO.with_suffix(".jpg")
    shown = read_photo(picture)
    marked = read_strokes(PHOTO.with_suffix(".svg"), shown)[0]
    with studio("oak.sketchtree") as (browser, address):
        page = opened(browser, address, 1400, 860)
        page.evaluate(UPLOAD, base64.b64encode(picture.read_bytes()).decode())
        page.get_by_test_id("photo-card").wait_for()
        settle(page)
        place = _on_screen(page, shown.width, shown.height)
        for points, button in ((np.r_[marked.crown, marked.crown[:1]], "left"), *((line, "right") for line in marked.branches)):
            way = place(points)
            page.mouse.move(*way[0])
            page.mouse.down(button=button)
            for x, y in way:
                page.mouse.move(x, y)
            page.mouse.up(button=button)
        page.get_by_test_id("photo-tint").wait_for(timeout=1000 * PATIENCE)
        page.locator("[data-testid=photo-card][data-grown=ready]").wait_for(timeout=1000 * PATIENCE)
        page.locator(".template:nth-child(-n + 10) .thumbnail:not([data-picture])").first.wait_for(state="detached", timeout=1000 * PATIENCE)
        settle(page)
        still(page, out / "studio_photo.png")


def _on_screen(page: Page, width: int, height: int) -> Callable[[np.ndarray], np.ndarray]:
    """Where pixels of a photo that was just laid under the page are: in the middle of what is free of it, 6 % of which is margin on each side (`PageCamera.fit`)."""
    box = page.get_by_test_id("page-canvas").bounding_box()
    head, foot = page.evaluate(
        "() => { const words = document.querySelector('.page-words'), foot = document.querySelector('.page-foot'); "
        "return [words.offsetTop + words.offsetHeight, document.getElementById('page').clientHeight - foot.offsetTop + 4] }"
    )
    free = box["height"] - head - foot
    scale = 0.88 * min(box["width"] / width, free / height)
    middle = np.array([box["x"] + box["width"] / 2, box["y"] + head + free / 2])
    return lambda pixels: middle + scale * (np.asarray(pixels) - [width / 2, height / 2])


def points(out: Path) -> None:
    """Points of a scan under the page, strokes over them, and the tree that took its depths from them, in winter, seen from aside."""
    with studio("scan.sketchtree") as (browser, address):
        page = opened(browser, address, 1400, 860)
        page.get_by_test_id("empty-gallery").click()
        page.get_by_test_id(f"example-{EXAMPLE}").click()
        page.locator("[data-testid=cloud-card]:not([hidden])").wait_for(timeout=1000 * PATIENCE)
        page.evaluate(SAY, json.dumps([{"type": "choose", "options": {"template": "european_ash", "season": "bare"}}, *({"type": "strokes", "label": "branch", "put": [stroke | PEN]} for stroke in strokes_over(16))]))
        settle(page)
        page.get_by_test_id("page-zoom").click()
        page.locator(".template:nth-child(-n + 10) .thumbnail:not([data-picture])").first.wait_for(state="detached", timeout=1000 * PATIENCE)
        box = page.get_by_test_id("tree-view").bounding_box()
        page.mouse.move(box["x"] + 0.35 * box["width"], box["y"] + 0.5 * box["height"])
        page.mouse.down()
        page.mouse.move(box["x"] + 0.6 * box["width"], box["y"] + 0.5 * box["height"], steps=12)
        page.mouse.up()
        page.mouse.move(300, 5)
        settle(page)
        still(page, out / "studio_points.png")


def main() -> None:
    """All, or one."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", choices=("gif", "pictures", "photo", "points"))
    parser.add_argument("--out", type=Path, default=Path("docs/pictures"))
    chosen = parser.parse_args()
    made = {"pictures": lambda: pictures(chosen.out), "photo": lambda: photo(chosen.out), "points": lambda: points(chosen.out), "gif": lambda: film(chosen.out / "studio.gif")}
    for make in made.values() if chosen.only is None else (made[chosen.only],):
        make()


if __name__ == "__main__":
    main()
