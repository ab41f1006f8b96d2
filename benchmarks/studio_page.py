"""How does the studio's page keep up? `python -m benchmarks.studio_page [--sketch examples/oak.svg] [--strokes 8]`

A real `sketchtree studio` with a real browser. Without a graphics card the browser draws with the processor (SwiftShader), which is what most of the figures of
the second table are then made of.

    pen up → came     the frame of what was touched has arrived         → taken in    its meshes are in the scene         → shown    it is on the screen
    frames a second   while the view turns: all of it, only wood, only leaves, an empty scene
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
ARGUMENTS = ["--no-sandbox", "--enable-unsafe-swiftshader", "--use-gl=angle", "--use-angle=swiftshader", "--ignore-gpu-blocklist"]
PATIENCE = 120.0


def settled(page, revision: int = 0) -> int:
    """Wait until a tree newer than that is there and nothing is being worked at; its revision."""
    status = page.locator('[data-testid="status"]')
    until = time.monotonic() + PATIENCE
    while time.monotonic() < until:
        now, state = int(status.get_attribute("data-revision") or 0), status.get_attribute("data-state")
        if state == "idle" and now > revision and int(status.get_attribute("data-segments") or 0):
            return now
        page.wait_for_timeout(50)
    raise TimeoutError("The tree did not come.")


def draw(page, k: int) -> None:
    """A short limb at the trunk, left and right in turn, ever higher."""
    box = page.locator('[data-testid="page-canvas"]').bounding_box()
    side, height = (1 if k % 2 else -1), 0.62 - 0.035 * k

    def at(x: float, y: float) -> tuple[float, float]:
        return box["x"] + x * box["width"], box["y"] + y * box["height"]

    page.mouse.move(*at(0.5, height))
    page.mouse.down()
    page.mouse.move(*at(0.5 + 0.06 * side, height - 0.03), steps=4)
    page.mouse.move(*at(0.5 + 0.1 * side, height - 0.08), steps=4)
    page.mouse.up()


def measured(address: str, strokes: int) -> None:
    """Prints both tables."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as play:
        browser = play.chromium.launch(executable_path="/usr/bin/chromium" if Path("/usr/bin/chromium").exists() else None, args=ARGUMENTS)
        page = browser.new_page(viewport={"width": 1280, "height": 720})
        page.goto(address)
        page.goto(address.partition("?")[0] + "?bench")
        revision = settled(page)
        page.wait_for_timeout(4000)
        found = []
        for k in range(strokes + 1):
            draw(page, k)
            revision = settled(page, revision)
            page.wait_for_timeout(600)
            lifted = page.evaluate("window.__studio.lifted()")
            found += lifted if k else []  # programs are compiled by the first
        print(f"{'pen up →':>12s}{'came':>8s}{'taken in':>10s}{'shown':>8s}   (ms, of {len(found)} strokes, first frames: {', '.join(sorted({one['phase'] for one in found}))})")
        for name, how in (("p50", 50), ("p95", 95)):
            print(f"{name:>12s}" + "".join(f"{np.percentile([one[key] for one in found], how):{width}.0f}" for key, width in (("came", 8), ("taken", 10), ("shown", 8))))
        for part in ("all", "wood", "leaves", "none"):
            got = page.evaluate(f"window.__studio.fps(3, '{part}')")
            print(f"{part:>12s} {got['fps']:6.1f} frames a second, 95 % within {got['p95']:.0f} ms, {'software' if got['software'] else 'hardware'}")
        status = page.locator('[data-testid="status"]')
        print(f"{status.get_attribute('data-segments')} segments, {status.get_attribute('data-triangles')} triangles; {status.inner_text().split('leaves')[0].split()[-1]} leaves")
        browser.close()


def main(argv=None) -> None:
    """Starts a studio, and measures."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sketch", type=Path, default=ROOT / "examples" / "oak.svg")
    parser.add_argument("--strokes", type=int, default=8)
    asked = parser.parse_args(argv)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / asked.sketch.name
        file.write_bytes(asked.sketch.read_bytes())
        command = [sys.executable, "-m", "sketchtree", "studio", str(file), "--no-browser"]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=os.environ | {"SKETCHTREE_RECOVERY": f"{folder}/recovery"})
        try:
            measured(process.stdout.readline().split()[-1], asked.strokes)
        finally:
            process.terminate()
            process.wait(20)


if __name__ == "__main__":
    main()
