"""What does `sketchtree grow` write? Every crown whole or not at all: one that grows, one at a time, a series, a film; and the trunk that was found."""

import dataclasses
from pathlib import Path

from sketchtree.animation.wanted import joints_of
from sketchtree.commands.grow_asked import ANIMATED, of_crown
from sketchtree.commands.series import series_files
from sketchtree.export.files import MESHES, SKELETONS

MOVIE_FRAMES = 72


def grow_all(begun, growth, tree, output: Path, run, wanted: dict, *, kept: tuple[Path, ...]) -> dict:
    """Grow every crown and write it; returns the report. Each crown is grown, written and forgotten."""
    from sketchtree.commands import writing
    from sketchtree.growth_report import growth_report, of_crown as told_of
    from sketchtree.growth_tree import grown_tree

    first, moving, crowns, warnings = None, None, [], ()
    for crown in range(wanted["variations"]):
        grown, paths = _at_level(grown_tree(begun, growth, tree, crown=crown, watch=run.watch), wanted["lod"], run.watch), of_crown(crown, output, wanted)
        with run.watch("export"):
            asset, told = _write(grown, paths, run, wanted, kept)
        crowns.append(told_of(grown, paths["output"].name))
        warnings += (*told, *grown.warnings)
        first, moving = (grown, asset) if first is None else (first, moving)
    if begun.trunk is not None:
        with run.watch("export"):
            _write_trunk(begun.trunk, run, wanted)
    return growth_report(first, crowns, moving, **writing.of_run(run), warnings=warnings)


def _at_level(grown, lod: int, watch):
    """The same tree in the meshes of a level of detail, 0-3."""
    if lod == 0:
        return grown
    from sketchtree.levels.make import level_of_detail

    with watch("mesh"):
        return dataclasses.replace(grown, model=dataclasses.replace(grown.model, meshes=level_of_detail(grown.model, lod)))


def _write(grown, paths: dict, run, wanted: dict, kept: tuple[Path, ...]):
    """(what was animated, if anything was; warnings): every file of one crown."""
    from sketchtree.tree_output import write_skeleton_of

    output, moment = paths["output"], wanted["moment"]
    moves = output.suffix.lower() in ANIMATED and moment is None
    growing = _growing(grown, wanted["joints"] or joints_of(wanted["lod"])) if moves or paths["movie"] is not None or wanted["series"] is not None or (moment or 1.0) < 1 or moment == 0 or grown.plan.bend else None
    asset, told = None, ()
    if moves:
        from sketchtree.export.write import write_asset

        asset = growing.asset(seconds=wanted["seconds"], about=_about(grown, run))
        told = write_asset(output, asset, kept=kept, compact=wanted["compact"])
    else:
        told = _write_still(grown, growing, 1.0 if moment is None else moment, output, run, kept, wanted["compact"])
        if moment is None:
            told += (f"{output.name} does not move: it is the tree grown up; `--time` says when otherwise.",)
    if paths["skeleton"] is not None:
        write_skeleton_of(paths["skeleton"], grown.plan.at(1.0 if moment is None else moment), run.made)
    if paths["preview"] is not None:
        told += _picture(_meshes(grown, growing, 1.0 if moment is None else moment), paths["preview"])
    if wanted["series"] is not None:
        _write_series(grown, growing, series_files(wanted["series"], output.stem, wanted["frames"]), run, wanted["compact"])
    if paths["movie"] is not None:
        from sketchtree.view.growth_film import growth_film

        drawn, reason = growth_film(growing, paths["movie"], frames=wanted["frames"] or MOVIE_FRAMES, seconds=wanted["seconds"])
        told += () if drawn else (f"{paths['movie']} was not drawn: {reason}",)
    return asset, told


def _growing(grown, joints: int):
    from sketchtree.animation.growing import Growing

    return Growing.of(grown.model, grown.plan, most_joints=joints)


def _about(grown, run) -> dict:
    from sketchtree.tree_output import about_of

    return about_of(grown.model, run.made)


def _meshes(grown, growing, moment: float) -> tuple:
    return tuple(grown.model.meshes) if moment == 1 and not grown.plan.bend else growing.at(moment)


def _write_still(grown, growing, moment: float, output: Path, run, kept: tuple[Path, ...], compact: bool) -> tuple[str, ...]:
    """The tree at one time."""
    from sketchtree.export.write import write_asset
    from sketchtree.tree_output import write_skeleton_of

    suffix = output.suffix.lower()
    if suffix in SKELETONS:
        write_skeleton_of(output, grown.plan.at(moment), run.made)
        return ()
    if suffix not in MESHES:
        return _picture(_meshes(grown, growing, moment), output)
    return write_asset(output, _still(grown, growing, moment, run), kept=kept, compact=compact)


def _still(grown, growing, moment: float, run):
    from sketchtree.asset import Asset

    return Asset.of(_meshes(grown, growing, moment), skeleton=grown.plan.at(moment), about=_about(grown, run))


def _picture(meshes, path: Path) -> tuple[str, ...]:
    from sketchtree.view import preview

    drawn, reason = preview(meshes, path)
    return () if drawn else (f"{path} was not drawn: {reason}",)


def _write_series(grown, growing, paths: list[Path], run, compact: bool) -> None:
    """The tree at even times."""
    from sketchtree.commands.series import write_series
    from sketchtree.export.write import asset_files

    last = len(paths) - 1
    write_series(paths, lambda path, number: asset_files(path, _still(grown, growing, number / last, run), compact=compact)[path], run.watch.on_part)


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
