"""`sketchtree infer SKETCH -o DRAWN.swc`: only the drawn branches, in 3D."""

import time
from pathlib import Path

import click

from sketchtree.commands import options
from sketchtree.commands.progress import Progress


@click.command("infer")
@click.argument("sketch", type=click.Path(path_type=Path))
@click.option("-o", "--output", required=True, type=click.Path(path_type=Path), metavar="DRAWN.swc", help=".swc or .json")
@click.option("--frame", type=click.Choice(["sketch", "world"]), default="world", show_default=True, help="The sketch's own units (y up), or metres with the root at the origin.")
@options.reading
@click.option("--samples", type=click.IntRange(0, 1_000_000), default=0, metavar="N", help="Sample the posterior at least N times.")
@click.option("--posterior", type=click.Path(path_type=Path), metavar="P.npz", help="Write the samples.")
@click.option("--alternatives", type=click.IntRange(0, 64), default=0, metavar="K", help="K distinct readings; the others go to DRAWN.2.swc, ….")
@options.common
def infer(sketch: Path, output: Path, frame: str, seed: int, quiet: bool, json_log: bool, report: Path | None, db: Path | None, posterior: Path | None, **wanted) -> None:
    """Infer the depths of the strokes in SKETCH and write the drawn branches as a skeleton."""
    began = time.perf_counter()
    from sketchtree.commands import made_anew, writing

    others = writing.other_readings(output, wanted["alternatives"])
    writing.check_outputs(sketch, output, report, posterior=posterior, others=others, kinds=writing.SKELETONS)
    made_anew.refuse((sketch,), "infer", "`sketchtree grow {name} -o TRUNK.swc --levels 0` writes its trunk in 3D.")
    from sketchtree import options as choices
    from sketchtree import pipeline
    from sketchtree.editing.settled import Settled
    from sketchtree.keys import root_key
    from sketchtree.templates.store.database import Database
    from sketchtree.watch import Watch

    imported = time.perf_counter() - began
    (reading,) = writing.split_options(wanted, choices.ReadingOptions)
    progress = Progress(("read", "match", "infer", "export"), quiet=quiet, json_log=json_log)
    watch = Watch(progress, progress.part)
    with progress.running():
        templates = None if db is None and reading.template == "none" else Database.open(db)
        anew = Settled() if posterior or reading.samples else None  # of a project: samples are of what nobody holds, not of what it has settled on
        drawn = pipeline.draw_out(sketch, templates, key=root_key(seed), options=reading, settled=anew, watch=watch)
        run = writing.Run("infer", seed, imported, began, watch, choices.options_as_dict(reading) | {"frame": frame})
        with watch("export"):
            writing.write_posterior(posterior, drawn, frame=frame)
            writing.write_drawn(drawn, output, run, frame=frame, others=others)
        record = writing.record(run, drawn)
        writing.write_report(report, record)
    writing.conclude(record, output, progress)
