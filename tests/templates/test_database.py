"""The file holds what was put in, or says why not, and is never touched by reading."""

import dataclasses
import hashlib
import os
import shutil
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py
import numpy as np
import pytest

from sketchtree.errors import TemplateError
from sketchtree.templates.store.columns import COLUMNS, SCHEMA, to_columns
from sketchtree.templates.store.database import Database, default_path
from sketchtree.templates.exemplar import measure
from sketchtree.templates.growing.procedural import grow
from sketchtree.templates.growing.recipe import parse_recipe
from sketchtree.templates.making.regenerate import recipe_folder
from sketchtree.templates.store.writer import Writer, write_database

SHIPPED = recipe_folder() / "exemplars.h5"


@pytest.fixture
def made(minimal):
    recipe = parse_recipe(minimal.replace("A stick", "Ein Stöckchen"), file="x.toml")
    return measure(
        grow(recipe), name="stick", title=recipe.title, habit=recipe.habit,
        recipe=recipe.text, source="estimated", seed=1, version="0.0",
    )  # fmt: skip


@pytest.fixture
def copy(tmp_path):
    return shutil.copy(SHIPPED, tmp_path / "copy.h5")


def refused(path, match):
    path = Path(path)
    before = path.read_bytes()
    with pytest.raises(TemplateError, match=match) as caught:
        Database(path).verify()
    assert path.read_bytes() == before, "the file is left alone"
    assert path.name in str(caught.value)
    return str(caught.value)


def test_an_exemplar_comes_back_as_it_was(made, tmp_path):
    exemplar, views = made
    write_database(tmp_path / "one.h5", to_columns([exemplar], [views]))
    db = Database(tmp_path / "one.h5")
    back = db.exemplar("stick")
    for field in ("name", "title", "theta", "theta_order", "habit", "recipe", "source", "seed", "version"):
        assert getattr(back, field) == getattr(exemplar, field), field
    assert back.title == "Ein Stöckchen with arms"
    for column in ("parent", "tip", "radius", "order", "limb"):
        np.testing.assert_array_equal(getattr(back.skeleton, column), getattr(exemplar.skeleton, column))
    for field in dataclasses.fields(exemplar.limbs):
        np.testing.assert_array_equal(getattr(back.limbs, field.name), getattr(exemplar.limbs, field.name))
    np.testing.assert_array_equal(back.thumbnail, exemplar.thumbnail)
    np.testing.assert_allclose(db.views.footprint[0], views.footprint, atol=1e-7)
    np.testing.assert_allclose(db.views.branching.mean[0], views.branching.mean, rtol=1e-6)
    np.testing.assert_allclose(db.views.posture[0], views.posture, atol=1e-6)


def test_every_column_has_its_unit_meaning_and_checksum_and_the_readme_lists_it():
    text = (recipe_folder() / "README.md").read_text(encoding="utf-8")
    with h5py.File(SHIPPED) as file:
        assert file.attrs["schema"] == SCHEMA == 2
        for name, (dtype, unit, meaning) in COLUMNS.items():
            assert file[name].attrs["unit"] == unit and file[name].attrs["meaning"] == meaning
            assert len(file[name].attrs["sha256"]) == 64 and file[name].fletcher32
            assert file[name].dtype.kind == np.dtype(dtype).kind
            assert f"| `{name}` | {dtype} | {unit} | {meaning} |" in text


def test_the_same_columns_give_the_same_bytes(made, tmp_path):
    columns = to_columns([made[0]], [made[1]])
    for name in ("a.h5", "b.h5"):
        write_database(tmp_path / name, columns)
    digests = {hashlib.sha256((tmp_path / name).read_bytes()).hexdigest() for name in ("a.h5", "b.h5")}
    assert len(digests) == 1
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.h5", "b.h5"], "no temporary file stays"


def test_an_old_file_is_replaced_only_when_the_new_one_is_complete(made, tmp_path):
    path = tmp_path / "db.h5"
    path.write_bytes(b"precious")
    columns = to_columns([made[0]], [made[1]])
    del columns["views/posture"]
    with pytest.raises(KeyError):
        write_database(path, columns)
    assert path.read_bytes() == b"precious" and len(list(tmp_path.iterdir())) == 1


def test_an_unwritable_place_is_named(made, tmp_path):
    columns = to_columns([made[0]], [made[1]])
    with pytest.raises(TemplateError, match=r"db\.h5: it can't be written \(No such file or dir.*\)\. Choose a folder that exists"):
        write_database(tmp_path / "none" / "db.h5", columns)
    (tmp_path / "folder").mkdir()
    with pytest.raises(TemplateError, match=r"folder: it can't be written"):
        write_database(tmp_path / "folder", columns)
    assert [p.name for p in tmp_path.iterdir()] == ["folder"]


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(TemplateError, match=r"none\.h5: there is no such database\. Rebuild it with `sketchtree templates build`"):
        Database.open(tmp_path / "none.h5")


def test_an_empty_or_foreign_file_is_refused(tmp_path):
    (tmp_path / "empty.h5").write_bytes(b"")
    refused(tmp_path / "empty.h5", "it is empty, so no database")
    (tmp_path / "picture.h5").write_bytes(b"\x89PNG and so on")
    refused(tmp_path / "picture.h5", "it is no HDF5 file, so no database")
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["data"] = np.arange(3)
    refused(tmp_path / "other.h5", "it is an HDF5 file, but no SketchTree database")


def test_a_newer_schema_is_refused(copy):
    with h5py.File(copy, "a") as file:
        file.attrs["schema"] = 7
    assert "Update SketchTree" in refused(copy, r"it has schema 7, and this version of SketchTree reads up to 2")


def test_a_file_that_is_cut_off_is_refused(copy):
    with open(copy, "rb+") as file:
        file.truncate(os.path.getsize(copy) // 2)
    refused(copy, r"the database is damaged \(it is cut off or its index is broken\)")


def test_a_missing_column_is_refused(copy):
    with h5py.File(copy, "a") as file:
        del file["theta/tree"]
    refused(copy, r"the database is damaged \(a part of it can't be read\)")


def test_a_changed_value_is_found_by_its_checksum(copy):
    with h5py.File(copy, "a") as file:
        file["theta/tree"][0, 0] += 1.0
    refused(copy, r"the database is damaged \(the checksum of `theta/tree` is wrong\)")


def test_a_changed_checksum_is_found_by_the_roots(copy):
    with h5py.File(copy, "a") as file:
        file["theta/tree"].attrs["sha256"] = "0" * 64
    refused(copy, r"its checksums don't agree")


def test_any_flipped_byte_is_harmless_or_refused(copy):
    """Damage anywhere never gives wrong values nor any other error."""
    whole, rng = Path(copy).read_bytes(), np.random.default_rng(8)
    good = Database(SHIPPED)
    for at in np.r_[rng.integers(0, 4000, 20), rng.integers(0, len(whole), 20)]:
        broken = bytearray(whole)
        broken[at] ^= 0xFF
        with open(copy, "wb") as file:
            file.write(broken)
        try:
            db = Database(copy)
            db.verify()
        except TemplateError:
            continue
        assert db.names == good.names
        np.testing.assert_array_equal(db.views.footprint, good.views.footprint)


def test_an_unknown_name_gets_a_suggestion(shipped):
    with pytest.raises(TemplateError, match=r"There is no exemplar called 'oak' in exemplars\.h5\. Did you mean dead_oak or english_oak or cypress_oak\?"):
        shipped.exemplar("oak")
    with pytest.raises(TemplateError, match=r"Use one of: american_elm, apple"):
        shipped.exemplar("zzzzzz")


def test_the_environment_names_the_default(monkeypatch, copy):
    monkeypatch.delenv("SKETCHTREE_DB", raising=False)
    assert default_path().name == "exemplars.h5" and default_path().exists()
    monkeypatch.setenv("SKETCHTREE_DB", str(copy))
    assert Database.open().path == default_path() and str(default_path()) == str(copy)


def test_blocks_one_by_one_give_the_bytes_of_the_whole(shipped, tmp_path):
    widths = {name: shipped.width(name) for name, (dtype, _, _) in COLUMNS.items() if dtype == "S"}
    with Writer(tmp_path / "again.h5", len(shipped), widths) as writer:
        for block in shipped.blocks():
            writer.add(block)
    assert (tmp_path / "again.h5").read_bytes() == SHIPPED.read_bytes()


def test_a_writer_that_fails_on_the_way_leaves_the_old_file(made, tmp_path):
    path = tmp_path / "db.h5"
    block = to_columns([made[0]], [made[1]])
    write_database(path, block)
    before = path.read_bytes()
    widths = {name: 64_000 for name, (dtype, _, _) in COLUMNS.items() if dtype == "S"}
    with pytest.raises(TemplateError, match=r"db\.h5: two exemplars are called 'stick'"), Writer(path, 2, widths) as writer:
        writer.add(block)
        writer.add(block)
    with pytest.raises(ValueError, match="1 exemplars were added of 2"), Writer(path, 2, widths) as writer:
        writer.add(block)
    with pytest.raises(TemplateError, match=r"db\.h5: it can't be written \(No space left"), Writer(path, 1, widths) as writer:
        raise OSError(28, "No space left on device")
    with pytest.raises(ValueError, match="longer than was said"), Writer(path, 1, dict.fromkeys(widths, 1)) as writer:
        writer.add(block)
    assert path.read_bytes() == before and [p.name for p in tmp_path.iterdir()] == ["db.h5"]


def test_readers_see_the_old_file_or_the_new_while_a_writer_replaces_it(made, tmp_path):
    """Four threads read without a break while the file is replaced eight times; none ever sees a mixture."""
    path = tmp_path / "db.h5"
    versions = []
    for seed in range(2):
        exemplar = dataclasses.replace(made[0], seed=seed, title=f"version {seed}")
        versions.append(to_columns([exemplar], [made[1]]))
    write_database(path, versions[0])
    seen, done = set(), threading.Event()

    def read():
        while not done.is_set():
            try:
                db = Database(path)
                exemplar = db.exemplar("stick")
                pair = (db.titles[0], exemplar.title, exemplar.seed)
            except TemplateError as error:
                assert "it has been replaced since it was opened. Open it again." in str(error)
                continue
            assert pair in {(f"version {k}", f"version {k}", k) for k in range(2)}
            seen.add(pair[2])
        return True

    with ThreadPoolExecutor(4) as pool:
        readers = [pool.submit(read) for _ in range(4)]
        try:
            for turn in range(8):
                write_database(path, versions[turn % 2])
        finally:
            done.set()
        assert all(reader.result() for reader in readers) and seen == {0, 1}


def test_a_reader_in_another_process_is_told_that_the_file_was_replaced(made, tmp_path):
    path = tmp_path / "db.h5"
    columns = to_columns([made[0]], [made[1]])
    write_database(path, columns)
    code = (
        "import sys; from sketchtree.templates.store.database import Database; db = Database(sys.argv[1]); print(db.exemplar('stick').seed, flush=True);"
        "sys.stdin.readline()\ntry: db.exemplar('stick')\nexcept Exception as error: print(error)\nprint(Database(sys.argv[1]).exemplar('stick').seed)"
    )
    with subprocess.Popen([sys.executable, "-c", code, path], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as reader:
        assert reader.stdout.readline().strip() == "1"
        write_database(path, columns | {"exemplar/seed": columns["exemplar/seed"] + 7})
        said = reader.communicate("\n", timeout=60)[0].splitlines()
    assert said == [f"{path}: it has been replaced since it was opened. Open it again.", "8"]


def test_parts_are_read_without_the_rest(shipped, monkeypatch):
    """One exemplar of the database is read without any whole column."""
    monkeypatch.setattr(Database, "_whole", lambda self, file, name: pytest.fail(f"{name} was read whole"))
    assert shipped.exemplar("hazel").growth_habit == "shrub"
