"""What do forks look like close up, as tubes and in one piece? `python -m benchmarks.fork_picture [-o docs/pictures/forks.png]`

Columns: an acute fork, two limbs as thick as each other, a right angle, a whorl of four, thin on thick. Rows: tubes and one piece, each from
the front and from the side.
"""

import argparse
import sys
import tempfile
from pathlib import Path

import jax
import numpy as np
from PIL import Image

from sketchtree.geometry.wood import wood_meshes
from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton
from sketchtree.view import preview

PICTURE = Path(__file__).parents[1] / "docs" / "pictures" / "forks.png"
FORKS = ((25.0, 0.7, 1, 0.5), (45.0, 1.0, 1, 0.4), (90.0, 0.5, 1, 0.3), (65.0, 0.4, 4, 0.32), (60.0, 0.12, 1, 0.16))
"""Angle (degrees), radius over the parent's, how many round it, and metres about the fork that are shown."""
_SIDES = (20.0, 110.0)  # degrees round the tree
_PIXELS = 300


def forked(angle: float, thickness: float, children: int) -> TreeSkeleton:
    """A trunk of radius 0.1 m with limbs at 1 m, evenly round it."""
    parent, tip, limb, radius = [-1, 0, 1, 2], [(0.0, 0, 0), (0.0, 1, 0), (0.0, 2, 0), (0.0, 3, 0)], [0] * 4, [0.1, 0.1, 0.08, 0.05]
    slope = np.radians(angle)
    for child in range(children):
        azimuth = 2.0 * np.pi * child / children + 0.3
        step = np.array([np.sin(slope) * np.cos(azimuth), np.cos(slope), np.sin(slope) * np.sin(azimuth)])
        for k in range(1, 4):
            parent.append(1 if k == 1 else len(parent) - 1)
            tip.append(tuple([0.0, 1.0, 0.0] + 0.5 * k * step))
            limb.append(child + 1)
            radius.append(0.1 * thickness * (1.1 - 0.2 * k))
    return TreeSkeleton.from_columns(np.array(parent), np.array(tip), np.array(radius), limb=np.array(limb))


def sheet(folder: Path) -> Image.Image:
    """All close-ups."""
    whole = Image.new("RGB", (_PIXELS * len(FORKS), _PIXELS * 2 * len(_SIDES)), "white")
    for column, (angle, thickness, children, reach) in enumerate(FORKS):
        tree = forked(angle, thickness, children)
        for row, (way, side) in enumerate((way, side) for way in ("tubes", "one-piece") for side in _SIDES):
            meshes = wood_meshes(tree, bark="oak", habit=Habit(), key=jax.random.key(0), wood=way)
            place = (0.0, 1.0 + 0.25 * (angle < 30.0), 0.0)
            drawn, reason = preview(meshes, folder / "fork.png", azimuth=side, elevation=15.0, focus=(place, reach), size=(_PIXELS, _PIXELS), ground=False)
            if not drawn:
                raise SystemExit(reason)
            with Image.open(folder / "fork.png") as picture:
                whole.paste(picture.convert("RGB"), (_PIXELS * column, _PIXELS * row))
    return whole


def main(arguments: list[str]) -> None:
    """Draw the picture."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.fork_picture", description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", type=Path, default=PICTURE)
    options = parser.parse_args(arguments)
    with tempfile.TemporaryDirectory() as folder:
        sheet(Path(folder)).quantize(160).save(options.output, optimize=True)


if __name__ == "__main__":
    main(sys.argv[1:])
