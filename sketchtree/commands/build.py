"""`sketchtree build SKETCH -o TREE`: a sketch file in, a complete textured tree out."""

import time
from pathlib import Path

import click

from sketchtree.commands import options
from sketchtree.commands.progress import Progress


@click.command("build")
@click.argument("sketch", type=click.Path(path_type=Path))
@click.option("-o", "--output", required=True, type=click.Path(path_type=Path), metavar="TREE", help=".glb .gltf .usd .usdz .obj .ply .stl .3mf, .swc .mtg .json .h5, .sketchtree, or .png")
@options.reading
@options.tree(200_000, "the tree")
@options.files
@options.common
def build(sketch: Path, output: Path, seed: int, quiet: bool, json_log: bool, report: Path | None, db: Path | None, **wanted) -> None:
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
    from sketchtree.templates.store.database import Database
    from sketchtree.watch import Watch

    imported = time.perf_counter() - began
    reading, tree = writing.split_options(wanted, choices.ReadingOptions, choices.TreeOptions)
    progress = Progress(pipeline.STAGES, quiet=quiet, json_log=json_log)
    watch = Watch(progress, progress.part)
    with progress.running():
        templates = None if db is None and reading.template == "none" else Database.open(db)
        model = pipeline.sketch_to_tree(sketch, templates, key=root_key(seed), reading=reading, tree=tree, watch=watch)
        run = writing.Run("build", seed, imported, began, watch, choices.options_as_dict(reading, tree, files))
        with watch("export"):
            unseen = writing.write_tree(model, output, run, skeleton=wanted["skeleton"], preview=wanted["preview"], files=files, sketches=(sketch,))
        record = writing.record(run, model.drawn, model, extra_warnings=unseen)
        writing.write_report(report, record)
    writing.conclude(record, output, progress)
