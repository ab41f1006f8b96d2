"""What if the program ends suddenly? Every step is in a journal before it is answered, and the next start plays it.

One journal a project, in the user's own data folder (`SKETCHTREE_RECOVERY` names another). It begins with the first step after the project was saved,
so that a drawing which is safe in its file has none. Nothing is ever deleted that was not saved: what can't be read is set aside under another name.
"""

import contextlib
import errno
import hashlib
import os
import re
import shutil
from dataclasses import dataclass
from pathlib import Path

import msgspec
from platformdirs import user_data_dir

from sketchtree.editing.document import Document
from sketchtree.errors import SketchTreeError
from sketchtree.studio import journal_lines as lines
from sketchtree.studio import key as keys
from sketchtree.studio.change import change
from sketchtree.studio.history import History
from sketchtree.studio.locking import Lock, same_file

_UNTITLED = 20  # drawings without a name that may be open at once


class StudioError(SketchTreeError):
    """The studio can't start, or can't do what it was asked."""


@dataclass(frozen=True, eq=False)
class Recovered:
    """What a journal gave."""

    history: History
    saved_state: int | None  # which state is as in the file
    signature: tuple[int, int] | None  # of the file then
    pictures: dict[str, bytes]  # that were traced over, by digest


def shelf() -> Path:
    """The folder of journals, made if it is missing. Raises StudioError."""
    folder = Path(os.environ.get("SKETCHTREE_RECOVERY") or Path(user_data_dir("sketchtree", appauthor=False)) / "recovery")
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    except OSError as error:
        raise _cannot_keep(folder, error) from error
    return folder


def journal_of(project: Path | None, *, home: Path | None = None) -> "Journal":
    """The journal of a project file, or of a drawing without one, which nobody else has open; rather that of a studio that ran in `home`. Raises StudioError."""
    folder = shelf()
    try:
        return _journal_in(folder, project, home)
    except OSError as error:
        raise _cannot_keep(folder, error) from error


def _cannot_keep(folder: Path, error: OSError) -> StudioError:
    why = (error.strerror or "it fails").lower()
    return StudioError(f"Can't keep the studio's journal in {folder}: {why}.", remedy="Name a folder you may write to in SKETCHTREE_RECOVERY.")


def _journal_in(folder: Path, project: Path | None, home: Path | None) -> "Journal":
    if project is not None:
        place = os.path.abspath(project).encode(errors="surrogateescape")
        path = folder / f"{re.sub(r'[^A-Za-z0-9_-]', '_', project.stem)[:40]}-{hashlib.sha256(place).hexdigest()[:16]}.jsonl"
        lock = Lock.taken(path.with_suffix(".lock"))
        if lock.holder is not None:
            raise StudioError(f"{project.name} is open in another studio (process {lock.holder}).", remedy="Go on there, or stop it and start again.")
        return Journal(path, lock, project)
    return _untitled(folder, home)


def _untitled(folder: Path, home: Path | None) -> "Journal":
    """Of a drawing without a name: one that ended suddenly, in this folder or else in another; else a new one."""

    def elsewhere(path: Path) -> bool:
        key = keys.kept(path.with_suffix(".key"))
        return key is None or key.folder != str(home)

    paths = [folder / ("untitled.jsonl" if number == 1 else f"untitled-{number}.jsonl") for number in range(1, _UNTITLED + 1)]
    for path in sorted(paths, key=lambda path: (elsewhere(path), not path.exists())):
        lock = Lock.taken(path.with_suffix(".lock"))
        if lock.holder is None:
            return Journal(path, lock)
    raise StudioError(f"{_UNTITLED} studios are open already.", remedy="Stop one of them.")


class Journal:
    """One file of lines; only one program has it open. `write` may be called on another thread, one call at a time."""

    def __init__(self, path: Path, lock: Lock, project: Path | None = None):
        self.path, self.project = path, project
        self.notes: list[str] = []  # what the user is to know
        self.key: keys.Key | None = None  # lies beside it while the studio runs
        self._lock = lock
        self._file = None
        self._good = 0  # bytes of it that are whole lines
        self._pictures: set[str] = set()

    @property
    def holds_something(self) -> bool:
        """Is there anything to recover?"""
        return self.path.exists() and self.path.stat().st_size > 0

    def play(self) -> Recovered | None:
        """All that is in it; None: nothing. The journal goes on after the last line that can be read."""
        if not self.holds_something:
            return None
        player, good = _Player(), 0
        data = self.path.read_bytes()
        while good < len(data):
            end = data.find(b"\n", good)
            if end < 0 or not player.takes(data[good:end]):
                break
            good = end + 1
        if good < len(data) and data.find(b"\n", good) >= 0:  # more than a last line that was being written
            self._set_aside(whole=player.history is None)
        self._file, self._good = _opened(self.path), good
        self._file.truncate(good)
        self._pictures = set(player.pictures)
        return None if player.history is None or not player.steps else Recovered(player.history, 0 if player.saved else None, player.signature, player.pictures)

    def write(self, *what: lines.Line) -> None:
        """Lines, on the disk when this returns. Raises OSError: then none of them is in the file."""
        known = frozenset(self._pictures)
        file = self._at_hand()
        try:
            for line in what:
                if isinstance(line, lines.Picture):
                    if line.digest in self._pictures:
                        continue
                    self._pictures.add(line.digest)
                _write_all(file, lines.encode(line))
            os.fsync(file.fileno())
        except OSError:
            self._pictures.intersection_update(known)
            with contextlib.suppress(OSError):  # else before the next line is written
                file.truncate(self._good)  # no line that is torn stands before others
            raise
        self._good = file.seek(0, os.SEEK_END)

    def clear(self) -> None:
        """All of it is safe elsewhere. Where it can't be removed nothing is wrong: the next first line begins it anew."""
        file, self._file, self._good = self._file, None, 0
        self._pictures.clear()
        with contextlib.suppress(OSError), file or contextlib.nullcontext():
            if file is not None:
                file.truncate(0)
            self.path.unlink(missing_ok=True)

    def set_aside(self) -> None:
        """What is in it is of another drawing: it is kept under another name."""
        with contextlib.suppress(OSError):  # where it can't be kept it stays
            if self.holds_something:
                self._set_aside(whole=True)
            self.clear()

    def close(self) -> None:
        """Another program may have it."""
        if self._file is not None:
            self._file.close()
            self._file = None
        self._lock.free()

    def keep_key(self, key: keys.Key | None) -> None:
        """By this key a page finds the studio again, should it end suddenly; None: it ends in order."""
        self.key, path = key, self.path.with_suffix(".key")
        keys.drop(path) if key is None else keys.keep(path, key)

    def kept_key(self) -> keys.Key | None:
        """That of a studio that ended suddenly."""
        return keys.kept(self.path.with_suffix(".key"))

    def _at_hand(self):
        """The file, at its end. Where it is gone, alone or with its folder, it is made again, with all that was in it. Raises OSError."""
        if self._file is None:
            self._back_on_shelf()
            self._file = _opened(self.path)
            self._good = self._file.seek(0, os.SEEK_END)
        elif not same_file(self.path, self._file.fileno()):
            self._back_on_shelf()
            self._file = self._copied(self._file)
        if self._file.seek(0, os.SEEK_END) != self._good:
            self._file.truncate(self._good)
            self._file.seek(0, os.SEEK_END)
        return self._file

    def _back_on_shelf(self) -> None:
        """The folder is there, with our lock in it."""
        self.path.parent.mkdir(mode=0o700, exist_ok=True)
        if not self._lock.holds():
            raise OSError(errno.EBUSY, "another studio has the drawing's journal")
        if self.key is not None and not self.path.with_suffix(".key").exists():
            self.keep_key(self.key)

    def _copied(self, file):
        """All that was written, in a file that is there; what stands in its place is kept."""
        path = self.path.with_suffix(".again")
        path.unlink(missing_ok=True)
        again = _opened(path)
        try:
            file.seek(0)
            shutil.copyfileobj(file, again)
            os.fsync(again.fileno())
            if self.holds_something:
                self._set_aside(whole=True)
            os.replace(path, self.path)
        except OSError:
            again.close()
            raise
        file.close()
        return again

    def _set_aside(self, *, whole: bool) -> None:
        kept = next(path for number in range(1, 10_000) if not (path := self.path.with_suffix(f".kept-{number}.jsonl")).exists())
        shutil.copyfile(self.path, kept)
        which = "A journal of an earlier session" if whole else "The last part of a journal of an earlier session"
        self.notes.append(f"{which} can't be read; it is kept as {kept}.")


def _opened(path: Path):
    """A file to read, and to write at its end; its owner's alone."""
    return open(path, "a+b", buffering=0, opener=lambda path, flags: os.open(path, flags, 0o600))


def _write_all(file, data: bytes) -> None:
    rest = memoryview(data)
    while rest:
        rest = rest[file.write(rest) :]


class _Player:
    """Does again what the lines say."""

    def __init__(self):
        self.history: History | None = None
        self.saved = False
        self.signature: tuple[int, int] | None = None
        self.pictures: dict[str, bytes] = {}
        self.steps = 0

    def takes(self, text: bytes) -> bool:
        """Does one line again; False: it can't be read, or makes no sense here."""
        try:
            return self._do(lines.decode(text))
        except (msgspec.MsgspecError, SketchTreeError, KeyError, ValueError, TypeError, RecursionError):
            return False

    def _do(self, line: lines.Line) -> bool:
        if isinstance(line, lines.Picture):
            self.pictures[line.digest] = line.data
            return True
        if isinstance(line, lines.Begin):
            if line.version != lines.VERSION:
                return False
            self.history, self.steps = History(lines.differing(Document(), line.document, self.pictures)), 0
            self.saved, self.signature = line.saved, line.signature
            return True
        if self.history is None:
            return False
        return self._go_on(self.history, line)

    def _go_on(self, history: History, line: lines.Line) -> bool:
        if isinstance(line, lines.Back | lines.On):
            return history.undo() if isinstance(line, lines.Back) else history.redo()
        document = lines.differing(history.document, line.different, self.pictures)
        if isinstance(line, lines.Step):
            if line.merges and history.undo_label is None:
                return False
            history.put(change(history.document, document), line.label, merges=line.merges)
            self.steps += 1
        else:
            history.keep(document)
        return True
