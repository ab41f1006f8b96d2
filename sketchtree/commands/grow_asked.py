"""What is asked of `sketchtree grow`? Checked before the work: what it reads, options without effect, outputs that can't be written."""

import json
from pathlib import Path

import click
from click.core import ParameterSource

from sketchtree.animation.wanted import LEAST_JOINTS, LIMIT_JOINTS
from sketchtree.commands.series import check_series
from sketchtree.errors import ExportError, OptionError
from sketchtree.export.files import MESHES, PROJECTS, SKELETONS
from sketchtree.sketch.files.project import holds_scribbles, holds_traced

ANIMATED = (".glb", ".gltf", ".usd", ".usda", ".usdc", ".usdz")
PICTURES = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".webp", ".bmp", ".gif", ".heic", ".avif")
ROWS = (".swc", ".mtg", ".h5", ".npz", ".csv", ".txt")
_OF_PICTURE = ("scribbles", "use_matte", "matting", "edit_matte", "vertices", "gap", "root", "lift", "matte", "trunk")
_OF_DRAWING = ("theta", "method", "planar", "crown", "max_strokes", "generations", "fill", "density", "light", "obstacle", "sag", "shed", "shed_twigs", "untangle")
_OF_FILE = ("max_mb", "max_megapixels")
_UNUSED = {"traced": (*_OF_PICTURE, *_OF_DRAWING, *_OF_FILE), "scribbled": (*_OF_PICTURE[:-2], *_OF_DRAWING), "picture": _OF_DRAWING, "drawing": _OF_PICTURE, "skeleton": (*_OF_PICTURE, *_OF_DRAWING, *_OF_FILE)}
_IS = {"traced": "keeps points with a tree in them", "scribbled": "keeps a photo with what is scribbled on it", "picture": "is a picture with a tree in it", "drawing": "is a drawing", "skeleton": "holds a tree already"}


def given(context: click.Context) -> set[str]:
    """The options that the user named."""
    return {name for name in context.params if context.get_parameter_source(name) is not ParameterSource.DEFAULT}


def kind_of(source: Path, wanted: dict) -> str:
    """picture, drawing or skeleton: by the extension, of JSON by what it says; scribbled, traced: a project whose tree is taken from scribbles on its photo, or from points. Raises SketchError, ExportError."""
    suffix = source.suffix.lower()
    if suffix in PROJECTS and holds_scribbles(source):
        return "scribbled"
    if suffix in PROJECTS and holds_traced(source):
        return "traced"
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
    refuse_idle(kind, source, said)
    if kind == "picture":
        _check_marks(source, wanted)
    _range("variations", wanted["variations"], 1, 64)
    _range("frames", wanted["frames"], 2, 720)
    _range("seconds", wanted["seconds"], 0.1, 600)
    _range("joints", wanted["joints"], LEAST_JOINTS, LIMIT_JOINTS)
    _range("time", wanted["moment"], 0, 1)
    moves = output.suffix.lower() in ANIMATED and wanted["moment"] is None
    if "frames" in said and wanted["movie"] is None and wanted["series"] is None:
        raise OptionError("`--frames` counts the pictures of a film or the trees of a series, and none is asked for.", remedy="Add `--movie FILE` or `--series FOLDER`, or leave it out.")
    if "seconds" in said and not moves and wanted["movie"] is None:
        raise OptionError("`--seconds` says how long the tree grows, and nothing that is asked for moves.", remedy="Write .glb, .gltf or .usd without `--time`, add `--movie FILE`, or leave it out.")
    if "joints" in said and not moves and wanted["movie"] is None and wanted["series"] is None:
        raise OptionError("`--joints` says how finely the tree moves, and nothing that is asked for moves.", remedy="Write .glb, .gltf or .usd without `--time`, or leave it out.")
    if wanted["lod"] and output.suffix.lower() not in (*MESHES, ".png") and wanted["movie"] is None and wanted["series"] is None and wanted["preview"] is None:
        raise OptionError(f"`--lod {wanted['lod']}` says how fine the meshes are, and `{output.suffix.lower()}` files hold none.", remedy="Leave it out, or write a mesh.")
    if wanted["compact"] and output.suffix.lower() not in (".glb", ".gltf"):
        raise OptionError(f"`--compact` is for glTF, and `{output.suffix.lower()}` files have no such numbers.", remedy="Leave it out, or write .glb or .gltf.")
    if kind == "skeleton" and wanted["variations"] > 1 and not wanted["levels"]:
        raise OptionError(f"`--variations {wanted['variations']}` differ in what is grafted on, and nothing is.", remedy="Add `--levels 2`, say.")
    if kind == "picture" and wanted["variations"] > 1 and wanted["levels"] == 0:
        raise OptionError(f"`--variations {wanted['variations']}` differ in what is grafted on, and `--levels 0` grafts nothing.", remedy="Give 1 to 5 levels.")


def refuse_idle(kind: str, source: Path, said: set[str]) -> None:
    """Refuse, among the options that the user named, one that does nothing with such an input. Raises OptionError."""
    idle = next((name for name in _UNUSED[kind] if name in said), None)
    if idle is not None:
        raise OptionError(f"`--{idle.replace('_', '-')}` does nothing here: {source.name} {_IS[kind]}.", remedy="Leave it out, or give another input.")


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
        check_series(wanted["series"], [of_crown(crown, output, wanted)["output"].stem for crown in range(wanted["variations"])], wanted["frames"])


def of_crown(crown: int, output: Path, wanted: dict) -> dict:
    """The outputs of one of several crowns: their names numbered from 1."""
    paths = {"output": output} | {name: wanted[name] for name in ("skeleton", "preview", "movie")}
    if wanted["variations"] == 1:
        return paths
    return {name: None if path is None else path.with_name(f"{path.stem}_{crown + 1}{path.suffix}") for name, path in paths.items()}
