"""Which files does `sketchtree photo` read and write? Checked before the work, written after it."""

from pathlib import Path

from sketchtree.errors import ExportError, OptionError
from sketchtree.export.files import SKELETONS

_NONE = "There are no strokes to say which tree is meant."


def check_strokes(strokes: Path | None, auto: bool) -> None:
    """Strokes, or leave to propose them. Raises OptionError."""
    if strokes is None and not auto:
        raise OptionError(_NONE, remedy="Give `--strokes FILE` with one stroke round the crown and one along the trunk, or `--auto`.")
    if strokes is not None and auto:
        raise OptionError("`--strokes` and `--auto` both say which tree is meant.", remedy="Leave one of the two out.")


def libraries(wanted: str) -> tuple[str, ...]:
    """`all`, or names with commas between."""
    from sketchtree.photo.wanted import LIBRARIES

    return LIBRARIES if wanted == "all" else tuple(dict.fromkeys(name.strip() for name in wanted.split(",")))


def check(image: Path, strokes: Path | None, output: Path, report: Path | None, wanted: dict, files) -> None:
    """Refuse, before any work, an output that can't be written. Raises ExportError."""
    from sketchtree.commands import writing

    mask, traced, compare = wanted["mask"], wanted["traced"], wanted["compare"]
    for option, path, kinds in (("--compare", compare, (".png",)), ("--mask", mask, (".png",)), ("--traced", traced, SKELETONS)):
        if path is not None and path.suffix.lower() not in kinds:
            raise ExportError(f"`{option} {path}` is no {' '.join(kinds)} file.", remedy=f"Name it {path.with_suffix(kinds[0]).name}.")
    writing.check_outputs(
        inputs(image, strokes, wanted), output, report, wanted["skeleton"], wanted["preview"], more={"--mask": mask, "--traced": traced, "--compare": compare}, files=files,
        kinds=writing.WHOLE,
    )  # fmt: skip


def inputs(image: Path, strokes: Path | None, wanted: dict) -> tuple[Path, ...]:
    """The files that are read, and so never written."""
    return tuple(path for path in (image, strokes, wanted["use_mask"]) if path is not None)


def read(image: Path, strokes: Path | None, mask: Path | None, limits, *, key):
    """(the photo, the strokes of each tree, the foliage if its mask is there). Raises SketchError, OptionError."""
    from sketchtree.photo.auto.propose import propose
    from sketchtree.photo.known_foliage import read_mask
    from sketchtree.photo.read_photo import read_photo
    from sketchtree.photo.read_strokes import read_strokes

    photo = read_photo(image, max_mb=limits.max_mb, max_megapixels=limits.max_megapixels)
    known = None if mask is None else read_mask(mask, photo)
    if strokes is not None:
        return photo, read_strokes(strokes, photo), known
    return photo, propose(photo, key=key).trees, known


def check_trees(output: Path, photo, trees: int) -> None:
    """Refuse, before the work, a file that can't hold so many trees. Raises ExportError."""
    from sketchtree.export.files import PROJECTS

    if trees > 1 and output.suffix.lower() in PROJECTS:
        raise ExportError(f"A project holds one tree, and {trees} are marked in {photo.name}.", remedy="Write .glb, or give strokes of one tree.")


def write(made, output: Path, run, wanted: dict, files, *, kept: tuple[Path, ...]) -> tuple[str, ...]:
    """Everything asked for; returns warnings (a picture that could not be drawn)."""
    from sketchtree.commands import writing
    from sketchtree.tree_output import write_skeleton_of

    warnings = writing.write_tree(made.model, output, run, skeleton=None, preview=wanted["preview"], files=files, sketches=kept)
    pixels = {"units": "pixels", "frame": "photo"}
    if wanted["skeleton"] is not None:
        write_skeleton_of(wanted["skeleton"], made.in_pixels(), run.made, **pixels)
    if wanted["traced"] is not None:
        write_skeleton_of(wanted["traced"], made.visible_in_pixels(), run.made, **pixels)
    if wanted["mask"] is not None:
        _write_mask(wanted["mask"], made)
    if wanted["compare"] is not None:
        from sketchtree.view.beside import beside

        drawn, reason = beside(made.photo.rgb, made.model.meshes, made.frame, wanted["compare"])
        warnings += () if drawn else (f"{wanted['compare']} was not drawn: {reason}",)
    return warnings


def _write_mask(path: Path, made) -> None:
    """The foliage of all trees as a grey PNG of the photo's size, white where it is."""
    import io

    import numpy as np
    from PIL import Image

    from sketchtree.export.files import write_whole

    mask = np.any([tree.foliage.mask for tree in made.trees], axis=0)
    whole = io.BytesIO()
    Image.fromarray((255 * mask).astype(np.uint8)).save(whole, "PNG")
    write_whole(path, whole.getvalue())


def record(run, made, *, extra_warnings: tuple[str, ...]) -> dict:
    """The report of one tree, or of all of them as a forest's."""
    from sketchtree.commands import writing

    if len(made.trees) == 1:
        return writing.record(run, made.trees[0].drawn, made.model, extra_warnings=extra_warnings)
    return writing.record_forest(run, made.model, extra_warnings=extra_warnings)
