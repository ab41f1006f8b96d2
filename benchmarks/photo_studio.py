"""How long from pen up to the limbs traced in a photo under the page, and to the tree that grows in it? `python -m benchmarks.photo_studio PHOTOS [--pixels 1500] [--rounds 4]`

PHOTOS is a folder with pictures called as the strokes in `data/photo_strokes`. A real `sketchtree studio` runs in a process of its own; a page without a screen lays the photo,
made as large as asked, under an empty page, outlines its crown, then draws each branch and erases it again, with the pause of a person between. Times are from sending a stroke to having read

    trace   the limbs, which the page shows at once: the bar is 100 ms
    mask    the foliage, of a crown that was not seen before: the bar is 3 s
    tree    the photo's tree, of the same crown: foliage, a second's pause, growth and leaves, in a process that was begun for it

in milliseconds, median and 95th percentile of the first. Drawing on the screen is the browser's and not counted here.
"""

import argparse
import asyncio
import io
import tempfile
import time
from pathlib import Path

import numpy as np
from PIL import Image

from benchmarks.studio_latency import PATIENCE, PAUSE, Page, head_of, studio
from sketchtree.photo.read_photo import read_photo
from sketchtree.photo.read_strokes import read_strokes

STROKES = Path(__file__).parent / "data" / "photo_strokes"


def enlarged(path: Path, pixels: int) -> bytes:
    """A PNG of the photo whose longer side has so many pixels."""
    photo, data = read_photo(path), io.BytesIO()
    factor = pixels / max(photo.width, photo.height)
    Image.fromarray(photo.rgb).resize((round(photo.width * factor), round(photo.height * factor)), Image.Resampling.LANCZOS).save(data, "PNG")
    return data.getvalue()


def marks(name: str, path: Path, underlay: dict) -> tuple[dict, list[dict]]:
    """(the crown's stroke, those of branches), on the page where the photo lies."""
    photo = read_photo(path)
    marked = read_strokes(STROKES / f"{name}.svg", photo)[0]

    def stroke(kind: str, number: int, line) -> dict:
        xy = np.array(line) * underlay["width"] / photo.width + (underlay["x"], underlay["y"])
        return {"id": f"{kind}-{number}", "kind": kind, "xy": xy.ravel().round(2).tolist(), "closed": kind == "crown", "width": None if kind == "crown" else 3.0}

    return stroke("crown", 0, marked.crown), [stroke("branch", k, line) for k, line in enumerate(marked.branches)]


async def measured(address: str, name: str, path: Path, pixels: int, rounds: int) -> dict[str, list[float]]:
    """Milliseconds of every stroke on one photo."""
    import httpx
    from websockets.asyncio.client import connect

    base, found = address.partition("/?")[0], {"trace": [], "mask": [], "tree": []}
    with httpx.Client(trust_env=False, timeout=PATIENCE) as client:
        client.get(address, follow_redirects=True)
        cookie = "; ".join(f"{key}={value}" for key, value in client.cookies.items())
        async with connect(base.replace("http", "ws") + "/ws", origin=base, additional_headers={"Cookie": cookie}, max_size=None, proxy=None) as socket:
            page = Page(socket)
            await page.ask(type="hello", version=1)
            await page.said("welcome")
            data = await asyncio.to_thread(enlarged, path, pixels)
            await asyncio.to_thread(client.post, f"{base}/upload?name={name}.png&as=photo", content=data, headers={"Origin": base})
            underlay = await _underlay(page)
            crown, branches = marks(name, path, underlay)
            await page.said("traced", revision=page.revision)  # the process is there
            await _answer(page, "traced", label="branch", put=branches[:1])
            began = time.perf_counter()
            found["mask"].append(await _answer(page, "foliage", label="crown", put=[crown]))
            await page.said("tree", phase="photo")
            found["tree"].append(1000 * (time.perf_counter() - began))
            for _ in range(rounds):
                for branch in branches[1:] or [branches[0] | {"id": "again"}]:
                    for step in ({"label": "branch", "put": [branch]}, {"label": "erase", "gone": [branch["id"]]}):
                        await asyncio.sleep(PAUSE)
                        found["trace"].append(await _answer(page, "traced", **step))
    return found


async def _answer(page: Page, kind: str, **step) -> float:
    """Milliseconds until a step is answered by such a message, which may come before the step is confirmed."""
    before, began, took = page.revision, time.perf_counter(), None
    await page.ask(type="strokes", **step)
    async with asyncio.timeout(PATIENCE):
        while took is None or page.revision == before:
            head = head_of(await page.socket.recv())
            if head["type"] == "changed":
                page.revision = head["revision"]
            elif head["type"] == kind and head["revision"] > before and took is None:
                took = 1000 * (time.perf_counter() - began)
    return took


async def _underlay(page: Page) -> dict:
    while True:
        said = await page.said("changed")
        if said["underlay"] and said["underlay"]["photo"]:
            return said["underlay"]


def one_photo(path: Path, pixels: int, rounds: int) -> str:
    """A line of the table."""
    with tempfile.TemporaryDirectory() as folder:
        process, address = studio(folder, Path(folder) / "photo.sketchtree")
        try:
            found = asyncio.run(measured(address, path.stem, path, pixels, rounds))
        finally:
            process.terminate()
            process.wait(10)
    told = [f"{np.percentile(found['trace'], share):6.0f}" for share in (50, 95)]
    return f"{path.stem:28s} {' '.join(told)}   {found['mask'][0]:6.0f} {found['tree'][0]:6.0f}   {len(found['trace'])} strokes"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("photos", type=Path)
    parser.add_argument("--only", nargs="*", help="names of photos")
    parser.add_argument("--pixels", type=int, default=1500)
    parser.add_argument("--rounds", type=int, default=4)
    wanted = parser.parse_args()
    print(f"{'photo':28s} {'trace':>6s} {'95 %':>6s}   {'mask':>6s} {'tree':>6s}   ms")
    for path in sorted(wanted.photos.iterdir()):
        if (STROKES / f"{path.stem}.svg").exists() and (not wanted.only or path.stem in wanted.only):
            print(one_photo(path, wanted.pixels, wanted.rounds), flush=True)


if __name__ == "__main__":
    main()
