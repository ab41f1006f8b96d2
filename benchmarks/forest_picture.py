"""Do trees look as if they had grown up together, and as if they had grown towards the light?

    python -m benchmarks.forest_picture [-o PICTURE.png]

Above: five sketches in a row, each grown alone (left) and all together (right); below them the same from straight above. At the foot
an oak's limbs without light and with it, and an apple that grew beside a poplar, likewise.
"""

import argparse
import dataclasses
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image

import sketchtree as st
from sketchtree.forest import Forest, sketches_to_forest
from sketchtree.keys import root_key
from sketchtree.options import TreeOptions

ROOT = Path(__file__).resolve().parents[1]
ROW = ("oak.svg", "poplar.svg", "oak_50.svg", "spruce.svg", "oak.svg")
SPACING = 5.0  # metres
FRONT, ABOVE, FOOT = (1000, 640), (1000, 460), (500, 460)
LIGHTS = (0.0, 0.7)


def grown(names, spacing: float, **options) -> Forest:
    """The sketches in a row."""
    sketches = [ROOT / "examples" / name for name in names]
    return sketches_to_forest(sketches, key=root_key(0), spacing=spacing, tree=TreeOptions(max_segments=1_000_000, **options))


def drawn_together(forest: Forest, spacing: float) -> Forest:
    """The meshes of a forest at other places: what trees that grew far apart look like side by side."""
    trees = []
    for k, tree in enumerate(forest.trees):
        by = np.array([k * spacing, 0.0, 0.0]) - forest.place[k]
        meshes = tuple(dataclasses.replace(mesh, position=mesh.position + by) for mesh in tree.meshes)
        trees.append(dataclasses.replace(tree, meshes=meshes))
    return dataclasses.replace(forest, trees=tuple(trees))


def picture(meshes, elevation: float, size) -> np.ndarray:
    """One view as pixels."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "view.png"
        drawn, reason = st.preview(meshes, path, size=size, azimuth=0.0, elevation=elevation)
        if not drawn:
            raise SystemExit(reason)
        return np.array(Image.open(path).convert("RGB"))


def main(argv=None) -> None:
    """Draws the sheet."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "docs" / "pictures" / "forest.png")
    arguments = parser.parse_args(argv)
    stands = [drawn_together(grown(ROW, 100.0), SPACING).meshes, grown(ROW, SPACING).meshes]
    rows = [[picture(stand, elevation, size) for stand in stands] for elevation, size in ((6.0, FRONT), (89.0, ABOVE))]
    limbs = [grown(("oak_50.svg",), 1.0, light=light, leaf="none").meshes for light in LIGHTS]
    beside = [grown(("poplar.svg", "apple.json"), 2.2, light=light).trees[1].meshes for light in LIGHTS]
    rows.append([picture(meshes, 4.0, FOOT) for meshes in (*limbs, *beside)])
    sheet = Image.fromarray(np.vstack([np.hstack(row) for row in rows]))
    sheet = sheet.resize((sheet.width * 3 // 5, sheet.height * 3 // 5), Image.Resampling.LANCZOS)
    sheet.quantize(160, dither=Image.Dither.NONE).save(arguments.output, optimize=True)


if __name__ == "__main__":
    main()
