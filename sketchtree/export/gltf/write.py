"""A tree as glTF 2.0: `.glb`, one binary file, or `.gltf`, JSON with its buffer and images beside it.

Metres, y up. The same asset gives the same bytes: there is no date and no path in the file.
"""

import json
import os
import struct
from collections.abc import Sequence
from pathlib import Path
from urllib.parse import quote

from sketchtree.asset import Asset
from sketchtree.export.files import check_extension, check_writable, write_set
from sketchtree.export.gltf.scene import scene_content
from sketchtree.export.gltf.tables import Tables
from sketchtree.export.images import ending
from sketchtree.geometry.mesh import Mesh
from sketchtree.version import __version__

GENERATOR = f"SketchTree {__version__}"


def write_gltf(path: str | os.PathLike, asset: Asset, *, collision: Sequence[str] = ()) -> None:
    """Write the asset as `.glb` or `.gltf`, all its files or none.

    Several levels of detail stand in one file (MSFT_lod). `collision` names
    a node for each capsule, where they are to be meshes too. Parts without triangles are left out.
    Raises `ExportError` where a number is not finite or a file can't be written.
    """
    check_extension(path, (".glb", ".gltf"))
    check_writable(path)
    write_set(gltf_files(Path(path), asset, collision=collision))


def write_glb(path: str | os.PathLike, meshes: Sequence[Mesh], *, extras: dict | None = None) -> None:
    """Write the meshes as a GLB file, all or nothing. `extras` must be JSON; it stands on the scene."""
    check_extension(path, (".glb",))
    check_writable(path)
    write_set({Path(path): glb_bytes(meshes, extras=extras)})


def glb_bytes(meshes: Sequence[Mesh], *, extras: dict | None = None) -> bytes:
    """The file of `write_glb` as bytes."""
    return asset_bytes(Asset.of(meshes), extras=extras)


def asset_bytes(asset: Asset, *, collision: Sequence[str] = (), extras: dict | None = None, compact: bool = False) -> bytes:
    """The asset as the bytes of a GLB. `extras` are further JSON on the scene; `compact`: vertices in small numbers (`vertices`)."""
    content, tables = _document(asset, collision, extras, compact)
    images = [{"name": picture.name, "mimeType": picture.media, "bufferView": tables.view(picture.data)} for picture in tables.pictures]
    content |= {"images": images} if images else {}
    return _packed(_whole(content, tables), tables)


def gltf_files(path: Path, asset: Asset, *, collision: Sequence[str] = (), compact: bool = False) -> dict[Path, bytes]:
    """Every file that `write_gltf` writes, by its path; `compact` as in `asset_bytes`."""
    if path.suffix.lower() == ".glb":
        return {path: asset_bytes(asset, collision=collision, compact=compact)}
    return _loose(path, asset, collision, compact)


def _loose(path: Path, asset: Asset, collision: Sequence[str], compact: bool) -> dict[Path, bytes]:
    """The JSON, its buffer and its images, named after it."""
    content, tables = _document(asset, collision, None, compact)
    beside, images = {}, []
    for picture in tables.pictures:
        name = f"{path.stem}_{picture.name}{ending(picture.media)}"
        images.append({"name": picture.name, "uri": quote(name)})
        beside[path.with_name(name)] = picture.data
    content |= {"images": images} if images else {}
    content = _whole(content, tables)
    if tables.size:
        content["buffers"][0]["uri"] = quote(f"{path.stem}.bin")
        beside[path.with_suffix(".bin")] = b"".join(tables.chunks)
    return beside | {path: _text(content)}


def _document(asset: Asset, collision: Sequence[str], extras: dict | None, compact: bool = False) -> tuple[dict, Tables]:
    tables = Tables(compact=compact)
    scene = scene_content(tables, asset, collision=collision, extras=extras)
    return {"asset": {"version": "2.0", "generator": GENERATOR}} | scene | tables.content(), tables


def _whole(content: dict, tables: Tables) -> dict:
    if not tables.size:
        return content
    return content | {"bufferViews": tables.views, "buffers": [{"byteLength": tables.size}]}


def _text(content: dict) -> bytes:
    return json.dumps(content, separators=(",", ":"), ensure_ascii=False, allow_nan=False).encode()


def _packed(content: dict, tables: Tables) -> bytes:
    text = _text(content)
    text += b" " * (-len(text) % 4)
    parts = [struct.pack("<I4s", len(text), b"JSON"), text]
    if tables.size:
        gap = -tables.size % 4
        parts += [struct.pack("<I4s", tables.size + gap, b"BIN\0"), *tables.chunks, bytes(gap)]
    return b"".join([struct.pack("<4sII", b"glTF", 2, 12 + sum(map(len, parts))), *parts])
