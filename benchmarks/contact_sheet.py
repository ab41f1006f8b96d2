"""How is every drawing of a folder read? One picture of all their overlays, or the reason why not.

    python -m benchmarks.contact_sheet FILE_OR_FOLDER ... -o SHEET.png [--columns N] [--skip WORD ...]

A caption counts strokes, stems, limbs and doubts. A drawing that can't be read shows its error.
"""

import argparse
import io
import textwrap
import time
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

from sketchtree.errors import SketchTreeError
from sketchtree.overlay.as_png import scene_png
from sketchtree.overlay.draw import MARGIN, overlay
from sketchtree.overlay.legend import counts
from sketchtree.overlay.scan import scan
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.reading import sketch_graph

CELL, CAPTION = 430, 46  # pixels
KINDS = (".svg", ".svgz", ".json", ".excalidraw", ".excalidrawlib", ".inkml", ".ndjson", ".png", ".jpg", ".jpeg", ".webp", ".tif", ".tiff")


def files(places: list[Path], skip: list[str]) -> list[Path]:
    """Every drawing in these places; a rendered twin (PNG beside an SVG of its name) counts too, and every line of an .ndjson."""
    found = [p for place in places for p in (sorted(place.rglob("*")) if place.is_dir() else [place])]
    found = [p for p in found if p.suffix.lower() in KINDS and not any(word in str(p) for word in skip)]
    return [drawing for p in found for drawing in (_lines(p) if p.suffix.lower() == ".ndjson" else [p])]


def _lines(path: Path) -> list[Path]:
    """The drawings of a file that holds one a line."""
    count = sum(bool(line.strip()) for line in path.read_bytes().splitlines())
    return [path.with_name(f"{path.name}#{k}") for k in range(1, count + 1)]


def cell(path: Path) -> tuple[Image.Image, str]:
    """(the overlay of one drawing, its line for the terminal)."""
    picture = Image.new("RGB", (CELL, CELL + CAPTION), "#ffffff")
    write = ImageDraw.Draw(picture)
    began = time.process_time()
    try:
        sketch = read_sketch(path)
        graph = sketch_graph(sketch)
        caption = counts(graph)
        scene = overlay(sketch, graph, underlay=scan(path, sketch), long_side=CELL - 2 * MARGIN, explained=False)
        seen = Image.open(io.BytesIO(scene_png(scene)))
        picture.paste(seen, ((CELL - seen.width) // 2, CAPTION + (CELL - seen.height) // 2))
    except SketchTreeError as error:
        caption = "not read"
        for k, line in enumerate(textwrap.wrap(str(error), 52)):
            write.text((14, CAPTION + 24 + 20 * k), line, "#a02020", ImageFont.load_default(15))
    write.rectangle((0, 0, CELL - 1, CELL + CAPTION - 1), outline="#dddddd")
    write.text((8, 4), f"{path.parent.name}/{path.name}", "#111111", ImageFont.load_default(16))
    write.text((8, 25), caption, "#555555", ImageFont.load_default(13))
    return picture, f"{path.name:34} {time.process_time() - began:6.2f} s  {caption}"


def main() -> None:
    """Draw the sheet and print a line a drawing."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("places", type=Path, nargs="+", help="drawings, or folders of them")
    parser.add_argument("-o", "--output", type=Path, required=True, help="the picture to write (.png)")
    parser.add_argument("--columns", type=int, default=6)
    parser.add_argument("--skip", nargs="*", default=[], help="leave out paths with these words")
    wanted = parser.parse_args()
    cells = []
    for path in files(wanted.places, wanted.skip):
        picture, line = cell(path)
        cells.append(picture)
        print(line, flush=True)
    rows = -(-len(cells) // wanted.columns)
    sheet = Image.new("RGB", (wanted.columns * CELL, rows * (CELL + CAPTION)), "#ffffff")
    for k, picture in enumerate(cells):
        sheet.paste(picture, (k % wanted.columns * CELL, k // wanted.columns * (CELL + CAPTION)))
    sheet.save(wanted.output)


if __name__ == "__main__":
    main()
