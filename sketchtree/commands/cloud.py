"""`sketchtree cloud POINTS -o TREE`: a point cloud in, the tree that stands in it out."""

import time
from pathlib import Path

import click

from sketchtree.commands import options
from sketchtree.commands.progress import Progress

_FILE = click.Path(path_type=Path)


@click.command("cloud")
@click.argument("points_file", metavar="POINTS", type=_FILE)
@click.option("-o", "--output", required=True, type=_FILE, metavar="TREE", help=".glb .gltf .usd .usdz .obj .ply .stl .3mf, .swc .mtg .json .h5, or .png")
@click.option("--up", type=click.Choice(["auto", "y", "z"]), default="auto", show_default=True, help="The cloud's axis that points up.")
@click.option("--tree", type=click.IntRange(1), metavar="K", help="Which of several trees, 1 the largest.")
@click.option("--unit", type=float, default=1.0, show_default=True, metavar="METRES", help="What 1 in the file means: 0.001 for millimetres.")
@click.option("--points", type=int, default=300_000, show_default=True, metavar="N", help="Points of the tree at most; the rest is thinned, spread evenly.")
@options.standing
@options.common
def cloud(points_file: Path, output: Path, seed: int, quiet: bool, json_log: bool, report: Path | None, db: Path | None, **wanted) -> None:
    """Make the tree that stands in a point cloud.

    POINTS is a scan of one plant, or of several (`--tree`): .ply .las .laz .xyz .txt .csv .npz .npy, with its ground or without.
    """
    began = time.perf_counter()
    from sketchtree import options as choices
    from sketchtree.commands import writing
    from sketchtree.export.files import MESHES, SKELETONS, check_extension

    check_extension(output, MESHES + SKELETONS + writing.PICTURES)
    writing.check_outputs(points_file, output, report, wanted["skeleton"], wanted["preview"])
    from sketchtree import pipeline
    from sketchtree.cloud_report import cloud_report
    from sketchtree.cloud_tree import CloudOptions, cloud_to_tree
    from sketchtree.growth_tree import check_tree
    from sketchtree.keys import root_key
    from sketchtree.templates.store.database import Database
    from sketchtree.watch import Watch

    imported = time.perf_counter() - began
    which = wanted.pop("tree")
    tree, files = writing.split_options(wanted, choices.TreeOptions, choices.FileOptions)
    how = CloudOptions(tree=which, **{name: wanted[name] for name in ("up", "unit", "points", "method", "species", "roots", "inside")})
    progress = Progress(pipeline.STAGES, quiet=quiet, json_log=json_log)
    watch = Watch(progress, progress.part)
    with progress.running():
        templates = Database.open(db)
        check_tree(tree, templates)
        if wanted["template"] is not None:
            templates.exemplar(wanted["template"])
        made = cloud_to_tree(points_file, templates, key=root_key(seed), wanted=how, tree=tree, template=wanted["template"], watch=watch)
        run = writing.Run("cloud", seed, imported, began, watch, choices.options_as_dict(how, tree, files) | {"template": wanted["template"]})
        with watch("export"):
            unseen = writing.write_tree(made.model, output, run, skeleton=wanted["skeleton"], preview=wanted["preview"], files=files, sketches=(points_file,))
        record = cloud_report(made, **writing.of_run(run), warnings=unseen)
        writing.write_report(report, record)
    writing.conclude(record, output, progress)
