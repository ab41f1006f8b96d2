"""How is a leaf drawn into a texture?

Everything is drawn three times larger and averaged down. A `Painting` knows no season: it holds how much
of each pixel is blade, vein or stem, a shade and a height; `albedo` mixes a season's colours into it.

    albedo  = shade · (blade C_blade + vein C_vein + stem C_stem)       C: linear colours of the season
    normal  ∝ (−∂h/∂x, −∂h/∂y, 1)                                       h: height, veins sunk between pillows
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, UInt8
from PIL import Image, ImageDraw
from scipy import ndimage

from sketchtree.foliage.outline import Curve
from sketchtree.foliage.venation import Vein

PIXELS = 512  # along the blade
_SUPERSAMPLE = 3
PLAIN = 130  # a shade of 1 in the mask of shades
_AXIS_PENS = {"cover": 255, "twig": 255, "shade": PLAIN, "ridge": 160, "line": 0}, {"ridge": 255}
_BORDER = 4  # transparent pixels round the drawing, so that mipmaps and bilinear filters stay clean


@dataclass(frozen=True, eq=False)
class Painting:
    """A leaf before its season. The card spans `left…right` × `bottom…top` in blade lengths."""

    coverage: Float[np.ndarray, "row column"]  # 0-1
    vein: Float[np.ndarray, "row column"]  # 0-1, share of the pixel
    stem: Float[np.ndarray, "row column"]  # 0-1
    shade: Float[np.ndarray, "row column"]  # factor, about 1
    height: Float[np.ndarray, "row column"]  # pixels
    left: float
    right: float
    bottom: float
    top: float


class Canvas:
    """A rectangle of blade coordinates with a margin, and the masks drawn on it."""

    def __init__(self, low: Float[np.ndarray, " 2"], high: Float[np.ndarray, " 2"]):
        scale = (PIXELS - 2 * _BORDER) / max(high - low)
        self.size = np.maximum(64, 16 * np.ceil((scale * (high - low) + 2 * _BORDER) / 16)).astype(int)
        centre = (low + high) / 2
        self.low, self.high = centre - self.size / scale / 2, centre + self.size / scale / 2
        self._scale = scale * _SUPERSAMPLE

    @classmethod
    def about_the_axis(cls, points: Curve) -> "Canvas":
        """The canvas that holds the points, x = 0 in its middle."""
        half = np.abs(points[:, 0]).max()
        return cls(np.array([-half, points[:, 1].min()]), np.array([half, points[:, 1].max()]))

    def blank(self) -> Image.Image:
        """An empty mask at the drawing's resolution."""
        return Image.new("L", tuple(int(n) for n in self.size * _SUPERSAMPLE), 0)

    def place(self, outline: Curve) -> list[float]:
        """A closed outline as pixels x, y, x, y, …"""
        return ((outline - [self.low[0], self.high[1]]) * [self._scale, -self._scale]).ravel().tolist()

    def fill(self, mask: Image.Image, outline: Curve) -> None:
        """Fill a closed outline."""
        ImageDraw.Draw(mask).polygon(self.place(outline), fill=255)

    def stroke(self, mask: Image.Image, path: Curve, start_width: float, end_width: float) -> None:
        """Fill a tapered line."""
        self.fill(mask, ribbon(path, start_width, end_width))

    def average(self, mask: Image.Image) -> Float[np.ndarray, "row column"]:
        """The mask at the texture's resolution, 0-1."""
        return np.asarray(mask.reduce(_SUPERSAMPLE), np.float32) / 255.0


def ribbon(path: Curve, start_width: float, end_width: float) -> Curve:
    """The outline of a tapered line along `path`."""
    tangent = np.gradient(path, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True) + 1e-12
    half = np.linspace(start_width, end_width, len(path))[:, None] / 2
    side = np.stack([tangent[:, 1], -tangent[:, 0]], axis=1) * half
    return np.vstack([path + side, (path - side)[::-1]])


def paint_blade(outline: Curve, veins: list[Vein], *, petiole: float, reticulation: float = 1.0, seed: int = 0) -> Painting:
    """A flat blade with a petiole. The first vein is the midrib, petiole included; `reticulation`
    weighs the fine net between the veins."""
    half = np.abs(outline[:, 0]).max()
    foot, tip = min(outline[:, 1].min(), -petiole), outline[:, 1].max()
    canvas = Canvas(np.array([-half, foot]), np.array([half, tip]))
    body, stalk, lines = canvas.blank(), canvas.blank(), canvas.blank()
    canvas.fill(body, outline)
    for vein in veins:
        canvas.stroke(lines, vein.path, vein.start_width, vein.end_width)
    if petiole > 0:
        canvas.stroke(stalk, np.array([[0.0, -petiole], [0.0, 0.08]]), 1.15 * veins[0].start_width, veins[0].start_width)
    blade, stem, vein = (canvas.average(mask) for mask in (body, stalk, lines))
    vein = vein * blade
    stem = np.clip(stem - blade, 0, 1)
    net = reticulation_net(blade.shape, seed) * reticulation
    soft = ndimage.gaussian_filter(vein, 3.0)
    mottle = ndimage.zoom(np.random.default_rng(seed).normal(size=(12, 12)), np.array(blade.shape) / 12, order=1)
    rim = np.clip(ndimage.gaussian_filter(blade, 9.0), 0, 1)
    shade = 1 - 0.10 * soft - 0.13 * net + 0.035 * mottle - 0.10 * (1 - rim) * blade
    height = -2.2 * soft - 0.8 * ndimage.gaussian_filter(net, 1.0) + 1.4 * rim + 1.5 * ndimage.gaussian_filter(vein, 0.8)
    return Painting(np.clip(blade + stem, 0, 1), vein, stem, shade, height, canvas.low[0], canvas.high[0], canvas.low[1], canvas.high[1])


def paint_shoots(shoots: list[tuple[Vein, list[tuple[Vein, float]]]]) -> Painting:
    """Shoots with needles, each with its shade; later ones lie over earlier ones, and a shoot's own axis over
    the first half of its needles."""
    points = np.vstack([vein.path for axis, needles in shoots for vein in (axis, *(needle for needle, _ in needles))])
    canvas = Canvas.about_the_axis(points)
    masks = {name: canvas.blank() for name in ("cover", "twig", "shade", "ridge", "line")}
    pens = {name: ImageDraw.Draw(mask) for name, mask in masks.items()}
    for axis, needles in shoots:
        half = len(needles) // 2
        drawn = [(vein, *_needle_pens(shade)) for vein, shade in needles]
        for vein, whole, middle in [*drawn[:half], (axis, *_AXIS_PENS), *drawn[half:]]:
            for share, values in ((1.0, whole), (0.35, middle)):
                outline = canvas.place(ribbon(vein.path, share * vein.start_width, share * vein.end_width))
                for name, value in values.items():
                    pens[name].polygon(outline, fill=value)
    coverage = canvas.average(masks["cover"])
    tone = canvas.average(masks["shade"]) * 255 / PLAIN
    tone = np.where(coverage > 0.02, tone / np.maximum(coverage, 0.02), 1.0)
    height = 2.5 * ndimage.gaussian_filter(canvas.average(masks["ridge"]), 0.8)
    line, twig = canvas.average(masks["line"]), canvas.average(masks["twig"])
    return Painting(coverage, 0.6 * line, twig, tone, height, canvas.low[0], canvas.high[0], canvas.low[1], canvas.high[1])


def _needle_pens(shade: float) -> tuple[dict, dict]:
    """What a needle writes into each mask, over its width and along its middle. It hides what is under it: its
    pixels are no twig, and have a ridge and a pale line of their own."""
    return {"cover": 255, "twig": 0, "shade": int(PLAIN * shade), "ridge": 60, "line": 0}, {"ridge": 255, "line": 255}


def albedo(painting: Painting, blade, vein, stem) -> UInt8[np.ndarray, "row column 4"]:
    """The sRGB texture with alpha in a season's linear colours; colour runs on under the transparent
    area, so that no halo appears where a filter reaches across the edge."""
    w_stem = painting.stem[..., None]
    w_vein = np.minimum(painting.vein, 1 - painting.stem)[..., None]
    colour = (1 - w_stem - w_vein) * np.asarray(blade) + w_vein * np.asarray(vein) + w_stem * np.asarray(stem)
    colour = np.clip(colour * painting.shade[..., None], 0, 1)
    colour = _run_on(to_srgb(colour), painting.coverage)
    return np.dstack([np.round(255 * colour), np.round(255 * painting.coverage)]).astype(np.uint8)


def normal_map(painting: Painting, strength: float = 1.0) -> UInt8[np.ndarray, "row column 3"]:
    """The tangent-space normal texture, +y up (glTF's convention); flat where transparent."""
    down, right = np.gradient(ndimage.gaussian_filter(painting.height, 0.7) * strength)
    inner = painting.coverage > 0.9
    normal = np.dstack([-right * inner, down * inner, np.ones_like(down)])
    normal /= np.linalg.norm(normal, axis=2, keepdims=True)
    return np.round(127.5 + 127.5 * normal).astype(np.uint8)


def to_srgb(linear):
    """Linear light 0-1 to sRGB 0-1 (IEC 61966-2-1)."""
    linear = np.asarray(linear, float)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)


def to_linear(srgb):
    """sRGB 0-1 to linear light 0-1 (IEC 61966-2-1)."""
    srgb = np.asarray(srgb, float)
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def _run_on(colour, coverage):
    """Every transparent pixel takes the colour of the nearest solid one."""
    nearest = ndimage.distance_transform_edt(coverage < 0.5, return_distances=False, return_indices=True)
    return colour[tuple(nearest)]


def reticulation_net(shape, seed):
    """The fine net of a blade, 0-1: pixels about as near to their second closest cell as to the closest."""
    from scipy.spatial import cKDTree

    rows, columns = (n // 2 for n in shape)
    rng = np.random.default_rng(seed)
    cells = rng.uniform(0, 1, (rows * columns // 60, 2)) * [rows, columns]
    grid = np.stack(np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij"), axis=-1).reshape(-1, 2)
    near = cKDTree(cells).query(grid, k=2)[0]
    net = np.clip(1 - (near[:, 1] - near[:, 0]) / 1.8, 0, 1).reshape(rows, columns)
    return ndimage.zoom(net, np.array(shape) / net.shape, order=1)
