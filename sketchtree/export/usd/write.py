"""A tree as USD: `.usda` text, `.usd` and `.usdc` binary, `.usdz` one packed file.

Metres, y up. The default prim is the tree, kind `component`, with its parts, a scope `Materials` and, of several levels of detail, a variant set
`LOD`; what moves has time samples. Textures lie in a folder NAME_textures beside the file, or in the package. Seed and version stand in `customLayerData`; no
date, no path: the same asset gives the same bytes.
"""

import io
import json
import tempfile
import zipfile
from pathlib import Path

from sketchtree.asset import Asset, Level
from sketchtree.errors import ExportError
from sketchtree.export.capsules import capsules_as_json
from sketchtree.export.checks import check_asset
from sketchtree.export.files import check_program
from sketchtree.export.usd.names import prim_name
from sketchtree.geometry.instances import Instances
from sketchtree.version import __version__

_ALIGNED = 64  # bytes: where a package's files begin
_EPOCH = (1980, 1, 1, 0, 0, 0)


def usd_files(path: Path, asset: Asset) -> dict[Path, bytes]:
    """Every file of the asset, by its path. Raises `ExportError` without usd-core, and where a number is not finite."""
    check_program(path)
    check_asset(asset)
    suffix = path.suffix.lower()
    packed = suffix == ".usdz"
    stage, textures = _stage(asset, "textures" if packed else f"{path.stem}_textures")
    layer = _exported(stage.GetRootLayer(), ".usdc" if packed else suffix)
    if packed:
        return {path: _package({f"{path.stem}.usdc": layer} | textures)}
    return {path.parent / name: data for name, data in textures.items()} | {path: layer}


def _stage(asset: Asset, folder: str):
    """(the stage, its textures by their names)."""
    from pxr import Kind, Usd, UsdGeom, UsdSkel

    from sketchtree.export.usd.bones import define_bones
    from sketchtree.export.usd.materials import Materials
    from sketchtree.export.usd.tints import palettes

    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    root = f"/{prim_name(asset.name, set())}"
    top = (UsdSkel.Root if asset.armature is not None else UsdGeom.Xform).Define(stage, root).GetPrim()
    stage.SetDefaultPrim(top)
    Usd.ModelAPI(top).SetKind(Kind.Tokens.component)
    stage.GetRootLayer().customLayerData = {"creator": f"SketchTree {__version__}"} | _told(asset)
    materials = Materials(stage, f"{root}/Materials", folder, palettes(part for level in asset.levels for part in level.parts if part.triangle_count))
    skeleton = define_bones(stage, f"{root}/bones", asset.armature) if asset.armature is not None else None
    if len(asset.levels) == 1:
        named = _parts(stage, root, asset.levels[0], materials, skeleton)
    else:
        named = _variants(stage, top, root, asset, materials, skeleton)
    if asset.animation is not None and skeleton is not None:
        from sketchtree.export.usd.moving import define_animation

        define_animation(stage, skeleton, asset, named)
    box = UsdGeom.BBoxCache(Usd.TimeCode.Default(), UsdGeom.Imageable.GetOrderedPurposeTokens())
    model = UsdGeom.ModelAPI.Apply(top)
    model.SetExtentsHint(model.ComputeExtentsHint(box))
    return stage, materials.files


def _variants(stage, top, root: str, asset: Asset, materials, skeleton) -> dict[int, str]:
    """A variant a level; the finest is chosen. The paths of its parts."""
    named = []
    levels = top.GetVariantSets().AddVariantSet("LOD")
    for number, level in enumerate(asset.levels):
        levels.AddVariant(f"LOD{number}")
        levels.SetVariantSelection(f"LOD{number}")
        with levels.GetVariantEditContext():
            named.append(_parts(stage, root, level, materials, skeleton))
    levels.SetVariantSelection("LOD0")
    return named[0]


def _parts(stage, root: str, level: Level, materials, skeleton) -> dict[int, str]:
    """The path of each part that is drawn."""
    from sketchtree.export.usd.parts import define_mesh, define_places

    taken, named = {"Materials", "bones"}, {}
    for number, part in enumerate(level.parts):
        if not part.triangle_count:
            continue
        named[number] = path = f"{root}/{prim_name(part.name, taken)}"
        if isinstance(part, Instances):
            define_places(stage, path, part, materials)
        else:
            define_mesh(stage, path, part, materials, skeleton=skeleton)
    return named


def _told(asset: Asset) -> dict:
    """What the file is about, as USD's metadata can hold it."""
    from sketchtree.export.skeletons.packed import skeleton_extras

    told = {name: value for name, value in asset.about.items() if isinstance(value, (str, int, float, bool))}
    if len(asset.levels) > 1:
        told["lod_coverage"] = json.dumps([float(level.coverage) for level in asset.levels])
    if asset.skeleton is not None:
        told["skeleton"] = json.dumps(skeleton_extras(asset.skeleton), separators=(",", ":"))
    if asset.capsules is not None:
        told["capsules"] = json.dumps(capsules_as_json(asset.capsules), separators=(",", ":"))
    return told


def _exported(layer, suffix: str) -> bytes:
    """The layer's bytes; USD writes files only by their path."""
    try:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / f"layer{suffix}"
            if layer.Export(str(path)):
                return path.read_bytes()
    except Exception as error:  # pxr raises Tf.ErrorException where the disk is full
        raise _no_room() from error
    raise _no_room()


def _no_room() -> ExportError:
    where = tempfile.gettempdir()
    return ExportError(f"USD could not be written to the folder for temporary files, {where}.", remedy="Free some space there, or name another folder in TMPDIR.")


def _package(files: dict[str, bytes]) -> bytes:
    """A zip without compression in which every file begins at a multiple of 64 bytes (usdz specification)."""
    whole = io.BytesIO()
    with zipfile.ZipFile(whole, "w", zipfile.ZIP_STORED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, _EPOCH)
            begins = whole.tell() + 30 + len(name.encode()) + 4
            entry.extra = b"\x86\x19" + (-begins % _ALIGNED).to_bytes(2, "little") + bytes(-begins % _ALIGNED)
            archive.writestr(entry, data)
    return whole.getvalue()
