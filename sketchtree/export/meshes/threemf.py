"""Wood for printing, as 3MF: the wood's triangles without colour, in metres, z up as the printer's plate asks.

3MF core specification 1.3 (3MF Consortium): a zip of three small XML files. Vertices at one place become one, as a slicer needs
them to see that a piece is closed. Leaves are sheets without thickness, which can't be printed, and are left out.
"""

import io
import zipfile
from collections.abc import Sequence
from xml.sax.saxutils import quoteattr

import numpy as np

from sketchtree.geometry.mesh import Mesh
from sketchtree.version import __version__

_EPOCH = (1980, 1, 1, 0, 0, 0)  # a zip must name a time; the same file every time
_TYPES = (
    '<?xml version="1.0" encoding="UTF-8"?>\n<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">'
    '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
    '<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>'
)
_RELATIONS = (
    '<?xml version="1.0" encoding="UTF-8"?>\n<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
    '<Relationship Target="/3D/3dmodel.model" Id="model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>'
)


def threemf_bytes(meshes: Sequence[Mesh], name: str = "tree") -> bytes:
    """The meshes that are wood, one object each."""
    objects = [_object(number, mesh) for number, mesh in enumerate(meshes, 1)]
    items = "".join(f'<item objectid="{number}"/>' for number in range(1, len(objects) + 1))
    model = (
        '<?xml version="1.0" encoding="UTF-8"?>\n<model unit="meter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">'
        f'<metadata name="Title">{quoteattr(name)[1:-1]}</metadata><metadata name="Application">SketchTree {__version__}</metadata>'
        f'<resources>{"".join(objects)}</resources><build>{items}</build></model>'
    )
    return _zipped({"[Content_Types].xml": _TYPES, "_rels/.rels": _RELATIONS, "3D/3dmodel.model": model})


def _object(number: int, mesh: Mesh) -> str:
    place, at = np.unique(mesh.position.astype(np.float32), axis=0, return_inverse=True)
    triangle = at.reshape(-1)[mesh.triangle]
    flat = (triangle[:, 0] == triangle[:, 1]) | (triangle[:, 1] == triangle[:, 2]) | (triangle[:, 0] == triangle[:, 2])
    vertices = "".join('<vertex x="%.7g" y="%.7g" z="%.7g"/>' % (x, -z, y) for x, y, z in place.tolist())
    triangles = "".join('<triangle v1="%d" v2="%d" v3="%d"/>' % (a, b, c) for a, b, c in triangle[~flat].tolist())
    return f'<object id="{number}" type="model" name={quoteattr(mesh.name)}><mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh></object>'


def _zipped(parts: dict[str, str]) -> bytes:
    whole = io.BytesIO()
    with zipfile.ZipFile(whole, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in parts.items():
            archive.writestr(zipfile.ZipInfo(name, _EPOCH), text, zipfile.ZIP_DEFLATED, 6)
    return whole.getvalue()
