"""What do matting and skeletons look like beside others? Pictures like Figures 2 and 4 of the single-image growth paper, of our own drawn trees and of photos in the public domain.

    python -m benchmarks.growth_figures -o DIR [--shared DIR]

`matting.png`: scribbles | closed form | normalised | ours, of toys of 150 × 100 pixels and a drawn tree, with --shared also two photos of Levison 1914; then mattes between the steps of the normalised, and its
objective by step (`matting_steps.png`). `trunk.png`: thinning and the medial axis of scikit-image; ours with few vertices, with as many as the noise allows, and edited by hand. `trunks.png`: the trunk in space.
"""

import argparse
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont
from scipy.ndimage import gaussian_filter

from benchmarks import matting, trunk_noise
from benchmarks.growth_pictures import picture as in_space
from benchmarks.matting_cases import Case, before, drawn_cases, real_cases
from sketchtree.keys import root_key
from sketchtree.matting import normalised
from sketchtree.matting.matte import find_matte
from sketchtree.matting.scribbles import Scribbles
from sketchtree.trunk.as_tree import as_tree
from sketchtree.trunk.skeletonise import GAP, trunk_skeleton

WIDE, HIGH = 150, 100
PHOTOS = ("bare_sugar_maple", "bare_tulip_tree")
KEPT = (1, 3, 10)  # steps whose mattes are shown


def toys() -> list[Case]:
    """A disc and a fork of soft edges before two colours, with a short line on each side."""
    y, x = np.mgrid[:HIGH, :WIDE] + 0.5
    disc = np.hypot(x - 75, y - 50) < 30
    fork = (np.abs(x - 75) < 7) & (y > 45) | (np.abs(np.abs(x - 75) - (50 - y)) < 8) & (y < 50) & (y > 10)
    inks = {"disc": (disc, [0.8, 0.3, 0.2], [0.2, 0.4, 0.7]), "fork": (fork, [0.3, 0.22, 0.16], [0.75, 0.85, 0.6])}
    draw, cases = np.random.default_rng(1), []
    for name, (mask, ink, paper) in inks.items():
        alpha = gaussian_filter(mask.astype(float), 1.0)
        grain = draw.normal(0, 0.02, (HIGH, WIDE, 1))
        photo = before(np.array(ink) + grain, alpha, np.array(paper) + grain, name)
        lines = np.array([[75.0, 60.0], [75.0, 75.0]]), np.array([[10.0, 20.0], [10.0, 80.0]])
        cases.append(Case(f"toy, {name}", photo, Scribbles((lines[0],), (lines[1],), 3.0, name), alpha))
    return cases


def figure_2(cases: list[Case], folder: Path) -> list[dict]:
    """Figure 2; returns Table 1's rows."""
    found = [matting.measured(case, matting.ORDER) for case in cases]
    path = folder / "matting.png"
    matting.sheet([(case, mattes) for case, (_, mattes) in zip(cases, found, strict=True)], path, cell=230)
    Image.open(path).quantize(128).save(path, optimize=True)
    _steps(cases[-1], folder / "matting_steps.png")
    return [row for row, _ in found]


def _steps(case: Case, path: Path) -> None:
    """The normalised mattes after some steps."""
    most, mattes = normalised.STEPS, []
    try:
        for steps in KEPT:
            normalised.STEPS = steps
            mattes.append(find_matte(case.photo, case.scribbles, method="normalised", key=root_key(0)).alpha)
    finally:
        normalised.STEPS = most
    Image.fromarray(np.round(255 * np.concatenate(mattes, axis=1)).astype(np.uint8)).save(path)


def figure_4(case: Case, folder: Path) -> None:
    """Figure 4, top to bottom; the last row of a photo or of our drawn tree."""
    one = trunk_noise.trunk(1000)
    sheet = trunk_noise.vertices_picture(one, trunk_noise.noisy(one, 1.0, 7))
    _in_rows(sheet, ("thinning", "medial axis", "ours, 20 vertices", "ours, as many as noise allows", "ours, leftmost limb merged by hand")).quantize(64).save(folder / "trunk.png", optimize=True)
    panels = []
    for vertices in (24, None):
        skeleton = trunk_skeleton(find_matte(case.photo, case.scribbles, key=root_key(0)).alpha, vertices=vertices, gap=GAP)
        over = Image.fromarray(case.photo.rgb)
        pen = ImageDraw.Draw(over)
        for a, b in skeleton.edges:
            pen.line([*skeleton.xy[a], *skeleton.xy[b]], fill=(220, 0, 0), width=1)
        tree = as_tree(skeleton, key=root_key(0))
        low, high = tree.tip.min(axis=0), tree.tip.max(axis=0)
        frame = ((low[0] + high[0]) / 2, 0.0, (low[2] + high[2]) / 2), 1.05 * float((high - low).max())
        panels += [over.resize((300, round(300 * over.height / over.width))), in_space(tree, frame), in_space(tree, frame, "side")]
    row = Image.new("RGB", (sum(panel.width for panel in panels), max(panel.height for panel in panels)), "white")
    for k, panel in enumerate(panels):
        row.paste(panel, (sum(before.width for before in panels[:k]), row.height - panel.height))
    row.save(folder / "trunks.png")


def _in_rows(sheet: Image.Image, titles: tuple[str, ...], columns: int = 3, shrink: float = 0.5) -> Image.Image:
    """The panels of a strip, two rows of them, with their titles."""
    wide, high, caption = round(shrink * sheet.width / len(titles)), round(shrink * sheet.height), 22
    strip = sheet.resize((wide * len(titles), high), Image.Resampling.LANCZOS)
    rows = Image.new("RGB", (columns * wide, -(-len(titles) // columns) * (high + caption)), "white")
    pen, font = ImageDraw.Draw(rows), ImageFont.load_default(14)
    for k, title in enumerate(titles):
        x, y = k % columns * wide, k // columns * (high + caption)
        rows.paste(strip.crop((k * wide, 0, (k + 1) * wide, high)), (x, y))
        pen.text((x + wide / 2, y + high + caption / 2), title, fill="black", font=font, anchor="mm")
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--out", type=Path, required=True)
    parser.add_argument("--shared", type=Path)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    drawn = drawn_cases()[2:3]
    photos = [case for case in real_cases(options.shared) if case.name in PHOTOS] if options.shared else []
    print("Table 1: αᵀLα of closed form, wᵀWw of the normalised matte (Eq. 4); then SAD and MSE")
    for row in figure_2([*toys(), *drawn, *photos], options.out):
        print(f"{row['case']:22} {row['closed-form']['energy']:.3e} {row['normalised']['objective']:.3e} | {matting.told(row)}")
    figure_4((photos or drawn)[-1], options.out)


if __name__ == "__main__":
    main()
