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
    from sketchtree.commands import writing

    writing.check_outputs(points_file, output, report, wanted["skeleton"], wanted["preview"], more={"--distances": wanted["distances"]}, source="the cloud itself")
    from sketchtree.commands import of_points
    from sketchtree.pipeline import STAGES
    from sketchtree.watch import Watch

    imported = time.perf_counter() - began
    progress = Progress(STAGES, quiet=quiet, json_log=json_log)
    watch = Watch(progress, progress.part)
    with progress.running():
        asked = of_points.asked(wanted, given=(points_file,), output=output, report=report, seed=seed, db=db, up=wanted["up"], tree=wanted["tree"], unit=wanted["unit"], points=wanted["points"])
        tree = of_points.made(points_file, asked, watch)
        record = of_points.written(tree, asked, "cloud", watch, began=began, imported=imported, given=(points_file,))
    writing.conclude(record, output, progress)
