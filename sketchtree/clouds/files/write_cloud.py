"""A cloud → a PLY file that any program opens: binary, little-endian, metres, y up. The file appears whole or not at all."""

import os
from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np
from jaxtyping import Float

from sketchtree.clouds.cloud import PointCloud
from sketchtree.errors import ExportError
from sketchtree.export.files import check_extension, write_whole


def write_cloud(cloud: PointCloud, path: str | os.PathLike, comments: Sequence[str] = (), numbers: Mapping[str, Float[np.ndarray, " point"]] = MappingProxyType({})) -> None:
    """Write a cloud; `read_cloud` gives it back, its numbers rounded to 32 bits and its colours to 8. `numbers`: more of every point, by the property's name; they aren't read back.
    Raises ExportError for another extension or a place that can't be written."""
    check_extension(path, (".ply",))
    write_whole(path, ply_bytes(cloud, comments, numbers))


def ply_bytes(cloud: PointCloud, comments: Sequence[str] = (), numbers: Mapping[str, Float[np.ndarray, " point"]] = MappingProxyType({})) -> bytes:
    """The file's bytes. Comments are lines of plain text."""
    if any(not line.isascii() or not line.isprintable() for line in comments):
        raise ExportError("A comment of the cloud is not one line of plain text.", remedy="Keep to letters and signs of ASCII.")
    fields = [("xyz", "<f4", 3, ("float x", "float y", "float z"))]
    if cloud.normal is not None:
        fields.append(("normal", "<f4", 3, ("float nx", "float ny", "float nz")))
    if cloud.colour is not None:
        fields.append(("colour", "u1", 3, ("uchar red", "uchar green", "uchar blue")))
    fields += [(name, "<f4", 1, (f"float {name}",)) for name in numbers]
    rows = np.empty(len(cloud), [(name, kind, size) if size > 1 else (name, kind) for name, kind, size, _ in fields])
    rows["xyz"] = cloud.xyz
    if cloud.normal is not None:
        rows["normal"] = cloud.normal
    if cloud.colour is not None:
        rows["colour"] = np.round(np.clip(cloud.colour, 0.0, 1.0) * 255.0)
    for name, value in numbers.items():
        rows[name] = value
    head = ["ply", "format binary_little_endian 1.0", "comment up: +y", "comment units: m", *(f"comment {line}" for line in comments), f"element vertex {len(cloud)}"]
    head += [f"property {name}" for _, _, _, names in fields for name in names] + ["end_header", ""]
    return "\n".join(head).encode() + rows.tobytes()
