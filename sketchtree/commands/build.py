"""`sketchtree build SKETCH -o TREE`: a sketch file in, a complete textured tree out."""

import time
from pathlib import Path

import click

from sketchtree.commands import options
from sketchtree.commands.planned import not_yet
from sketchtree.commands.progress import Progress

_LATER = {
    "pack": ("--pack", "Files that drop into real tools"),
}


@click.command("build")
@click.argument("sketch", type=click.Path(path_type=Path))
@click.option("-o", "--output", required=True, type=click.Path(path_type=Path), metavar="TREE", help=".glb .gltf .usd .usdz .obj .ply .stl .3mf, .swc .mtg .json .h5, .sketchtree, or .png")
@options.reading
@options.tree(200_000, "the tree")
@click.option("--lod", type=click.IntRange(0, 3), default=0, show_default=True)
@click.option("--leaves", type=click.Choice(["merged", "instanced"]), default="merged", show_default=True)
@click.option("--pack", hidden=True)
@options.common
def build(sketch: Path, output: Path, seed: int, quiet: bool, json_log: bool, report: Path | None, db: Path | None, **wanted) -> None:
    """Turn SKETCH into a complete tree."""
    began = time.perf_counter()
    _refuse_planned(wanted)
    from sketchtree.commands import writing

    writing.check_outputs(sketch, output, report, wanted["skeleton"], wanted["preview"], kinds=writing.WHOLE)
    from sketchtree import options as choices
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
        run = writing.Run("build", seed, imported, began, watch, choices.options_as_dict(reading, tree))
        with watch("export"):
            unseen = writing.write_tree(model, output, run, skeleton=wanted["skeleton"], preview=wanted["preview"])
        record = writing.record(run, model.drawn, model, extra_warnings=unseen)
        writing.write_report(report, record)
    writing.conclude(record, output, progress)


def _refuse_planned(wanted: dict) -> None:
    for name, (option, section) in _LATER.items():
        if wanted.pop(name):
            raise not_yet(option, section)
    if wanted.pop("lod"):
        raise not_yet("--lod", "Files that drop into real tools", "Use `--lod 0`, the default.")
    if wanted.pop("leaves") == "instanced":
        raise not_yet("--leaves instanced", "Files that drop into real tools", "Use `--leaves merged`, the default.")
