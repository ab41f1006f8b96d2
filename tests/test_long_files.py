"""Files that take long begin first, and all of them are there."""

from pathlib import Path
from types import SimpleNamespace

from long_files import LONG, long_first

ROOT = Path(__file__).resolve().parents[1]


def test_files_that_begin_first_are_there():
    assert len(set(LONG)) == len(LONG) and [name for name in LONG if not (ROOT / name).is_file()] == []


def test_long_files_come_first_and_nothing_else_changes_its_place():
    names = ["tests/test_choose.py", LONG[2], "tests/test_roots.py", LONG[0], LONG[2]]
    items = [SimpleNamespace(nodeid=f"{name}::{k}") for k, name in enumerate(names)]
    assert [item.nodeid for item in sorted(items, key=long_first)] == [f"{LONG[0]}::3", f"{LONG[2]}::1", f"{LONG[2]}::4", "tests/test_choose.py::0", "tests/test_roots.py::2"]
