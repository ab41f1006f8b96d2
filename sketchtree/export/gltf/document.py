"""A glTF file as it lies on disk: its JSON, and the bytes that the JSON points at."""

import base64
import json
import os
import struct
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote

import numpy as np

from sketchtree.errors import ExportError
from sketchtree.export.images import decode

_COMPONENT = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def read_glb_json(path: str | os.PathLike) -> dict:
    """The JSON part of a glTF file. Raises `ExportError` where it is none."""
    try:
        with open(path, "rb") as file:
            head = file.read(20)
            if len(head) == 20 and head[:4] == b"glTF" and head[16:20] == b"JSON":
                return json.loads(file.read(struct.unpack("<I", head[12:16])[0]))
            if Path(path).suffix.lower() == ".gltf":
                return json.loads(head + file.read())
    except OSError as error:
        raise ExportError(f"{path} can't be read: {(error.strerror or 'unknown error').lower()}.", remedy="Check the path.") from error
    except ValueError as error:
        raise ExportError(f"{path} is damaged: its JSON can't be read.", remedy="Write it again.") from error
    raise ExportError(f"{path} is not a GLB file.", remedy="Give a file that ends in .glb.")


@dataclass
class Document:
    """The JSON `content` and where its bytes are. Raises KeyError, IndexError, ValueError or TypeError for what is no glTF."""

    content: dict
    binary: bytes  # of a GLB; empty for loose files
    folder: Path  # of the file
    pixels: dict  # images that were decoded, by number and mode

    @classmethod
    def read(cls, path: Path) -> "Document":
        data = path.read_bytes()
        if data[:4] != b"glTF":
            if path.suffix.lower() != ".gltf":
                raise ValueError("no glTF header")
            return cls(json.loads(data), b"", path.parent, {})
        whole, length = struct.unpack_from("<II", data, 8)
        if len(data) < whole:
            raise ExportError(f"{path} is cut short: it has {len(data):,} bytes of {whole:,}.", remedy="Write it again, or copy it again.")
        rest = 20 + length
        size = struct.unpack_from("<I", data, rest)[0] if rest < len(data) else 0
        return cls(json.loads(data[20:rest]), data[rest + 8 : rest + 8 + size], path.parent, {})

    def column(self, number: int) -> np.ndarray:
        """An accessor's rows, [row channel]; normalised ones as shares."""
        accessor = self.content["accessors"][number]
        view = self.content["bufferViews"][accessor["bufferView"]]
        kind, width = np.dtype(_COMPONENT[accessor["componentType"]]), _WIDTH[accessor["type"]]
        stride = view.get("byteStride", kind.itemsize * width)
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        rows = np.ndarray((accessor["count"], width), kind, self._buffer(view["buffer"]), start, (stride, kind.itemsize))
        return np.maximum(rows / float(np.iinfo(kind).max), -1.0) if accessor.get("normalized") else rows.copy()

    def image(self, texture: dict | None, mode: str) -> np.ndarray | None:
        """The pixels that a texture reference names, in PIL's `mode`."""
        if texture is None:
            return None
        number = self.content["textures"][texture["index"]]["source"]
        if (number, mode) not in self.pixels:
            self.pixels[number, mode] = decode(self._picture(self.content["images"][number]), mode)
        return self.pixels[number, mode]

    def _picture(self, image: dict) -> bytes:
        if "uri" in image:
            return self._fetched(image["uri"])
        view = self.content["bufferViews"][image["bufferView"]]
        start = view.get("byteOffset", 0)
        return self._buffer(view["buffer"])[start : start + view["byteLength"]]

    def _buffer(self, number: int) -> bytes:
        uri = self.content["buffers"][number].get("uri")
        if uri is None:
            return self.binary
        if ("buffer", number) not in self.pixels:
            self.pixels["buffer", number] = self._fetched(uri)
        return self.pixels["buffer", number]

    def _fetched(self, uri: str) -> bytes:
        if uri.startswith("data:"):
            return base64.b64decode(uri.partition(",")[2])
        return (self.folder / unquote(uri)).read_bytes()
