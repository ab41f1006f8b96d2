"""`sketchtree studio [FILE]`: draw on a page in the browser, and the tree follows the pen."""

import asyncio
import contextlib
import importlib.util
import json
import signal
import threading
import time
import webbrowser
from pathlib import Path

import click

from sketchtree.commands import options
from sketchtree.commands.stopping import leave_to_asyncio

_NEEDS = ("starlette", "uvicorn", "websockets", "msgspec")


@click.command("studio")
@click.argument("file", required=False, type=click.Path(path_type=Path))
@click.option("--port", type=click.IntRange(0, 65535), default=0, metavar="N", help="Port on this machine (default: any that is free).")
@click.option("--no-browser", is_flag=True, help="Print the address, and open no browser.")
@options.common
def studio(file: Path | None, port: int, no_browser: bool, seed: int, quiet: bool, json_log: bool, report: Path | None, db: Path | None) -> None:
    """Draw a tree in the browser. FILE is a drawing or a project (.sketchtree); a project that is not there yet is begun.

    Prints its address, which only this machine can reach, and runs until Ctrl-C.
    """
    began = time.perf_counter()
    leave_to_asyncio()
    _stop_like_ctrl_c(signal.SIGTERM)
    _check_extra()
    from sketchtree.studio.built import page_folder
    from sketchtree.studio.crew import Crew
    from sketchtree.studio.serving import Start, serve
    from sketchtree.studio.stock import Stock
    from sketchtree.studio.stocked import Stocked

    page, file = page_folder(), _checked(file)
    _check_report(report)
    start = Start(file, Path.cwd() if file is None else file.parent, seed, port)
    with contextlib.suppress(KeyboardInterrupt):
        asyncio.run(serve(Stocked(Crew(db), Stock.of_user(db)), start, page, lambda url: _told(url, not no_browser, json_log)))
    _write_report(report, {"file": None if file is None else file.name, "port": port}, seed, time.perf_counter() - began)


def _check_extra() -> None:
    from sketchtree.errors import OptionError

    missing = [name for name in _NEEDS if importlib.util.find_spec(name) is None]
    if missing:
        raise OptionError(f"`sketchtree studio` needs {', '.join(missing)}.", remedy="Install it: pip install 'sketchtree[studio]'.")


def _checked(file: Path | None) -> Path | None:
    """The file, where it really is. Raises SketchError."""
    from sketchtree.errors import SketchError
    from sketchtree.studio.folder import PROJECT, is_name

    if file is None:
        return None
    found = file.resolve()
    if found.is_dir():
        raise SketchError(f"{file} is a folder.", remedy="Give a drawing or a project in it, or start the studio in it.")
    if not found.exists() and (found.suffix.lower() != PROJECT or not found.parent.is_dir()):
        raise SketchError(f"{file} does not exist.", remedy=f"Check the path, or name a new project NAME{PROJECT} in a folder that is there.")
    if not is_name(found.name):
        raise SketchError(f"{found.name} is hidden, or no name that a file can have everywhere.", remedy="Rename it.")
    return found


def _told(url: str, browser: bool, json_log: bool) -> None:
    """The one line, when connections are accepted."""
    click.echo(f"Studio: {url}")
    if json_log:
        click.echo(json.dumps({"event": "ready", "text": f"Studio: {url}"}), err=True)
    if browser:
        threading.Thread(target=webbrowser.open, args=(url,), daemon=True).start()


def _stop_like_ctrl_c(number: int) -> None:
    """Being told to end is an end like Ctrl-C: what runs is stopped in order."""
    signal.signal(number, lambda *_: signal.raise_signal(signal.SIGINT))


def _check_report(report: Path | None) -> None:
    from sketchtree.export.files import check_writable

    if report is not None:
        check_writable(report)


def _write_report(report: Path | None, said: dict, seed: int, seconds: float) -> None:
    if report is None:
        return
    from sketchtree.commands import writing
    from sketchtree.reading_report import SCHEMA
    from sketchtree.version import __version__

    record = {"schema": SCHEMA, "command": "studio", "version": __version__, "seed": seed, "options": said}
    writing.write_report(report, record | {"seconds": {"total": round(seconds, 4)}, "warnings": []})
