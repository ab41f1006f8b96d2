"""The large database of the speed benchmark is a database."""

import pytest

from benchmarks.match_speed import measure, print_table, write_large
from sketchtree.templates.store.database import Database


@pytest.mark.parametrize("gzip", [False, True])
def test_a_large_database_is_whole_and_is_searched(tmp_path, gzip):
    path = tmp_path / "large.h5"
    write_large(path, 60, gzip=gzip)
    db = Database(path)
    db.verify()
    assert len(db) == 60 and db.views.footprint.shape == (60, 36, 64)
    assert db.exemplar(db.names[-1]).skeleton.height == pytest.approx(1.0)


def test_a_measurement_has_every_figure(tmp_path, capsys):
    path = tmp_path / "large.h5"
    write_large(path, 60)
    took = measure(str(path))
    assert {"load", "first", "warm", "warm bare", "warm chen", "rss"} <= set(took) and took["exemplars"] == 60
    print_table(took, {"warm": 0.0, "rss": 1e6})
    assert "at most 0.0 s: missed" in (shown := capsys.readouterr().out) and "at most 1000000.0 GB: met" in shown
