"""The tables of a glTF 2.0 document while it is put together: what is stored is stored once, and named by its number.

Every column begins at a multiple of four bytes. Images and materials that come again are those that are there.
"""

from dataclasses import dataclass, field

import numpy as np

from sketchtree.export.images import encode

VERTEX, INDEX = 34962, 34963  # buffer view targets
COMPONENT = {"b": 5120, "B": 5121, "h": 5122, "H": 5123, "I": 5125, "f": 5126}
_KIND = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
_LINEAR, _MIPMAP, _REPEAT = 9729, 9987, 10497


@dataclass(frozen=True)
class Picture:
    """An image of the document."""

    name: str
    media: str
    data: bytes


@dataclass
class Tables:
    """What the nodes of a document point at."""

    compact: bool = False  # vertices in numbers of 8 and 16 bits (`vertices`)
    chunks: list[bytes] = field(default_factory=list)  # of the buffer
    size: int = 0  # of the buffer, bytes
    views: list = field(default_factory=list)
    accessors: list = field(default_factory=list)
    meshes: list = field(default_factory=list)
    materials: list = field(default_factory=list)
    textures: list = field(default_factory=list)
    pictures: list[Picture] = field(default_factory=list)
    skins: list = field(default_factory=list)
    animations: list = field(default_factory=list)
    used: set = field(default_factory=set)  # extensions
    required: set = field(default_factory=set)
    known: dict = field(default_factory=dict)  # what was stored already, by its content

    def column(self, array, target: int | None = VERTEX, *, bounds: bool = False, normalized: bool = False) -> int:
        """The number of an accessor of the array, [row] or [row channel], of the component type that its dtype has."""
        width = array.shape[1] if array.ndim == 2 else 1
        component = COMPONENT[array.dtype.char.replace("L", "I")]
        entry = {"bufferView": self.view(array.tobytes(), target), "componentType": component, "count": len(array), "type": _KIND[width]}
        if normalized:
            entry["normalized"] = True
        if bounds:
            entry |= {name: np.atleast_1d(bound.astype(float)).tolist() for name, bound in (("min", array.min(axis=0)), ("max", array.max(axis=0)))}
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def padded(self, array, *, bounds: bool = False) -> int:
        """The number of an accessor of vectors of three whole numbers, normalised, each row filled up to a multiple of four bytes."""
        rows = np.concatenate([array, np.zeros_like(array[:, :1])], axis=1)
        entry = {"bufferView": self.view(rows.tobytes(), VERTEX, rows.dtype.itemsize * 4), "componentType": COMPONENT[array.dtype.char], "normalized": True, "count": len(array), "type": "VEC3"}
        if bounds:
            entry |= {name: bound.tolist() for name, bound in (("min", array.min(axis=0)), ("max", array.max(axis=0)))}
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def view(self, data: bytes, target: int | None = None, stride: int | None = None) -> int:
        """The number of a buffer view that holds the bytes."""
        gap = -self.size % 4
        entry = {"buffer": 0, "byteOffset": self.size + gap, "byteLength": len(data)}
        self.views.append(entry | ({"target": target} if target else {}) | ({"byteStride": stride} if stride else {}))
        self.chunks += [bytes(gap), data]
        self.size += gap + len(data)
        return len(self.views) - 1

    def texture(self, image, name: str, quality: int | None = None) -> int:
        """The number of a texture that shows the image; `quality` as in `encode`."""
        data, media = encode(image, quality)
        if data not in self.known:
            self.pictures.append(Picture(name, media, data))
            self.textures.append({"source": len(self.pictures) - 1, "sampler": 0, "name": name})
            self.known[data] = len(self.textures) - 1
        return self.known[data]

    def use(self, extension: str, *, required: bool = False) -> str:
        """The extension's name, which the document will list."""
        self.used.add(extension)
        if required:
            self.required.add(extension)
        return extension

    def content(self) -> dict:
        """All tables but the images and the buffer, which depend on how the document is packed."""
        sampler = {"magFilter": _LINEAR, "minFilter": _MIPMAP, "wrapS": _REPEAT, "wrapT": _REPEAT}
        tables = {
            "extensionsUsed": sorted(self.used),
            "extensionsRequired": sorted(self.required),
            "meshes": self.meshes,
            "skins": self.skins,
            "animations": self.animations,
            "materials": self.materials,
            "textures": self.textures,
            "samplers": [sampler] if self.textures else [],
            "accessors": self.accessors,
        }
        return {name: rows for name, rows in tables.items() if rows}


def unit32(vector) -> np.ndarray:
    """Unit vectors [row channel] that are still of unit length after rounding to 32 bits."""
    vector = np.ascontiguousarray(vector, "<f4")
    return vector / np.sqrt(np.einsum("ij,ij->i", vector, vector))[:, None]


def signed(share, bits: int) -> np.ndarray:
    """Numbers from -1 to 1 as normalised whole ones of so many bits."""
    most = 2 ** (bits - 1) - 1
    return np.round(np.clip(share, -1.0, 1.0) * most).astype(f"<i{bits // 8}")


def as_bytes(share) -> np.ndarray:
    """Shares, 0-1, as normalised bytes."""
    return np.round(np.clip(share, 0.0, 1.0) * 255.0).astype("u1")
