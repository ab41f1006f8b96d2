"""A scene as a PNG picture, drawn at FINER times its size and scaled down, so that its lines are smooth."""

import io

import numpy as np
from jaxtyping import Float
from PIL import Image, ImageColor, ImageDraw, ImageFont

from sketchtree.overlay.scene import Disc, Path, Scene, Underlay, Words

FINER = 3


def scene_png(scene: Scene) -> bytes:
    """The bytes of a PNG file of the scene's size."""
    picture = Image.new("RGB", (scene.width * FINER, scene.height * FINER), "#ffffff")
    if scene.underlay:
        _lay_under(picture, scene.underlay)
    canvas = ImageDraw.Draw(picture)
    for mark in scene.marks:
        if isinstance(mark, Path):
            _path(picture, canvas, mark)
        elif isinstance(mark, Disc):
            _disc(canvas, mark)
    picture = picture.resize((scene.width, scene.height), Image.Resampling.LANCZOS)
    canvas = ImageDraw.Draw(picture)
    for mark in scene.marks:
        if isinstance(mark, Words):
            _words(canvas, mark)
    file = io.BytesIO()
    picture.save(file, "PNG", optimize=False)
    return file.getvalue()


def _lay_under(picture: Image.Image, under: Underlay) -> None:
    left, top, width, height = (round(value * FINER) for value in under.box)
    image = Image.fromarray(under.pixels).resize((max(width, 1), max(height, 1)))
    picture.paste(Image.blend(Image.new("RGB", image.size, "#ffffff"), image, under.opacity), (left, top))


def _path(picture: Image.Image, canvas: ImageDraw.ImageDraw, path: Path) -> None:
    points = [tuple(point) for point in (path.points * FINER).tolist()]
    if path.fill and len(points) > 2:
        _area(picture, points, path.fill, path.fill_opacity)
    if path.colour is None:
        return
    width, colour = max(1, round(path.width * FINER)), _faded(path.colour, path.opacity)
    points = points + points[:1] if path.closed else points
    for piece in _dashes(np.array(points), path.dash * FINER) if path.dash else [points]:
        canvas.line(piece, colour, width, joint="curve")
        for x, y in (piece[0], piece[-1]):
            canvas.ellipse((x - width / 2, y - width / 2, x + width / 2, y + width / 2), colour)


def _area(picture: Image.Image, points, colour: str, opacity: float) -> None:
    """Fills a polygon by the even-odd rule, over what is there."""
    corner = np.floor(np.min(points, axis=0)).astype(int)
    size = np.ceil(np.max(points, axis=0)).astype(int) - corner + 1
    mask = Image.new("L", tuple(np.clip(size, 1, picture.size).tolist()))
    ImageDraw.Draw(mask).polygon([(x - corner[0], y - corner[1]) for x, y in points], round(255 * opacity))
    picture.paste(Image.new("RGB", mask.size, colour), tuple(corner.tolist()), mask)


def _disc(canvas: ImageDraw.ImageDraw, disc: Disc) -> None:
    x, y, r = disc.x * FINER, disc.y * FINER, disc.radius * FINER
    canvas.ellipse((x - r, y - r, x + r, y + r), disc.fill, disc.colour, max(1, round(disc.width * FINER)) if disc.colour else 0)


def _words(canvas: ImageDraw.ImageDraw, words: Words) -> None:
    font = ImageFont.load_default(words.size)
    anchor = {"start": "ls", "middle": "ms", "end": "rs"}[words.anchor]
    text = "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in words.text)
    if words.halo:
        canvas.text((words.x, words.y), text, "#ffffff", font, anchor, stroke_width=2.5, stroke_fill="#ffffff")
    canvas.text((words.x, words.y), text, words.colour, font, anchor, stroke_width=0.35 if words.bold else 0)


def _dashes(points: Float[np.ndarray, "point 2"], dash: float) -> list[list[tuple[float, float]]]:
    """Every second piece of `dash` pixels along a line."""
    along = np.r_[0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T))]
    pieces = []
    for start in np.arange(0.0, max(along[-1], 1e-9), 2 * dash):
        stop = min(start + dash, along[-1])
        s = np.r_[start, along[(along > start) & (along < stop)], stop]
        pieces.append(list(zip(*(np.interp(s, along, points[:, axis]).tolist() for axis in (0, 1)), strict=True)))
    return pieces


def _faded(colour: str, opacity: float) -> tuple[int, int, int]:
    """The colour as it looks over white paper."""
    rgb = np.array(ImageColor.getrgb(colour)[:3], float)
    return tuple(int(v) for v in np.round(255 + opacity * (rgb - 255)))
