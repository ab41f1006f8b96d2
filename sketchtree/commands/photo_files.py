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


def made_again(project: Path, templates, *, seed: int, reading, tree, season_asked: bool, watch):
    """(the trees of a project's photo, how they were wanted). Raises SketchError, OptionError."""
    import dataclasses

    from sketchtree.keys import root_key
    from sketchtree.photo_project import read_photo_project
    from sketchtree.photo_tree import photo_to_tree

    found = read_photo_project(project, reading)
    wanted = dataclasses.replace(found.wanted, bare_as_seen=found.wanted.bare_as_seen and not season_asked)
    return photo_to_tree(found.photo, found.marked, templates, key=root_key(seed), wanted=wanted, reading=reading, tree=tree, watch=watch), wanted


def write_trees(made, output: Path, run, files, *, picture: bytes, skeleton: Path | None = None, preview: Path | None = None, kept: tuple[Path, ...] = ()) -> tuple[str, ...]:
    """The trees, and a project with the photo, whose file's bytes are `picture`; returns warnings."""
    from sketchtree.commands import writing
    from sketchtree.export.files import PROJECTS

    if output.suffix.lower() not in PROJECTS:
        return writing.write_tree(made.model, output, run, skeleton=skeleton, preview=preview, files=files, sketches=kept)
    from sketchtree.photo_project import as_project

    model, underlay, told = as_project(made.trees[0], picture)
    return told + writing.write_tree(model, output, run, skeleton=skeleton, preview=preview, files=files, sketches=kept, underlay=underlay)


def write(made, output: Path, run, wanted: dict, files, *, kept: tuple[Path, ...]) -> tuple[str, ...]:
    """Everything asked for; returns warnings (a picture that could not be drawn, what a project can't keep). The first of `kept` is the photo."""
    from sketchtree.export.files import PROJECTS
    from sketchtree.tree_output import write_skeleton_of

    warnings = write_trees(made, output, run, files, picture=kept[0].read_bytes(), preview=wanted["preview"], kept=kept)
    if wanted["use_mask"] is not None and output.suffix.lower() in PROJECTS:
        warnings += (f"A project keeps no mask: the foliage in {output.name} is found anew, not taken from {wanted['use_mask'].name}.",)
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
