"""What is there to choose from? Templates, leaves, barks, examples and kinds of file, with their names for people."""

from sketchtree.export.files import MESHES, PROJECTS, SKELETONS
from sketchtree.foliage.models import leaf_names
from sketchtree.foliage.species.blossoms import BLOSSOMS
from sketchtree.geometry.bark import bark_names
from sketchtree.studio import examples, messages
from sketchtree.studio.making.textures import SEASONS
from sketchtree.studio.making.scanned_picture import scanned_picture
from sketchtree.studio.scribbled_example import scribbled_picture
from sketchtree.view.film import encoder

_FORMATS = {
    ".glb": "glTF, one file", ".gltf": "glTF, with its parts beside it", ".usdz": "USD, one file with textures", ".usd": "USD", ".usda": "USD as text", ".obj": "OBJ",
    ".ply": "PLY", ".stl": "STL, for printing", ".3mf": "3MF, for printing", ".swc": "SWC skeleton", ".mtg": "MTG skeleton", ".json": "JSON skeleton", ".h5": "HDF5 skeleton",
    ".sketchtree": "SketchTree project",
}  # fmt: skip
_MOVING = {
    ".glb": "glTF, animated", ".usdz": "USD, animated, one file", ".usd": "USD, animated", ".mp4": "Film", ".gif": "Film for the web",
}  # fmt: skip


def catalogue(templates) -> messages.Welcome:
    """Folder and files are left empty."""
    formats = [name for name in _FORMATS if name in MESHES + SKELETONS + PROJECTS]
    return messages.Welcome(
        version=messages.VERSION,
        templates=[_choice(name, "template", title) for name, title in zip(templates.names, templates.titles, strict=True)],
        leaves=[_choice(name, "leaf") for name in leaf_names() if name not in BLOSSOMS],
        barks=[_choice(name, "bark") for name in bark_names()],
        seasons=list(SEASONS),
        examples=[messages.Choice(name=name, title=examples.title(name), picture=f"/picture/example/{name}.png") for name in examples.names()],
        formats=[messages.Choice(name=name, title=_FORMATS[name]) for name in formats],
        moving=[messages.Choice(name=name, title=title) for name, title in _MOVING.items() if name != ".mp4" or encoder() is not None],
        folder="",
        files=[],
    )


def example_picture(name: str) -> bytes | None:
    """An example's strokes, small; None: there is none of that name."""
    from PIL import Image, ImageDraw

    from sketchtree.studio.making.documents import document_of
    from sketchtree.studio.making.textures import encoded

    if name not in examples.names():
        return None
    if name in examples.SCRIBBLED:
        return scribbled_picture(name)
    if name in examples.SCANNED:
        return encoded(scanned_picture(document_of(examples.data(name), name).cloud))
    strokes = document_of(examples.data(name), name).strokes.values()
    low = [min(float(stroke.points[:, axis].min()) for stroke in strokes) for axis in (0, 1)]
    high = [max(float(stroke.points[:, axis].max()) for stroke in strokes) for axis in (0, 1)]
    size, edge = 480, 24
    scale = (size - 2 * edge) / max(high[0] - low[0], high[1] - low[1], 1e-9)
    aside = (size - scale * (high[0] - low[0])) / 2
    image = Image.new("L", (size, size), 0)
    pen = ImageDraw.Draw(image)
    for stroke in strokes:
        line = [(aside + scale * (x - low[0]), edge + scale * (high[1] - y)) for x, y in stroke.points.tolist()]
        line = line + line[:1] if stroke.closed else line
        pen.line(line, fill=110 if stroke.kind != "branch" else 255, width=max(3, min(14, round(scale * (stroke.width or 0)))), joint="curve")
    alpha = image.resize((size // 3, size // 3), Image.Resampling.LANCZOS)
    import numpy as np

    ink = np.asarray(alpha)
    return encoded(np.stack([np.full_like(ink, 40), ink], axis=-1))


def _choice(name: str, what: str, title: str = "") -> messages.Choice:
    return messages.Choice(name=name, title=title or name.replace("_", " ").capitalize(), picture=f"/picture/{what}/{name}.png")
