"""What do grafting, bending and growing look like? Pictures like Figures 5 to 9 of the single-image growth paper, and curves of growth."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from jaxtyping import Float
from PIL import Image, ImageDraw, ImageFont

from sketchtree.growth.age import growth_age
from sketchtree.growth.grafting import Graft, variations
from sketchtree.growth.plan import MODES, GrowthPlan
from sketchtree.keys import root_key
from sketchtree.skeleton import Kind, TreeSkeleton

WIDE, HIGH, CAPTION, FINER = 300, 330, 24, 3  # pixels of one tree; times as large before it is averaged down
BARK, NEW, PAPER = (70, 54, 42), (122, 112, 66), (255, 255, 255)
STRENGTHS = (20, 0, -7, -14, -25)  # Figure 8
TIMES = (0.04, 0.12, 0.25, 0.4, 0.6, 0.8, 1.0)
_YOUNG, _OLD = np.array([60, 150, 70]), np.array([70, 40, 30])


def draw_all(trunk: TreeSkeleton, folder: Path) -> None:
    """Every picture of a bare trunk and what becomes of it, as files in a folder."""
    grafted = [Graft(levels)(trunk, key=root_key(0)) for levels in (2, 3, 4)]
    tree = grafted[1]
    frame = _frame(grafted[-1])
    seen = [("trunk", trunk), *((f"{levels} levels", one) for levels, one in zip((2, 3, 4), grafted, strict=True))]
    _save(folder / "levels.png", [[(name, picture(one, frame, view)) for name, one in seen] for view in ("front", "top")])
    _save(folder / "variations.png", [[(f"crown {k + 1}", picture(one, frame)) for k, one in enumerate(variations(trunk, 5, levels=3, key=root_key(0)))]])
    bent = [(f"bend {delta}", GrowthPlan.of(tree, bend=delta).at(1.0)) for delta in STRENGTHS]
    _save(folder / "bending.png", [[(name, picture(one, frame, view)) for name, one in bent] for view in ("front", "side")])
    lives = [(mode, bend, GrowthPlan.of(tree, mode=mode, bend=bend)) for mode, bend in (*((mode, 0) for mode in MODES), ("full", -25))]
    _save(folder / "modes.png", [[(f"{mode}, bend {bend}, t = {now:g}", picture(plan.at(now), frame)) for now in TIMES] for mode, bend, plan in lives])
    alone = GrowthPlan.of(trunk, mode="age")
    _save(folder / "trunk.png", [[(f"t = {now:g}", picture(alone.at(now), _frame(trunk))) for now in TIMES]])
    _save(folder / "age.png", [[("growth age T: brown old, green young", picture(tree, frame, colour=_by_age(tree)))]])
    curves([(mode, plan) for mode, bend, plan in lives if bend == 0], folder / "curves.png")


def picture(tree: TreeSkeleton, frame, view: str = "front", colour: Float[np.ndarray, "segment 3"] | None = None) -> Image.Image:
    """The wood of a tree as round strokes, the thick over the thin; `frame` is the middle, the ground and the extent of what is shown, metres."""
    (x, ground, z), extent = frame
    scale = 0.94 * FINER * min(WIDE, HIGH) / extent
    image = Image.new("RGB", (FINER * WIDE, FINER * HIGH), PAPER)
    pen = ImageDraw.Draw(image)
    if colour is None:
        colour = np.where((tree.kind == int(Kind.GROWN))[:, None], NEW, BARK)

    def place(point):
        right = point[:, 0] - x if view != "side" else z - point[:, 2]
        down = FINER * HIGH / 2 + scale * (point[:, 2] - z) if view == "top" else 0.97 * FINER * HIGH - scale * (point[:, 1] - ground)
        return np.stack([FINER * WIDE / 2 + scale * right, down], axis=1)

    start, end, width = place(tree.start), place(tree.tip), np.maximum(2 * scale * tree.radius, 1.0)
    for row in sorted(np.flatnonzero(~tree.is_base), key=tree.radius.__getitem__):
        ink, half = tuple(int(tone) for tone in colour[row]), 0.5 * width[row]
        pen.line([tuple(start[row]), tuple(end[row])], fill=ink, width=round(2 * half))
        if half > 1:
            pen.ellipse([*(end[row] - half), *(end[row] + half)], fill=ink)
    return image.resize((WIDE, HIGH), Image.Resampling.LANCZOS)


def curves(plans: Sequence[tuple[str, GrowthPlan]], path: Path) -> None:
    """Total length, thickest radius and number of segments against time, each as a share of the last."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    times = np.linspace(0, 1, 121)
    figure, axes = plt.subplots(1, 3, figsize=(10.5, 3.1), layout="constrained")
    for mode, plan in plans:
        poses = plan.poses(times)
        for axis, title, value in zip(axes, ("length of all wood", "radius of the trunk", "segments"), (poses.length, poses.radius[:, 1], poses.count), strict=True):
            axis.plot(times, value / value[-1], label=mode)
            axis.set(title=title, xlabel="time", ylim=(0, 1.03), xlim=(0, 1))
    axes[0].legend(frameon=False)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def _by_age(tree: TreeSkeleton):
    clock = 1.0 / growth_age(tree)
    share = (clock / clock.max())[:, None]
    return (1 - share) * _OLD + share * _YOUNG


def _frame(tree: TreeSkeleton):
    low, high = tree.tip.min(axis=0), tree.tip.max(axis=0)
    middle = 0.5 * (low + high)
    return (middle[0], low[1], middle[2]), float((high - low).max())


def _save(path: Path, rows: Sequence[Sequence[tuple[str, Image.Image]]]) -> None:
    sheet = Image.new("RGB", (WIDE * max(map(len, rows)), (HIGH + CAPTION) * len(rows)), PAPER)
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(15)
    for i, row in enumerate(rows):
        for k, (title, image) in enumerate(row):
            sheet.paste(image, (WIDE * k, (HIGH + CAPTION) * i))
            pen.text((WIDE * (k + 0.5), (HIGH + CAPTION) * (i + 1) - CAPTION / 2), title, fill="black", font=font, anchor="mm")
    sheet.quantize(96, dither=Image.Dither.FLOYDSTEINBERG).save(path, optimize=True)
