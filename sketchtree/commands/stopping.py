"""Does Ctrl-C always arrive? jax has Python's garbage collector call it back, and what is raised in there is lost, with a traceback. So an interrupt that comes there comes again."""

import _thread
import signal
import threading

_DEAF = "_xla_gc_callback"  # the function of jax in which nothing can be raised
_AGAIN = 0.05  # seconds


def listen() -> None:
    """From now on no interrupt is lost. Where somebody else already sees to them, or outside the main thread, nothing changes."""
    if threading.current_thread() is threading.main_thread() and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _interrupted)


def leave_to_asyncio() -> None:
    """An interrupt is Python's own again: asyncio stops its tasks in order only where it is, and a process that runs no jax loses none."""
    if signal.getsignal(signal.SIGINT) is _interrupted:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _interrupted(_, frame) -> None:
    if frame is None or frame.f_code.co_name != _DEAF:
        raise KeyboardInterrupt
    again = threading.Timer(_AGAIN, _thread.interrupt_main)
    again.daemon = True
    again.start()
