"""Which writer takes this file? By its extension; every file of a set is written, or none."""

import os
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from sketchtree.asset import Asset, Level
from sketchtree.errors import ExportError
from sketchtree.export.files import MESHES, SKELETONS, check_extension, check_program, check_writable, write_set
from sketchtree.skeleton import TreeSkeleton


def write_asset(
    path: str | os.PathLike, asset: Asset, *, separate: bool = False, collision: Sequence[str] = (), kept: Collection[Path] = (), compact: bool = False
) -> tuple[str, ...]:
    """Write the asset as the extension says; returns what a person should know about what the format could not hold.

    Of several levels of detail OBJ, PLY, STL and 3MF hold the finest, glTF and USD all; if `separate`, each level is in a file of its own.
    `collision` names a node for each capsule in glTF, where they are to be meshes; `compact`: glTF's vertices are small numbers. Raises `ExportError`, also
    where a file of the set, a texture perhaps, would overwrite one of `kept`: what the tree was made of.
    """
    check_extension(path, MESHES)
    check_program(path)
    path = Path(path)
    check_writable(path)
    files = asset_files(path, asset, separate=separate, collision=collision, compact=compact)
    held = {Path(one).resolve() for one in kept}
    for file in files:
        if file.resolve() in held:
            raise ExportError(f"{path} comes with {file.name}, which would overwrite what the tree is made of.", remedy="Give the output another name.")
    write_set(files)
    scene = path.suffix.lower() in (".glb", ".gltf") or path.suffix.lower().startswith(".usd")
    return () if scene or separate else _left_out(path, asset)


def asset_files(path: Path, asset: Asset, *, separate: bool = False, collision: Sequence[str] = (), compact: bool = False) -> dict[Path, bytes]:
    """Every file that `write_asset` writes, by its path. If `separate`, several levels become NAME_LOD0, NAME_LOD1 …, an impostor NAME_impostor."""
    if separate and len(asset.levels) > 1:
        files: dict[Path, bytes] = {}
        for number, level in enumerate(asset.levels):
            one = replace(asset, levels=(level,)) if number == 0 else Asset((level,), name=asset.name, armature=asset.armature, about=asset.about)
            files |= asset_files(_of_level(path, number, level), one, collision=collision, compact=compact)
        return files
    suffix = path.suffix.lower()
    if suffix in (".glb", ".gltf"):
        from sketchtree.export.gltf.write import gltf_files

        return gltf_files(path, asset, collision=collision, compact=compact)
    if suffix.startswith(".usd"):
        from sketchtree.export.usd.write import usd_files

        return usd_files(path, asset)
    from sketchtree.export.meshes import mesh_files

    return mesh_files(path, [part.merged() for part in asset.parts])


def level_path(path: Path, number: int) -> Path:
    """Where a level of a set stands: NAME_LOD1.glb."""
    return path.with_name(f"{path.stem}_LOD{number}{path.suffix}")


def impostor_path(path: Path) -> Path:
    """Where the impostor of a set stands: NAME_impostor.glb."""
    return path.with_name(f"{path.stem}_impostor{path.suffix}")


def _of_level(path: Path, number: int, level: Level) -> Path:
    return impostor_path(path) if [part.name for part in level.parts] == ["impostor"] else level_path(path, number)


def write_skeleton(path: str | os.PathLike, tree: TreeSkeleton, *, header: Mapping[str, object]) -> None:
    """Write the skeleton as the extension says. `header` (units, frame, version, seed) is told where the format has a place for it. Raises `ExportError`."""
    suffix = check_extension(path, SKELETONS)
    if suffix == ".h5":
        from sketchtree.export.skeletons.hdf5 import write_hdf5

        return write_hdf5(path, tree, header=header)
    from sketchtree.export.skeletons.columns import write_skeleton_json
    from sketchtree.export.skeletons.mtg import write_mtg
    from sketchtree.export.skeletons.swc import write_swc

    {".swc": write_swc, ".mtg": write_mtg, ".json": write_skeleton_json}[suffix](path, tree, header=dict(header))


def _left_out(path: Path, asset: Asset) -> tuple[str, ...]:
    """Warnings: what a file without a scene can't hold."""
    said = []
    suffix = path.suffix.lower()
    if len(asset.levels) > 1:
        said.append(f"{path} holds the finest of {len(asset.levels)} levels of detail; `{suffix}` has no place for more.")
    if asset.armature is not None or asset.capsules is not None:
        said.append(f"{path} holds no bones and nothing to collide with; `{suffix}` has no place for them.")
    if asset.animation is not None:
        said.append(f"{path} does not move; `{suffix}` has no place for an animation, so it shows the tree at rest.")
    leaves = sum(part.triangle_count for part in asset.parts if part.name.startswith("leaf"))
    if suffix == ".3mf" and leaves:
        said.append(f"{path} holds the wood alone: leaves are sheets without thickness, which can't be printed.")
    return tuple(said)
