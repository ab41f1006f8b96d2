"""How is work ended at once that can't be asked to end? It is done in a process of its own, which is killed.

COLMAP's steps run in compiled threads that look up only when a photo, or all photos, are done; Ctrl-C, and whoever does not want the work any more, would wait
for half a minute and longer. The process is a plain one: nothing of the program that asks is run again in it, so that a script needs no `if __name__ == …`.

    this process: (work, arguments) ─ stdin ─►  the other: work(*arguments, tell)
                  parts, answer or fault     ◄─ stdout, one pickle after the other; what compiled code prints goes where errors go

The other process leaves Ctrl-C to this one, and ends when this one is gone, however that came about: its stdin is then closed.
"""

import contextlib
import os
import pickle
import queue
import signal
import subprocess
import sys
import tempfile
import threading
import traceback
from collections.abc import Callable
from typing import IO

from sketchtree.watch import Pulse

_BEGIN = "import pickle, sys; sys.path[:] = pickle.load(sys.stdin.buffer); from sketchtree.multiview.apart import serve; serve()"
_BREATH = 0.1  # seconds between two pulses
_PART, _DONE, _FAULT, _ENDED = "part", "done", "fault", "ended"


class Lost(Exception):
    """The other process ended, or failed, before it had an answer. `str(lost)` says how; what it wrote is a note."""


def apart(work: Callable, *arguments, part: Callable[[float], None], pulse: Pulse):
    """What `work(*arguments, tell)` answers, a function of a module; what it tells goes to `part`. Whatever is raised here, by Ctrl-C or by `pulse`, ends it at once. Raises Lost."""
    heard = queue.SimpleQueue()
    with tempfile.TemporaryFile() as said:
        child = subprocess.Popen([sys.executable, "-P", "-c", _BEGIN], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=said)
        listener = threading.Thread(target=_listen, args=(child.stdout, heard), daemon=True)
        try:
            listener.start()
            with contextlib.suppress(OSError):  # it has ended already, as is heard below
                child.stdin.write(pickle.dumps(sys.path) + pickle.dumps((work, arguments)))
                child.stdin.flush()
            return _answer(heard, child, said, part, pulse)
        finally:
            child.kill()
            child.wait()
            listener.join()
            child.stdout.close()
            with contextlib.suppress(OSError):  # what it never read
                child.stdin.close()


def _answer(heard: queue.SimpleQueue, child: subprocess.Popen, said: IO[bytes], part: Callable[[float], None], pulse: Pulse):
    while True:
        pulse()
        try:
            what, value = heard.get(timeout=_BREATH)
        except queue.Empty:
            continue
        if what == _PART:
            part(value)
        elif what == _DONE:
            return value
        else:
            raise _lost(value if what == _FAULT else _end_of(child.wait()), said)


def _listen(pipe: IO[bytes], heard: queue.SimpleQueue) -> None:
    try:
        while True:
            heard.put(pickle.load(pipe))
    except (EOFError, OSError, pickle.UnpicklingError):
        heard.put((_ENDED, None))


def _end_of(status: int) -> str:
    return f"status {status}" if status >= 0 else signal.Signals(-status).name


def _lost(how: str, said: IO[bytes]) -> Lost:
    said.seek(0)
    lost = Lost(how)
    lost.add_note(said.read().decode(errors="replace").strip())
    return lost


def serve() -> None:
    """The other process: do the work that stdin tells, then end."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    work, arguments = pickle.load(sys.stdin.buffer)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    try:
        _say(answers, _DONE, work(*arguments, lambda done: _say(answers, _PART, done)))
    except Exception as error:  # noqa: BLE001 - whatever it is, whoever asked has to know
        traceback.print_exc()
        sys.stderr.flush()
        _say(answers, _FAULT, traceback.format_exception_only(error)[-1].strip())
    answers.close()


def _say(answers: IO[bytes], what: str, value: object) -> None:
    answers.write(pickle.dumps((what, value)))
    answers.flush()


def _end_with_parent() -> None:
    with contextlib.suppress(OSError):
        os.read(0, 1)
    os._exit(1)
