"""What does a tree look like that grew beside something?

    python -m benchmarks.obstacle_picture [SKETCH] [-o PICTURE.png]

One sketch, three trees: alone; beside a house; between a wall and a ball in its crown. Each from the front and
from another side. Strokes that run into what stands there are left out: nobody draws a limb into a house.
"""

import argparse
import dataclasses
import tempfile
from pathlib import Path

import numpy as np
import trimesh
from PIL import Image

import sketchtree as st
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.keys import root_key
from sketchtree.options import ReadingOptions
from sketchtree.pipeline import DrawnTree, complete, draw_out
from sketchtree.propagate.space.domain import Domain
from sketchtree.propagate.space.obstacles import Obstacles

ROOT = Path(__file__).resolve().parents[1]
SIZE = (640, 560)
FINE = 0.4  # metres
GREY = (0.34, 0.33, 0.32, 1.0)  # linear


def house(x: float, depth: float, width: float, eaves: float, ridge: float) -> trimesh.Trimesh:
    """A closed house with a gable, its near wall at `x`, metres."""
    gable = np.array([[0, 0], [width, 0], [width, eaves], [width / 2, ridge], [0, eaves]]) + [x, 0]
    front, back = (np.column_stack([gable, np.full(5, z)]) for z in (depth / 2, -depth / 2))
    cap = np.array([[0, 1, 2], [0, 2, 4], [4, 2, 3]])
    side = [[i, j, j + 5, i + 5] for i, j in zip(range(5), (1, 2, 3, 4, 0), strict=True)]
    walls = np.array([[b, a, d, d, c, b] for a, b, c, d in side]).reshape(-1, 3)
    found = trimesh.Trimesh(np.concatenate([front, back]), np.concatenate([cap, cap[:, ::-1] + 5, walls]))
    found.fix_normals()
    return found


def wall(x: float, height: float, depth: float) -> trimesh.Trimesh:
    """An open sheet at `x`, metres."""
    z = depth / 2
    return trimesh.Trimesh([[x, 0, -z], [x, 0, z], [x, height, z], [x, height, -z]], [[0, 1, 2], [0, 2, 3]])


def ball(centre, radius: float) -> trimesh.Trimesh:
    """A sphere, metres."""
    found = trimesh.creation.icosphere(4, radius)
    found.apply_translation(centre)
    return found


def shown(mesh: trimesh.Trimesh, colour, name: str) -> Mesh:
    """The same with flat faces, small enough for their light to be smooth, and one colour, both sides of them."""
    mesh = mesh.subdivide_to_size(FINE, max_iter=12)
    flat = mesh.triangles.reshape(-1, 3)
    normal = np.repeat(mesh.face_normals, 3, axis=0)
    material = Material(f"wood {name}", base_color=colour, double_sided=True)
    return Mesh(f"wood {name}", flat, normal, np.zeros((len(flat), 2)), np.arange(len(flat)).reshape(-1, 3), material)


def scenes(height: float) -> dict[str, tuple[tuple[trimesh.Trimesh, ...], tuple[float, float]]]:
    """What stands by the tree, and the azimuths of two views, degrees."""
    h = height / 15.0
    return {
        "alone": ((), (0.0, -40.0)),
        "house": ((house(2.4 * h, 9 * h, 8 * h, 6.5 * h, 10 * h),), (0.0, -50.0)),
        "wall": ((wall(2.2 * h, 13 * h, 15 * h), ball((-2.8 * h, 10.5 * h, 2.6 * h), 1.7 * h)), (0.0, -35.0)),
    }


def drawn_beside(sketch: st.Sketch, meshes, reading: ReadingOptions, key) -> DrawnTree:
    """The sketch in 3D without the strokes that run into one of the meshes."""
    drawn = draw_out(sketch, key=key, options=reading)
    tree = drawn.skeleton
    domain = Domain.of(tree, None, drawn.habit, tree.height)
    met = Obstacles.build(meshes, (), domain).exit_fraction(tree.start, tree.tip) < 1.0
    names = {drawn.graph.stroke_ids[stroke] for stroke in np.unique(tree.stroke[met & ~tree.is_base])}
    if not names:
        return drawn
    left = tuple(stroke for stroke in sketch.strokes if stroke.id not in names)
    return drawn_beside(dataclasses.replace(sketch, strokes=left), meshes, reading, key)


def main(argv=None) -> None:
    """Draws all scenes on one sheet."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sketch", nargs="?", type=Path, default=ROOT / "examples" / "oak_50.svg")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "docs" / "pictures" / "obstacles.png")
    arguments = parser.parse_args(argv)
    key, sketch = root_key(0), st.read_sketch(arguments.sketch)
    alone = draw_out(sketch, key=key)
    reading = ReadingOptions(height=alone.skeleton.height, template=alone.matches[0].name)
    panes = []
    for meshes, azimuths in scenes(reading.height).values():
        tree = complete(drawn_beside(sketch, meshes, reading, key), key=key, obstacles=meshes)
        grey = [shown(mesh, GREY, f"obstacle {k}") for k, mesh in enumerate(meshes)]
        panes.append([picture([*tree.meshes, *grey], azimuth, parser) for azimuth in azimuths])
    sheet = Image.fromarray(np.vstack([np.hstack(row) for row in zip(*panes, strict=True)]))
    sheet = sheet.resize((sheet.width * 3 // 4, sheet.height * 3 // 4), Image.Resampling.LANCZOS)
    sheet.quantize(128, dither=Image.Dither.NONE).save(arguments.output, optimize=True)


def picture(meshes, azimuth: float, parser) -> np.ndarray:
    """One view as pixels."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "view.png"
        drawn, reason = st.preview(meshes, path, size=SIZE, azimuth=azimuth, elevation=8.0)
        if not drawn:
            parser.exit(1, f"{reason}\n")
        return np.array(Image.open(path).convert("RGB"))


if __name__ == "__main__":
    main()
