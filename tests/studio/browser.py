"""A real studio in its own process, and a real browser in front of it: what the browser tests stand on.

With `CI` set, a missing browser is a failure; elsewhere the tests skip, with the reason.
"""

import os
import queue
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from urllib.parse import urlsplit

import pytest

ARGUMENTS = [
    "--no-sandbox", "--enable-unsafe-swiftshader", "--use-gl=angle", "--use-angle=swiftshader", "--ignore-gpu-blocklist", "--disable-background-networking",
    "--disable-component-update", "--no-first-run", "--disable-quic",
]  # fmt: skip
PATIENCE = 90.0  # seconds; nothing here is asserted to be quick


def without(reason: str):
    """There is no browser here."""
    (pytest.fail if os.environ.get("CI") else pytest.skip)(reason)


def launch():
    """Playwright and a browser of the machine's own."""
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        without("Playwright for Python is not installed: pip install 'sketchtree[test]'")
    program = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if program is None:
        without("no chromium on PATH (Debian: apt-get install chromium)")
    playwright = sync_playwright().start()
    return playwright, playwright.chromium.launch(executable_path=program, args=ARGUMENTS)


def open_window(browser, width: int = 1280, height: int = 720, **more):
    """A window of the least size that the page is made for; one pixel a CSS pixel."""
    return browser.new_context(viewport={"width": width, "height": height}, **more)


STATUS = """(element, seen) => new Promise((done) => {
  const said = () => ({ ...element.dataset });
  const isNew = () => !seen || Object.entries(said()).some(([name, value]) => String(seen[name]) !== value);
  if (isNew()) return done(said());
  const watch = new MutationObserver(() => isNew() && end());
  const end = () => { watch.disconnect(); clearTimeout(timer); done(said()); };
  const timer = setTimeout(end, 500);
  watch.observe(element, { attributes: true });
})"""  # what the status line says, once that is not what was seen; after half a second in any case

CONTRASTS = (Path(__file__).parent / "contrasts.js").read_text("utf-8")


class Studio:
    """`sketchtree studio --no-browser` in a folder of its own."""

    def __init__(self, folder: Path, *arguments: str):
        self.folder = folder
        self.arguments = arguments
        self.start()

    def start(self) -> None:
        environment = {**os.environ, "SKETCHTREE_RECOVERY": str(self.folder / "recovery"), "PYTHONUNBUFFERED": "1"}
        work = self.folder / "work"
        work.mkdir(parents=True, exist_ok=True)
        said: queue.Queue[str] = queue.Queue()  # of this process: one that was killed may still be heard
        self.errors = open(self.folder / "stderr.txt", "ab")
        self.process = subprocess.Popen(
            [sys.executable, "-m", "sketchtree", "studio", "--no-browser", *self.arguments],
            cwd=work, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=self.errors, text=True, start_new_session=True,
        )  # fmt: skip
        threading.Thread(target=self._listen, args=(self.process.stdout, said), daemon=True).start()
        try:
            line = said.get(timeout=PATIENCE)
        except queue.Empty:
            line = ""
        if not line.startswith("Studio: http://127.0.0.1:"):
            self.stop()
            raise AssertionError(f"the studio said {line!r} and {self.trouble()!r}")
        self.address = line.removeprefix("Studio: ").strip()

    @staticmethod
    def _listen(stream, said: queue.Queue) -> None:
        with stream:
            for line in stream:
                said.put(line)
        said.put("")

    def trouble(self) -> str:
        """What it wrote on stderr."""
        return (self.folder / "stderr.txt").read_text("utf-8", "replace")

    @property
    def alive(self) -> bool:
        return self.process.poll() is None

    def kill(self) -> None:
        """As a power cut: it and the processes it started, at once."""
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait(PATIENCE)
        self.errors.close()

    def stop(self) -> int:
        """As Ctrl-C; gives the exit status."""
        if self.alive:
            os.kill(self.process.pid, signal.SIGINT)
        try:
            status = self.process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self.kill()
            raise
        self.errors.close()
        return status


class Page:
    """One page of a studio, and everything odd that happens in it."""

    def __init__(self, context, address: str):
        self.faults: list[str] = []
        self.outside: list[str] = []
        self.page = context.new_page()
        self.page.set_default_timeout(PATIENCE * 1000)
        self.page.on("console", self._console)
        self.page.on("pageerror", lambda error: self.faults.append(f"uncaught: {error}"))
        self.page.on("request", self._request)
        self.page.add_init_script("addEventListener('securitypolicyviolation', (e) => console.error('policy: ' + e.violatedDirective + ' ' + e.blockedURI))")
        self._expected: tuple[str, ...] = ()
        self.page.goto(address)

    def expect(self, *parts: str) -> None:
        """What a test provokes itself is not odd: messages with one of these in them."""
        self._expected += parts

    @property
    def odd(self) -> list[str]:
        """Errors of the console, uncaught ones, breaches of the policy."""
        return [fault for fault in self.faults if not any(part in fault for part in self._expected)]

    def _console(self, message) -> None:
        if message.type == "error":
            self.faults.append(message.text)

    def _request(self, request) -> None:
        parts = urlsplit(request.url)
        if parts.scheme not in ("data", "blob") and parts.hostname != "127.0.0.1":
            self.outside.append(request.url)

    def get(self, test_id: str):
        """The element of this test id."""
        return self.page.get_by_test_id(test_id)

    @property
    def status(self) -> dict:
        """What the status line says: state, segments, triangles, revision; figures are numbers."""
        return self._status_after(None)

    def _status_after(self, seen: dict | None) -> dict:
        """The next status that is another one, or the same after a while; without `seen` the one there is."""
        data = self.get("status").evaluate(STATUS, seen)
        return {name: int(value) if name in ("segments", "triangles", "revision") and value else value for name, value in data.items()}

    def wait(self, holds: Callable[[dict], bool], what: str = "the status line", patience: float = PATIENCE) -> dict:
        """The status once this holds of it."""
        end = time.monotonic() + patience
        status = self.status
        while not holds(status):
            if time.monotonic() > end:
                raise AssertionError(f"{what} did not come; the status line says {status}; odd: {self.odd}")
            status = self._status_after(status)
        return status

    def settle(self) -> dict:
        """The status once nothing is being worked at."""
        return self.wait(lambda status: status.get("state") == "idle" and isinstance(status.get("revision"), int), "rest")

    def change(self, do: Callable[[], object]) -> tuple[dict, dict]:
        """The status before and after something that makes another tree."""
        before = self.settle()
        do()
        after = self.wait(lambda status: status["state"] == "idle" and status["revision"] > before["revision"], "a newer tree")
        return before, after

    def draw(self, *points: tuple[float, float], steps: int = 6) -> None:
        """With the mouse, on the page; 0 0 is its top left corner, 1 1 the lower right."""
        box = self.get("page-canvas").bounding_box()
        at = [(box["x"] + x * box["width"], box["y"] + y * box["height"]) for x, y in points]
        mouse = self.page.mouse
        mouse.move(*at[0])
        mouse.down()
        for place in at[1:]:
            mouse.move(*place, steps=steps)
        mouse.up()

    def click_page(self, x: float, y: float) -> None:
        """With the mouse, at a place of the page as `draw` has it."""
        box = self.get("page-canvas").bounding_box()
        self.page.mouse.click(box["x"] + x * box["width"], box["y"] + y * box["height"])

    def weak_contrasts(self) -> list[dict]:
        """Visible texts whose contrast with their ground is under 4.5 to 1 (3 to 1 for large ones), by WCAG 2."""
        return self.page.evaluate(CONTRASTS)
