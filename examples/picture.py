"""The picture of the README: a sketch, and the tree made from it, from the front and from the side.

python examples/picture.py [SKETCH] [-o PICTURE.png]
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

import sketchtree as st

HERE = Path(__file__).resolve().parent
SIZE = (760, 760)
PAPER, INK, OUTLINE = (250, 248, 243), (45, 42, 40), (120, 150, 110)


def page(sketch: st.Sketch) -> Image.Image:
    """The strokes as they were drawn, on paper; four times oversampled."""
    over = 4
    points = np.concatenate([stroke.points for stroke in sketch.strokes])
    low, high = points.min(axis=0), points.max(axis=0)
    scale = over * 0.84 * min(SIZE / (high - low))
    middle = (low + high) / 2
    picture = Image.new("RGB", (SIZE[0] * over, SIZE[1] * over), PAPER)
    pen = ImageDraw.Draw(picture)
    for stroke in sketch.strokes:
        at = (stroke.points - middle) * [scale, -scale] + np.array(SIZE) * over / 2
        line = [tuple(point) for point in at]
        crown = stroke.kind == st.StrokeKind.CROWN
        width = max(3 * over // 2, round((stroke.width or 2.0) * scale / 2)) if not crown else 2 * over
        pen.line(line + line[:1] * stroke.closed, fill=OUTLINE if crown else INK, width=width, joint="curve")
    return picture.resize(SIZE, Image.Resampling.LANCZOS)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sketch", nargs="?", type=Path, default=HERE / "oak.svg")
    parser.add_argument("-o", "--output", type=Path, default=HERE.parent / "docs" / "pictures" / "readme.png")
    arguments = parser.parse_args()
    sketch = st.read_sketch(arguments.sketch)
    tree = st.sketch_to_tree(sketch, key=st.root_key(0))
    panes = [page(sketch)]
    with tempfile.TemporaryDirectory() as folder:
        for view in ("front", "side"):
            path = Path(folder) / f"{view}.png"
            drawn, reason = st.preview(tree.meshes, path, size=SIZE, view=view)
            if not drawn:
                parser.exit(1, f"{reason}\n")
            panes.append(Image.open(path).convert("RGB"))
    whole = Image.new("RGB", (SIZE[0] * len(panes), SIZE[1]), PAPER)
    for place, pane in enumerate(panes):
        whole.paste(pane, (place * SIZE[0], 0))
    whole = whole.resize((whole.width * 2 // 3, whole.height * 2 // 3), Image.Resampling.LANCZOS)
    whole.quantize(192, dither=Image.Dither.FLOYDSTEINBERG).save(arguments.output, optimize=True)


if __name__ == "__main__":
    main()
