"""Work that another process does for the tests."""

import os
import time


def tenfold(number: int, tell) -> tuple[int, int]:
    """(ten times the number, who says so)."""
    print("something that compiled code prints")
    tell(0.5)
    return 10 * number, os.getpid()


def forever(tell) -> None:
    """Tells who it is, then sleeps."""
    tell(os.getpid())
    time.sleep(3600)


def mistaken(tell) -> None:
    """Fails."""
    raise ValueError("[mapper.cc:12] check failed")


def dying(tell) -> None:
    """Ends without a word."""
    os._exit(3)


def crashing(tell) -> None:
    """Ends as compiled code may."""
    os.abort()
