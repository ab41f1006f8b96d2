"""Round which point does each part of the tree turn, and which part carries it?

Elements are stems and the thickest limbs on them, three deep and at most a thousand, parents first; every other limb, and every leaf, goes
with the element it grows from. Each has a pivot, the foot of its limb; an axis, from there to the limb's tip; and an extent along it.

Pivot Painter 2 (Unreal Engine's own textures and material functions for it) keeps one pixel an element, row by row from the top left, and reads it
where the second UV set of the element's vertices points:

    PivotPos_Index.exr    half floats   R G B  pivot, centimetres, Unreal's axes     A  the parent's number, its own if it has none
    XVector_Extent.png    bytes         R G B  (axis + 1) / 2, Unreal's axes          A  extent / 2048 cm, in steps of 8 cm, 8 at least

A number i stands in a half float as the bits of i + 1024, which any step that keeps halves as they are leaves alone. Unreal's importer takes
glTF's (x, y, z) metres to (100 x, 100 z, 100 y): left-handed, z up. Sources: Epic's "Pivot Painter Tool 2.0 MAXScript reference"; for the packing,
which the reference does not spell out, the notes kept at github.com/godot-extended-libraries/godot-pivot-painter.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Float16, Int, UInt8

from sketchtree.axes import NULL
from sketchtree.geometry.limbs import CentreLines
from sketchtree.rig.boughs import Boughs

DEEPEST = 3  # limbs below the stem that have an element: Unreal's foliage function knows four levels
_HALF = 1024  # added to a number, so that no half float is subnormal
_STEP, _STEPS = 8.0, 256.0  # centimetres of an extent, and how many of them at most
_CENTIMETRES = 100.0


@dataclass(frozen=True, eq=False)
class Pivots:
    """One row an element, parents before children. Metres, y up."""

    parent: Int[np.ndarray, " element"]  # NULL: it stands on the ground
    position: Float[np.ndarray, "element 3"]
    axis: Float[np.ndarray, "element 3"]  # unit
    extent: Float[np.ndarray, " element"]  # metres along the axis
    limb: Int[np.ndarray, " element"]  # of the centre lines
    of_limb: Int[np.ndarray, " limb"]  # the element that each limb goes with

    def __len__(self) -> int:
        return len(self.parent)

    @property
    def size(self) -> tuple[int, int]:
        """Columns and rows of the textures: powers of two, at least one pixel an element."""
        columns = 1 << int(np.ceil(np.log2(max(len(self), 1)) / 2.0))
        rows = 1 << int(np.ceil(np.log2(max(int(np.ceil(len(self) / columns)), 1))))
        return columns, rows


def pivots(lines: CentreLines, limbs: Boughs, *, most: int = 1000) -> Pivots:
    """The elements of a tree, `most` (≥ the number of stems, ≤ 30,000) at most. Roots go with the first stem."""
    radius = lines.radius[lines.start[:-1]]
    able = np.flatnonzero((limbs.depth <= DEEPEST) & ~limbs.is_root)
    able = able[np.lexsort((able, -limbs.carried[able], ~limbs.is_stem[able]))][:most]  # a parent carries more than its child
    able = able[np.lexsort((able, -radius[able], limbs.depth[able]))]
    of_limb = np.full(len(lines), NULL)
    of_limb[able] = np.arange(len(able))
    for limb in range(len(lines)):
        if of_limb[limb] == NULL:
            of_limb[limb] = of_limb[lines.parent[limb]] if lines.parent[limb] != NULL else 0
    above = lines.parent[able]
    foot, tip = lines.point[lines.start[able]], lines.point[lines.start[able + 1] - 1]
    extent = np.linalg.norm(tip - foot, axis=1)
    axis = (tip - foot) / np.maximum(extent, 1e-12)[:, None]
    return Pivots(np.where(above == NULL, NULL, of_limb[above]), foot, axis, extent, able, of_limb)


def texel(found: Pivots, element: Int[np.ndarray, " vertex"]) -> Float[np.ndarray, "vertex 2"]:
    """Where in the textures each vertex finds its element: the middle of the pixel, (0, 0) the top left."""
    columns, rows = found.size
    return np.column_stack([(element % columns + 0.5) / columns, (element // columns + 0.5) / rows])


def pivot_columns(found: Pivots, element: Int[np.ndarray, " vertex"]) -> tuple[Float[np.ndarray, "vertex 2"], Float[np.ndarray, "vertex 2"]]:
    """For shaders without textures: (x, y) of the pivot and (z, number of the parent element, its own if none), metres, y up."""
    position = found.position[element]
    return position[:, :2], np.column_stack([position[:, 2], _above(found)[element]])


def position_texture(found: Pivots) -> Float16[np.ndarray, "row column 4"]:
    """R G B: pivots in Unreal's frame; A: parents' numbers as bits."""
    pixels = np.zeros((len(found), 4), np.float16)
    pixels[:, :3] = _CENTIMETRES * unreal(found.position)
    pixels[:, 3] = (_above(found) + _HALF).astype(np.uint16).view(np.float16)
    return _as_image(found, pixels)


def axis_texture(found: Pivots) -> UInt8[np.ndarray, "row column 4"]:
    """R G B: axes in Unreal's frame; A: extents."""
    extent = np.clip(_CENTIMETRES * found.extent / _STEP, 1.0, _STEPS) / _STEPS
    pixels = np.column_stack([0.5 * (unreal(found.axis) + 1.0), extent])
    return _as_image(found, np.round(255.0 * pixels).astype(np.uint8))


def unreal(vector: Float[np.ndarray, "row 3"]) -> Float[np.ndarray, "row 3"]:
    """The vectors on Unreal's axes; lengths as they are."""
    return vector[:, [0, 2, 1]]


def _above(found: Pivots) -> Int[np.ndarray, " element"]:
    return np.where(found.parent == NULL, np.arange(len(found)), found.parent)


def _as_image(found: Pivots, pixels):
    columns, rows = found.size
    image = np.zeros((columns * rows, 4), pixels.dtype)
    image[: len(pixels)] = pixels
    return image.reshape(rows, columns, 4)
