"""`sketchtree inspect SKETCH -o OVERLAY.png|.svg`: what the reader makes of a drawing, as a picture to check it by."""

import time
from pathlib import Path

import click

from sketchtree.commands import options
from sketchtree.commands.progress import Progress

KINDS = (".png", ".svg")


@click.command("inspect")
@click.argument("sketch", type=click.Path(path_type=Path))
@click.option("-o", "--output", required=True, type=click.Path(path_type=Path), metavar="OVERLAY.png|.svg", help=".png or .svg")
@options.drawing
@options.common
def inspect(sketch: Path, output: Path, seed: int, quiet: bool, json_log: bool, report: Path | None, db: Path | None, **wanted) -> None:
    """Show how SKETCH is read: strokes, junctions, root, crown and doubts in colours. Nothing is inferred."""
    began = time.perf_counter()
    from sketchtree.commands import made_anew, writing

    writing.check_outputs(sketch, output, report, kinds=KINDS)
    made_anew.refuse((sketch,), "inspect", "`sketchtree grow {name} -o TREE.glb --matte MATTE.png --trunk TRUNK.swc` writes what is found in it.")
    from sketchtree import options as choices
    from sketchtree.overlay.legend import counts
    from sketchtree.drawing import read_drawing
    from sketchtree.reading_report import reading_report
    from sketchtree.watch import Watch

    imported = time.perf_counter() - began
    (reading,) = writing.split_options(wanted, choices.DrawingOptions)
    progress = Progress(("read", "export"), quiet=quiet, json_log=json_log)
    watch = Watch(progress, progress.part)
    with progress.running():
        with watch("read"):
            drawing, graph = read_drawing(sketch, reading, watch)
        with watch("export"):
            _write(sketch, output, drawing, graph)
        seconds = {"import": imported} | watch.seconds | {"total": time.perf_counter() - began}
        seconds = {name: round(value, 4) for name, value in seconds.items()}
        record = reading_report(graph, command="inspect", seed=seed, seconds=seconds, options=choices.options_as_dict(reading))
        writing.write_report(report, record)
    for warning in record["warnings"]:
        progress.say(f"Note: {warning}", event="warning")
    progress.say(f"{output}: {counts(graph)}, {seconds['total']:.1f} s", event="done")


def _write(path: Path, output: Path, drawing, graph) -> None:
    from sketchtree.export.files import write_whole
    from sketchtree.overlay.as_png import scene_png
    from sketchtree.overlay.as_svg import scene_svg
    from sketchtree.overlay.draw import overlay
    from sketchtree.overlay.scan import scan

    scene = overlay(drawing, graph, underlay=scan(path, drawing))
    write_whole(output, scene_png(scene) if output.suffix.lower() == ".png" else scene_svg(scene).encode())
