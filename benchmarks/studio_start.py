"""How soon is the studio there, and how much memory does it take? `python -m benchmarks.studio_start [--starts 4] [--edits 200]`

Starts one after the other, each of `sketchtree studio --no-browser` with its example and a real browser: the first with nothing in the stock of trees and pictures
(compiled programs are warm), as after the program was installed anew; the others with it. Seconds from the command to

    address    its line is printed: connections are accepted       paint    the browser has painted (the browser's own start left out)
    page       one can draw                                        tree     the whole tree is there
    cpu        not since the command, but spent by the server and its processes until the tree was there: what a busy machine leaves as it is

and megabytes of the server and its three processes, then and after so many edits of one page.
"""

import argparse
import asyncio
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ARGUMENTS = ["--no-sandbox", "--enable-unsafe-swiftshader", "--use-gl=angle", "--use-angle=swiftshader", "--ignore-gpu-blocklist"]
PATIENCE = 120.0


def start(folder: str) -> tuple[subprocess.Popen, str, float]:
    """(a studio, its address, when it was asked for)."""
    began = time.perf_counter()
    command = [sys.executable, "-m", "sketchtree", "studio", "--no-browser"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=folder, env=os.environ | {"SKETCHTREE_RECOVERY": f"{folder}/recovery"})
    return process, process.stdout.readline().split()[-1], began


def one_start(browser) -> dict[str, float]:
    """Seconds of one start."""
    with tempfile.TemporaryDirectory() as folder:
        page = browser.new_page(viewport={"width": 1280, "height": 720})
        process, address, began = start(folder)
        found = {"address": time.perf_counter() - began}
        try:
            asked = time.perf_counter()
            page.goto(address, wait_until="commit")
            while not page.evaluate("performance.getEntriesByName('first-contentful-paint').length"):
                page.wait_for_timeout(20)
            paint = page.evaluate("performance.getEntriesByName('first-contentful-paint')[0].startTime") / 1000
            found["paint"] = asked - began + paint
            page.locator('[data-testid="page-canvas"]').first.wait_for()
            found["page"] = time.perf_counter() - began
            status = page.locator('[data-testid="status"]')
            while not (status.get_attribute("data-state") == "idle" and int(status.get_attribute("data-segments") or 0)):
                page.wait_for_timeout(50)
            found["tree"], found["cpu"] = time.perf_counter() - began, seconds_of(process)
        finally:
            page.close()
            process.terminate()
            process.wait(20)
    return found


def seconds_of(process: subprocess.Popen) -> float:
    """CPU seconds of the server and of all its children so far."""
    children = subprocess.run(["ps", "-o", "pid=", "--ppid", str(process.pid)], capture_output=True, text=True).stdout.split()
    fields = [Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split() for pid in (str(process.pid), *children)]
    return sum(int(field[11]) + int(field[12]) for field in fields) / os.sysconf("SC_CLK_TCK")


def megabytes(process: subprocess.Popen) -> dict[str, float]:
    """Resident memory of the server, and of all its children."""
    children = subprocess.run(["ps", "-o", "pid=", "--ppid", str(process.pid)], capture_output=True, text=True).stdout.split()

    def resident(pid: str) -> float:
        text = Path(f"/proc/{pid}/status").read_text()
        return next(int(line.split()[1]) / 1024 for line in text.splitlines() if line.startswith("VmRSS"))

    return {"server": resident(str(process.pid)), "processes": sum(resident(pid) for pid in children)}


async def edited(address: str, edits: int) -> None:
    """So many strokes, each erased again, one after the other."""
    from benchmarks.studio_latency import entered

    async with entered(address) as page:
        await page.said("tree", phase="full")
        for k in range(edits):
            stroke = {"id": "edit", "kind": "branch", "xy": [400, 400, 430 + k % 20, 330]}
            await page.ask(type="strokes", label="branch", **({"put": [stroke]} if k % 2 == 0 else {"gone": ["edit"]}))
            await page.said("changed")
            await page.said("tree", revision=page.revision)


def main(argv=None) -> None:
    """Prints both tables."""
    from playwright.sync_api import sync_playwright

    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--starts", type=int, default=4)
    parser.add_argument("--edits", type=int, default=200)
    asked = parser.parse_args(argv)
    with sync_playwright() as play, tempfile.TemporaryDirectory() as stock:
        os.environ["SKETCHTREE_CACHE"] = stock
        browser = play.chromium.launch(executable_path="/usr/bin/chromium" if Path("/usr/bin/chromium").exists() else None, args=ARGUMENTS)
        for _ in range(asked.starts):
            print(json.dumps({name: round(seconds, 2) for name, seconds in one_start(browser).items()}), flush=True)
        browser.close()
    if not asked.edits:
        return
    with tempfile.TemporaryDirectory() as folder:
        process, address, _ = start(folder)
        try:
            for edits in (2, asked.edits):
                asyncio.run(edited(address, edits))
                print(f"after {edits} edits, MB: " + ", ".join(f"{name} {size:.0f}" for name, size in megabytes(process).items()), flush=True)
        finally:
            process.terminate()
            process.wait(20)


if __name__ == "__main__":
    main()
