"""What is in this file? Meshes, a skeleton, or both, told by its extension."""

import os
from dataclasses import dataclass
from pathlib import Path

from sketchtree.asset import Asset
from sketchtree.errors import ExportError
from sketchtree.export.files import PROJECTS, SKELETONS, check_program
from sketchtree.skeleton import TreeSkeleton

READABLE = (".glb", ".gltf", ".usd", ".usda", ".usdc", ".usdz", ".obj", ".ply", ".stl", *SKELETONS, *PROJECTS)


@dataclass(frozen=True, eq=False)
class Contents:
    """What a file holds."""

    asset: Asset | None  # None: no mesh
    skeleton: TreeSkeleton | None
    header: dict  # units, frame, seed … as far as the file says


def read_contents(path: str | os.PathLike) -> Contents:
    """The file's meshes and skeleton. Raises `ExportError` for another extension or what can't be read, `SkeletonError` for a skeleton at fault."""
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix in SKELETONS + PROJECTS:
        from sketchtree.skeleton_files import read_skeleton

        return Contents(None, read_skeleton(path), _header(path))
    if suffix not in READABLE:
        said = f"`{suffix}` files are not converted" if suffix else "it has no extension to tell the format"
        raise ExportError(f"Can't read {path}: {said}.", remedy=f"Give a file that ends in one of {', '.join(READABLE)}.")
    asset = _meshes(path, suffix)
    metres = {"units": "metres", "frame": "world"} | ({"seed": asset.about["seed"]} if "seed" in asset.about else {})
    return Contents(asset, asset.skeleton, metres)


def _meshes(path: Path, suffix: str) -> Asset:
    if suffix in (".glb", ".gltf"):
        from sketchtree.export.gltf.read import read_asset

        return read_asset(path)
    if suffix.startswith(".usd"):
        check_program(path, "read")
        if not path.is_file():
            raise ExportError(f"{path} can't be read: no such file or directory.", remedy="Check the path.")
        from sketchtree.export.usd.read import read_usd

        return read_usd(path)
    from sketchtree.export.meshes.read import read_meshes

    return read_meshes(path)


def _header(path: Path) -> dict:
    """Units, frame and seed that a text file of ours names in its comments; those of our HDF5 files."""
    if path.suffix.lower() in (".h5", ".sketchtree"):
        from sketchtree.skeleton_hdf5 import read_header

        return read_header(path)
    if path.suffix.lower() == ".json":
        return _json_header(path)
    found = {}
    with open(path, encoding="utf-8", errors="replace") as file:
        for line in file:
            if not line.startswith("#"):
                break
            name, colon, value = line[1:].partition(":")
            if colon and name.strip() in ("units", "frame", "seed"):
                found[name.strip()] = value.strip()
    return found


def _json_header(path: Path) -> dict:
    import json

    with open(path, encoding="utf-8") as file:
        header = json.load(file).get("header", {})
    return {name: header[name] for name in ("units", "frame", "seed") if name in header} if isinstance(header, dict) else {}
