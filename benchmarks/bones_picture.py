"""What do the bones, the capsules and the pivots of a tree look like, and how does it bend?

    python -m benchmarks.bones_picture [SKETCH] [-o PICTURE.png]

The bones in the wood; which bone moves which wood; the tree in leaf, and the same with its trunk bent by 30° and its boughs let down; the
capsules that collide instead of the wood; and the elements that Pivot Painter turns, each with its own colour.
"""

import argparse
import dataclasses
from pathlib import Path

import numpy as np

from benchmarks.rigged import dressed, false_colour, hue, sheet
from sketchtree.asset import Armature
from sketchtree.axes import NULL
from sketchtree.export.capsules import capsule_meshes
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.rig.capsules import capsules
from sketchtree.rig.pose import posed
from sketchtree.rig.weights import Weights

ROOT = Path(__file__).resolve().parents[1]
GOLDEN = 0.6180339887  # of the colour wheel, between one and the next
WIDE = 0.09  # width of a bone / its length


def main(argv=None) -> None:
    """Draws all six on one sheet."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sketch", nargs="?", type=Path, default=ROOT / "examples" / "oak.svg")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "docs" / "pictures" / "bones.png")
    arguments = parser.parse_args(argv)
    rigging, meshes = dressed(arguments.sketch)
    wood = [mesh for mesh in meshes if not mesh.name.startswith("leaf")]
    bones = rigging.bones.armature
    found = capsules(rigging.lines, rigging.limbs, rigging.bones).capsules
    panes = {
        f"{len(bones)} bones": octahedra(bones),
        "what they move": [false_colour(mesh, weighted(mesh, len(bones))) for mesh in wood],
        f"{len(found)} capsules": [solid(mesh, number) for number, mesh in enumerate(capsule_meshes(found, [str(k) for k in range(len(found))]))],
        "at rest": meshes,
        "bent": [bent(mesh, bones) for mesh in meshes],
        f"{len(rigging.pivots)} pivots": [false_colour(mesh, hue(element(mesh) * GOLDEN % 1.0)) for mesh in wood],
    }
    sheet([*panes.values()], [*panes], columns=3, output=arguments.output, parser=parser, around=[*meshes, *panes["bent"]])


def weighted(mesh: Mesh, joints: int) -> np.ndarray:
    """Colours of the bones, mixed by their weights."""
    colour = hue((1 + np.arange(joints)) * GOLDEN % 1.0)
    return np.einsum("vk,vkc->vc", mesh.extra["WEIGHTS_0"].astype(float), colour[mesh.extra["JOINTS_0"].astype(int)])


def element(mesh: Mesh) -> np.ndarray:
    """A number for each pivot, from its pixel."""
    _, number = np.unique(mesh.extra["TEXCOORD_1"], axis=0, return_inverse=True)
    return 1.0 + number.ravel()


def bent(mesh: Mesh, bones: Armature) -> Mesh:
    """The trunk bent to the right by 30° in all, boughs let down by 12°."""
    turn = np.zeros((len(bones), 3))
    trunk = np.array(["trunk" in name for name in bones.name])
    turn[trunk] = [0.0, 0.0, -np.radians(30.0) / trunk.sum()]
    first = np.array([name.endswith("_0") for name in bones.name]) & ~trunk & (bones.parent != NULL)
    along = np.array([bones.position[k] - bones.position[0] for k in range(len(bones))])
    out = np.column_stack([along[:, 2], np.zeros(len(along)), -along[:, 0]])
    out /= np.maximum(np.linalg.norm(out, axis=1, keepdims=True), 1e-9)
    turn[first] = np.radians(12.0) * out[first]
    weights = Weights(mesh.extra["JOINTS_0"].astype(int), mesh.extra["WEIGHTS_0"].astype(float))
    return dataclasses.replace(mesh, position=posed(bones, turn, weights, mesh.position))


def octahedra(bones: Armature) -> list[Mesh]:
    """A bone as animators draw it: thick near its joint, pointed at its end."""
    from scipy.spatial.transform import Rotation

    corner = np.array([[0, 0, 0], [1, 1, 0], [0, 1, 1], [-1, 1, 0], [0, 1, -1], [0, 1, 0]], float)
    faces = np.array([[0, a, b] for a, b in ((1, 2), (2, 3), (3, 4), (4, 1))] + [[5, b, a] for a, b in ((1, 2), (2, 3), (3, 4), (4, 1))])
    made = []
    for k in range(len(bones)):
        wide, long = WIDE * bones.length[k], bones.length[k]
        shape = corner * [wide, 0.12 * long, wide]
        shape[5, 1] = long
        points = (bones.position[k] + Rotation.from_quat(bones.rotation[k]).apply(shape))[faces].reshape(-1, 3)
        normal = np.repeat(np.cross(points[1::3] - points[::3], points[2::3] - points[::3]), 3, axis=0)
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
        made.append(solid(Mesh(f"bone {k}", points, normal, np.zeros((len(points), 2)), np.arange(len(points)).reshape(-1, 3), Material("bone")), k))
    return made


def solid(mesh: Mesh, number: int) -> Mesh:
    """In the colour of its number."""
    colour = tuple(hue(np.array([(1 + number) * GOLDEN % 1.0]))[0]) + (1.0,)
    return dataclasses.replace(mesh, material=Material(f"wood {number}", base_color=colour, double_sided=True))


if __name__ == "__main__":
    main()
