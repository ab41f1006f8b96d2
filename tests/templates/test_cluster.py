"""A real Dask cluster on this machine makes the same file; whatever is wrong with one is named."""

import sys

import pytest

from sketchtree.errors import OptionError, SketchTreeError, TemplateError
from sketchtree.templates.making import cluster as cluster_module
from sketchtree.templates.making.cluster import cluster
from sketchtree.templates.making.fingerprint import fingerprint
from sketchtree.templates.making.journal import Journal
from sketchtree.templates.making.regenerate import orders, recipe_folder, regenerate

pytestmark = pytest.mark.filterwarnings("default")  # those of distributed and tornado are not ours


@pytest.fixture(scope="module")
def local():
    """Two worker processes behind a scheduler."""
    from distributed import LocalCluster

    fingerprint.cache_clear()  # the sources may have been edited since another test asked
    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0") as running:
        yield running


@pytest.fixture
def recipes(tmp_path, minimal):
    (tmp_path / "recipes").mkdir()
    (tmp_path / "recipes" / "stick.toml").write_text(minimal)
    return tmp_path / "recipes"


def test_a_cluster_makes_the_same_bytes_and_floods_nobody(local, tmp_path):
    wanted, heard = orders(recipe_folder(), only=("apple", "date_palm"), count=4), []
    regenerate(tmp_path / "a.h5", wanted)
    regenerate(tmp_path / "b.h5", wanted, scheduler=local.scheduler_address, progress=heard.append)
    assert (tmp_path / "a.h5").read_bytes() == (tmp_path / "b.h5").read_bytes()
    assert heard == [order.name for order in wanted] and not Journal(tmp_path / "b.h5").folder.exists()
    with cluster(local.scheduler_address) as crew:
        assert crew.window == 4 * 2


def test_a_build_stopped_on_a_cluster_goes_on_without_it(local, tmp_path, recipes):
    wanted, said = orders(recipes, count=30), []

    def stop(name):
        if name == "stick_5":
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        regenerate(tmp_path / "db.h5", wanted, scheduler=local.scheduler_address, progress=stop)
    regenerate(tmp_path / "whole.h5", wanted)
    regenerate(tmp_path / "db.h5", wanted, say=said.append)
    assert said[0].startswith("taking up ") and " of 30 exemplars" in said[0]
    assert (tmp_path / "db.h5").read_bytes() == (tmp_path / "whole.h5").read_bytes()


def test_a_worker_of_another_program_is_refused(local, tmp_path, recipes, monkeypatch):
    monkeypatch.setattr(cluster_module, "fingerprint", lambda: "another")
    with pytest.raises(TemplateError, match=r"a worker runs another SketchTree than this one\. Install the same version"):
        regenerate(tmp_path / "db.h5", orders(recipes), scheduler=local.scheduler_address)
    monkeypatch.setattr(cluster_module._Workers, "greet", lambda self: None)  # a worker that joins later
    with pytest.raises(TemplateError, match=r"A worker runs another SketchTree \("):
        regenerate(tmp_path / "db.h5", orders(recipes), scheduler=local.scheduler_address)
    assert [p.name for p in tmp_path.iterdir()] == ["recipes"]


def test_a_scheduler_that_is_not_there_or_has_no_worker_is_named(tmp_path, recipes, monkeypatch):
    from distributed import LocalCluster

    monkeypatch.setattr(cluster_module, "PATIENCE", 0.5)
    monkeypatch.setattr(cluster_module, "WAIT", 0.5)
    for nowhere in ("tcp://127.0.0.1:9", "nonsense://x", "tcp://127.0.0.1:none"):
        with pytest.raises(OptionError, match=f"--scheduler {nowhere}: no Dask scheduler answers there"):
            regenerate(tmp_path / "db.h5", orders(recipes), scheduler=nowhere)
    with LocalCluster(n_workers=0, processes=False, dashboard_address=":0") as empty:
        with pytest.raises(TemplateError, match=r"no worker answered within 0\.5 s\. Start one with `dask worker"):
            regenerate(tmp_path / "db.h5", orders(recipes), scheduler=empty.scheduler_address)
    assert [p.name for p in tmp_path.iterdir()] == ["recipes"]


def test_a_cluster_that_is_lost_on_the_way_is_named_and_the_finished_are_kept(tmp_path, recipes):
    from distributed import LocalCluster

    wanted = orders(recipes, count=200)
    running = LocalCluster(n_workers=1, threads_per_worker=1, processes=False, dashboard_address=":0")

    def lose(name):
        if name == "stick_3":
            running.close()

    try:
        with pytest.raises(SketchTreeError, match=r"the cluster was lost on the way .* finished exemplars are kept"):
            regenerate(tmp_path / "db.h5", wanted, scheduler=running.scheduler_address, progress=lose)
    finally:
        running.close()
    assert Journal(tmp_path / "db.h5").count(wanted) >= 3


def test_without_distributed_the_command_to_install_it_is_named(tmp_path, recipes, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(OptionError, match=r"pip install 'sketchtree\[cluster\]'"):
        regenerate(tmp_path / "db.h5", orders(recipes), scheduler="tcp://127.0.0.1:9")
