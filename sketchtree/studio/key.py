"""How does a page that was open find the studio again after a crash? The next start takes the same port and the same key, if they are there for it.

The key lies beside the journal for as long as the studio runs, readable by its owner alone, and goes when the studio ends in order: what is found there is of
one that did not. It is taken up only by a studio of the same folder and drawing, on the same port.
"""

import contextlib
import os
import re
import stat
from pathlib import Path

import msgspec

_TOKEN = re.compile(r"[A-Za-z0-9_-]{43}")
_LONGEST = 10_000  # bytes


class Key(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a page needs to come back."""

    port: int
    token: str
    folder: str  # the studio's own


def kept(path: Path) -> Key | None:
    """The key that a studio left which did not end in order. One that is not this user's own, or that others might have read, counts for nothing."""
    try:
        descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0))
        with open(descriptor, "rb") as file:
            found = _DECODER.decode(file.read(_LONGEST)) if _is_own(os.fstat(descriptor)) else None
    except (OSError, msgspec.MsgspecError, UnicodeError):
        return None
    return found if found is not None and 0 < found.port < 65536 and _TOKEN.fullmatch(found.token) else None


def keep(path: Path, key: Key) -> None:
    """In the place of any that is there. A studio that can't keep its key runs without."""
    drop(path)
    with contextlib.suppress(OSError):
        descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_NOFOLLOW", 0), 0o600)
        with open(descriptor, "wb") as file:
            file.write(msgspec.json.encode(key))


def drop(path: Path) -> None:
    """Nobody comes back with it."""
    with contextlib.suppress(OSError):
        path.unlink()


def _is_own(found: os.stat_result) -> bool:
    if not stat.S_ISREG(found.st_mode):
        return False
    return not hasattr(os, "getuid") or (found.st_uid == os.getuid() and not found.st_mode & 0o077)


_DECODER = msgspec.json.Decoder(Key)
