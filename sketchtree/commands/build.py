"""`sketchtree build SKETCH -o TREE`: a sketch file in, a complete textured tree out."""

import time
from pathlib import Path

import click
from click.core import ParameterSource

from sketchtree.commands import options
from sketchtree.commands.progress import Progress
from sketchtree.errors import ExportError


@click.command("build")
@click.argument("sketch", type=click.Path(path_type=Path))
@click.option("-o", "--output", required=True, type=click.Path(path_type=Path), metavar="TREE", help=".glb .gltf .usd .usdz .obj .ply .stl .3mf, .swc .mtg .json .h5, .sketchtree, or .png")
@options.reading
@options.tree(200_000, "the tree")
@click.option("--as-drawn", is_flag=True, help="Of a project with a photo: the tree of its strokes alone, not the one in the photo.")
@options.files
@options.common
def build(sketch: Path, output: Path, as_drawn: bool, seed: int, quiet: bool, json_log: bool, report: Path | None, db: Path | None, **wanted) -> None:
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
    from sketchtree.sketch.files.project import holds_photo, holds_scribbles

    scribbled = not as_drawn and holds_scribbles(sketch)
    if scribbled:
        _check_scribbled(sketch, output)
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
        elif not as_drawn and holds_photo(sketch):
            record = _of_photo(sketch, output, files, beside, seed, imported, began, templates, reading, tree, watch)
        else:
            model = pipeline.sketch_to_tree(sketch, templates, key=root_key(seed), reading=reading, tree=tree, watch=watch)
            run = writing.Run("build", seed, imported, began, watch, choices.options_as_dict(reading, tree, files))
            with watch("export"):
                unseen = writing.write_tree(model, output, run, files=files, sketches=(sketch,), **beside)
            record = writing.record(run, model.drawn, model, extra_warnings=unseen)
        writing.write_report(report, record)
    writing.conclude(record, output, progress)


def _check_scribbled(project: Path, output: Path) -> None:
    """Refuse, before the work, what does nothing with a project of scribbles. Raises OptionError, ExportError."""
    from sketchtree.commands import grow_asked
    from sketchtree.export.files import PROJECTS

    grow_asked.refuse_idle("scribbled", project, grow_asked.given(click.get_current_context()))
    if output.suffix.lower() in PROJECTS:
        raise ExportError(f"Can't write {output}: {project.name} is the project already, and its tree is made anew of what is scribbled in it.", remedy="Copy it, or write .glb.")


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
