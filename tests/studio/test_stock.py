"""What need not be made again at the next start."""

import os

import pytest

from sketchtree.studio import stock
from sketchtree.studio.stock import Stock


@pytest.fixture
def kept(tmp_path):
    return Stock(tmp_path / "studio", "this program")


def _files(kept) -> list:
    return sorted(kept._folder.iterdir())


def test_what_was_kept_is_there_the_next_time(kept, tmp_path):
    assert kept.get("a leaf") is None
    kept.put("a leaf", b"green")
    assert Stock(tmp_path / "studio", "this program").get("a leaf") == b"green" and kept.get("a bark") is None


def test_another_program_has_nothing_of_it(kept, tmp_path):
    kept.put("a leaf", b"green")
    assert Stock(tmp_path / "studio", "a newer program").get("a leaf") is None


@pytest.mark.parametrize("spoil", [lambda data: data[:-1], lambda data: data[:20] + b"X" + data[21:], lambda data: b"", lambda data: b"something else altogether"])
def test_what_is_torn_or_foreign_is_as_none_and_is_made_again(kept, spoil):
    kept.put("a leaf", b"green and more")
    (path,) = _files(kept)
    path.write_bytes(spoil(path.read_bytes()))
    assert kept.get("a leaf") is None
    kept.put("a leaf", b"green")
    assert kept.get("a leaf") == b"green"


def test_one_file_in_the_place_of_another_is_as_none(kept):
    kept.put("a leaf", b"green")
    (leaf,) = _files(kept)
    kept.put("a bark", b"brown")
    bark = next(path for path in _files(kept) if path != leaf)
    bark.write_bytes(leaf.read_bytes())
    assert kept.get("a bark") is None


def test_the_folder_has_a_bound_and_what_was_not_used_for_longest_goes_first(kept, monkeypatch):
    monkeypatch.setattr(stock, "MOST", 3 * 1016)
    for age, name in enumerate(("first", "second", "third")):
        kept.put(name, bytes(1000))
        os.utime(kept._path(name), (age, age))
    kept.get("first")  # used now
    kept.put("fourth", bytes(1000))
    assert [kept.get(name) is not None for name in ("first", "second", "third", "fourth")] == [True, False, True, True]


def test_what_is_too_large_is_not_kept(kept, monkeypatch):
    monkeypatch.setattr(stock, "LARGEST", 10)
    kept.put("a leaf", bytes(11))
    assert kept.get("a leaf") is None


def test_where_nothing_can_be_kept_nothing_fails(tmp_path):
    (tmp_path / "studio").write_text("a file")
    kept = Stock(tmp_path / "studio", "this program")
    kept.put("a leaf", b"green")
    kept.drop("a leaf")
    assert kept.get("a leaf") is None


def test_what_was_dropped_is_gone(kept):
    kept.put("a leaf", b"green")
    kept.drop("a leaf")
    assert kept.get("a leaf") is None


def test_it_hangs_on_the_sources_and_on_the_database(tmp_path, monkeypatch):
    database = tmp_path / "one.h5"
    database.write_bytes(b"one")
    before = stock._made_with(database)
    assert stock._made_with(database) == before
    database.write_bytes(b"another")
    after = stock._made_with(database)
    assert after != before and "stock.py" in after and "page/" not in after
    monkeypatch.setenv("SKETCHTREE_CACHE", str(tmp_path))
    Stock.of_user(database).put("a leaf", b"green")
    assert len(list((tmp_path / "studio").iterdir())) == 1
