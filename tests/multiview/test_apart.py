"""Work that can't be asked to end is done in a process of its own, and ends with whoever asked for it."""

import os
import select
import signal
import subprocess
import sys
from pathlib import Path

import pytest
import work_apart
from PIL import Image

from sketchtree.errors import ViewsError
from sketchtree.multiview import sfm
from sketchtree.multiview.apart import Lost, apart
from sketchtree.watch import no_pulse


class Enough(Exception):
    """Raised by a pulse."""


@pytest.fixture
def gone():
    """Whether the process of that number has ended: nothing of it is left, not even for its parent to ask about."""
    if not hasattr(signal, "pthread_sigmask"):
        pytest.skip("processes are asked about as on POSIX")

    def ended(number: int) -> bool:
        try:
            os.kill(number, 0)
        except ProcessLookupError:
            return True
        return False

    return ended


def asked(work, *arguments, part=lambda done: None, pulse=no_pulse):
    return apart(work, *arguments, part=part, pulse=pulse)


def test_the_answer_is_that_of_another_process_and_parts_are_told():
    parts = []
    number, process = asked(work_apart.tenfold, 7, part=parts.append)
    assert number == 70 and process != os.getpid() and parts == [0.5]


def raised_while_it_runs(kind, end):
    """The number of the process that worked when `end` was called."""
    running = []
    with pytest.raises(kind):
        asked(work_apart.forever, part=running.append, pulse=lambda: end() if running else None)
    return running[0]


def test_what_a_pulse_raises_ends_it_at_once(gone):
    def enough():
        raise Enough

    assert gone(raised_while_it_runs(Enough, enough))


def test_ctrl_c_ends_it_at_once(gone):
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        assert gone(raised_while_it_runs(KeyboardInterrupt, lambda: signal.raise_signal(signal.SIGINT)))
    finally:
        signal.signal(signal.SIGINT, before)


def test_it_leaves_ctrl_c_at_the_terminal_to_whoever_asked(gone):
    """Every process of a terminal hears of it."""
    running, hears = [], iter(range(3))

    def interrupted():
        if running and next(hears, None) is not None:
            os.kill(running[0], signal.SIGINT)
        elif running:
            os.kill(running[0], 0)
            raise Enough

    with pytest.raises(Enough):
        asked(work_apart.forever, part=running.append, pulse=interrupted)
    assert gone(running[0])


@pytest.mark.skipif(not hasattr(os, "pidfd_open"), reason="the end of a process that is not one's own is heard of on Linux")
def test_it_ends_when_whoever_asked_is_killed(gone):
    asks = "import work_apart; from sketchtree.multiview.apart import apart; apart(work_apart.forever, part=lambda number: print(number, flush=True), pulse=int)"
    paths = os.pathsep.join([str(Path(__file__).parent), *sys.path])
    with subprocess.Popen([sys.executable, "-c", asks], stdout=subprocess.PIPE, text=True, env={**os.environ, "PYTHONPATH": paths}) as other:
        running = int(other.stdout.readline())
        other.kill()
    if not gone(running):
        ends = os.pidfd_open(running)
        assert select.select([ends], [], [], 60)[0]
        os.close(ends)


def test_what_failed_there_is_told_with_where():
    with pytest.raises(Lost) as lost:
        asked(work_apart.mistaken)
    assert str(lost.value) == "ValueError: [mapper.cc:12] check failed"
    assert "in mistaken" in lost.value.__notes__[0]


def test_how_it_ended_is_told():
    with pytest.raises(Lost, match="^status 3$"):
        asked(work_apart.dying)


@pytest.mark.skipif(os.name != "posix", reason="Windows has no signals")
def test_the_signal_that_ended_it_is_told():
    with pytest.raises(Lost, match="^SIGABRT$"):
        asked(work_apart.crashing)


def test_a_colmap_that_crashes_is_named(monkeypatch, tmp_path):
    for k in range(5):
        Image.new("RGB", (8, 8)).save(tmp_path / f"{k}.png")
    monkeypatch.setattr(sfm, "apart", lambda placed, *arguments, **told: apart(work_apart.dying, **told))
    with pytest.raises(ViewsError) as error:
        sfm.structure_from_motion(tmp_path)
    assert str(error.value) == (
        "COLMAP, which finds where photos were taken from, ended before it was done (status 3). "
        "If memory ran out: close other programs, or give fewer or smaller photos. Or give the poses, if something else knows them."
    )
