"""A file of the first schema is read, tells what it can, and becomes one of the second when it is written again."""

import hashlib

import h5py
import numpy as np
import pytest

from sketchtree.templates.store.columns import COLUMNS, SCHEMA, to_columns
from sketchtree.templates.store.database import Database
from sketchtree.templates.store.digest import digest_of, root_digest
from sketchtree.templates.store.migrate import ADDED, filled, stored
from sketchtree.templates.making.order import make
from sketchtree.templates.making.regenerate import orders, recipe_folder
from sketchtree.templates.store.writer import Writer, write_database


@pytest.fixture
def columns():
    return to_columns(*zip(*map(make, orders(recipe_folder(), only=("date_palm", "hazel"))), strict=True))


@pytest.fixture
def first_schema(tmp_path, columns):
    """A file as version 0.1 wrote it: without two columns, the head hashed before the values."""
    path = tmp_path / "old.h5"
    with h5py.File(path, "w", libver=("v110", "v110")) as file:
        digests = {}
        for name in stored(1):
            values = columns[name]
            head = f"{name} {values.dtype.str} {values.shape}".encode()
            digests[name] = hashlib.sha256(head + values.tobytes()).hexdigest()
            file.create_dataset(name, data=values, fletcher32=True, chunks=values.shape, track_times=False).attrs["sha256"] = digests[name]
        file.attrs["format"], file.attrs["schema"], file.attrs["sha256"] = "SketchTree exemplars", 1, root_digest(digests)
    return path


def test_what_the_first_schema_lacks_comes_from_the_recipes(first_schema, columns):
    before = first_schema.read_bytes()
    db = Database(first_schema)
    db.verify()
    assert db.schema == 1 and set(COLUMNS) - set(stored(1)) == set(ADDED) == {"exemplar/species", "exemplar/growth_habit"}
    assert db.species == ("Phoenix dactylifera", "Corylus avellana") and db.growth_habits == ("palm", "shrub")
    assert db.exemplar("hazel").species == "Corylus avellana" and db.exemplar("date_palm").growth_habit == "palm"
    for name in COLUMNS:
        np.testing.assert_array_equal(db.column(name), columns[name])
    assert first_schema.read_bytes() == before, "reading changes nothing"


def test_written_again_it_is_the_file_that_a_build_writes(first_schema, columns, tmp_path):
    old = Database(first_schema)
    widths = {name: old.width(name) for name, (dtype, _, _) in COLUMNS.items() if dtype == "S"}
    with Writer(tmp_path / "new.h5", len(old), widths) as writer:
        for block in old.blocks():
            writer.add(block)
    write_database(tmp_path / "built.h5", columns)
    assert (tmp_path / "new.h5").read_bytes() == (tmp_path / "built.h5").read_bytes()
    assert Database(tmp_path / "new.h5").schema == SCHEMA == 2


def test_a_recipe_that_does_not_say_or_is_broken_leaves_it_empty():
    recipes = np.array([b'name = "x"', b"species = [", b"", b'species = "Alnus"\ngrowth_habit = 3'])
    assert filled("exemplar/species", recipes).tolist() == [b"", b"", b"", b"Alnus"]
    assert filled("exemplar/growth_habit", recipes).tolist() == [b""] * 4
    assert filled("exemplar/species", recipes[:0]).dtype.kind == "S"


def test_a_column_is_hashed_the_same_in_one_piece_or_many():
    values = np.arange(12.0).reshape(6, 2)
    for schema in (1, 2):
        whole = digest_of("c", [values], values.dtype, values.shape, schema=schema)
        assert whole == digest_of("c", [values[:1], values[1:5], values[5:]], values.dtype, values.shape, schema=schema)
    assert whole != digest_of("c", [values], values.dtype, (12,), schema=2)
