"""What do the wind's channels look like, and what does the wind do with them?

    python -m benchmarks.wind_picture [SKETCH] [-o PICTURE.png]

Above, the four channels in false colour: how far the whole tree, its bough and its leaf carry a vertex, and when its bough swings. Below, the
tree at rest and at three moments of a storm, by the formula of `sketchtree/rig/sway.py` that `docs/game.md` gives for each engine.
"""

import argparse
import dataclasses
from pathlib import Path

import numpy as np

from benchmarks.rigged import dressed, false_colour, hue, ramp, sheet
from sketchtree.rig.sway import swayed
from sketchtree.rig.wind import CHANNELS

ROOT = Path(__file__).resolve().parents[1]
MOMENTS = (None, 0.35, 1.1, 2.3)  # seconds


def main(argv=None) -> None:
    """Draws both rows on one sheet."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sketch", nargs="?", type=Path, default=ROOT / "examples" / "oak.svg")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "docs" / "pictures" / "wind.png")
    arguments = parser.parse_args(argv)
    rigging, meshes = dressed(arguments.sketch)
    channels = [[false_colour(mesh, (hue if name == "phase" else ramp)(mesh.extra["COLOR_1"][:, k])) for mesh in meshes] for k, name in enumerate(CHANNELS)]
    moments = [meshes if moment is None else [blown(mesh, rigging.wind, moment) for mesh in meshes] for moment in MOMENTS]
    titles = [*CHANNELS, "at rest", *(f"storm, {moment:g} s" for moment in MOMENTS[1:])]
    sheet([*channels, *moments], titles, columns=4, output=arguments.output, parser=parser, around=meshes)


def blown(mesh, wind, moment: float):
    """The mesh at a moment of a storm."""
    position = swayed(mesh.position, mesh.normal, mesh.extra["COLOR_1"].astype(np.float64), time=moment, height=wind.height, reach=wind.reach, strength=1.0)
    return dataclasses.replace(mesh, position=position)


if __name__ == "__main__":
    main()
