"""What arrives in each engine?

    python -m benchmarks.engines_picture [SKETCH] [-o PICTURE.png]

Unreal: the two textures of Pivot Painter (positions and axes as colours, one pixel an element) over the elements that they turn. Unity: what
glTFast makes of TEXCOORD_2, red sway, green 1 − branch. Godot: CUSTOM0 as red sway, green branch, blue flutter, with the shapes that collide.
"""

import argparse
import dataclasses
from pathlib import Path

import numpy as np
from PIL import Image

from benchmarks.bones_picture import GOLDEN, element
from benchmarks.rigged import SIZE, dressed, false_colour, hue, sheet
from sketchtree.export.capsules import capsule_meshes
from sketchtree.geometry.mesh import Material
from sketchtree.rig.capsules import capsules
from sketchtree.rig.pivots import axis_texture, position_texture

ROOT = Path(__file__).resolve().parents[1]
LARGE = 84  # pixels of a texture's side on the sheet


def main(argv=None) -> None:
    """Draws the three on one sheet."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sketch", nargs="?", type=Path, default=ROOT / "examples" / "oak.svg")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "docs" / "pictures" / "engines.png")
    arguments = parser.parse_args(argv)
    rigging, meshes = dressed(arguments.sketch)
    wood = [mesh for mesh in meshes if not mesh.name.startswith("leaf")]
    turned = [false_colour(mesh, hue(element(mesh) * GOLDEN % 1.0)) for mesh in wood]
    set_2 = [false_colour(mesh, channels(mesh, lambda sway, branch, phase, flutter: (sway, 1 - branch, 0 * sway))) for mesh in meshes]
    custom = [false_colour(mesh, channels(mesh, lambda sway, branch, phase, flutter: (sway, branch, flutter))) for mesh in meshes]
    found = capsules(rigging.lines, rigging.limbs, rigging.bones).capsules
    plain = Material("wood", base_color=(0.75, 0.72, 0.66, 1.0), double_sided=True)
    bars = [dataclasses.replace(mesh, material=plain) for mesh in capsule_meshes(found, [str(k) for k in range(len(found))])]
    titles = ["Unreal: Pivot Painter 2", "Unity: uv3", "Godot: CUSTOM0", "Godot: collision shapes"]
    sheet([turned, set_2, custom, bars], titles, columns=4, output=arguments.output, parser=parser, around=meshes)
    paste(arguments.output, rigging.pivots)


def channels(mesh, mixed) -> np.ndarray:
    """Colours (linear) of the wind's channels, dark where all are 0."""
    return 0.02 + 0.9 * np.column_stack(mixed(*mesh.extra["COLOR_1"].astype(float).T))


def paste(path: Path, found) -> None:
    """The two textures into the lower left corner of the first pane, one above the other."""
    whole = Image.open(path).convert("RGB")
    place = position_texture(found)[..., :3].astype(float)
    place = (place - place.min(axis=(0, 1))) / np.maximum(np.ptp(place, axis=(0, 1)), 1e-6)
    for k, pixels in enumerate((np.round(255 * place).astype(np.uint8), axis_texture(found)[..., :3])):
        large = Image.fromarray(pixels).resize((LARGE, LARGE), Image.Resampling.NEAREST)
        whole.paste(large, (10, SIZE[1] - (2 - k) * (LARGE + 8)))
    whole.quantize(256, dither=Image.Dither.NONE).save(path, optimize=True)


if __name__ == "__main__":
    main()
