"""One little tree in every format that is read: a trunk, limbs, twigs and a crown, as each program writes them.

The files hold the same strokes, so that they must give the same graph; and they are what the fuzzing starts from.
"""

import gzip
import io
import json

import numpy as np

STROKES = {  # px, y down
    "trunk": [[100, 280], [101, 230], [99, 180], [102, 130], [100, 80], [101, 40]],
    "left": [[99, 180], [80, 160], [62, 150], [40, 130], [25, 122]],
    "right": [[101, 205], [120, 180], [140, 172], [158, 150], [181, 140]],
    "upper": [[102, 130], [88, 110], [74, 84], [66, 60]],
    "twig": [[62, 150], [50, 160], [36, 162]],
    "bough": [[140, 172], [150, 190], [166, 196]],
    "shoot": [[100, 80], [118, 66], [126, 44]],
}
CROWN = [[round(100 + 95 * np.cos(a)), round(115 + 105 * np.sin(a))] for a in np.linspace(0, 2 * np.pi, 24, endpoint=False)]


def files() -> dict[str, bytes]:
    """File name → the tree as that file holds it; every vector format."""
    return {
        "tree.svg": svg(),
        "dressed.svg": dressed_svg(),
        "tree.svgz": gzip.compress(svg(), mtime=0),
        "tree.json": sketch_json(),
        "tree.excalidraw": excalidraw(),
        "tree.inkml": inkml(),
        "tree.ndjson": quickdraw(),
    }


def svg() -> bytes:
    """Inkscape's way: a layer a kind, one path a stroke."""
    paths = "".join(f'<path id="{name}" d="M {" L ".join(f"{x},{y}" for x, y in points)}"/>' for name, points in STROKES.items())
    ring = " L ".join(f"{x},{y}" for x, y in CROWN)
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n<svg xmlns="http://www.w3.org/2000/svg" '
        'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width="200" height="300" viewBox="0 0 200 300">'
        f'<g inkscape:groupmode="layer" inkscape:label="wood" style="fill:none;stroke:#5b3;stroke-width:2">{paths}</g>'
        f'<g inkscape:groupmode="layer" inkscape:label="crown" fill="none" stroke="#080"><path id="outline" d="M {ring} Z"/></g></svg>'
    ).encode()


def dressed_svg() -> bytes:
    """The same with everything that SVG and CSS can put around a line: an entity, a symbol, a nested page, a clip, a mask, variables."""
    names = list(STROKES)

    def paths(some: list[str], dx: float = 0.0, dy: float = 0.0) -> str:
        """Half as large, from (dx, dy)."""
        lines = {name: " ".join(f"{(x - dx) / 2} {(y - dy) / 2}" for x, y in STROKES[name]) for name in some}
        return "".join(f'<path id="{name}" d="M{line}"/>' for name, line in lines.items())

    ring = " ".join(f"{x},{y}" for x, y in CROWN)
    return (
        '<!DOCTYPE svg [<!ENTITY brown "#5b3">]>\n<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
        'width="40mm" height="60mm" viewBox="0 0 200 300"><style>:root{--ink:&brown;}.wood{fill:none;stroke:var(--ink, red)} '
        "#half > path{stroke-width:1px!important} #outline{stroke:url(#fade)}</style><defs>"
        '<linearGradient id="fade"><stop stop-color="#080"/><stop offset="1"/></linearGradient>'
        '<clipPath id="page"><rect width="100%" height="100%"/></clipPath>'
        '<mask id="all" maskUnits="userSpaceOnUse" x="-99" y="-99" width="500" height="500"><rect width="200" height="300" fill="white"/></mask>'
        f'<symbol id="half" viewBox="0 0 100 150">{paths(names[:3])}</symbol></defs>'
        '<g class="wood" id="wood" clip-path="url(#page)"><use xlink:href="#half" width="200" height="300"/>'
        f'<svg x="10" y="20" width="190" height="280" viewBox="0 0 95 140" overflow="visible" stroke-width="1">{paths(names[3:5], 10, 20)}</svg>'
        f'<g style="transform:translate(4px, 8px) scale(2)">{paths(names[5:], 4, 8)}</g></g>'
        f'<g id="crown" mask="url(#all)"><polygon id="outline" fill="none" points="{ring}"/></g></svg>'
    ).encode()


def sketch_json() -> bytes:
    """Our own format."""
    rows = [{"id": name, "points": points, "width": 2} for name, points in STROKES.items()]
    rows.append({"id": "outline", "kind": "crown", "closed": True, "points": CROWN, "width": 1})
    return json.dumps({"sketchtree": 1, "units": "px", "y": "down", "strokes": rows}).encode()


def excalidraw() -> bytes:
    """Lines and freedraw of a scene; the crown is named by a text in its group."""
    elements = []
    for k, (name, points) in enumerate([*STROKES.items(), ("outline", CROWN)]):
        (x, y), local = points[0], [[a - points[0][0], b - points[0][1]] for a, b in points]
        element = {"id": name, "type": ("line", "freedraw")[k % 2], "x": x, "y": y, "angle": 0, "strokeColor": "#1e1e1e", "opacity": 100}
        element |= {"width": 0, "height": 0, "strokeWidth": 2, "backgroundColor": "transparent", "groupIds": [], "points": local}
        element |= {"pressures": [], "simulatePressure": True} if k % 2 else {"roundness": None}
        if name == "outline":
            element |= {"groupIds": ["g"], "type": "line", "polygon": True, "points": [*local, [0, 0]]}
        elements.append(element)
    elements.append({"id": "t", "type": "text", "x": 90, "y": 0, "text": "crown", "groupIds": ["g"]})
    return json.dumps({"type": "excalidraw", "version": 2, "source": "test", "elements": elements, "appState": {}, "files": {}}).encode()


def inkml() -> bytes:
    """A tablet's way: channels from a source, traces one plain, one by differences, the crown in a named group."""
    traces = []
    for k, (name, points) in enumerate(STROKES.items()):
        plain = ", ".join(f"{x} {y}" for x, y in points)
        steps = np.diff(points, axis=0)
        coded = ",".join([f"{points[0][0]} {points[0][1]}", f"'{steps[0][0]}'{steps[0][1]}", *(f"{x} {y}" for x, y in steps[1:])])
        traces.append(f'<trace xml:id="{name}" brushRef="#b">{coded if k % 2 else plain}</trace>')
    ring = ",".join(f"{x} {y}" for x, y in [*CROWN, CROWN[0]])
    return (
        '<?xml version="1.0"?><ink xmlns="http://www.w3.org/2003/InkML"><definitions>'
        '<inkSource xml:id="pen"><traceFormat><channel name="X" type="integer"/><channel name="Y" type="integer"/></traceFormat></inkSource>'
        '<brush xml:id="b"><brushProperty name="width" value="2"/></brush><context xml:id="c" inkSourceRef="#pen"/></definitions>'
        f'<traceGroup contextRef="#c">{"".join(traces)}</traceGroup>'
        f'<traceGroup><annotation type="label">crown</annotation><trace xml:id="outline" brushRef="#b">{ring}</trace></traceGroup></ink>'
    ).encode()


def quickdraw() -> bytes:
    """One line of the data set, in its raw form; it has no names, so the crown is left to be found by shape."""
    drawing, clock = [], 0
    for points in [*STROKES.values(), [*CROWN, CROWN[0]]]:
        x, y = (list(column) for column in zip(*points, strict=True))
        drawing.append([x, y, list(range(clock, clock + 20 * len(x), 20))])
        clock += 20 * len(x) + 500
    return json.dumps({"word": "tree", "countrycode": "XX", "recognized": True, "drawing": drawing}).encode() + b"\n"


def picture(kind: str = "PNG", scale: float = 1.0, *, scene: bool = False) -> bytes:
    """The branches as a pen drew them on white paper; a PNG may carry the scene, as Excalidraw exports it."""
    from PIL import Image, ImageDraw, PngImagePlugin

    page = Image.new("L", (round(200 * scale), round(300 * scale)), 255)
    for points in STROKES.values():
        ImageDraw.Draw(page).line([(x * scale, y * scale) for x, y in points], fill=20, width=max(round(4 * scale), 1), joint="curve")
    file = io.BytesIO()
    inside = PngImagePlugin.PngInfo()
    inside.add_text("application/vnd.excalidraw+json", excalidraw().decode())
    page.save(file, kind, **({"pnginfo": inside} if scene else {}))
    return file.getvalue()
