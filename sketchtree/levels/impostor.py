"""What does a tree look like on eight cards?

Four upright planes cross in the tree's axis, 45° apart; each is a card on both sides, with the picture of the tree as seen from that side (Maciel &
Shirley 1995, "Visual navigation of large environments using textured clusters"): its own colours without light, and its normals for the engine's light.
Coverage becomes alpha, scaled card by card so that as much passes the cutoff as is wanted (after Castaño 2010, "Computing alpha mipmaps"):

    alpha = min(s a, 1)     with s such that  #(s a ≥ ½) = κ Σ a       a: share of the pixel that is covered

Cards seen askew fill holes of the one that faces the viewer; κ ≤ 1 makes up for it: with it the cards together cover as much as the tree, on average over
the sides.

A card lit by its own direction would show where cards cross. So their normals are those of a round crown rather, nearly alike where they meet, and what the
texture adds is a half of the way to the leaves' own:

    N ∝ ⅘ up + ½ (p − c) / R + ⅛ d       d: out of the card     p − c: from the crown's middle, within the card     R: half its height
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float, UInt8
from scipy import ndimage

from sketchtree.foliage.painting import to_srgb
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.levels.raster import Seen, View, render_both, silhouette

SIDES = 8
_BORDER = 4  # clear pixels round each picture
_FINE = 2  # pictures are drawn so many times larger and averaged
_APART = 1e-4  # the two sides of a card stand apart, / the tree's width: programs that draw both sides of a triangle need it
_ROUND = 16  # widths of pictures are multiples of it
_THINNEST = 0.5  # least κ
_SOFT = 0.6  # pixels, by which coverage is blurred
_TRIES = 3  # of finding κ


def impostor(meshes: Sequence[Mesh], *, pixels: int = 512) -> Mesh:
    """The tree on eight cards, 16 triangles: a mesh called `impostor`. `pixels` is the longer side of each of its eight pictures (64-2048).

    Meshes without a triangle make an empty one.
    """
    material = Material("impostor", alpha_cutoff=0.5)
    point = np.vstack([mesh.position[np.unique(mesh.triangle)] for mesh in meshes] or [np.zeros((0, 3))])
    if len(point) == 0:
        return Mesh("impostor", point, point, np.zeros((0, 2)), np.zeros((0, 3), np.int64), material)
    low, high = point.min(axis=0), point.max(axis=0)
    centre = 0.5 * (low + high)
    across = max(float(np.hypot(point[:, 0] - centre[0], point[:, 2] - centre[2]).max()), 1e-6)
    half = max(across, 0.5 * float(high[1] - low[1])) * pixels / (pixels - 2 * _BORDER)
    wide = min(int(_ROUND * np.ceil((across / half * pixels + 2 * _BORDER) / _ROUND)), pixels)
    views = [View.round(2.0 * np.pi * k / SIDES, centre, half, _FINE * pixels) for k in range(SIDES)]
    reach = wide / pixels * half, half
    both = [render_both(meshes, view) for view in views[: SIDES // 2]]
    pictures = [_Picture.of(both[k % len(both)][k // len(both)], view, wide, reach) for k, view in enumerate(views)]
    kept = 1.0
    for _ in range(_TRIES):
        made = _cards(pictures, views, reach, wide, pixels, across, kept)
        covered = sum(_area(made, view, pixels) for view in views[:2])
        kept = float(np.clip(kept * sum(picture.area for picture in pictures[:2]) / max(covered, 1.0), _THINNEST, 1.0))
    return _cards(pictures, views, reach, wide, pixels, across, kept)


def _area(card: Mesh, view: View, pixels: int) -> float:
    """What a side shows of the cards, in pixels of their pictures."""
    return float(silhouette([card], replace(view, pixels=pixels)).sum())


@dataclass(frozen=True, eq=False)
class _Picture:
    """The tree from one side, as its card holds it."""

    share: Float[np.ndarray, "row column"]  # of the pixel that is covered
    color: UInt8[np.ndarray, "row column 3"]
    normal: UInt8[np.ndarray, "row column 3"]

    @classmethod
    def of(cls, seen: Seen, view: View, wide: int, reach) -> "_Picture":
        """The middle `wide` columns of what is seen, averaged; clear pixels have the colour of the nearest covered one."""
        covered = np.isfinite(seen.depth)[..., None]
        share = _averaged(covered.astype(float))
        color, normal = (_averaged(part * covered) / np.maximum(share, 1e-9) for part in (seen.color, seen.normal))
        margin = (share.shape[1] - wide) // 2
        share, color, normal = share[:, margin : margin + wide, 0], color[:, margin : margin + wide], normal[:, margin : margin + wide]
        if (share >= 0.25).any():
            solid = tuple(ndimage.distance_transform_edt(share < 0.25, return_distances=False, return_indices=True))
            color, normal = color[solid], normal[solid]
        return cls(share, _bytes(to_srgb(np.clip(color, 0, 1))), _bytes(0.5 + 0.5 * _in_card(normal, view, reach)))

    @property
    def area(self) -> float:
        """Covered pixels."""
        return float(self.share.sum())

    def alpha(self, kept: float) -> UInt8[np.ndarray, "row column"]:
        """With the share κ of what is covered passing the cutoff."""
        soft = ndimage.gaussian_filter(self.share, _SOFT)  # few values are alike, so that any share can be kept
        some = np.sort(soft[soft > 1e-3])[::-1]
        wanted = int(np.clip(round(kept * self.area), 1, max(len(some), 1)))
        scale = float(np.clip(0.5 / some[wanted - 1], 0.5, 8.0)) if len(some) else 1.0
        return _bytes(np.clip(soft * scale, 0.0, 1.0))


def _cards(pictures, views, reach, wide: int, pixels: int, across: float, kept: float) -> Mesh:
    columns = _columns(wide, pixels)
    color = _atlas([np.dstack([picture.color, picture.alpha(kept)]) for picture in pictures], columns)
    normal = _atlas([picture.normal for picture in pictures], columns)
    cards = [_card(view, reach, k, columns, across) for k, view in enumerate(views)]
    position, facing, uv = (np.concatenate([card[k] for card in cards]) for k in range(3))
    triangle = np.concatenate([np.array([[0, 1, 2], [0, 2, 3]]) + 4 * k for k in range(SIDES)])
    return Mesh("impostor", position, facing, uv, triangle, Material("impostor", base_color_texture=color, normal_texture=normal, alpha_cutoff=0.5))


def _columns(wide: int, high: int) -> int:
    """Pictures side by side in a row of the texture: what makes it most nearly a square."""
    return min((1, 2, 4, 8), key=lambda k: abs(np.log(k * wide / (SIDES // k * high))))


def _in_card(normal, view: View, reach) -> Float[np.ndarray, "row column 3"]:
    """World normals, half of the way from the card's own, in the card's frame: along u, against v, and along its normal N."""
    rows, columns = normal.shape[:2]
    across = (2.0 * (np.arange(columns) + 0.5) / columns - 1.0) * np.ones((rows, 1))
    up = (1.0 - 2.0 * (np.arange(rows) + 0.5) / rows)[:, None] * np.ones(columns)
    corners = [_facing(view, np.float64(x), np.float64(y), reach) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    weight = [(1 - across) * (1 - up) / 4, (1 + across) * (1 - up) / 4, (1 + across) * (1 + up) / 4, (1 - across) * (1 + up) / 4]
    own = _unit(sum(w[..., None] * corner for w, corner in zip(weight, corners)))
    bent = _unit(_unit(normal) + own)
    along = _unit(view.right - np.sum(view.right * own, axis=-1, keepdims=True) * own)
    local = np.stack([np.sum(bent * axis, axis=-1) for axis in (along, np.cross(own, along), own)], axis=-1)
    local[..., 2] = np.maximum(local[..., 2], 0.15)
    return _unit(local)


def _facing(view: View, across, up, reach):
    """N at a place of the card, −1 to 1 across and upwards."""
    out = (across[..., None] * reach[0] * view.right + up[..., None] * reach[1] * view.up) / reach[1]
    return _unit(0.8 * view.up + 0.5 * out + view.towards / 8.0)


def _unit(vector):
    return vector / np.maximum(np.linalg.norm(vector, axis=-1, keepdims=True), 1e-9)


def _averaged(fine: Float[np.ndarray, "row column channel"]):
    rows, columns, channels = fine.shape
    return fine.reshape(rows // _FINE, _FINE, columns // _FINE, _FINE, channels).mean(axis=(1, 3))


def _atlas(pictures, columns: int):
    rows = [np.concatenate(pictures[k : k + columns], axis=1) for k in range(0, SIDES, columns)]
    return np.concatenate(rows, axis=0)


def _card(view: View, reach, rank: int, columns: int, across: float):
    """Corners, normals and texture places of one card: bottom left, bottom right, top right, top left."""
    across_sign, up_sign = np.array([-1, 1, 1, -1]), np.array([-1, -1, 1, 1])
    position = view.centre + across_sign[:, None] * reach[0] * view.right + up_sign[:, None] * reach[1] * view.up
    column, row = rank % columns, rank // columns
    u = (column + 0.5 + 0.5 * across_sign) / columns
    v = (row + 0.5 - 0.5 * up_sign) / (SIDES // columns)
    return position + _APART * across * view.towards, _facing(view, across_sign, up_sign, reach), np.stack([u, v], axis=1)


def _bytes(value):
    return np.round(np.clip(value, 0.0, 1.0) * 255.0).astype(np.uint8)
