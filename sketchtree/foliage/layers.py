"""How is a picture drawn of many small things that hide each other: leaflets, petals, scales?

The painter's way: layers from back to front, each an outline filled into every mask (`painting.Canvas`), so that what
lies under it is gone from the picture. A layer is blade, vein or stem; every blade darkens towards its own edge.

    placed:   x = foot + size · (x cos h + y sin h,  y cos h − x sin h)      h: heading, radians from upright, positive to the right
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float
from PIL import ImageDraw
from scipy import ndimage

from sketchtree.foliage.outline import Curve
from sketchtree.foliage.painting import PLAIN, Canvas, Painting, reticulation_net, ribbon
from sketchtree.foliage.venation import Vein

_EDGE = 0.0045  # width of the rim that each blade darkens, picture lengths


class Layer(NamedTuple):
    """A filled outline. `kind` is blade, vein or stem; `shade` a factor about 1, up to 1.9."""

    outline: Curve
    kind: str = "blade"
    shade: float = 1.0


def placed(curve: Curve, foot, heading: float, size: float) -> Curve:
    """A curve in blade coordinates brought to its place in the picture."""
    x, y = curve[:, 0], curve[:, 1]
    cosine, sine = np.cos(heading), np.sin(heading)
    return np.asarray(foot) + size * np.stack([x * cosine + y * sine, y * cosine - x * sine], axis=1)


def line(path: Curve, start_width: float, end_width: float, kind: str = "stem", shade: float = 1.0) -> Layer:
    """A tapered line along `path`."""
    return Layer(ribbon(np.asarray(path, float), start_width, end_width), kind, shade)


def blade(outline: Curve, veins: list[Vein], foot, heading: float, size: float, shade: float = 1.0) -> list[Layer]:
    """A leaflet and its veins, at its place."""
    layers = [Layer(placed(outline, foot, heading, size), "blade", shade)]
    return layers + [Layer(placed(ribbon(v.path, v.start_width, v.end_width), foot, heading, size), "vein", shade) for v in veins]


def disc(centre, radius: float, kind: str, shade: float = 1.0, flat: float = 1.0, heading: float = 0.0) -> Layer:
    """An ellipse, `flat` times as high as wide, turned by `heading`."""
    turn = np.linspace(0, 2 * np.pi, 14, endpoint=False)
    return Layer(placed(np.stack([np.cos(turn), flat * np.sin(turn)], axis=1), centre, heading, radius), kind, shade)


def paint_layers(layers: list[Layer], *, reticulation: float = 0.0, seed: int = 0) -> Painting:
    """The layers, the first at the back. `reticulation` weighs the fine net of the blades."""
    points = np.vstack([layer.outline for layer in layers])
    canvas = Canvas.about_the_axis(points)
    masks = {name: canvas.blank() for name in ("cover", "vein", "stem", "shade", "edge")}
    pens = {name: ImageDraw.Draw(mask) for name, mask in masks.items()}
    width = max(2, round(_EDGE * max(masks["cover"].size)))
    for layer in layers:
        outline = canvas.place(layer.outline)
        for name, value in _values(layer).items():
            pens[name].polygon(outline, fill=value)
        if layer.kind == "blade":
            pens["edge"].line(outline + outline[:4], fill=255, width=width)
    return _painting(canvas, {name: canvas.average(mask) for name, mask in masks.items()}, reticulation, seed)


def _values(layer: Layer) -> dict[str, int]:
    own = {name: 255 if layer.kind == name else 0 for name in ("vein", "stem")}
    under = {} if layer.kind == "vein" else {"edge": 0}
    return {"cover": 255, "shade": int(np.clip(PLAIN * layer.shade, 1, 255))} | own | under


def _painting(canvas: Canvas, mask: dict[str, Float[np.ndarray, "row column"]], reticulation: float, seed: int) -> Painting:
    cover = mask["cover"]
    tone = np.where(cover > 0.02, mask["shade"] * 255 / PLAIN / np.maximum(cover, 0.02), 1.0)
    net = reticulation * reticulation_net(cover.shape, seed) if reticulation else np.zeros_like(cover)
    edge = np.minimum(mask["edge"], cover)
    rim = ndimage.gaussian_filter(edge, 1.5)
    soft = ndimage.gaussian_filter(mask["vein"], 1.5)
    shade = tone * (1 - 0.10 * soft - 0.13 * net - 0.22 * rim)
    height = -1.2 * soft - 0.6 * net - 1.8 * rim + 1.5 * ndimage.gaussian_filter(mask["stem"], 1.0)
    return Painting(cover, mask["vein"], mask["stem"], shade, height, canvas.low[0], canvas.high[0], canvas.low[1], canvas.high[1])
