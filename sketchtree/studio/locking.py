"""Has another program this open? A locked file says so, and whose it is; the system frees it when that program ends, however it does."""

import os
from pathlib import Path

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None


class Lock:
    """`holder` is None where it is ours, else the process that has it, as far as it is known."""

    def __init__(self, path: Path, descriptor: int | None, holder: str | None):
        self.path, self.holder = path, holder
        self._descriptor = descriptor

    @classmethod
    def taken(cls, path: Path) -> "Lock":
        """The lock, if nobody has it; else who."""
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o600)
        if not _locked(descriptor):
            holder = os.pread(descriptor, 20, 1).decode("ascii", "replace").strip() if hasattr(os, "pread") else ""
            os.close(descriptor)
            return cls(path, None, holder or "unknown")
        os.ftruncate(descriptor, 0)
        os.write(descriptor, f" {os.getpid()}\n".encode())
        return cls(path, descriptor, None)

    def holds(self) -> bool:
        """Is it ours still? Where its file is gone it is taken anew; False: another has it now. Raises OSError."""
        if self._descriptor is None or same_file(self.path, self._descriptor):
            return self._descriptor is not None
        again = Lock.taken(self.path)
        if again.holder is not None:
            return False
        os.close(self._descriptor)
        self._descriptor = again._descriptor
        return True

    def free(self) -> None:
        """Others may have it."""
        if self._descriptor is not None:
            os.close(self._descriptor)
            self._descriptor = None


def same_file(path: Path, descriptor: int) -> bool:
    """Is the file of that name the one that is open?"""
    try:
        return os.path.samestat(path.stat(), os.fstat(descriptor))
    except FileNotFoundError:
        return False


def _locked(descriptor: int) -> bool:
    """Locks the file for this process; False: another has it."""
    try:
        if fcntl is not None:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        else:
            import msvcrt

            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)  # its first byte, which holds nothing
    except OSError:
        return False
    return True
