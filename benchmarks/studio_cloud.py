"""How soon is a tree there when somebody draws over points? `python -m benchmarks.studio_cloud [--looks 2 30] [--kept]`

A real `sketchtree studio` begins with an empty page, and a page without a screen opens the example *ash*. It looks at the points for so many seconds; then it draws the trunk and, one after the
other, limbs that were traced in them. A line for every stroke:

    quick    the frame of what was touched, which the page shows at once        full    the frame of the whole tree          seconds since the stroke was sent
    cpu      of the server and its processes meanwhile, seconds: what a busy machine leaves as it is

`--kept` begins with the programs that earlier runs compiled; without it there are none, as after the program was installed.
"""

import argparse
import asyncio
import json
import os
import tempfile
import time
from pathlib import Path

import msgspec
import numpy as np

from benchmarks.studio_latency import PATIENCE, entered, studio
from benchmarks.studio_start import seconds_of
from sketchtree.keys import root_key
from sketchtree.laid_tree import Laid, as_strokes, tree_of
from sketchtree.studio import examples
from sketchtree.studio.making.documents import document_of
from sketchtree.studio.wire import stroke_out

EXAMPLE = "ash.ply"
PAUSE = 0.5  # seconds between a full tree and the next stroke


def strokes_over(limbs: int) -> list[dict]:
    """The trunk of the example and so many of its limbs, as a page sends them: without their depths."""
    cloud = document_of(examples.data(EXAMPLE), EXAMPLE).cloud
    laid = Laid(cloud)
    found, _ = as_strokes(tree_of(laid, None, key=root_key(0)), laid)
    long = sorted(list(found.values())[1:], key=lambda stroke: -float(np.linalg.norm(np.diff(stroke.points, axis=0), axis=1).sum()))
    return [json.loads(msgspec.json.encode(stroke_out(stroke))) for stroke in [found["trunk"], *long[:limbs]]]


async def measured(address: str, process, looks: float, strokes: list[dict]) -> None:
    """Prints a line for every stroke."""
    async with entered(address) as page:
        await page.said("changed")
        began, cpu = time.perf_counter(), seconds_of(process)
        await page.ask(type="open", name=EXAMPLE, example=True)
        while page.revision < 2:
            await page.said("changed")
        print(f"  points are there after {time.perf_counter() - began:.1f} s, cpu {seconds_of(process) - cpu:.1f}", flush=True)
        await asyncio.sleep(looks)
        print(f"  cpu when the first stroke is drawn {seconds_of(process) - cpu:.1f}", flush=True)
        for number, stroke in enumerate(strokes):
            cpu, began = seconds_of(process), time.perf_counter()
            await page.ask(type="strokes", label="branch", put=[stroke])
            await page.said("changed")
            found = {}
            while "full" not in found:
                head = await page.said("tree", revision=page.revision)
                found.setdefault(head["phase"], time.perf_counter() - began)
            quick = f"{found['quick']:8.2f}" if "quick" in found else f"{'-':>8s}"
            print(f"  {'trunk' if number == 0 else f'limb {number}':8s}{quick}{found['full']:8.2f}{seconds_of(process) - cpu:8.1f}", flush=True)
            await asyncio.sleep(PAUSE)


def main(argv=None) -> None:
    """Prints a table for every pause."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--looks", nargs="+", type=float, default=[2.0, 30.0])
    parser.add_argument("--limbs", type=int, default=8)
    parser.add_argument("--kept", action="store_true")
    asked = parser.parse_args(argv)
    strokes = strokes_over(asked.limbs)
    for looks in asked.looks:
        with tempfile.TemporaryDirectory() as folder:
            os.environ["SKETCHTREE_CACHE"] = f"{folder}/stock"
            if not asked.kept:
                os.environ["JAX_COMPILATION_CACHE_DIR"] = f"{folder}/jax"
                Path(folder, "jax").mkdir()
            print(f"{looks:g} s of looking, {'programs kept' if asked.kept else 'no program kept'}\n  stroke     quick    full     cpu   (s)", flush=True)
            process, address = studio(folder, Path(folder) / "blank.sketchtree")
            try:
                asyncio.run(asyncio.wait_for(measured(address, process, looks, strokes), 5 * PATIENCE))
            finally:
                process.terminate()
                process.wait(20)


if __name__ == "__main__":
    main()
