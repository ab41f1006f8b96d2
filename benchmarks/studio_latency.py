"""How long from pen up to a new tree? `python -m benchmarks.studio_latency [--segments 5 15 50 150 500] [--strokes 12]`

A real `sketchtree studio` runs in a process of its own; a page without a screen draws on it. Of each drawing one outer limb after the other is taken away and drawn
again, with the pause of a person between. Times are from sending the stroke to having read

    quick   the frame of what was touched, which the page shows at once: the bar is 150 ms for 50 segments
    full    the frame of the whole tree

in milliseconds, median and 95th percentile; drawing the frame on the screen is the browser's and not counted here (`studio_page`).
"""

import argparse
import asyncio
import json
import os
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

import numpy as np

from benchmarks.speed_case import tree_of_segments
from sketchtree.sketch.files.sketch_json import sketch_json
from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.strokes import Sketch, Stroke

PAUSE = 0.3  # seconds between a full tree and the next stroke
PATIENCE = 120.0


def drawing(graph: SketchGraph) -> Sketch:
    """A graph as strokes, one a limb, at the size of a page."""
    scale = 800.0 / graph.height
    strokes = []
    for limb in range(len(graph.limb_id)):
        rows = np.flatnonzero((graph.limb == limb) & ~graph.is_base)
        points = np.concatenate([graph.curve(rows[0])[:1], *[graph.curve(row)[1:] for row in rows]])
        strokes.append(Stroke(f"limb {limb}", points * scale, labelled=True))  # as the page's pen draws them
    return Sketch(tuple(strokes))


def outer(graph: SketchGraph) -> list[str]:
    """Strokes that bear no other."""
    bearing = set(graph.limb_parent.tolist())
    return [f"limb {limb}" for limb in range(len(graph.limb_id)) if limb not in bearing and graph.limb_parent[limb] >= 0]


class Page:
    """What a page does, without a screen."""

    def __init__(self, socket):
        self.socket, self.revision = socket, 0

    async def said(self, kind: str, *, revision: int = -1, phase: str = "") -> dict:
        """The next message of a kind; of trees of a phase and a revision."""
        async with asyncio.timeout(PATIENCE):
            while True:
                head = head_of(await self.socket.recv())
                if head["type"] == "changed":
                    self.revision = head["revision"]
                if head["type"] == kind and head.get("revision", 0) >= revision and phase in ("", head.get("phase")):
                    return head

    async def ask(self, **request) -> None:
        await self.socket.send(json.dumps(request))


def head_of(said: str | bytes) -> dict:
    """A message, or the head of a frame."""
    if isinstance(said, str):
        return json.loads(said)
    (length,) = struct.unpack_from("<I", said)
    return json.loads(said[4 : 4 + length])


@asynccontextmanager
async def entered(address: str) -> AsyncIterator[Page]:
    """A page without a screen at a studio's address, welcomed."""
    import httpx
    from websockets.asyncio.client import connect

    with httpx.Client(trust_env=False) as client:
        client.get(address, follow_redirects=True)
        cookie = "; ".join(f"{name}={value}" for name, value in client.cookies.items())
    base = address.partition("/?")[0]
    async with connect(base.replace("http", "ws") + "/ws", origin=base, additional_headers={"Cookie": cookie}, max_size=None, proxy=None) as socket:
        page = Page(socket)
        await page.ask(type="hello", version=1)
        yield page


async def measured(address: str, strokes: dict[str, dict], names: list[str]) -> dict[str, list[float]]:
    """Milliseconds of every stroke."""
    found: dict[str, list[float]] = {"quick": [], "full": []}
    async with entered(address) as page:
        await page.said("tree", phase="full")
        for name in (names[0], *names):  # the first is not counted: programs are compiled
            await page.ask(type="strokes", label="erase", gone=[name])
            await page.said("changed")
            await page.said("tree", phase="full", revision=page.revision)
            await asyncio.sleep(PAUSE)
            began = time.perf_counter()
            await page.ask(type="strokes", label="branch", put=[strokes[name]])
            await page.said("changed")
            await page.said("tree", phase="quick", revision=page.revision)
            found["quick"].append(1000 * (time.perf_counter() - began))
            await page.said("tree", phase="full", revision=page.revision)
            found["full"].append(1000 * (time.perf_counter() - began))
            await asyncio.sleep(PAUSE)
    return {kind: times[1:] for kind, times in found.items()}


def studio(folder: str, file: Path) -> tuple[subprocess.Popen, str]:
    """(a studio that runs, its address)."""
    command = [sys.executable, "-m", "sketchtree", "studio", str(file), "--no-browser"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=os.environ | {"SKETCHTREE_RECOVERY": f"{folder}/recovery"})
    return process, process.stdout.readline().split()[-1]


def one_size(segments: int, strokes: int) -> str:
    """A line of the table."""
    from sketchtree.studio.wire import stroke_out

    graph = tree_of_segments(segments)
    sketch = drawing(graph)
    by_name = {stroke.id: json.loads(_encoded(stroke_out(stroke))) for stroke in sketch.strokes}
    names = outer(graph)
    names = [names[k] for k in np.linspace(0, len(names) - 1, min(strokes, len(names))).astype(int)]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "drawing.json"
        file.write_text(sketch_json(sketch))
        process, address = studio(folder, file)
        try:
            found = asyncio.run(measured(address, by_name, names))
        finally:
            process.terminate()
            process.wait(20)
    figures = "".join(f"{np.median(found[kind]):10.0f}{np.percentile(found[kind], 95):8.0f}" for kind in ("quick", "full"))
    return f"{graph.segment_count:10d}{len(sketch.strokes):9d}{figures}{len(names):9d}"


def _encoded(message) -> bytes:
    import msgspec

    return msgspec.json.encode(message)


def main(argv=None) -> None:
    """Prints one line a size."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--segments", nargs="+", type=int, default=[10, 25, 50, 150, 500])
    parser.add_argument("--strokes", type=int, default=12)
    asked = parser.parse_args(argv)
    print(f"{'segments':>10s}{'strokes':>9s}{'quick p50':>10s}{'p95':>8s}{'full p50':>10s}{'p95':>8s}{'tries':>9s}   (ms)")
    for segments in asked.segments:
        print(one_size(segments, asked.strokes), flush=True)


if __name__ == "__main__":
    main()
