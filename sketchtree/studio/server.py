"""What does the browser ask for, and what does it get?

    /  /assets/…                          the page, as it was built
    /ws                                   messages (`messages`)
    /texture/KEY/MAP.png                  what the tree wears
    /picture/WHAT/NAME.png                thumbnails
    /underlay/DIGEST                      the picture to trace over
    /cloud/DIGEST                         the points behind the drawing
    POST /upload?name=&as=&tree=&up=&unit=&height=   a drawing, project or point cloud to open; a picture to trace over, to mark a tree in, or to read strokes from; points to draw over
    POST /export                          the tree, as files, or its growth; hanging up stops their making
    POST /growth                          the tree as it grows, an animated GLB, likewise
    /download  /marks  /command?export=   the project; the strokes that mark the photo, as SVG; the command line that makes the same as that export
"""

import asyncio
import contextlib
import re
from collections.abc import Mapping
from pathlib import Path

import msgspec
from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import FileResponse, PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp
from starlette.websockets import WebSocket, WebSocketDisconnect

from sketchtree.editing.document import Document
from sketchtree.errors import SeveralTrees, SketchTreeError
from sketchtree.studio import exports, filing, messages
from sketchtree.studio.engine import Tell, untold
from sketchtree.studio.folder import PROJECT, is_name
from sketchtree.studio.growth import Growing
from sketchtree.studio.security import Guard, Guarded
from sketchtree.studio.session import Session
from sketchtree.studio.underlays import kind_of

_REQUEST = msgspec.json.Decoder(messages.Request)
_EXPORT = msgspec.json.Decoder(exports.Export)
_GROWING = msgspec.json.Decoder(Growing)
_SMALL = 10_000  # bytes of a request that says what to export
_PAUSE = 0.1  # seconds between two tellings of how far something is
_KEY = re.compile(r"[A-Za-z0-9_.:-]{1,120}")
_KINDS = {
    ".html": "text/html; charset=utf-8", ".js": "text/javascript; charset=utf-8", ".css": "text/css; charset=utf-8", ".svg": "image/svg+xml",
    ".png": "image/png", ".woff2": "font/woff2", ".json": "application/json", ".wasm": "application/wasm", ".map": "application/json",
}  # fmt: skip


class Unread(SketchTreeError):
    """What a page asks can't be read."""


class Studio:
    """The routes of one session."""

    def __init__(self, session: Session, page: Path):
        self._session = session
        self._pages = {path.relative_to(page).as_posix(): path for path in sorted(page.rglob("*")) if path.is_file() and path.suffix in _KINDS}
        self._exporting = asyncio.Lock()  # one after the other

    def app(self, guard: Guard) -> ASGIApp:
        """The application, which lets in whom the guard does."""
        routes = [
            Route("/", self._index),
            Route("/texture/{key}/{name}.png", self._texture),
            Route("/picture/{what}/{name}.png", self._picture),
            Route("/underlay/{digest}", self._underlay),
            Route("/cloud/{digest}", self._cloud),
            Route("/upload", self._upload, methods=["POST"]),
            Route("/export", self._export, methods=["POST"]),
            Route("/growth", self._growth, methods=["POST"]),
            Route("/download", self._download),
            Route("/marks", self._marks),
            Route("/command", self._command),
            WebSocketRoute("/ws", self._socket),
            Route("/{path:path}", self._file),
        ]
        handlers = {HTTPException: _not_so, SketchTreeError: _cannot, Unread: _unread}
        return Guarded(Starlette(routes=routes, exception_handlers=handlers), guard)

    # The page

    async def _index(self, request: Request) -> Response:
        return self._built("index.html")

    async def _file(self, request: Request) -> Response:
        return self._built(request.path_params["path"])

    def _built(self, name: str) -> Response:
        """A file of the built page: one of those that were there at the start, and no other."""
        path = self._pages.get(name)
        if path is None:
            raise HTTPException(404)
        return FileResponse(path, media_type=_KINDS[path.suffix])

    # Messages

    async def _socket(self, socket: WebSocket) -> None:
        await socket.accept()
        page = self._session.join(lambda said: _send(socket, said))
        page.sender.add_done_callback(lambda sender: sender.cancelled() or _aside(_hang_up(socket)))
        try:
            while True:
                received = await socket.receive()
                if received["type"] == "websocket.disconnect":
                    return
                await self._take(page, received.get("text") or received.get("bytes") or b"")
        except WebSocketDisconnect:
            return
        finally:
            self._session.leave(page)

    async def _take(self, page, said: str | bytes) -> None:
        try:
            request = _REQUEST.decode(said)
        except (msgspec.MsgspecError, UnicodeError, RecursionError) as error:
            what = str(error)[:300]
            page.outbox.put(messages.Trouble(message=f"A message of the page can't be read: {what}.", remedy="Load the page again.", about="message"))
            return
        await self._session.take(page, request)

    # Pictures

    async def _texture(self, request: Request) -> Response:
        return await self._png(self._session.desk.engine.texture, request.path_params["key"], request.path_params["name"])

    async def _picture(self, request: Request) -> Response:
        return await self._png(self._session.desk.engine.picture, request.path_params["what"], request.path_params["name"])

    async def _png(self, source, first: str, second: str) -> Response:
        if not (_KEY.fullmatch(first) and (_KEY.fullmatch(second) or is_name(second))):
            raise HTTPException(404)
        data = await source(first, second)
        if data is None:
            raise HTTPException(404)
        return Response(data, media_type="image/png")

    async def _underlay(self, request: Request) -> Response:
        picture = self._session.desk.pictures.get(request.path_params["digest"])
        kind = None if picture is None else kind_of(picture)
        if kind is None:
            raise HTTPException(404)
        return Response(picture, media_type=kind)

    async def _cloud(self, request: Request) -> Response:
        cloud = self._session.desk.clouds.get(request.path_params["digest"])
        if cloud is None:
            raise HTTPException(404)
        return Response(cloud.points, media_type="application/octet-stream")

    # Files

    async def _upload(self, request: Request) -> Response:
        name, use = request.query_params.get("name", ""), request.query_params.get("as", "drawing")
        if use not in ("drawing", "underlay", "photo", "cloud"):
            raise HTTPException(400)
        reading = _reading(request.query_params)
        data = await _body(request, messages.MAX_UPLOAD)
        desk = self._session.desk
        await desk.ready.wait()
        if use == "underlay":
            await filing.trace(desk, data, name if is_name(name) else "This file")
        elif use == "photo":
            await filing.open_photo(desk, data, name if is_name(name) else "This file")
        elif use == "cloud":
            await filing.lay(desk, data, name, reading)
        else:
            await filing.open_bytes(desk, data, name, reading)
        return _json({"revision": desk.revision})

    async def _export(self, request: Request) -> Response:
        wanted = _read(_EXPORT, await _body(request, _SMALL), "What to export")
        desk = self._session.desk
        await desk.ready.wait()
        document = desk.document
        files = await _while_heard(request, self._exported(document, wanted, self._teller(wanted.id)))
        if len(files) == 1:
            ((name, data),) = files.items()
            return _attachment(name, data)
        return _attachment(document.name + ".zip", await asyncio.to_thread(exports.zipped, files))

    async def _exported(self, document: Document, wanted: exports.Export, tell: Tell) -> dict[str, bytes]:
        name, engine = document.name + wanted.format, self._session.desk.engine
        if wanted.growth is not None:
            return await engine.moving(document, name, wanted.tree, wanted.growth, tell)
        of_photo = wanted.tree == "photo" and wanted.format != PROJECT  # a project keeps the photo and its strokes
        async with self._exporting:
            return await (engine.grown if of_photo else engine.export)(document, name, wanted.options, tell)

    def _teller(self, name: str | None) -> Tell:
        """Tells pages how far something is that goes by that id."""
        if name is None:
            return untold
        loop, told = asyncio.get_running_loop(), float("-inf")

        def tell(stage: str, done: float) -> None:
            nonlocal told
            if loop.time() - told >= _PAUSE:
                told = loop.time()
                self._session.desk.tell(messages.Making(id=name, stage=stage, done=min(max(float(done), 0.0), 1.0)))

        return tell

    async def _growth(self, request: Request) -> Response:
        wanted = _read(_GROWING, await _body(request, _SMALL), "How the tree is to grow")
        desk = self._session.desk
        await desk.ready.wait()
        revision = desk.revision
        data = await _while_heard(request, desk.engine.aged(desk.document, wanted, self._teller(wanted.id)))
        return Response(data, media_type="model/gltf-binary", headers={"X-Revision": str(revision)})

    async def _download(self, request: Request) -> Response:
        await self._session.desk.ready.wait()
        document = self._session.document
        return _attachment(document.name + PROJECT, await self._session.desk.engine.project(document))

    async def _marks(self, request: Request) -> Response:
        await self._session.desk.ready.wait()
        document = self._session.document
        return _attachment(document.name + ".svg", await self._session.desk.engine.marks(document))

    async def _command(self, request: Request) -> Response:
        await self._session.desk.ready.wait()
        wanted = _read(_EXPORT, request.query_params.get("export", '{"format": ".glb"}'), "What to export")
        return PlainTextResponse(exports.command_line(self._session.document, wanted))


def _reading(said: Mapping[str, str]) -> messages.CloudReading:
    """How points are to be read, as an address says it. Raises Unread."""
    try:
        return msgspec.convert({name: said[name] for name in messages.CloudReading.__struct_fields__ if said.get(name)}, messages.CloudReading, strict=False)
    except msgspec.ValidationError as error:
        what, _, name = str(error).partition(" - at `$.")
        raise Unread(f"The cloud's {name.rstrip('`') or 'reading'} can't be that: {what[:1].lower()}{what[1:]}.", remedy="Choose another value.") from error


def _read(decoder: msgspec.json.Decoder, said: bytes | str, what: str):
    """What a page asks. Raises Unread."""
    try:
        return decoder.decode(said)
    except (msgspec.MsgspecError, UnicodeError, RecursionError) as error:
        raise Unread(f"{what} can't be read: {str(error)[:300]}.", remedy="Load the page again.") from error


async def _send(socket: WebSocket, said: str | bytes) -> None:
    """Raises ConnectionError where the page is gone."""
    try:
        await (socket.send_bytes(said) if isinstance(said, bytes) else socket.send_text(said))
    except (WebSocketDisconnect, RuntimeError) as error:
        raise ConnectionError from error


async def _hang_up(socket: WebSocket) -> None:
    """A page that can't be told anything must not wait for it: it opens another line, and is told everything there."""
    with contextlib.suppress(WebSocketDisconnect, RuntimeError):
        await socket.close(1011)


_asides: set[asyncio.Task] = set()


def _aside(work) -> None:
    task = asyncio.get_running_loop().create_task(work)
    _asides.add(task)
    task.add_done_callback(_asides.discard)


async def _while_heard(request: Request, work):
    """What comes of the work, which ends when whoever asked hangs up."""
    working = asyncio.ensure_future(work)
    gone = asyncio.ensure_future(_hangs_up(request))
    try:
        await asyncio.wait((working, gone), return_when=asyncio.FIRST_COMPLETED)
        if not working.done():
            raise HTTPException(499)
        return working.result()
    finally:
        gone.cancel()
        working.cancel()


async def _hangs_up(request: Request) -> None:
    while (await request.receive())["type"] != "http.disconnect":
        pass


async def _body(request: Request, most: int) -> bytes:
    """The body, which is not read on where it is too long."""
    length = request.headers.get("content-length", "0")
    if not length.isdecimal() or int(length) > most:
        raise HTTPException(413)
    whole = bytearray()
    async for part in request.stream():
        whole += part
        if len(whole) > most:
            raise HTTPException(413)
    return bytes(whole)


def _attachment(name: str, data: bytes) -> Response:
    return Response(data, media_type="application/octet-stream", headers={"Content-Disposition": exports.disposition(name)})


def _json(what: dict, status: int = 200) -> Response:
    return Response(msgspec.json.encode(what), status, media_type="application/json")


_SAID = {400: "That was not asked rightly.", 404: "There is nothing here.", 405: "That can't be done here.", 413: "That is too large."}


async def _not_so(request: Request, error: HTTPException) -> Response:
    """Nothing of what was asked is said again."""
    if error.status_code == 413:
        return _json({"message": f"The file is too large: {messages.MAX_UPLOAD / 1e6:.0f} MB is the most.", "remedy": "Choose a smaller one."}, 413)
    return PlainTextResponse(_SAID.get(error.status_code, "That does not work.") + "\n", error.status_code, headers=error.headers)


async def _cannot(request: Request, error: SketchTreeError) -> Response:
    several = {"trees": list(error.trees)} if isinstance(error, SeveralTrees) else {}
    return _json({"message": error.message, "remedy": error.remedy} | several, 422)


async def _unread(request: Request, error: Unread) -> Response:
    return _json({"message": error.message, "remedy": error.remedy}, 400)
