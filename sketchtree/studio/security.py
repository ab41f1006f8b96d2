"""Who may talk to the studio? Only pages that it served itself, opened by whoever has the address that it printed.

    Host       127.0.0.1 or localhost, with the right port: a foreign name that leads here (DNS rebinding) is refused
    Origin     of every POST and WebSocket the page's own: no other site can send anything
    token      random, in the address once; a redirect turns it into a cookie that no script can read and no other site sends

A studio that starts again after a crash takes the token that its pages have (`key`); after an end in order there is another one each time.

Every answer carries headers by which a browser loads and runs nothing but what comes from here, and keeps nothing.
"""

import secrets
from dataclasses import dataclass, field
from http.cookies import CookieError, SimpleCookie
from urllib.parse import parse_qs

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse, RedirectResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

ADDRESS = "127.0.0.1"
_REFUSED = "Not allowed. Open the address that `sketchtree studio` printed.\n"


@dataclass(frozen=True)
class Guard:
    """What a request must bring. `port` is the studio's own."""

    port: int
    token: str = field(default_factory=lambda: secrets.token_urlsafe(32), repr=False)  # `key.Key` keeps it

    @property
    def url(self) -> str:
        """The address to open."""
        return f"http://{ADDRESS}:{self.port}/?token={self.token}"

    @property
    def hosts(self) -> tuple[str, str]:
        """What `Host` may be."""
        return f"{ADDRESS}:{self.port}", f"localhost:{self.port}"

    @property
    def cookie(self) -> str:
        """Name of the cookie: cookies know no ports, and two studios may be open."""
        return f"sketchtree-{self.port}"

    def knows(self, token: str | None) -> bool:
        """Is it the token? Takes as long whatever it is."""
        return secrets.compare_digest((token or "").encode(), self.token.encode())

    def policy(self, host: str) -> str:
        """Content-Security-Policy."""
        return (
            f"default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self' ws://{host}; worker-src 'self' blob:; "
            "frame-ancestors 'none'; base-uri 'none'; form-action 'none'"
        )


class Guarded:
    """An application that lets nobody else in."""

    def __init__(self, app: ASGIApp, guard: Guard):
        self._app, self._guard = app, guard

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """ASGI."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        if not self._may(scope, headers):
            await self._refuse(scope, receive, send)
        elif scope["type"] == "websocket":
            await self._app(scope, receive, send)
        elif "token" in (query := parse_qs(scope["query_string"].decode("latin-1"))) and scope["path"] == "/":
            answer = self._let_in() if self._guard.knows(query["token"][0]) else PlainTextResponse(_REFUSED, 403)
            await answer(scope, receive, self._sealed(headers["host"], send))
        elif not self._guard.knows(_cookie(headers, self._guard.cookie)):
            await self._refuse(scope, receive, send)
        else:
            await self._app(scope, receive, self._sealed(headers["host"], send))

    def _may(self, scope: Scope, headers: Headers) -> bool:
        """By `Host` and `Origin`; a WebSocket by its cookie too."""
        hosts = headers.getlist("host")
        if len(hosts) != 1 or hosts[0] not in self._guard.hosts:
            return False
        if scope["type"] == "http" and scope["method"] in ("GET", "HEAD"):
            return True
        if headers.getlist("origin") != [f"http://{hosts[0]}"]:
            return False
        return scope["type"] == "http" or self._guard.knows(_cookie(headers, self._guard.cookie))

    async def _refuse(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "websocket":
            await send({"type": "websocket.close", "code": 1008})
            return
        await PlainTextResponse(_REFUSED, 403)(scope, receive, self._sealed(self._guard.hosts[0], send))

    def _let_in(self) -> RedirectResponse:
        answer = RedirectResponse("/", 303)
        answer.set_cookie(self._guard.cookie, self._guard.token, httponly=True, samesite="strict", path="/")
        return answer

    def _sealed(self, host: str, send: Send) -> Send:
        """`send`, with the headers that every answer has."""

        async def sealed(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                headers["Content-Security-Policy"] = self._guard.policy(host)
                headers["X-Content-Type-Options"] = "nosniff"
                headers["Cache-Control"] = "no-store"
                headers["Referrer-Policy"] = "no-referrer"
                headers["Cross-Origin-Opener-Policy"] = "same-origin"
                headers["Cross-Origin-Resource-Policy"] = "same-origin"
            await send(message)

        return sealed


def _cookie(headers: Headers, name: str) -> str | None:
    try:
        found = SimpleCookie(headers.get("cookie", "")).get(name)
    except CookieError:
        return None
    return None if found is None else found.value
