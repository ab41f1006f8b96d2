"""Which program is this, exactly? Two with one fingerprint make the same exemplars of the same recipes."""

import hashlib
from functools import cache
from pathlib import Path

import numpy as np

from sketchtree.version import __version__


@cache
def fingerprint() -> str:
    """A hash of the version, of numpy's, and of every source file of the package: in a checkout the version alone doesn't change."""
    folder = Path(__file__).resolve().parents[2]
    whole = hashlib.sha256(f"{__version__} {np.__version__}".encode())
    for path in sorted(folder.rglob("*.py")):
        whole.update(path.relative_to(folder).as_posix().encode() + b"\0" + path.read_bytes().replace(b"\r\n", b"\n"))
    return whole.hexdigest()


def same_program(other: str) -> bool:
    """Whether this is the program with the fingerprint `other`: what a worker is asked."""
    return fingerprint() == other
