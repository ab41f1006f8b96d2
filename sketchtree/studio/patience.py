"""How long may someone take to say what he wants? Whoever only opens connections, or sends a request letter by letter, is not waited for.

uvicorn waits for ever until the head of a request is there; so many of them, opened by any program of this machine, would leave no connection for the page.
"""

import asyncio

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

SECONDS = 20.0  # until the head of a request must be there


class Patient(H11Protocol):
    """HTTP as uvicorn speaks it, with an end to its patience."""

    _timer: asyncio.TimerHandle | None = None

    def connection_made(self, transport) -> None:
        """asyncio."""
        super().connection_made(transport)
        self._wait()

    def connection_lost(self, exc) -> None:
        """asyncio."""
        self._leave()
        super().connection_lost(exc)

    def on_response_complete(self) -> None:
        """uvicorn: the next request may come."""
        super().on_response_complete()
        self._wait()

    def handle_websocket_upgrade(self, event) -> None:
        """uvicorn: a WebSocket takes over."""
        self._leave()
        super().handle_websocket_upgrade(event)

    def _wait(self) -> None:
        self._leave()
        self._timer = self.loop.call_later(SECONDS, self._out)

    def _leave(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _out(self) -> None:
        if self.conn.their_state is h11.IDLE and not self.transport.is_closing():
            self.transport.abort()
