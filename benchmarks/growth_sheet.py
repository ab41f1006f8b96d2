"""What does a tree that grows look like, with its leaves? Pictures like Figures 6 to 9 of the single-image growth paper, and a film.

    python -m benchmarks.growth_sheet -o FOLDER [photo] [modes] [crowns] [bends] [film]

`growth_photo.png`: from `examples/photo/sugar_maple.jpg` with lines on it to a tree. All others are of `examples/oak.svg`. `growth_modes.png`: every mode at even times. `growth_crowns.png`: branches grafted on the drawn limbs alone, two to four levels deep, from the front and above,
and other crowns on the same limbs. `growth_bends.png`: the strengths of Figure 8 at the end, and one of them as it grows. `growth.gif`: the film of the README.
"""

import argparse
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont, ImageOps

from sketchtree.animation.growing import Growing
from sketchtree.drawn_tree import draw_out
from sketchtree.growth.plan import MODES
from sketchtree.growth_tree import Beginning, GrowthOptions, find_trunk, grown_tree, of_drawing, of_picture, of_skeleton
from sketchtree.keys import root_key
from sketchtree.matting.scribbles import read_scribbles
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.photo.read_photo import read_photo
from sketchtree.templates.store.database import Database
from sketchtree.view.growth_film import growth_film
from sketchtree.view.picture import preview

DRAWING = Path("examples/oak.svg")
PHOTO, MARKS = Path("examples/photo/sugar_maple.jpg"), Path("examples/photo/sugar_maple_marks.json")
SIDE, CAPTION = 230, 24  # pixels
STRENGTHS = (20, 0, -7, -14, -25)  # degrees, Figure 8
LEVELS, CROWNS = (2, 3, 4), 4
STEPS = 6  # times of a row, the last the whole tree
FILM, FRAMES, SECONDS, TURN = 400, 60, 5.0, 40.0

Row = list[tuple[str, Image.Image]]


def drawn(templates: Database) -> Beginning:
    """The oak, as `sketchtree grow examples/oak.svg` begins."""
    return of_drawing(DRAWING, templates, key=root_key(0), reading=ReadingOptions(), tree=TreeOptions())


def limbs(templates: Database, season: str = "summer") -> Beginning:
    """Its drawn limbs alone: a bare trunk that an oak's branches may be grafted on."""
    out = draw_out(DRAWING, templates, key=root_key(0), options=ReadingOptions())
    return of_skeleton(out.skeleton, TreeOptions(season=season), templates, key=root_key(0), template=out.exemplar.name)


def growing(beginning: Beginning, mode: str = "full", bend: float = 0.0, levels: int | None = None) -> Growing:
    """The tree that moves."""
    grown = grown_tree(beginning, GrowthOptions(levels, mode, bend))
    return Growing.of(grown.model, grown.plan)


def photo(templates: Database, path: Path) -> None:
    """Photo and lines, matte, trunk, and the tree of it from the front and from the side."""
    shown = read_photo(PHOTO)
    scribbles = read_scribbles(MARKS, shown)
    found = find_trunk(shown, scribbles, templates, key=root_key(0), reading=ReadingOptions(template="norway_maple"))
    bare, leafy = (grown_tree(of_picture(found, TreeOptions(season=season), templates, key=root_key(0))).model.meshes for season in ("bare", "summer"))
    marked, traced = Image.fromarray(shown.rgb), Image.fromarray(shown.rgb)
    for lines, ink in ((scribbles.foreground, (220, 30, 30)), (scribbles.background, (235, 190, 0))):
        for line in lines:
            ImageDraw.Draw(marked).line([tuple(point) for point in line], fill=ink, width=4)
    skeleton, pen = found.skeleton, ImageDraw.Draw(traced)
    for a, b in skeleton.edges:
        pen.line([*skeleton.xy[a], *skeleton.xy[b]], fill=(220, 30, 30), width=max(2, round(skeleton.radius[b])))
    matte = Image.fromarray(np.round(255 * found.matte.alpha).astype(np.uint8))
    pictures = [("photo, with lines", marked), ("matte", matte), ("trunk", traced)]
    widest = around(leafy)
    seen = [("bare", shot(bare, widest)), ("in leaf", shot(leafy, widest)), ("from the side", shot(bare, widest, "side"))]
    save(path, [[*((name, ImageOps.pad(one.convert("RGB"), (SIDE, SIDE), color="white")) for name, one in pictures), *seen]])


def modes(templates: Database, path: Path) -> None:
    """Figure 9: what grows, by mode and time."""
    oak = drawn(templates)
    save(path, [over_time(growing(oak, mode), mode) for mode in MODES])


def crowns(templates: Database, path: Path) -> None:
    """Figure 7c, d: levels; and variations."""
    bare = limbs(templates)
    seen = [(f"{levels} levels" if levels else "the drawn limbs", grown_tree(bare, GrowthOptions(levels)).model.meshes) for levels in (0, *LEVELS)]
    widest = around(seen[-1][1])
    rows = [[(name if view == "front" else "from above", shot(meshes, widest, view)) for name, meshes in seen] for view in ("front", "top")]
    others = [(f"crown {k + 1}", grown_tree(bare, GrowthOptions(LEVELS[1]), crown=k).model.meshes) for k in range(CROWNS)]
    save(path, [*rows, [(name, shot(meshes, widest)) for name, meshes in others]])


def bends(templates: Database, path: Path) -> None:
    """Figure 8: strengths of gravitropism, and how branches come to hang."""
    rows = []
    for season in ("bare", "summer"):
        trees = {bend: growing(limbs(templates, season), bend=bend, levels=3) for bend in STRENGTHS}
        widest = around(trees[0].at(1.0))
        rows.append([(f"bend {bend}", shot(trees[bend].at(1.0), widest)) for bend in STRENGTHS])
    save(path, [*rows, over_time(trees[-25], "bend -25", steps=len(STRENGTHS))])


def film(templates: Database, path: Path) -> None:
    """The film of the README."""
    told(growth_film(growing(drawn(templates)), path, size=(FILM, FILM), frames=FRAMES, seconds=SECONDS, turn=TURN))


def over_time(tree: Growing, name: str, *, steps: int = STEPS) -> Row:
    """A tree at even times, all in one frame, without the bare ground at 0."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "film.apng"
        told(growth_film(tree, path, size=(SIDE, SIDE), frames=steps + 1, seconds=1.0, hold=0.0))
        with Image.open(path) as pictures:
            shown = []
            for k in range(1, steps + 1):
                pictures.seek(k)
                shown.append((f"{name}, t = {k / steps:.2f}", pictures.convert("RGB")))
    return shown


def around(meshes) -> tuple[tuple[float, float, float], float]:
    """A ball about a tree: a focus for pictures that are to be compared."""
    points = np.vstack([mesh.position for mesh in meshes if mesh.triangle_count])
    low, high = points.min(axis=0), points.max(axis=0)
    return tuple((0.5 * (low + high)).tolist()), 0.54 * float((high - low).max())


def shot(meshes, focus, view: str = "front") -> Image.Image:
    """The tree from one side."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "shot.png"
        told(preview(meshes, path, size=(SIDE, SIDE), view=view, focus=focus, timeout=600))
        return Image.open(path).convert("RGB")


def told(made: tuple[bool, str]) -> None:
    """End where nothing could be drawn."""
    if not made[0]:
        raise SystemExit(made[1])


def save(path: Path, rows: Sequence[Row]) -> None:
    """Rows of pictures with captions."""
    sheet = Image.new("RGB", (SIDE * max(map(len, rows)), (SIDE + CAPTION) * len(rows)), "white")
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(14)
    for i, row in enumerate(rows):
        for k, (title, image) in enumerate(row):
            sheet.paste(image, (SIDE * k, (SIDE + CAPTION) * i))
            pen.text((SIDE * (k + 0.5), (SIDE + CAPTION) * (i + 1) - CAPTION / 2), title, fill="black", font=font, anchor="mm")
    palette = sheet.quantize(256, kmeans=2)
    sheet.quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG).save(path, optimize=True)  # or the ground's shade shows as rings


def main() -> None:
    kinds = {"photo": (photo, "growth_photo.png"), "modes": (modes, "growth_modes.png"), "crowns": (crowns, "growth_crowns.png"), "bends": (bends, "growth_bends.png"), "film": (film, "growth.gif")}
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kinds", nargs="*", default=list(kinds), metavar="KIND", help=", ".join(kinds))
    parser.add_argument("-o", "--out", type=Path, required=True)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    templates = Database.open()
    for kind in options.kinds:
        draw, name = kinds[kind]
        draw(templates, options.out / name)
        print(options.out / name, f"{(options.out / name).stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
