"""What does a crown do? One drawing without and with crowns, as Chen et al. 2008, Figure 7, have it.

    python -m benchmarks.crown_picture [SKETCH] [-o PICTURE.png]

Columns: no crown; a round one; one that hangs to one side; two lobes; the round one filled (`--fill`). Rows: the page,
the tree from the front, from the right, and from above.
"""

import argparse
import dataclasses
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

import sketchtree as st
from sketchtree.keys import root_key
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.pipeline import sketch_to_tree
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

ROOT = Path(__file__).resolve().parents[1]
PANE = 384  # pixels
VIEWS = ("front", "side", "top")


def outlines(sketch: Sketch) -> dict[str, tuple[list[np.ndarray], bool]]:
    """{name: (crowns in the sketch's units, whether to fill)}, sized by the drawing's branches."""
    points = np.concatenate([stroke.points for stroke in sketch.strokes])
    (left, bottom), (right, top) = points.min(axis=0), points.max(axis=0)
    x, wide, tall = 0.5 * (left + right), right - left, top - bottom
    round_ = _ring((x, top - 0.3 * tall), (0.58 * wide, 0.37 * tall))
    aside = _ring((x + 0.12 * wide, top - 0.33 * tall), (0.5 * wide, 0.33 * tall), lean=0.3)
    lobes = [_ring((x - 0.29 * wide, top - 0.5 * tall), (0.3 * wide, 0.17 * tall)), _ring((x + 0.18 * wide, top - 0.22 * tall), (0.4 * wide, 0.25 * tall))]
    return {"none": ([], False), "round": ([round_], False), "aside": ([aside], False), "two lobes": (lobes, False), "round, filled": ([round_], True)}


def _ring(centre, half, lean: float = 0.0) -> np.ndarray:
    """A closed oval; `lean` makes its right side fuller below."""
    turn = np.linspace(0, 2 * np.pi, 73)
    shape = np.column_stack([np.cos(turn), np.sin(turn)])
    shape[:, 1] *= 1.0 + lean * shape[:, 0]
    return np.asarray(centre) + shape * np.asarray(half)


def crowned(sketch: Sketch, crowns: list[np.ndarray]) -> Sketch:
    """The branches of the sketch and these crowns."""
    branches = tuple(stroke for stroke in sketch.strokes if stroke.kind == StrokeKind.BRANCH)
    extra = tuple(Stroke(id=f"crown {k}", points=points, kind=StrokeKind.CROWN, closed=True, labelled=True) for k, points in enumerate(crowns))
    return dataclasses.replace(sketch, strokes=branches + extra)


def page(sketch: Sketch, low, high) -> Image.Image:
    """The strokes as lines, crowns in green."""
    pane = Image.new("RGB", (2 * PANE, 2 * PANE), "white")
    pen = ImageDraw.Draw(pane)
    scale = 2 * PANE * 0.9 / max(high - low)
    flip = np.array([scale, -scale])
    shift = PANE - flip * 0.5 * (low + high)
    for stroke in sketch.strokes:
        is_crown = stroke.kind == StrokeKind.CROWN
        pen.line([tuple(point) for point in stroke.points * flip + shift], fill=(70, 140, 70) if is_crown else (40, 40, 40), width=4 if is_crown else 6)
    return pane.resize((PANE, PANE), Image.Resampling.LANCZOS)


def main(argv=None) -> None:
    """Draws the sheet."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sketch", nargs="?", type=Path, default=ROOT / "benchmarks" / "data" / "ten_strokes.svg")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "docs" / "pictures" / "crowns.png")
    arguments = parser.parse_args(argv)
    sketch, key = crowned(st.read_sketch(arguments.sketch), []), root_key(0)
    all_points = np.concatenate([stroke.points for stroke in sketch.strokes] + [c for crowns, _ in outlines(sketch).values() for c in crowns])
    low, high = all_points.min(axis=0), all_points.max(axis=0)
    columns, template = [], "auto"
    for crowns, fill in outlines(sketch).values():
        drawing = crowned(sketch, crowns)
        tree = sketch_to_tree(drawing, key=key, reading=ReadingOptions(template=template), tree=TreeOptions(fill=fill))
        template = tree.drawn.matches[0].name if template == "auto" else template
        columns.append(np.vstack([np.array(page(drawing, low, high)), *views(tree.meshes, parser)]))
    sheet = Image.fromarray(np.hstack(columns))
    sheet.quantize(160, dither=Image.Dither.NONE).save(arguments.output, optimize=True)


def views(meshes, parser) -> list[np.ndarray]:
    """The tree from `VIEWS`."""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for view in VIEWS:
            drawn, reason = st.preview(meshes, Path(folder) / "view.png", size=(PANE, PANE), view=view)
            if not drawn:
                parser.exit(1, f"{reason}\n")
            found.append(np.array(Image.open(Path(folder) / "view.png").convert("RGB")))
    return found


if __name__ == "__main__":
    main()
