"""`sketchtree build SKETCH -o TREE`: a sketch file in, a complete textured tree out."""

import time
from pathlib import Path

import click
from click.core import ParameterSource

from sketchtree.commands import options
from sketchtree.commands.progress import Progress
from sketchtree.errors import ExportError, OptionError


@click.command("build")
@click.argument("sketch", type=click.Path(path_type=Path))
@click.option("-o", "--output", required=True, type=click.Path(path_type=Path), metavar="TREE", help=".glb .gltf .usd .usdz .obj .ply .stl .3mf, .swc .mtg .json .h5, .sketchtree, or .png")
@options.reading
@options.tree(200_000, "the tree")
@click.option("--as-drawn", is_flag=True, help="Of a project with a photo, or with points: the tree of its strokes alone, not the one in the photo, or in the points.")
@click.option("--points", type=click.Path(path_type=Path), metavar="CLOUD", help="A point cloud that was drawn over: strokes take their depth from it. Its foot is the drawing's, and it is as high.")
@click.option("--tree", "which", type=click.IntRange(1), metavar="K", help="Which of several trees in CLOUD, 1 the largest.")
@options.files
@options.common
def build(sketch: Path, output: Path, as_drawn: bool, points: Path | None, which: int | None, seed: int, quiet: bool, json_log: bool, report: Path | None, db: Path | None, **wanted) -> None:
    """Turn SKETCH into a complete tree."""
    began = time.perf_counter()
    from sketchtree.commands import writing
    from sketchtree.export.files import check_extension

    from sketchtree import options as choices

    (files,) = writing.split_options(wanted, choices.FileOptions)
    check_extension(output, writing.WHOLE)
    writing.check_files(output, files)
    writing.check_outputs(sketch, output, report, wanted["skeleton"], wanted["preview"], files=files, kinds=writing.WHOLE)
    from sketchtree import pipeline
    from sketchtree.keys import root_key
    from sketchtree.sketch.files.project import holds_photo, holds_scribbles, holds_traced

    scribbled, traced = (not as_drawn and holds(sketch) for holds in (holds_scribbles, holds_traced))
    if scribbled or traced:
        _check_made_anew(sketch, output, "scribbled" if scribbled else "traced")
    if points is not None and (scribbled or traced or not as_drawn and holds_photo(sketch)):
        raise OptionError(f"`--points` does nothing here: the tree of {sketch.name} is not that of its strokes.", remedy="Leave it out, or add `--as-drawn`.")
    if which is not None and points is None:
        raise OptionError(f"`--tree {which}` says which tree of a point cloud, and none is given.", remedy="Add `--points CLOUD`, or leave it out.")
    from sketchtree.templates.store.database import Database
    from sketchtree.watch import Watch

    imported = time.perf_counter() - began
    reading, tree = writing.split_options(wanted, choices.ReadingOptions, choices.TreeOptions)
    progress = Progress(pipeline.STAGES, quiet=quiet, json_log=json_log)
    watch = Watch(progress, progress.part)
    with progress.running():
        templates = None if db is None and reading.template == "none" else Database.open(db)
        beside = {"skeleton": wanted["skeleton"], "preview": wanted["preview"]}
        if scribbled:
            record = _of_scribbles(sketch, output, files, beside, seed, imported, began, templates, reading, tree, watch)
        elif traced:
            record = _of_points(sketch, output, files, beside, seed, imported, began, templates, reading, tree, watch)
        elif not as_drawn and holds_photo(sketch):
            record = _of_photo(sketch, output, files, beside, seed, imported, began, templates, reading, tree, watch)
        else:
            cloud = None if points is None else _behind(points, sketch, which, reading, watch)
            model = pipeline.sketch_to_tree(sketch, templates, key=root_key(seed), reading=reading, tree=tree, cloud=cloud, watch=watch)
            run = writing.Run("build", seed, imported, began, watch, choices.options_as_dict(reading, tree, files))
            with watch("export"):
                unseen = writing.write_tree(model, output, run, files=files, sketches=(sketch,) if points is None else (sketch, points), **beside)
            record = writing.record(run, model.drawn, model, extra_warnings=(*unseen, *(() if cloud is None else cloud.remarks)))
        writing.write_report(report, record)
    writing.conclude(record, output, progress)


def _behind(points: Path, sketch: Path, which: int | None, reading, watch):
    """The points that the strokes were drawn over."""
    from sketchtree.laid_tree import read_behind

    with watch("read"):
        return read_behind(points, sketch, which, reading)


def _check_made_anew(project: Path, output: Path, kind: str) -> None:
    """Refuse, before the work, what does nothing with a project that keeps no tree. Raises OptionError, ExportError."""
    from sketchtree.commands import grow_asked
    from sketchtree.export.files import PROJECTS

    grow_asked.refuse_idle(kind, project, grow_asked.given(click.get_current_context()))
    if output.suffix.lower() in PROJECTS:
        raise ExportError(f"Can't write {output}: {project.name} is the project already, and its tree is made anew of what is {'scribbled in it' if kind == 'scribbled' else 'behind its drawing'}.", remedy="Copy it, or write .glb.")


def _of_scribbles(project: Path, output: Path, files, beside: dict, seed: int, imported: float, began: float, templates, reading, tree, watch) -> dict:
    """The tree of a project's scribbles, grown up and written; its report."""
    from sketchtree.commands import grow_asked, scribbled, writing
    from sketchtree.growth_report import growth_report, of_crown
    from sketchtree.growth_tree import check_tree, grown_tree
    from sketchtree.options import options_as_dict

    check_tree(tree, templates)
    said = grow_asked.given(click.get_current_context())
    begun, seed = scribbled.begun(project, templates, seed=seed, seed_chosen="seed" in said, season_chosen="season" in said, reading=reading, tree=tree, watch=watch)
    grown = grown_tree(begun, tree=tree, watch=watch)
    run = writing.Run("build", seed, imported, began, watch, options_as_dict(reading, tree, files, begun.trunk.wanted))
    with watch("export"):
        unseen = writing.write_tree(grown.model, output, run, files=files, sketches=(project,), **beside)
    return growth_report(grown, [of_crown(grown, output.name)], None, **writing.of_run(run), warnings=unseen)


def _of_points(project: Path, output: Path, files, beside: dict, seed: int, imported: float, began: float, templates, reading, tree, watch) -> dict:
    """The tree in the points of a project, traced and written; its report."""
    from sketchtree.cloud_report import cloud_report
    from sketchtree.commands import grow_asked, traced, writing
    from sketchtree.growth_tree import check_tree
    from sketchtree.options import options_as_dict

    check_tree(tree, templates)
    said = grow_asked.given(click.get_current_context())
    made, seed = traced.traced(project, templates, seed=seed, seed_chosen="seed" in said, season_chosen="season" in said, reading=reading, tree=tree, watch=watch)
    run = writing.Run("build", seed, imported, began, watch, options_as_dict(reading, tree, files))
    with watch("export"):
        unseen = writing.write_tree(made.model, output, run, files=files, sketches=(project,), **beside)
    return cloud_report(made, **writing.of_run(run), warnings=unseen)


def _of_photo(project: Path, output: Path, files, beside: dict, seed: int, imported: float, began: float, templates, reading, tree, watch) -> dict:
    """The tree in a project's photo, made again and written; its report."""
    from sketchtree.commands import photo_files, writing
    from sketchtree.options import options_as_dict
    from sketchtree.photo_project import picture_in

    asked = click.get_current_context().get_parameter_source("season") is not ParameterSource.DEFAULT
    made, how = photo_files.made_again(project, templates, seed=seed, reading=reading, tree=tree, season_asked=asked, watch=watch)
    photo_files.check_trees(output, made.photo, len(made.trees))
    run = writing.Run("build", seed, imported, began, watch, options_as_dict(reading, tree, files, how))
    with watch("export"):
        unseen = photo_files.write_trees(made, output, run, files, picture=picture_in(project), kept=(project,), **beside)
    return photo_files.record(run, made, extra_warnings=unseen)
