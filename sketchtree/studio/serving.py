"""How does the studio start and end? A socket of this machine alone, the engine, the first drawing, then the line that says where it is."""

import asyncio
import errno
import logging
import os
import socket
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import uvicorn
from starlette.types import ASGIApp

from sketchtree.editing.document import Document
from sketchtree.errors import OptionError, SketchTreeError
from sketchtree.studio import examples, filing
from sketchtree.studio.desk import trouble_of
from sketchtree.studio.engine import Engine
from sketchtree.studio.folder import PROJECT, Folder
from sketchtree.studio.key import Key
from sketchtree.studio.messages import MAX_MESSAGE
from sketchtree.studio.patience import Patient
from sketchtree.studio.recovery import Journal, journal_of
from sketchtree.studio.security import ADDRESS, Guard
from sketchtree.studio.server import Studio
from sketchtree.studio.session import Session

_PATIENCE = 0.5  # seconds that open connections have to end


@dataclass(frozen=True)
class Start:
    """What to begin with."""

    file: Path | None  # a drawing or a project; a project that is not there yet is a new one
    folder: Path  # of the files that the page may name
    seed: int = 0
    port: int = 0  # 0: any that is free


def bound(port: int) -> socket.socket:
    """A socket that listens to this machine only. Raises OptionError where the port is taken."""
    made = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    if os.name == "posix":  # elsewhere this would share the port with another program
        made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        made.bind((ADDRESS, port))
    except OSError as error:
        made.close()
        if error.errno == errno.EADDRINUSE:
            raise OptionError(f"Port {port} is taken.", remedy="Give another one with `--port`, or leave the option out.") from None
        raise OptionError(f"Port {port} can't be had: {(error.strerror or 'it fails').lower()}.", remedy="Leave `--port` out.") from None
    return made


async def serve(engine: Engine, start: Start, page: Path, told: Callable[[str], None], stop: asyncio.Event | None = None) -> None:
    """Run until a signal, or `stop`, ends it; `told` gets the address when it accepts connections. Raises SketchTreeError where it can't start."""
    journal = journal_of(start.file, home=start.folder)
    try:
        listening, guard = _door(start, journal.kept_key())
        with listening:
            await _serve(engine, start, page, told, stop or asyncio.Event(), journal, listening, guard)
    finally:
        journal.close()


async def _serve(engine: Engine, start: Start, page: Path, told, stop: asyncio.Event, journal: Journal, listening: socket.socket, guard: Guard) -> None:
    session = Session(engine, folder=Folder(start.folder))
    try:
        await engine.start()
        await _begin(session, journal, start)
        journal.keep_key(Key(guard.port, guard.token, str(start.folder)))
        try:
            await _run(Studio(session, page).app(guard), listening, lambda: told(guard.url), stop)
        finally:
            (session.desk.scribe.journal or journal).keep_key(None)  # another one by now, if it was saved under another name
    finally:
        await session.end()
        await engine.stop()


def _door(start: Start, left: Key | None) -> tuple[socket.socket, Guard]:
    """Where it listens, and who may come in. After a crash the pages that are still open may, if the port is free. Raises OptionError."""
    back = left if left is not None and left.folder == str(start.folder) and start.port in (0, left.port) else None
    if back is not None:
        try:
            return bound(back.port), Guard(back.port, back.token)
        except OptionError:
            if start.port:
                raise
    listening = bound(start.port)
    return listening, Guard(listening.getsockname()[1])


async def _begin(session: Session, journal: Journal, start: Start) -> None:
    """The first drawing: what an earlier session left, else the file, else an example. Raises SketchTreeError for a file that can't be read."""
    recovered = await asyncio.to_thread(journal.play)
    if recovered is not None:
        is_project = start.file is not None and start.file.suffix.lower() == PROJECT and start.file.exists()
        session.begin(journal=journal, recovered=recovered, saved_as=start.file.name if is_project else None)
        return
    if start.file is None:
        _aside(session, _example(session, journal, start.seed))
        return
    if not start.file.exists():
        session.begin(Document.blank(name=start.file.stem, seed=start.seed), journal=journal)
        return
    folder = session.desk.files.folder
    session.desk.files.signatures[start.file.name] = folder.signature(start.file.name)
    document = await filing.read(session.desk, await asyncio.to_thread(folder.read, start.file.name), start.file.name)
    session.begin(_seeded(document, start.seed), journal=journal, saved_as=start.file.name)


async def _example(session: Session, journal: Journal, seed: int) -> None:
    """An example to look at; without it, an empty page."""
    try:
        document = await filing.read(session.desk, examples.data(examples.FIRST), examples.FIRST)
    except SketchTreeError as error:
        session.desk.notes.append(trouble_of(error, "file"))
        document = Document.blank()
    session.begin(_seeded(document, seed), journal=journal, saved_as=examples.FIRST)


def _seeded(document: Document, seed: int) -> Document:
    return document.replace(seed=seed) if seed else document


def _aside(session: Session, work) -> None:
    task = asyncio.get_running_loop().create_task(work)
    session.desk.tasks.add(task)
    task.add_done_callback(session.desk.tasks.discard)


def _tells(record: logging.LogRecord) -> bool:
    """What a person at the terminal should see: faults, and not that pages were still asking when the program ended."""
    ended = record.exc_info is not None and isinstance(record.exc_info[1], asyncio.CancelledError)
    return not ended and "graceful shutdown" not in record.getMessage()


async def _run(app: ASGIApp, listening: socket.socket, told: Callable[[], None], stop: asyncio.Event) -> None:
    """Answer requests until a signal comes, or `stop`."""
    config = uvicorn.Config(
        app, http=Patient, loop="asyncio", lifespan="off", log_config=None, access_log=False, server_header=False, date_header=False, proxy_headers=False,
        ws="websockets-sansio", ws_max_size=MAX_MESSAGE, ws_per_message_deflate=False, ws_ping_interval=None, timeout_graceful_shutdown=_PATIENCE,
    )  # fmt: skip
    server = uvicorn.Server(config)
    logging.getLogger("uvicorn.error").addFilter(_tells)
    serving = asyncio.get_running_loop().create_task(server.serve(sockets=[listening]))
    while not server.started and not serving.done():
        await asyncio.sleep(0.005)
    if server.started:
        told()
    stopping = asyncio.get_running_loop().create_task(stop.wait())
    await asyncio.wait((serving, stopping), return_when=asyncio.FIRST_COMPLETED)
    stopping.cancel()
    server.should_exit = True
    await serving
