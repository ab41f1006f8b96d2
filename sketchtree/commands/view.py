"""`sketchtree view TREE`: look at a tree, in a window, as a picture or as a film."""

import time
from pathlib import Path

import click
from click.core import ParameterSource

from sketchtree.commands import options
from sketchtree.commands.progress import Progress


@click.command("view")
@click.argument("tree", type=click.Path(path_type=Path))
@click.option("--screenshot", type=click.Path(path_type=Path), metavar="P.png", help="Draw a picture instead of opening a window.")
@click.option("--turntable", type=click.Path(path_type=Path), metavar="FILM", help="Draw the tree turning once: .gif .webp .apng, or .mp4 (needs ffmpeg, or the extra `video`).")
@click.option("--view", "sides", multiple=True, metavar="SIDE", help="front, side, back, top or three-quarter (the default); several make a sheet.")
@click.option("--size", default="", metavar="WxH", help="Pixels (default: 1200x900, of a film 640x640).")
@click.option("--frames", type=int, default=48, show_default=True, help="Pictures of the film.")
@click.option("--seconds", type=float, default=6.0, show_default=True, help="How long one turn takes.")
@click.option("--level", type=click.IntRange(0), default=0, show_default=True, help="Level of detail to show, where the file holds several.")
@options.common
def view(tree: Path, screenshot: Path | None, turntable: Path | None, seed: int, quiet: bool, json_log: bool, report: Path | None, db: Path | None, **wanted) -> None:
    """Show the tree in a file: a mesh (.glb .gltf .usd .obj .ply .stl) as it is, a skeleton (.swc .mtg .json .h5 .sketchtree) as bare wood, a project of scribbles, or of points that are traced, as the tree that is made of them."""
    began = time.perf_counter()
    _check(tree, screenshot, turntable, report, wanted)
    size = _size(wanted["size"], (1200, 900) if turntable is None else (640, 640))
    imported = time.perf_counter() - began
    progress = Progress(("read", "draw"), quiet=quiet, json_log=json_log)
    with progress.running():
        meshes = _meshes(tree, wanted["level"], seed, db)
        drawn = time.perf_counter()
        warnings = [f"{path} was not drawn: {reason}" for path, reason in _draw(meshes, tree, screenshot, turntable, size, wanted) if reason]
    triangles = sum(mesh.triangle_count for mesh in meshes)
    _write_report(report, seed, wanted, imported, drawn, began, triangles, warnings)
    for warning in warnings:
        progress.say(f"Note: {warning}", event="warning")
    shown = [str(path) for path in (screenshot, turntable) if path is not None and path.exists() and not any(str(path) in text for text in warnings)]
    if shown:
        progress.say(f"{', '.join(shown)}: {triangles} triangles, {time.perf_counter() - began:.1f} s", event="done")


def _check(tree: Path, screenshot, turntable, report, wanted: dict) -> None:
    """Refuse what can't be done before anything is read."""
    from sketchtree.commands import writing
    from sketchtree.errors import OptionError
    from sketchtree.view.picture import VIEWS

    for side in wanted["sides"]:
        if side not in VIEWS:
            raise OptionError(f"There is no view called {side!r}.", remedy=f"Choose one of: {', '.join(VIEWS)}.")
    if screenshot is not None:
        writing.check_outputs(tree, screenshot, report, kinds=writing.PICTURES)
    if turntable is not None:
        from sketchtree.view.turntable import FILMS, check_film

        writing.check_outputs(tree, turntable, report, kinds=FILMS)
        check_film(turntable)


def _size(text: str, default: tuple[int, int]) -> tuple[int, int]:
    from sketchtree.errors import OptionError

    if not text:
        return default
    parts = text.lower().split("x")
    if len(parts) != 2 or not all(part.isdecimal() and 16 <= int(part) <= 8192 for part in parts):
        raise OptionError(f"`--size {text}` is no size of a picture.", remedy="Give width and height in pixels, 16 to 8192 each, such as 1200x900.")
    return int(parts[0]), int(parts[1])


def _meshes(tree: Path, level: int, seed: int, db: Path | None):
    """The meshes to show."""
    from sketchtree.errors import OptionError
    from sketchtree.export.read import read_contents
    from sketchtree.commands import made_anew

    if made_anew.is_made_anew(tree):
        if level:
            raise OptionError(f"The tree of {tree} is made anew, in one level of detail, and there is none numbered {level}.", remedy="Leave `--level` out.")
        chosen = click.get_current_context().get_parameter_source("seed") is not ParameterSource.DEFAULT
        return list(made_anew.grown(tree, db, seed=seed, seed_chosen=chosen)[0].model.meshes)
    contents = read_contents(tree)
    if contents.asset is None:
        from sketchtree.dressing import Dress, dressed
        from sketchtree.keys import root_key

        return list(dressed(contents.skeleton, Dress("oak", None), key=root_key(seed)))
    levels = contents.asset.levels
    if level >= len(levels):
        raise OptionError(f"{tree} holds {len(levels)} level{'s' if len(levels) > 1 else ''} of detail, none numbered {level}.", remedy="Count from 0.")
    return [part.merged() for part in levels[level].parts]


def _draw(meshes, tree: Path, screenshot, turntable, size, wanted: dict):
    """Each file asked for with the reason why it was not drawn, "" if it was; a window where none was asked for."""
    if screenshot is not None:
        from sketchtree.view.picture import preview

        yield screenshot, preview(meshes, screenshot, size=size if turntable is None else (1200, 900), view=wanted["sides"] or ("three-quarter",))[1]
    if turntable is not None:
        from sketchtree.view.turntable import turntable as film

        yield turntable, film(meshes, turntable, size=size, frames=wanted["frames"], seconds=wanted["seconds"])[1]
    if screenshot is None and turntable is None:
        from sketchtree.view.window import window

        window(meshes, tree.name, size=size)


def _write_report(report, seed: int, wanted: dict, imported, drawn, began, triangles: int, warnings) -> None:
    if report is None:
        return
    from sketchtree.commands import writing
    from sketchtree.reading_report import SCHEMA
    from sketchtree.version import __version__

    ended = time.perf_counter()
    seconds = {"import": imported, "read": drawn - began - imported, "draw": ended - drawn, "total": ended - began}
    said = {name: list(value) if isinstance(value, tuple) else value for name, value in wanted.items()}
    record = {"schema": SCHEMA, "command": "view", "version": __version__, "seed": seed, "options": said, "triangles": triangles}
    writing.write_report(report, record | {"seconds": {name: round(value, 4) for name, value in seconds.items()}, "warnings": list(warnings)})
