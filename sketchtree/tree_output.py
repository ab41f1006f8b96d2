"""A tree as whatever its file's name asks for: mesh, game pack, skeleton or project."""

from dataclasses import dataclass, field
from pathlib import Path

from sketchtree.asset import Asset
from sketchtree.errors import OptionError
from sketchtree.export.files import MESHES, PROJECTS, SKELETONS
from sketchtree.options import FileOptions
from sketchtree.version import __version__

SEEN = "seen"
"""What a file says of its leaves where they stand as they were seen in a point cloud."""

WHOLE = MESHES + SKELETONS + PROJECTS  # what a whole tree can be written as; a picture of it is for `view`


@dataclass(frozen=True)
class Made:
    """How a tree was made, for its file to tell."""

    seed: int
    options: dict = field(default_factory=dict)  # JSON, as used


def check_files(output: Path, files: FileOptions, instead: str = "") -> None:
    """Refuse, before any work, what the file can't hold; `instead` says how to ask for a GLB. Raises OptionError."""
    kind = output.suffix.lower()
    scene = kind in (".glb", ".gltf") or kind.startswith(".usd")
    if files.pack and kind != ".glb":
        raise OptionError(f"`--pack {files.pack}` writes GLB files, not `{kind}`.", remedy=instead or f"Name the output {output.stem}.glb.")
    if files.levels == "together" and not scene:
        raise OptionError(f"`{kind}` files hold one level of detail.", remedy="Write .glb, .gltf or .usd, or ask for `--levels apart`.")
    if files.leaves == "instanced" and not scene:
        raise OptionError(f"`{kind}` files can't hold instanced leaves.", remedy="Write .glb, .gltf or .usd, or leave `--leaves instanced` out.")
    if (files.is_coarser or files.levels != "one") and kind not in MESHES:
        raise OptionError(f"`{kind}` files hold no mesh, and so no level of detail.", remedy="Leave `--lod`, `--triangles` and `--levels` out, or write a mesh.")


def write_output(model, output: Path, made: Made, files: FileOptions | None = None, *, kept: tuple[Path, ...] = (), underlay=None) -> tuple[tuple, tuple[str, ...]]:
    """Write the tree (or forest) by the name of its file; returns (the meshes written, or the model's own; what a person should know).

    None of the files `kept` is overwritten. Raises ExportError; other kinds of file than MESHES, SKELETONS and PROJECTS are nobody's, and nothing is written."""
    kind = output.suffix.lower()
    if files is not None and files.pack:
        _write_pack(model, output, made, files)
    elif kind in MESHES:
        from sketchtree.export.write import write_asset

        asset = asset_of(model, made, files)
        warnings = write_asset(output, asset, separate=files is not None and files.levels == "apart", kept=kept)
        return tuple(part.merged() for part in asset.parts) if files is not None and files.is_coarser else model.meshes, warnings
    elif kind in SKELETONS:
        write_skeleton_of(output, model.skeleton, made)
    elif kind in PROJECTS:
        from sketchtree.export.skeletons.hdf5 import write_project

        write_project(output, model, seed=made.seed, options=made.options, underlay=underlay)
    return model.meshes, ()


def write_skeleton_of(path: Path, tree, made: Made, *, units: str = "metres", frame: str = "world") -> None:
    """A skeleton, with what its file should tell of it."""
    from sketchtree.export.write import write_skeleton

    write_skeleton(path, tree, header={"units": units, "frame": frame, "version": __version__, "seed": made.seed})


def asset_of(model, made: Made, files: FileOptions | None = None) -> Asset:
    """What a mesh file holds of the tree (or of a forest): its levels, the skeleton, and what it was made with."""
    if files is None:
        return Asset.of(model.meshes, skeleton=model.skeleton, about=about_of(model, made))
    from sketchtree.tree_asset import forest_asset, tree_asset

    return (forest_asset if hasattr(model, "trees") else tree_asset)(model, files, about=about_of(model, made))


def about_of(model, made: Made) -> dict:
    """What a file of ours tells of its tree."""
    dress = getattr(model, "dress", None)
    of_tree = {} if dress is None else {"template": _template_of(model)} | worn_in_words(dress) | ({"leaves": SEEN} if getattr(model, "leaves_seen", False) else {})
    return {"program": "SketchTree", "version": __version__, "seed": made.seed, "units": "metres", "up": "y"} | of_tree


def _template_of(model) -> str | None:
    """By which a tree grew: its drawing's, or that which a tree without a drawing names."""
    if hasattr(model, "drawn"):
        return model.drawn.exemplar.name if model.drawn.exemplar else None
    return model.template


def worn_in_words(dress) -> dict:
    """The tree's looks, by the names of the options that ask for them: a tree that `grow` makes of the file wears the same."""
    return {"leaf": dress.leaf or "none", "bark": dress.bark, "season": dress.season}


def _write_pack(model, output: Path, made: Made, files: FileOptions) -> None:
    from sketchtree.levels.make import make_levels
    from sketchtree.rig.pack import game_pack, write_pack

    levels = make_levels(model, pixel_error=files.pixel_error)
    far = levels[-1].parts[0] if levels[-1].parts and levels[-1].parts[0].name == "impostor" else None
    write_pack(output.parent, game_pack(model, levels if far is None else levels[:-1], far, name=output.stem, about=about_of(model, made)))
