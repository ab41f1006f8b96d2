"""What does `sketchtree grow` read, and what does it write? Checked before the work, written after it."""

import dataclasses
import json
from collections.abc import Iterator, Mapping
from pathlib import Path

import click
from click.core import ParameterSource

from sketchtree.errors import ExportError, OptionError, SketchError
from sketchtree.export.files import MESHES, PROJECTS, SKELETONS

ANIMATED = (".glb", ".gltf", ".usd", ".usda", ".usdc", ".usdz")
PICTURES = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".webp", ".bmp", ".gif", ".heic", ".avif")
ROWS = (".swc", ".mtg", ".h5", ".npz", ".csv", ".txt")
MOVIE_FRAMES, SERIES_FRAMES = 72, 24
_OF_PICTURE = ("scribbles", "use_matte", "matting", "edit_matte", "vertices", "gap", "root", "lift", "matte", "trunk")
_OF_DRAWING = ("theta", "method", "planar", "crown", "max_strokes", "generations", "fill", "density", "light", "obstacle", "sag", "shed", "shed_twigs", "untangle")
_OF_FILE = ("max_mb", "max_megapixels")
_UNUSED = {"picture": _OF_DRAWING, "drawing": _OF_PICTURE, "skeleton": (*_OF_PICTURE, *_OF_DRAWING, *_OF_FILE)}
_IS = {"picture": "is a picture with a tree in it", "drawing": "is a drawing", "skeleton": "holds a tree already"}


def given(context: click.Context) -> set[str]:
    """The options that the user named."""
    return {name for name in context.params if context.get_parameter_source(name) is not ParameterSource.DEFAULT}


def kind_of(source: Path, wanted: dict) -> str:
    """picture, drawing or skeleton: by the extension, of JSON by what it says. Raises SketchError, ExportError."""
    suffix = source.suffix.lower()
    if suffix in PICTURES:
        return "picture"
    if suffix in (*ROWS, *PROJECTS, *ANIMATED):
        return "skeleton"
    if suffix in MESHES:
        raise ExportError(f"{source} holds a mesh without a skeleton, and only a skeleton grows.", remedy="Give the .glb, .usd, .swc or .sketchtree that the tree was written as.")
    return "skeleton" if suffix == ".json" and _holds_skeleton(source) else "drawing"


def _holds_skeleton(path: Path) -> bool:
    try:
        said = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError):
        return False
    return isinstance(said, dict) and "sketchtree_skeleton" in said


def check_options(kind: str, source: Path, output: Path, wanted: dict, said: set[str]) -> None:
    """Refuse what does nothing, and what is out of range. Raises OptionError, SketchError."""
    idle = next((name for name in _UNUSED[kind] if name in said), None)
    if idle is not None:
        raise OptionError(f"`--{idle.replace('_', '-')}` does nothing here: {source.name} {_IS[kind]}.", remedy="Leave it out, or give another input.")
    if kind == "picture":
        _check_marks(source, wanted)
    _range("variations", wanted["variations"], 1, 64)
    _range("frames", wanted["frames"], 2, 720)
    _range("seconds", wanted["seconds"], 0.1, 600)
    _range("time", wanted["moment"], 0, 1)
    moves = output.suffix.lower() in ANIMATED and wanted["moment"] is None
    if "frames" in said and wanted["movie"] is None and wanted["series"] is None:
        raise OptionError("`--frames` counts the pictures of a film or the trees of a series, and none is asked for.", remedy="Add `--movie FILE` or `--series FOLDER`, or leave it out.")
    if "seconds" in said and not moves and wanted["movie"] is None:
        raise OptionError("`--seconds` says how long the tree grows, and nothing that is asked for moves.", remedy="Write .glb, .gltf or .usd without `--time`, add `--movie FILE`, or leave it out.")
    if kind == "skeleton" and wanted["variations"] > 1 and not wanted["levels"]:
        raise OptionError(f"`--variations {wanted['variations']}` differ in what is grafted on, and nothing is.", remedy="Add `--levels 2`, say.")
    if kind == "picture" and wanted["variations"] > 1 and wanted["levels"] == 0:
        raise OptionError(f"`--variations {wanted['variations']}` differ in what is grafted on, and `--levels 0` grafts nothing.", remedy="Give 1 to 5 levels.")


def _check_marks(source: Path, wanted: dict) -> None:
    """Scribbles, a matte, or the picture's own alpha, which is seen when it is read."""
    if wanted["scribbles"] is not None and wanted["use_matte"] is not None:
        raise OptionError("`--scribbles` and `--use-matte` both say what is tree.", remedy="Leave one of the two out.")


def _range(name: str, value, low, high) -> None:
    if value is not None and not low <= value <= high:
        raise OptionError(f"`--{name} {value:g}` is out of range.", remedy=f"Give {low:g} to {high:g}.")


def inputs(source: Path, wanted: dict) -> tuple[Path, ...]:
    """The files that are read, and so never written."""
    return tuple(path for path in (source, *(wanted[name] for name in ("scribbles", "use_matte", "edit_matte", "vertices"))) if path is not None)


def check_outputs(source: Path, output: Path, report: Path | None, wanted: dict) -> None:
    """Refuse, before any work, an output that can't be written. Raises ExportError."""
    from sketchtree.commands import writing
    from sketchtree.export.files import check_extension
    from sketchtree.view.turntable import FILMS, check_film

    suffix = output.suffix.lower()
    if suffix in PROJECTS:
        raise ExportError(f"Can't write {output}: a project keeps a drawing, not its growth.", remedy="Write .glb; or `build` the project, and give it to `grow`.")
    if suffix in FILMS:
        raise ExportError(f"Can't write {output} by `-o`, which writes trees.", remedy=f"Give `--movie {output.name}` and an output such as {output.stem}.glb.")
    check_extension(output, writing.WHOLE)
    for option, path, kinds in (("--matte", wanted["matte"], (".png",)), ("--trunk", wanted["trunk"], SKELETONS)):
        if path is not None and path.suffix.lower() not in kinds:
            raise ExportError(f"`{option} {path}` is no {' '.join(kinds)} file.", remedy=f"Name it {path.with_suffix(kinds[0]).name}.")
    for crown in range(wanted["variations"]):
        one = of_crown(crown, output, wanted)
        more = {"--matte": wanted["matte"], "--trunk": wanted["trunk"], "--movie": one["movie"]}
        writing.check_outputs(inputs(source, wanted), one["output"], report, one["skeleton"], one["preview"], more=more, kinds=writing.WHOLE)
        if one["movie"] is not None:
            check_film(one["movie"])
    if wanted["series"] is not None:
        _check_series(output, wanted)


def of_crown(crown: int, output: Path, wanted: dict) -> dict:
    """The outputs of one of several crowns: their names numbered from 1."""
    paths = {"output": output} | {name: wanted[name] for name in ("skeleton", "preview", "movie")}
    if wanted["variations"] == 1:
        return paths
    return {name: None if path is None else path.with_name(f"{path.stem}_{crown + 1}{path.suffix}") for name, path in paths.items()}


def series_files(output: Path, wanted: dict, stem: str) -> list[Path]:
    """The files of a series, in order."""
    return [wanted["series"] / f"{stem}_{k:04d}.glb" for k in range(wanted["frames"] or SERIES_FRAMES)]


def _check_series(output: Path, wanted: dict) -> None:
    folder = wanted["series"]
    if folder.exists() and not folder.is_dir():
        raise ExportError(f"`--series {folder}` is a file, not a folder.", remedy="Name a folder; it is made if it is missing.")
    if not folder.parent.is_dir():
        raise ExportError(f"Can't write {folder}: the folder {folder.parent} does not exist.", remedy="Create it, or choose another path.")
    for crown in range(wanted["variations"]):
        stem = of_crown(crown, output, wanted)["output"].stem
        ours = {path.name for path in series_files(output, wanted, stem)}
        others = sorted(path.name for path in folder.glob(f"{_literal(stem)}_[0-9][0-9][0-9][0-9].glb") if path.name not in ours) if folder.exists() else []
        if others:
            raise ExportError(f"{folder} holds {others[0]} of a longer series, which would stand among the new one.", remedy="Choose another folder, or clear this one.")


def _literal(name: str) -> str:
    import glob

    return glob.escape(name)


def read(kind: str, source: Path, wanted: dict, templates, *, seed: int, seed_chosen: bool, reading, tree, trunk, watch):
    """(what the tree begins as, the seed in use). Raises SketchError, SkeletonError, ExportError, OptionError."""
    from sketchtree.growth_tree import of_drawing
    from sketchtree.keys import root_key

    if kind == "picture":
        return _of_picture(source, wanted, templates, key=root_key(seed), reading=reading, tree=tree, trunk=trunk, watch=watch), seed
    if kind == "drawing":
        return of_drawing(source, templates, key=root_key(seed), reading=reading, tree=tree, watch=watch), seed
    with watch("read"):
        return _of_skeleton(source, wanted, templates, seed=seed, seed_chosen=seed_chosen, reading=reading, tree=tree)


def _of_picture(source: Path, wanted: dict, templates, *, key, reading, tree, trunk, watch):
    from sketchtree.growth_tree import find_trunk, of_picture
    from sketchtree.matting.known_matte import read_matte
    from sketchtree.matting.scribbles import read_scribbles
    from sketchtree.photo.read_photo import read_photo
    from sketchtree.trunk.edits import VertexEdits, read_edits

    with watch("read"):
        photo = read_photo(source, max_mb=reading.max_mb, max_megapixels=reading.max_megapixels)
        scribbles = None if wanted["scribbles"] is None else read_scribbles(wanted["scribbles"], photo, max_mb=reading.max_mb)
        known = None if wanted["use_matte"] is None else read_matte(wanted["use_matte"], photo)
        if scribbles is None and known is None and photo.alpha is None:
            raise SketchError(
                f"{source.name} is a picture, and nothing says what of it is tree.",
                remedy="Give `--scribbles FILE` with lines on the tree and beside it, or `--use-matte A.png`. If it is a drawing: `sketchtree build` it, and give that tree to `grow`.",
            )
        edits = VertexEdits() if wanted["vertices"] is None else read_edits(wanted["vertices"])
    found = find_trunk(photo, scribbles, templates, key=key, wanted=trunk, reading=reading, edits=edits, painted=wanted["edit_matte"], known=known, watch=watch)
    return of_picture(found, tree, templates, key=key)


def _of_skeleton(source: Path, wanted: dict, templates, *, seed: int, seed_chosen: bool, reading, tree):
    """A tree that is there already, dressed as its file tells where the user does not."""
    from sketchtree.growth_tree import of_skeleton
    from sketchtree.keys import root_key

    skeleton, told, units = _skeleton(source)
    seed = seed if seed_chosen else int(told.get("seed", seed))
    template = reading.template if reading.template not in ("auto", "none") else told.get("template") if reading.template == "auto" else None
    if template and (templates is None or template not in templates.names):
        from sketchtree.errors import TemplateError

        raise TemplateError(f"There is no template called “{template}”.", remedy=f"Choose auto, none or one of: {', '.join(templates.names if templates else ())}.")
    asked = click.get_current_context().get_parameter_source("season") is not ParameterSource.DEFAULT
    own = {name: told[name] for name in ("leaf", "bark", "wood") if getattr(tree, name) is None and told.get(name) is not None}
    own |= {"season": told["season"]} if not asked and told.get("season") else {}
    own |= {"solid": True} if told.get("solid") and not tree.solid else {}
    begun = of_skeleton(skeleton, dataclasses.replace(tree, **own), templates, key=root_key(seed), template=template or None, height=reading.height)
    return dataclasses.replace(begun, warnings=(*units, *begun.warnings)), seed


def _skeleton(source: Path):
    """(the skeleton of a file, what it tells of the tree's looks, what a person should know). Raises SkeletonError, ExportError."""
    from sketchtree.export.read import read_contents
    from sketchtree.skeleton_files import read_skeleton

    suffix = source.suffix.lower()
    if suffix in (".npz", ".csv", ".txt"):
        return read_skeleton(source), {}, ()
    contents = read_contents(source)
    if contents.skeleton is None:
        raise ExportError(f"{source} holds no skeleton, and only a skeleton grows.", remedy="Give a file that `sketchtree` wrote, or a skeleton.")
    units = str(contents.header.get("units", "metres"))
    said = () if units in ("metres", "m") else (f"{source.name} is in {units}; they were taken for metres (`--height` scales it).",)
    if suffix in PROJECTS:
        from sketchtree.export.skeletons.hdf5 import read_choices

        return contents.skeleton, read_choices(source), said
    return contents.skeleton, {} if contents.asset is None else _looks(contents.asset), said


def _looks(asset) -> dict:
    """What a mesh file of ours tells: seed and template, leaf and bark by the names of its materials."""
    about, names = asset.about, [part.mesh.material.name if hasattr(part, "mesh") else part.material.name for part in asset.parts]
    found = {name: about[name] for name in ("seed", "template") if about.get(name) is not None}
    from sketchtree.foliage.models import leaf_names
    from sketchtree.geometry.bark import bark_names

    leaves = [name.removeprefix("leaf_") for name in names if name.startswith("leaf_")]
    leaf = next((model for model in sorted(leaf_names(), key=len, reverse=True) for name in leaves if name.startswith(model)), None)
    bark = next((model for model in sorted(bark_names(), key=len, reverse=True) for name in names if name.startswith(f"wood_{model}")), None)
    return found | {"leaf": leaf or "none"} | ({} if bark is None else {"bark": bark})


def grow_all(begun, growth, tree, output: Path, run, wanted: dict, *, kept: tuple[Path, ...]) -> dict:
    """Grow every crown and write it; returns the report. Each crown is grown, written and forgotten."""
    from sketchtree.commands import writing
    from sketchtree.growth_report import growth_report, of_crown as told_of
    from sketchtree.growth_tree import grown_tree

    first, moving, crowns, warnings = None, None, [], ()
    for crown in range(wanted["variations"]):
        grown, paths = grown_tree(begun, growth, tree, crown=crown, watch=run.watch), of_crown(crown, output, wanted)
        with run.watch("export"):
            asset, told = _write(grown, paths, run, wanted, kept)
        crowns.append(told_of(grown, paths["output"].name))
        warnings += (*told, *grown.warnings)
        first, moving = (grown, asset) if first is None else (first, moving)
    if begun.trunk is not None:
        with run.watch("export"):
            _write_trunk(begun.trunk, run, wanted)
    return growth_report(first, crowns, moving, **writing._of_run(run), warnings=warnings)


def _write(grown, paths: dict, run, wanted: dict, kept: tuple[Path, ...]):
    """(what was animated, if anything was; warnings): every file of one crown."""
    from sketchtree.tree_output import write_skeleton_of

    output, moment = paths["output"], wanted["moment"]
    moves = output.suffix.lower() in ANIMATED and moment is None
    growing = _growing(grown) if moves or paths["movie"] is not None or wanted["series"] is not None or (moment or 1.0) < 1 or moment == 0 or grown.plan.bend else None
    asset, told = None, ()
    if moves:
        from sketchtree.export.write import write_asset

        asset = growing.asset(seconds=wanted["seconds"], about=_about(grown, run))
        told = write_asset(output, asset, kept=kept)
    else:
        told = _write_still(grown, growing, 1.0 if moment is None else moment, output, run, kept)
        if moment is None:
            told += (f"{output.name} does not move: it is the tree grown up; `--time` says when otherwise.",)
    if paths["skeleton"] is not None:
        write_skeleton_of(paths["skeleton"], grown.plan.at(1.0 if moment is None else moment), run.made)
    if paths["preview"] is not None:
        told += _picture(_meshes(grown, growing, 1.0 if moment is None else moment), paths["preview"])
    if wanted["series"] is not None:
        _write_series(grown, growing, series_files(output, wanted, output.stem), run)
    if paths["movie"] is not None:
        from sketchtree.view.growth_film import growth_film

        drawn, reason = growth_film(growing, paths["movie"], frames=wanted["frames"] or MOVIE_FRAMES, seconds=wanted["seconds"])
        told += () if drawn else (f"{paths['movie']} was not drawn: {reason}",)
    return asset, told


def _growing(grown):
    from sketchtree.animation.growing import Growing

    return Growing.of(grown.model, grown.plan)


def _about(grown, run) -> dict:
    from sketchtree.version import __version__

    template = grown.beginning.template
    return {"program": "SketchTree", "version": __version__, "seed": run.seed, "units": "metres", "up": "y", "template": template}


def _meshes(grown, growing, moment: float) -> tuple:
    return tuple(grown.model.meshes) if moment == 1 and not grown.plan.bend else growing.at(moment)


def _write_still(grown, growing, moment: float, output: Path, run, kept: tuple[Path, ...]) -> tuple[str, ...]:
    """The tree at one time."""
    from sketchtree.export.write import write_asset
    from sketchtree.tree_output import write_skeleton_of

    suffix = output.suffix.lower()
    if suffix in SKELETONS:
        write_skeleton_of(output, grown.plan.at(moment), run.made)
        return ()
    if suffix not in MESHES:
        return _picture(_meshes(grown, growing, moment), output)
    return write_asset(output, _still(grown, growing, moment, run), kept=kept)


def _still(grown, growing, moment: float, run):
    from sketchtree.asset import Asset

    return Asset.of(_meshes(grown, growing, moment), skeleton=grown.plan.at(moment), about=_about(grown, run))


def _picture(meshes, path: Path) -> tuple[str, ...]:
    from sketchtree.view import preview

    drawn, reason = preview(meshes, path)
    return () if drawn else (f"{path} was not drawn: {reason}",)


class _Frames(Mapping):
    """Path → bytes, each made when it is asked for: a long series need not fit into memory."""

    def __init__(self, paths: list[Path], make):
        self._number, self._make = {path: k for k, path in enumerate(paths)}, make

    def __getitem__(self, path: Path) -> bytes:
        return self._make(path, self._number[path])

    def __iter__(self) -> Iterator[Path]:
        return iter(self._number)

    def __len__(self) -> int:
        return len(self._number)


def _write_series(grown, growing, paths: list[Path], run) -> None:
    """All of them, or none; the folder is made if it is missing."""
    from sketchtree.export.files import write_set
    from sketchtree.export.write import asset_files

    folder, last = paths[0].parent, len(paths) - 1

    def frame(path: Path, number: int) -> bytes:
        run.watch.on_part(number / last)
        return asset_files(path, _still(grown, growing, number / last, run))[path]

    made = not folder.exists()
    folder.mkdir(exist_ok=True)
    try:
        write_set(_Frames(paths, frame))
    except BaseException:
        if made:
            folder.rmdir()
        raise


def _write_trunk(trunk, run, wanted: dict) -> None:
    """The matte and the trunk in the picture's pixels."""
    import io

    import numpy as np
    from PIL import Image

    from sketchtree.export.files import write_whole
    from sketchtree.tree_output import write_skeleton_of

    if wanted["matte"] is not None:
        whole = io.BytesIO()
        Image.fromarray(np.round(255 * np.asarray(trunk.matte.alpha)).astype(np.uint8)).save(whole, "PNG")
        write_whole(wanted["matte"], whole.getvalue())
    if wanted["trunk"] is not None:
        write_skeleton_of(wanted["trunk"], trunk.in_pixels, run.made, units="pixels", frame="photo")
