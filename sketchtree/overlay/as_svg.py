"""A scene as an SVG file: small, sharp at any size, every mark an element of its own."""

import base64
import io
from html import escape

from sketchtree.overlay.scene import Disc, Path, Scene, Underlay, Words


def scene_svg(scene: Scene) -> str:
    """The text of an SVG file, one mark a line."""
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{scene.width}" height="{scene.height}" '
        f'viewBox="0 0 {scene.width} {scene.height}" stroke-linecap="round" stroke-linejoin="round" font-family="sans-serif">'
    )
    lines = [head, f"<title>{escape(_printable(scene.title))}</title>", '<rect width="100%" height="100%" fill="#ffffff"/>']
    lines += [_underlay(scene.underlay)] if scene.underlay else []
    lines += [_WRITE[type(mark)](mark) for mark in scene.marks]
    return "\n".join([*lines, "</svg>", ""])


def _path(path: Path) -> str:
    points = "L".join(f"{x:.2f} {y:.2f}" for x, y in path.points)
    ink = f'stroke="{path.colour}" stroke-width="{path.width:.2f}"' if path.colour else 'stroke="none"'
    ink += f' stroke-opacity="{path.opacity:g}"' if path.opacity < 1 else ""
    ink += f' stroke-dasharray="{path.dash:g}"' if path.dash else ""
    area = f'fill="{path.fill}" fill-opacity="{path.fill_opacity:g}"' if path.fill else 'fill="none"'
    return f'<path d="M{points}{"Z" if path.closed else ""}" {ink} {area}/>'


def _disc(disc: Disc) -> str:
    rim = f' stroke="{disc.colour}" stroke-width="{disc.width:.2f}"' if disc.colour else ""
    return f'<circle cx="{disc.x:.2f}" cy="{disc.y:.2f}" r="{disc.radius:.2f}" fill="{disc.fill or "none"}"{rim}/>'


def _words(words: Words) -> str:
    weight = ' font-weight="bold"' if words.bold else ""
    weight += ' stroke="#ffffff" stroke-width="4" paint-order="stroke"' if words.halo else ""
    return (
        f'<text x="{words.x:.2f}" y="{words.y:.2f}" font-size="{words.size:g}" fill="{words.colour}" '
        f'text-anchor="{words.anchor}"{weight}>{escape(_printable(words.text))}</text>'
    )


def _underlay(under: Underlay) -> str:
    from PIL import Image

    file = io.BytesIO()
    Image.fromarray(under.pixels).save(file, "JPEG", quality=80)
    left, top, width, height = under.box
    data = base64.b64encode(file.getvalue()).decode()
    return (
        f'<image x="{left:.2f}" y="{top:.2f}" width="{width:.2f}" height="{height:.2f}" opacity="{under.opacity:g}" '
        f'preserveAspectRatio="none" href="data:image/jpeg;base64,{data}"/>'
    )


def _printable(text: str) -> str:
    """The text without characters that XML can't hold."""
    return "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in text)


_WRITE = {Path: _path, Disc: _disc, Words: _words}
