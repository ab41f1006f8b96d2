"""What does a game need of a tree, and in which files?

`NAME.glb` is the finest level of detail, `NAME_LOD1.glb` … the coarser ones, all with wind, pivots and bones; `NAME_impostor.glb` stands
for the tree from afar; `NAME_collision.glb` has a closed mesh for each capsule, named as Unreal and Godot know them;
`NAME_PivotPos_Index.exr` and `NAME_XVector_Extent.png` are Pivot Painter 2's textures; `NAME.skeleton.json` is the tree's skeleton, `NAME.pack.json`
says what is what (`manifest.py`). All of them are written, or none.
"""

import dataclasses
import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from sketchtree.asset import Asset, Level
from sketchtree.errors import ExportError
from sketchtree.foliage.leaves import Leaves
from sketchtree.geometry.instances import Instances
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.rig.capsules import capsules
from sketchtree.rig.exr import exr_bytes
from sketchtree.rig.manifest import manifest
from sketchtree.rig.pivots import axis_texture, position_texture
from sketchtree.rig.rigging import Rigging
from sketchtree.rig.textures import even_material
from sketchtree.skeleton import TreeSkeleton


class Model(Protocol):
    """What is packed: `pipeline.TreeModel` is one."""

    skeleton: TreeSkeleton
    leaves: Leaves
    blossom: Leaves | None


@dataclass(frozen=True, eq=False)
class Pack:
    """A tree made ready for games."""

    asset: Asset  # every level with all columns, armature, capsules; its name is that of the files
    impostor: Mesh | None
    rigging: Rigging
    content: dict  # the manifest

    @property
    def name(self) -> str:
        """What all file names begin with."""
        return self.asset.name


def game_pack(model: Model, levels: Sequence[Level], impostor: Mesh | None = None, *, name: str = "tree", about: dict | None = None) -> Pack:
    """The pack of a tree with its levels of detail, finest first. Instances are merged: most engines don't know them.

    `about` is JSON (seed, version, template, options …). Raises `ExportError` for a tree without wood.
    """
    wood = [part for level in levels[:1] for part in level.parts if not part.name.startswith("leaf")]
    if model.skeleton.segment_count == 0 or not any(part.triangle_count for part in wood):
        raise ExportError("There is no wood to make a game pack of.", remedy="Draw a stem.")
    rigging = Rigging.of(model.skeleton)
    rigged = tuple(Level(tuple(_rigged(rigging, model, part) for part in level.parts if part.triangle_count), level.coverage) for level in levels)
    fitted = capsules(rigging.lines, rigging.limbs, rigging.bones)
    asset = Asset(rigged, model.skeleton, name, rigging.bones.armature, fitted.capsules, about=about or {})
    far = None if impostor is None else rigging.impostor(dataclasses.replace(impostor, material=even_material(impostor.material)))
    roles = pack_roles(name, len(rigged), far is not None)
    return Pack(asset, far, rigging, manifest(asset, rigging, fitted, roles, None if far is None else far.triangle_count))


def write_pack(folder: str | os.PathLike, pack: Pack) -> tuple[Path, ...]:
    """Write every file of the pack into the folder, all or none; returns their paths. Raises `ExportError`."""
    from sketchtree.export.files import write_set

    files = {Path(folder) / name: data for name, data in pack_files(pack).items()}
    write_set(files)
    return tuple(files)


def pack_files(pack: Pack) -> dict[str, bytes]:
    """The bytes of every file, by name; the manifest is the last."""
    from sketchtree.export.gltf.write import asset_bytes
    from sketchtree.export.images import encode

    asset, name = pack.asset, pack.name
    made = []
    for number, level in enumerate(asset.levels):
        whole = number == 0
        made.append(asset_bytes(Asset((level,), asset.skeleton if whole else None, name, asset.armature, asset.capsules if whole else None, about=asset.about)))
    if pack.impostor is not None:
        made.append(asset_bytes(Asset.of([pack.impostor], name=name, about=asset.about)))
    made.append(_collision_bytes(pack))
    made.append(exr_bytes(position_texture(pack.rigging.pivots)))
    made.append(encode(axis_texture(pack.rigging.pivots))[0])
    made.append(_skeleton_bytes(asset.skeleton))
    made.append(json.dumps(pack.content, indent=1, ensure_ascii=False, allow_nan=False).encode() + b"\n")
    return dict(zip(pack_roles(name, len(asset.levels), pack.impostor is not None), made, strict=True))


def pack_roles(name: str, levels: int, impostor: bool) -> dict[str, str]:
    """The file names of a pack and what each is for, in the order in which they are written."""
    roles = {f"{name}.glb" if k == 0 else f"{name}_LOD{k}.glb": f"level {k}" for k in range(levels)}
    return roles | ({f"{name}_impostor.glb": "impostor"} if impostor else {}) | {
        f"{name}_collision.glb": "collision",
        f"{name}_PivotPos_Index.exr": "pivots: position and parent",
        f"{name}_XVector_Extent.png": "pivots: axis and extent",
        f"{name}.skeleton.json": "skeleton",
        f"{name}.pack.json": "manifest",
    }


def _rigged(rigging: Rigging, model: Model, part: Mesh | Instances) -> Mesh:
    mesh = part.merged()
    mesh = dataclasses.replace(mesh, material=even_material(mesh.material))
    blossom = getattr(model, "blossom", None)
    leaves = blossom if blossom is not None and "blossom" in mesh.name else model.leaves
    return rigging.leaves(mesh, leaves) if mesh.name.startswith("leaf") and len(leaves) else rigging.wood(mesh)


def _collision_bytes(pack: Pack) -> bytes:
    """The coarsest wood, which Unreal needs to know whose capsules they are and Godot is told to leave out, and the capsules."""
    from sketchtree.export.gltf.write import asset_bytes

    wood = next(part for level in reversed(pack.asset.levels) for part in level.parts if not part.name.startswith("leaf"))
    bare = dataclasses.replace(wood, name=f"{pack.name}-noimp", material=Material("wood"), extra={}, color=None)
    names = [f"UCP_{pack.name}-noimp_{k:02d}-convcolonly" for k in range(len(pack.asset.capsules))]
    return asset_bytes(Asset.of([bare], name=f"{pack.name}_collision", capsules=pack.asset.capsules), collision=names)


def _skeleton_bytes(tree: TreeSkeleton) -> bytes:
    from sketchtree.export.skeletons.columns import skeleton_json

    return skeleton_json(tree)
