"""The studio's server on a real port, on a thread, with an engine that makes nothing."""

import asyncio
import threading
from contextlib import closing, contextmanager
from http.client import HTTPConnection
from pathlib import Path

import httpx
from fake_engine import FakeEngine
from websockets.sync.client import connect

from sketchtree.studio import messages
from sketchtree.studio.outbox import encode
from sketchtree.studio.serving import Start, serve


class Running:
    """What a browser knows of it."""

    def __init__(self, url: str, engine: FakeEngine, folder: Path):
        self.url, self.engine, self.folder = url, engine, folder
        self.base, _, self.token = url.partition("/?token=")
        self.host = self.base.removeprefix("http://")
        self.port = int(self.host.rpartition(":")[2])
        self.cookie = f"sketchtree-{self.port}={self.token}"

    def get(self, path: str, **headers) -> httpx.Response:
        return self.ask("GET", path, **headers)

    def post(self, path: str, data=b"", **headers) -> httpx.Response:
        return self.ask("POST", path, data, **({"Origin": self.base} | headers))

    def ask(self, method: str, path: str, data=None, **headers) -> httpx.Response:
        """A request with the cookie; a header that is None is left out."""
        headers = {name.replace("_", "-"): value for name, value in ({"Cookie": self.cookie} | headers).items() if value is not None}
        with httpx.Client(base_url=self.base, trust_env=False) as client:
            return client.request(method, path, content=data, headers=headers)

    def raw(self, path: str, method: str = "GET", **headers: str) -> tuple[int, str]:
        """Status and body of a request, without a body, that no client has tidied."""
        with closing(HTTPConnection(self.host, timeout=10)) as connection:
            connection.putrequest(method, path, skip_host=True)
            for name, value in {"Host": self.host, "Cookie": self.cookie, "Origin": self.base, **headers}.items():
                connection.putheader(name.replace("_", "-"), value)
            connection.endheaders()
            answer = connection.getresponse()
            return answer.status, answer.read().decode()

    @contextmanager
    def page(self, **options):
        """A WebSocket, as the page opens it."""
        headers = {"Cookie": self.cookie, **options.pop("headers", {})}
        with connect(f"ws://{self.host}/ws", origin=options.pop("origin", self.base), additional_headers=headers, proxy=None, max_size=None, **options) as socket:
            yield socket

    def hello(self, socket) -> None:
        socket.send(encode(messages.Hello(version=messages.VERSION)))


@contextmanager
def running(folder: Path, file: Path | None = None, port: int = 0, page: Path | None = None):
    """The server, until the block ends; with `page` of the one that was built, else with one in which there is nothing."""
    page = page or _empty_page(folder / "built")
    (folder / "secret.js").write_text("secret")
    engine, told, fault, up = FakeEngine(), [], [], threading.Event()
    loop, stop = asyncio.new_event_loop(), asyncio.Event()

    def work():
        try:
            loop.run_until_complete(serve(engine, Start(file, folder, port=port), page, lambda url: (told.append(url), up.set()), stop))
        except BaseException as error:
            fault.append(error)
        finally:
            up.set()
            loop.close()

    thread = threading.Thread(target=work)
    thread.start()
    up.wait(30)
    if fault:
        thread.join(30)
        raise fault[0]
    try:
        yield Running(told[0], engine, folder)
    finally:
        loop.call_soon_threadsafe(stop.set)
        thread.join(30)


def _empty_page(page: Path) -> Path:
    (page / "assets").mkdir(parents=True, exist_ok=True)
    (page / "index.html").write_text("<!doctype html><title>page</title>")
    (page / "assets" / "page-1.js").write_text("export {};")
    return page
