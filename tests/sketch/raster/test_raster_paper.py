"""Paper tone, uneven light, shadows and colours change nothing of what is read."""

import numpy as np
import pytest
import sheets
from PIL import Image
from scipy.ndimage import gaussian_filter

INK = sheets.cover()
HEIGHT, WIDTH = INK.shape
Y, X = np.mgrid[:HEIGHT, :WIDTH] / HEIGHT
RNG = np.random.default_rng(3)


def pencil(ink) -> np.ndarray:
    """Ink that the tooth of the paper thins in places."""
    tooth = gaussian_filter(np.random.default_rng(1).normal(size=ink.shape), 1.2)
    return ink * np.clip(0.75 - 0.25 * tooth / tooth.std(), 0.1, 1)


PAGES = {
    "white": sheets.image_of(INK),
    "grey paper": sheets.image_of(INK, paper=0.6, tone=0.15),
    "pale ink": sheets.image_of(INK, paper=0.9, tone=0.75),
    "light from one corner": sheets.image_of(INK, paper=1.0 - 0.6 * (X + Y) / 2, tone=0.05),
    "the edge of a shadow": sheets.image_of(INK * 0.8, paper=np.where(X + 0.3 * Y < 0.6, 0.95, 0.62)),
    "a soft shadow": sheets.image_of(INK * 0.8, paper=0.9 - 0.45 / (1 + np.exp(-(X - 0.4) / 0.02))),
    "dark corners": sheets.image_of(INK, paper=1.0 - 0.8 * ((X - 0.4) ** 2 + (Y - 0.5) ** 2)),
    "grain": sheets.image_of(INK, paper=np.clip(0.85 + 0.03 * RNG.normal(size=INK.shape), 0, 1), tone=0.2),
    "white on black": sheets.image_of(1 - INK),
    "white on dark grey, uneven": sheets.image_of(INK, paper=0.3 - 0.2 * X, tone=0.95),
    "chalk on a slate": sheets.image_of(pencil(INK), paper=0.22, tone=0.85),
}


@pytest.mark.parametrize("page", PAGES)
def test_the_same_lines_are_read_on_any_paper(page):
    sketch = sheets.read(PAGES[page])
    assert len(sketch) == len(sheets.TREE) and sheets.apart(sketch) < 2.2
    assert [stroke.width for stroke in sketch.strokes] == pytest.approx([4.0] * 4, abs=0.7)


def test_a_photographed_pencil_page():
    paper = (0.82 - 0.25 * (X + Y) / 2) * (1 - 0.25 / (1 + np.exp(-(X + 0.4 * Y - 0.75) / 0.02)))
    shown = gaussian_filter(paper * (1 - 0.55 * pencil(INK)), 0.8) + 0.02 * RNG.normal(size=INK.shape)
    page = Image.fromarray(np.clip(np.round(255 * shown), 0, 255).astype(np.uint8))
    sketch = sheets.read(sheets.file_of(page, "JPEG", quality=80))
    assert len(sketch) == len(sheets.TREE) and sheets.apart(sketch) < 2.2


@pytest.mark.parametrize(
    ("paper", "ink"),
    {
        "blue on cream": ((250, 240, 215), (30, 50, 170)),
        "red on white": ((255, 255, 255), (210, 30, 30)),
        "brown on kraft": ((196, 164, 124), (90, 50, 20)),
        "white on blue": ((30, 70, 140), (245, 245, 250)),
        "yellow on black": ((10, 10, 10), (250, 220, 40)),
        "red on green of the same lightness": ((60, 160, 80), (225, 60, 60)),
        "green on white": ((255, 255, 255), (20, 120, 40)),
    }.values(),
    ids=lambda colour: "-".join(map(str, colour)),
)
def test_coloured_ink_on_coloured_paper(paper, ink):
    shown = INK[..., None] * np.array(ink) + (1 - INK[..., None]) * np.array(paper)
    sketch = sheets.read(Image.fromarray(np.round(shown).astype(np.uint8)))
    assert len(sketch) == len(sheets.TREE) and sheets.apart(sketch) < 2.2


def test_the_table_around_a_photographed_page_is_not_read():
    page = sheets.image_of(INK, paper=0.9, tone=0.2)
    table = Image.new("L", (420, 480), 60)
    table.paste(page, (60, 60))
    sketch = sheets.read(table)
    assert "What lies around the page, far darker than it, was left out." in sketch.warnings
    moved = [line + 60 for line in sheets.TREE]
    assert sheets.farthest(sheets.curves(sketch), moved) < 3.0
    assert sheets.farthest(moved, sheets.curves(sketch)) < 14.0  # the trunk ends 15 pixels from the page's edge


def test_a_dark_edge_that_the_scanner_left_is_told_and_left_out():
    page = np.asarray(sheets.image_of(INK)).copy()
    page[:, :5] = 20
    sketch = sheets.read(Image.fromarray(page))
    assert len(sketch) == len(sheets.TREE) and sheets.apart(sketch) < 2.0
    assert sketch.warnings == ("A dark edge of the picture was left out.",)
