"""What do the exemplars look like? A portrait of one, a contact sheet of all."""

from pathlib import Path

import numpy as np
from jaxtyping import UInt8
from PIL import Image, ImageDraw, ImageFont

from sketchtree.errors import OptionError
from sketchtree.templates.store.database import Database
from sketchtree.templates.exemplar import Exemplar
from sketchtree.templates.seen.thumbnail import thumbnail

PORTRAIT = 640  # pixels a view
CELL = 320  # pixels an exemplar on the sheet
COLUMNS = 4
_CAPTION = 28


def portrait(exemplar: Exemplar) -> UInt8[np.ndarray, "row column"]:
    """The bare tree from the front and from its left side, captioned; 255 paper."""
    views = [thumbnail(exemplar.skeleton, size=PORTRAIT, azimuth_deg=v) for v in (0.0, 90.0)]
    return np.concatenate([np.concatenate(views, axis=1), _caption(exemplar.title, 2 * PORTRAIT)])


def contact_sheet(database: Database) -> UInt8[np.ndarray, "row column"]:
    """Every exemplar with its name, in rows of `COLUMNS`."""
    cells = [
        np.concatenate([thumbnail(database.exemplar(name).skeleton, size=CELL), _caption(name, CELL)]) for name in database.names
    ]
    while len(cells) % COLUMNS:
        cells.append(np.full_like(cells[0], 255))
    rows = [np.concatenate(cells[i : i + COLUMNS], axis=1) for i in range(0, len(cells), COLUMNS)]
    return np.concatenate(rows)


def save_picture(picture: UInt8[np.ndarray, "row column"], path: Path) -> None:
    """Writes a PNG; nothing is left behind where that fails."""
    if path.suffix.lower() != ".png":
        raise OptionError(f"{path}: pictures of exemplars are PNG files.", remedy="Let its name end in .png.")
    try:
        Image.fromarray(picture).save(path, format="PNG")
    except OSError as error:
        raise OptionError(
            f"{path}: it can't be written ({error.strerror}).", remedy="Choose a folder that exists and is writable."
        ) from error


def _caption(text: str, width: int):
    image = Image.new("L", (width, _CAPTION), 255)
    font = ImageFont.load_default(size=16)
    draw = ImageDraw.Draw(image)
    box = draw.textbbox((0, 0), text, font=font)
    draw.text(((width - box[2]) / 2, 2), text, fill=60, font=font)
    return np.asarray(image)
