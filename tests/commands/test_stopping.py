"""Ctrl-C arrives, whatever jax does at that moment."""

import signal
import time

import pytest

from sketchtree.commands.stopping import leave_to_asyncio, listen


@pytest.fixture
def listening():
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    listen()
    yield
    signal.signal(signal.SIGINT, before)


def _xla_gc_callback():
    signal.raise_signal(signal.SIGINT)
    return "nothing was raised in here"


def test_an_interrupt_stops_at_once(listening):
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)


def test_one_that_would_be_lost_comes_again(listening):
    with pytest.raises(KeyboardInterrupt):
        assert _xla_gc_callback() == "nothing was raised in here"
        for _ in range(500):
            time.sleep(0.01)


def test_a_handler_of_somebody_else_stays():
    def theirs(*_):
        """Of another program."""

    before = signal.signal(signal.SIGINT, theirs)
    listen()
    assert signal.signal(signal.SIGINT, before) is theirs


def test_asyncio_has_pythons_own_handler(listening):
    leave_to_asyncio()
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
