"""Does a tree come to where foliage was seen, and is it as deep as wide? Growth by attractors, measured by the bars of the one-photo way.

    python -m benchmarks.attractors [--cases DIR] [--only NAME]... [-o FOLDER]

Three made-up crowns, a sketch with a crown, and photo cases by hand if asked (`NAME.json` and masks in DIR). Each is grown by default, by image attractors alone (Tan et al. 2008, Figure 6a), as in the paper,
and, for comparison, by replication blocks in the same crown. With -o: E2D and E3D over the run, and the wood from the front, the side and above.

    near      share of image attractors within a leaf length of the tree as seen            ≥ 0.95
    IoU       of the wood, dilated by a leaf length, and the mask                           ≥ 0.75
    deep      depth of what grew / its width, 2nd to 98th percentiles of its length         0.75-1.33
    gap       largest empty azimuth of the outer crown, degrees, in any third of its height     ≤ 120
    side      area of the dilated wood from the side / from the front
    CPU       seconds of one processor                                                      ≤ 5
"""

import argparse
import time
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw
from scipy import ndimage

from benchmarks.attractor_cases import Case, photographed, made_up, sketched
from benchmarks.azimuth import empty_azimuth
from sketchtree import keys
from sketchtree.parameters import GENERIC
from sketchtree.propagate.attractors.revolved import Axes
from sketchtree.propagate.attractors.stage import LEAF, attract
from sketchtree.propagate.attractors.wanted import PAPER
from sketchtree.propagate.attractors.wood import Wood
from sketchtree.propagate.generations import Propagation, propagate
from sketchtree.roots import without_roots
from sketchtree.skeleton import TreeSkeleton

ROOT = Path(__file__).resolve().parents[1]
MANNERS = {"default": {}, "image only": {"alternate": False}, "paper": PAPER, "blocks": None}
PANE = 420  # pixels
INKS = ((30, 30, 30), (150, 85, 40), (70, 120, 60), (60, 90, 170), (150, 60, 140))


def grown(case: Case, manner: str) -> tuple[Propagation, float]:
    """(the case grown so, seconds of processor)."""
    began = time.process_time()
    if manner == "blocks":
        found = propagate(case.tree, case.habit, GENERIC, key=keys.root_key(0), crown=_outlines(case))
    else:
        found = attract(case.tree, case.target, key=keys.root_key(0), **MANNERS[manner])
    return found, time.process_time() - began


def measured(case: Case, tree: TreeSkeleton, grew) -> dict[str, float]:
    """The bars of one tree that the case has become; `grew`: the rows that are new."""
    leaf = LEAF * max(case.tree.height, case.target.highest - float(case.tree.tip[case.tree.is_base, 1].min()))
    target = case.target.coarser()
    wood, new = _samples(tree, 0.25 * leaf), _samples(tree, 0.25 * leaf, grew)
    new = new if len(new) else wood
    pad = int(np.ceil(3 * leaf / target.pixel))
    mask = np.pad(target.mask, pad)
    corner = np.array([target.left - pad * target.pixel, target.top + pad * target.pixel])
    cover = _dilated(wood[:, :2], corner, mask.shape, target.pixel, leaf)
    trunk = case.tree.tip[case.tree.order == 0][:, 2].mean()
    side = _dilated(np.column_stack([wood[:, 2] - trunk + corner[0] + 0.5 * mask.shape[1] * target.pixel, wood[:, 1]]), corner, mask.shape, target.pixel, leaf)
    low, high = np.percentile(new[:, [0, 2]], [2, 98], axis=0)
    axes = Axes.about_crown(target, Wood.of(without_roots(case.tree)[0]).trunk())
    outward = axes.outward(new)[:, [0, 2]]
    out = axes.out(new)
    kept = np.isfinite(out) & (out > 0)
    gap = empty_azimuth(new[kept, 1], outward[kept], np.hypot(*outward[kept].T) / out[kept])
    region = ndimage.binary_dilation(mask.any(axis=1))[:, None]
    return {
        "near": float(cover[mask].mean()), "IoU": float((cover & mask).sum() / (cover & region | mask).sum()), "deep": float((high - low)[1] / max((high - low)[0], 1e-9)), "gap": gap,
        "side": float((side & region).sum() / max((cover & region).sum(), 1)), "segments": tree.segment_count,
    }  # fmt: skip


def _samples(tree: TreeSkeleton, spacing: float, rows=None):
    """Points along the rows, drawn points too."""
    parts = []
    for row in np.flatnonzero(~tree.is_base if rows is None else rows & ~tree.is_base):
        line = tree.curve(row)
        run = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))]
        at = np.linspace(0.0, run[-1], max(int(np.ceil(run[-1] / spacing)), 1) + 1)
        parts.append(np.column_stack([np.interp(at, run, line[:, axis]) for axis in range(3)]))
    return np.concatenate(parts) if parts else np.zeros((0, 3))


def _dilated(points, corner, shape, pixel: float, leaf: float):
    """Pixels within a leaf length of points on a page."""
    row, column = np.floor((corner[1] - points[:, 1]) / pixel).astype(int), np.floor((points[:, 0] - corner[0]) / pixel).astype(int)
    inside = (row >= 0) & (row < shape[0]) & (column >= 0) & (column < shape[1])
    wood = np.zeros(shape, bool)
    wood[row[inside], column[inside]] = True
    return ndimage.distance_transform_edt(~wood) * pixel <= leaf if wood.any() else wood


def _outlines(case: Case):
    """The crown as outlines for growth by blocks: one for every large part of the mask, left and right ends row by row."""
    target = case.target.coarser(200).closed(0.02 * case.target.height)
    label, count = ndimage.label(target.mask)
    found = []
    for part in range(1, count + 1):
        mask = label == part
        if mask.sum() < 0.05 * target.mask.sum():
            continue
        rows = np.flatnonzero(mask.any(axis=1))
        left, right = mask[rows].argmax(axis=1), mask.shape[1] - mask[rows][:, ::-1].argmax(axis=1)
        y = target.top - (rows + 0.5) * target.pixel
        found.append(np.column_stack([target.left + target.pixel * np.r_[left, right[::-1]], np.r_[y, y[::-1]]]))
    return tuple(found)


def wood_picture(case: Case, found: Propagation) -> Image.Image:
    """The wood from the front (with the mask), the side and above."""
    tree, target = found.skeleton, case.target.coarser(240)
    low, high = tree.tip.min(axis=0), np.maximum(tree.tip.max(axis=0), [0, target.highest, 0])
    scale = 2 * PANE * 0.94 / (high - low).max()
    sheet = Image.new("RGB", (6 * PANE, 2 * PANE), "white")
    pen = ImageDraw.Draw(sheet)
    middle = 0.5 * (low + high)
    for x, y in target.centres:
        at = np.array([PANE + (x - middle[0]) * scale, PANE - (y - middle[1]) * scale])
        pen.rectangle([*at - 0.5 * target.pixel * scale, *at + 0.5 * target.pixel * scale], fill=(226, 236, 214))
    for row in np.argsort(-found.generation, kind="stable"):
        if tree.is_base[row]:
            continue
        line = (tree.curve(row) - middle) * scale
        generation = int(found.generation[row])
        for pane, flat in enumerate((line[:, :2], np.column_stack([-line[:, 2], line[:, 1]]), np.column_stack([line[:, 0], -line[:, 2]]))):
            points = [((2 * pane + 1) * PANE + a, PANE - b) for a, b in flat]
            pen.line(points, fill=INKS[min(generation, 4)], width=max(2, round(9 * 0.62**generation)))
    return sheet.resize((3 * PANE, PANE), Image.Resampling.LANCZOS)


def energy_picture(runs: dict, path: Path) -> None:
    """E2D and E3D, a mean attractor's distance in metres, over the iterations."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure, panes = plt.subplots(1, 2, figsize=(10, 3.6), constrained_layout=True)
    for name, grown_ in runs.items():
        course = grown_.course
        panes[0].plot(np.array(course.image) / len(grown_.image), label=name)
        panes[1].plot(np.array(course.space) / np.maximum(course.in_space, 1), label=name)
    for pane, title in zip(panes, ("E2D / attractors on the page", "E3D / attractors in space"), strict=True):
        pane.set(title=title, xlabel="iteration", ylabel="metres", ylim=(0, None))
    panes[0].legend(fontsize=7)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def main(argv=None) -> None:
    """Prints the table; with -o, draws the pictures."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cases", type=Path, help="folder of photo cases (NAME.json, masks)")
    parser.add_argument("--only", action="append", help="cases by name")
    parser.add_argument("--manner", action="append", choices=list(MANNERS))
    parser.add_argument("-o", "--output", type=Path, help="folder for pictures")
    asked = parser.parse_args(argv)
    cases = [*made_up(), sketched(ROOT / "examples" / "oak.svg")]
    cases += [photographed(path) for path in sorted(asked.cases.glob("*.json"))] if asked.cases else []
    courses = {}
    print(f"{'case':20} {'manner':11} {'near':>5} {'IoU':>5} {'deep':>5} {'gap':>4} {'side':>5} {'E2D':>12} {'E3D':>12} {'segments':>8} {'CPU':>5}")
    for case in cases:
        if asked.only and case.name not in asked.only:
            continue
        for manner in asked.manner or MANNERS:
            found, seconds = grown(case, manner)
            of = measured(case, found.skeleton, found.generation > 0)
            its = next(iter(getattr(found, "grown", {}).values()), None)
            fall = ["" if its is None else f"{one[0]:.0f} → {one[-1]:.0f}" for one in ((its.course.image, its.course.space) if its else ((), ()))]
            print(f"{case.name:20} {manner:11} {of['near']:5.3f} {of['IoU']:5.3f} {of['deep']:5.2f} {of['gap']:4.0f} {of['side']:5.2f} {fall[0]:>12} {fall[1]:>12} {of['segments']:8} {seconds:5.1f}", flush=True)
            if asked.output:
                asked.output.mkdir(parents=True, exist_ok=True)
                wood_picture(case, found).save(asked.output / f"{case.name}_{manner}.png".replace(" ", "_"))
            if its is not None and manner == "default":
                courses[case.name] = its
    if asked.output and courses:
        energy_picture(courses, asked.output / "energies.png")


if __name__ == "__main__":
    main()
