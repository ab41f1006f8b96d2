"""Where does the program itself see crown and trunk? Proposals for every photo of a folder, against the strokes drawn by hand, as a table and a sheet."""

from pathlib import Path

import click
import numpy as np
from PIL import Image, ImageDraw

from benchmarks.foliage import STROKES, overlap
from sketchtree.errors import SketchTreeError
from sketchtree.keys import root_key
from sketchtree.photo.auto.propose import SURE, Proposal, propose
from sketchtree.photo.foliage_mask import within
from sketchtree.photo.photo import Photo
from sketchtree.photo.read_photo import read_photo
from sketchtree.photo.read_strokes import read_strokes

CELL, ACROSS = (350, 400), 6


def compared(photo: Photo, proposal: Proposal, strokes: Path | None) -> tuple[float, float]:
    """(overlap of the crowns, distance of the trunks' feet / the photo's size); NaN without strokes."""
    if strokes is None:
        return np.nan, np.nan
    (hand, *_), (tree, *_) = read_strokes(strokes, photo), proposal.trees
    crowns = (within(each.crown, photo.rgb.shape[:2]) for each in (hand, tree))
    foot = np.hypot(*(hand.branches[0][0] - tree.branches[0][0])) / max(photo.width, photo.height)
    return overlap(*crowns), float(foot)


def drawn(photo: Photo, proposal: Proposal) -> Image.Image:
    """The photo with what is proposed."""
    image = Image.fromarray(photo.rgb)
    pen, width = ImageDraw.Draw(image), max(2, photo.width // 150)
    for tree in proposal.trees:
        pen.line([*map(tuple, tree.crown), tuple(tree.crown[0])], fill=(230, 0, 0), width=width)
        for branch in tree.branches:
            pen.line([tuple(point) for point in branch], fill=(0, 0, 255), width=width)
    image.thumbnail(CELL)
    return image


@click.command(help=__doc__)
@click.option("--photos", type=click.Path(path_type=Path, exists=True), required=True)
@click.option("-o", "--out", type=click.Path(path_type=Path))
def main(photos: Path, out: Path | None) -> None:
    """Print the table; draw the sheet."""
    files = sorted(file for file in photos.iterdir() if file.suffix in (".jpg", ".png"))
    sheet = Image.new("RGB", (ACROSS * CELL[0], -(-len(files) // ACROSS) * CELL[1]), "white")
    rows: list[tuple[float, float]] = []
    for k, file in enumerate(files):
        photo = read_photo(file)
        strokes = next((each for each in sorted(STROKES.glob("*.svg")) if file.stem.startswith(each.stem)), None)
        try:
            proposal = propose(photo, key=root_key(0))
        except SketchTreeError as error:
            click.echo(f"{file.stem:30}{error}")
            continue
        crown, foot = compared(photo, proposal, strokes)
        rows.append((crown, proposal.confidence))
        click.echo(f"{file.stem:30}crown {crown:5.2f}   foot off {foot:5.2f}   sure {proposal.confidence:.2f}   {proposal.why}")
        sheet.paste(drawn(photo, proposal), (k % ACROSS * CELL[0], k // ACROSS * CELL[1]))
    known = np.array([row for row in rows if not np.isnan(row[0])]).reshape(-1, 2)
    sure = known[known[:, 1] >= SURE, 0]
    click.echo(f"median overlap {np.median(known[:, 0]):.2f} of {len(known)}; {np.median(sure):.2f} of the {len(sure)} that it is sure of" if len(sure) else "none is sure")
    if out is not None:
        sheet.save(out)


if __name__ == "__main__":
    main()
