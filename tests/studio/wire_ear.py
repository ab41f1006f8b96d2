"""A page without a screen: it says what it is told to, and keeps what the program says."""

import json
import struct
import threading
import time
from collections import Counter
from collections.abc import Callable
from contextlib import ExitStack
from urllib.parse import urlsplit

PATIENCE = 90.0


class Ear:
    """Connected as a page is, with the cookie of one."""

    def __init__(self, address: str, cookies: list[dict]):
        from websockets.sync.client import connect

        place = urlsplit(address).netloc
        cookie = "; ".join(f"{one['name']}={one['value']}" for one in cookies)
        self._open = ExitStack()
        self._line = self._open.enter_context(
            connect(f"ws://{place}/ws", additional_headers={"Cookie": cookie}, origin=f"http://{place}", max_size=None, compression=None)
        )
        self._changed = threading.Condition()
        self._strokes: dict[str, dict] = {}
        self._others: dict = {"options": {}, "edits": [], "underlay": None}
        self._limbs: list[dict] = []
        self._chunks: dict[str, dict] = {}
        self._counts: Counter = Counter()
        self._latest: dict[str, dict] = {}
        self._heard = 0.0
        threading.Thread(target=self._listen, daemon=True).start()
        self.ask({"type": "hello", "version": 1})
        self.wait(lambda: self._counts["changed"] > 0, "the drawing")

    def ask(self, request: dict) -> None:
        self._line.send(json.dumps(request))

    def throw(self, anything: str | bytes) -> None:
        """Something that is no request."""
        self._line.send(anything)

    def close(self) -> None:
        self._open.close()

    def sync(self) -> None:
        """Until what was said before was heard: the program works in order."""
        seen = self._counts["trouble"]
        self.ask({"type": "open", "name": "no such file.svg"})
        self.wait(lambda: self._counts["trouble"] > seen, "an answer")

    def wait(self, holds: Callable[[], bool], what: str, patience: float = PATIENCE) -> None:
        end = time.monotonic() + patience
        with self._changed:
            while not holds():
                if not self._changed.wait(min(0.5, max(0.0, end - time.monotonic()))) and time.monotonic() > end:
                    raise AssertionError(f"{what} did not come; heard {dict(self._counts)}")

    def count(self, kind: str) -> int:
        return self._counts[kind]

    @property
    def quiet(self) -> bool:
        """The program has nothing to do."""
        return self._latest.get("working", {}).get("state") == "idle"

    @property
    def strokes(self) -> list[dict]:
        return list(self._strokes.values())

    @property
    def options(self) -> dict:
        return self._others["options"]

    @property
    def edits(self) -> dict[str, dict]:
        """What was done by hand, by limb id."""
        return {one["limb"]: one for one in self._others["edits"]}

    def latest(self, kind: str) -> dict:
        """The newest event of a kind."""
        return self._latest[kind]

    @property
    def state(self) -> dict:
        """All that a project keeps."""
        return {"strokes": self.strokes, **self._others}

    @property
    def limbs(self) -> list[dict]:
        """All that were drawn or adopted, as the page walks through them."""
        return self._limbs

    @property
    def tree(self) -> dict:
        """The head of the newest whole tree."""
        return self._latest["full tree"]

    @property
    def undrawn(self) -> list[str]:
        """Limbs that nobody drew, the first of them the largest of their chunks."""
        owners = set(self.tree["owners"])
        return [name for owner in self.tree["owners"] for wood in self._chunks[owner]["wood"] for name in wood["limbs"] if name not in owners]

    @property
    def readings(self) -> list[dict]:
        """Of the newest `Alternatives`."""
        return self._latest.get("alternatives", {}).get("readings", [])

    @property
    def undo(self) -> str | None:
        """What undo would take back."""
        return self._latest["changed"]["undo"]

    def open(self, name: str) -> None:
        """A file of the folder takes the place of the drawing, and its tree is there."""
        self.ask({"type": "open", "name": name})
        self.rest()

    def put(self, *strokes: dict) -> None:
        """Strokes as the page sends them; their tree is there."""
        self.ask({"type": "strokes", "label": "branch", "put": list(strokes)})
        self.rest()

    def do(self, kind: str, **fields) -> None:
        """Anything else, and its tree is there."""
        self.ask({"type": kind, **fields})
        self.rest()

    def rest(self) -> None:
        """Until all that was said is done."""
        self.sync()
        self.wait(lambda: self.quiet, "rest")

    def limb_of(self, stroke: str) -> dict:
        """The limb that this stroke drew."""
        return next(limb for limb in self._limbs if stroke in limb["strokes"])

    def _listen(self) -> None:
        from websockets.exceptions import ConnectionClosed

        try:
            for said in self._line:
                event = json.loads(said) if isinstance(said, str) else json.loads(said[4 : 4 + struct.unpack_from("<I", said)[0]])
                with self._changed:
                    self._take(event)
                    self._changed.notify_all()
        except ConnectionClosed:
            pass

    def _take(self, event: dict) -> None:
        kind = event["type"]
        self._counts[kind] += 1
        self._latest[kind] = event
        if kind == "tree":
            self._take_tree(event)
        if kind != "changed":
            return
        if event["since"] == 0:
            self._strokes.clear()
        for name in event["gone"]:
            self._strokes.pop(name, None)
        self._strokes.update({stroke["id"]: stroke for stroke in event["put"]})
        if event["order"] is not None:
            self._strokes = {name: self._strokes[name] for name in event["order"]}
        self._others |= {name: event[name] for name in ("options", "edits", "trunk") if event[name] is not None}
        if event["underlay_changed"] or event["since"] == 0:
            self._others["underlay"] = event["underlay"]

    def _take_tree(self, event: dict) -> None:
        if event["phase"] in ("glance", "photo"):
            self._counts[event["phase"]] += 1
            return
        if event["limbs"] is not None:
            self._limbs = event["limbs"]
        self._chunks |= {chunk["owner"]: chunk for chunk in event["chunks"]}
        if event["phase"] == "full":
            self._latest["full tree"] = event
