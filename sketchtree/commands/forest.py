"""`sketchtree forest SKETCH… -o FOREST`: several sketch files in, trees that grew up together out."""

import time
from pathlib import Path

import click

from sketchtree.commands import options
from sketchtree.commands.progress import Progress


@click.command("forest")
@click.argument("sketches", nargs=-1, type=click.Path(path_type=Path), metavar="SKETCH...")
@click.option("-o", "--output", required=True, type=click.Path(path_type=Path), metavar="FOREST", help=".glb .gltf .usd .usdz .obj .ply .stl .3mf, .swc .mtg .json .h5, or .png")
@click.option("--spacing", type=float, metavar="METRES", help="From trunk to trunk (default: so that the drawings just touch).")
@options.reading
@options.tree(1_000_000, "all trees together, shared evenly,")
@options.leaves
@options.common
def forest(sketches: tuple[Path, ...], output: Path, spacing: float | None, seed: int, quiet: bool, json_log: bool, report, db, **wanted) -> None:
    """Turn every SKETCH into a tree, in a row, all competing for space and light. The same one again is another tree."""
    began = time.perf_counter()
    from sketchtree.commands import made_anew, writing
    from sketchtree.planting import check_stand

    check_stand(len(sketches), spacing)
    from sketchtree import options as choices

    (files,) = writing.split_options(wanted, choices.FileOptions)
    writing.check_outputs(sketches, output, report, wanted["skeleton"], wanted["preview"], files=files)
    made_anew.refuse(sketches, "forest")
    writing.check_files(output, files)
    from sketchtree import pipeline
    from sketchtree.forest import sketches_to_forest
    from sketchtree.keys import root_key
    from sketchtree.templates.store.database import Database
    from sketchtree.watch import Watch

    imported = time.perf_counter() - began
    reading, tree = writing.split_options(wanted, choices.ReadingOptions, choices.TreeOptions)
    progress = Progress(pipeline.STAGES, quiet=quiet, json_log=json_log)
    watch = Watch(progress, progress.part)
    with progress.running():
        templates = None if db is None and reading.template == "none" else Database.open(db)
        made = sketches_to_forest(sketches, templates, key=root_key(seed), spacing=spacing, reading=reading, tree=tree, watch=watch)
        used = choices.options_as_dict(reading, tree) | {"spacing": spacing, "leaves": files.leaves}
        run = writing.Run("forest", seed, imported, began, watch, used)
        with watch("export"):
            unseen = writing.write_tree(made, output, run, skeleton=wanted["skeleton"], preview=wanted["preview"], files=files, sketches=sketches)
        record = writing.record_forest(run, made, extra_warnings=unseen)
        writing.write_report(report, record)
    writing.conclude(record, output, progress)
