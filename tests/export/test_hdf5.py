"""Skeletons and projects as HDF5."""

import dataclasses
import json
from pathlib import Path

import h5py
import jax
import numpy as np
import pytest
from shapes import curved

from sketchtree.errors import ExportError, SkeletonError
from sketchtree.export.skeletons.hdf5 import read_choices, write_hdf5, write_project
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.pipeline import sketch_to_tree
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_files import read_skeleton
from sketchtree.sketch.formats import read_sketch

OAK = Path(__file__).parents[2] / "examples" / "oak.svg"
COLUMNS = [field.name for field in dataclasses.fields(TreeSkeleton)]


@pytest.fixture(scope="module")
def model():
    reading = ReadingOptions(template="none", method="flat", alternatives=0)
    return sketch_to_tree(OAK, key=jax.random.key(3), reading=reading, tree=TreeOptions(generations=0, leaf="none"))


def test_a_skeleton_loses_nothing(tmp_path):
    write_hdf5(tmp_path / "t.h5", curved())
    back = read_skeleton(tmp_path / "t.h5")
    for name in COLUMNS:
        np.testing.assert_array_equal(getattr(back, name), getattr(curved(), name))


def test_every_column_names_its_unit(tmp_path):
    write_hdf5(tmp_path / "t.h5", curved())
    with h5py.File(tmp_path / "t.h5") as file:
        units = {name: file[name].attrs["unit"] for name in file}
    assert set(units) == set(COLUMNS) and {name for name, unit in units.items() if unit == "m"} == {"tip", "radius", "depth_sd", "curve_points"}


def test_other_units_are_named(tmp_path):
    write_hdf5(tmp_path / "t.h5", curved(), header={"units": "sketch units", "frame": "sketch", "seed": 7})
    with h5py.File(tmp_path / "t.h5") as file:
        assert file["tip"].attrs["unit"] == "sketch units" and file["parent"].attrs["unit"] == "1"
        assert (file.attrs["frame"], file.attrs["seed"], file.attrs["format"]) == ("sketch", 7, "SketchTree skeleton")


def test_same_tree_same_bytes(tmp_path, model):
    for name in ("a", "b"):
        write_hdf5(tmp_path / f"{name}.h5", curved())
        write_project(tmp_path / f"{name}.sketchtree", model, seed=3, options={"leaf": None})
    assert (tmp_path / "a.h5").read_bytes() == (tmp_path / "b.h5").read_bytes()
    assert (tmp_path / "a.sketchtree").read_bytes() == (tmp_path / "b.sketchtree").read_bytes()


def test_a_project_holds_all_that_the_tree_was_made_of(tmp_path, model):
    write_project(tmp_path / "t.sketchtree", model, seed=3, options={"leaf": "oak", "season": "autumn", "bark": None})
    with h5py.File(tmp_path / "t.sketchtree") as file:
        assert file.attrs["format"] == "SketchTree project" and file.attrs["seed"] == 3 and file.attrs["schema"] == 1
        assert json.loads(file["edits"][()].tobytes()) == []
        assert json.loads(file["options"][()].tobytes()) == {"leaf": "oak", "season": "autumn", "bark": None}
        np.testing.assert_array_equal(file["posterior/depth"][()], model.drawn.fit.depth)
        assert file["posterior"].attrs["method"] == "flat"
    assert read_choices(tmp_path / "t.sketchtree") == {"seed": 3, "template": "", "leaf": "oak", "season": "autumn"}


def test_a_project_gives_its_skeleton_and_its_drawing_back(tmp_path, model):
    write_project(tmp_path / "t.sketchtree", model, seed=3, options={})
    back = read_skeleton(tmp_path / "t.sketchtree")
    for name in COLUMNS:
        np.testing.assert_array_equal(getattr(back, name), getattr(model.skeleton, name))
    drawing, given = read_sketch(tmp_path / "t.sketchtree"), read_sketch(OAK)
    assert [stroke.id for stroke in drawing.strokes] == [stroke.id for stroke in given.strokes]
    for stroke, other in zip(drawing.strokes, given.strokes, strict=True):
        np.testing.assert_array_equal(stroke.points, other.points)


def test_other_readings_are_kept_where_they_were_asked_for(tmp_path, model):
    from sketchtree.mrf.answer.readings import Reading

    two = (Reading(model.drawn.fit.depth, -1.0, 0.75), Reading(-model.drawn.fit.depth, -2.0, 0.25))
    fit = dataclasses.replace(model.drawn.fit, alternatives=two, log_posterior=-1.0)
    write_project(tmp_path / "t.sketchtree", dataclasses.replace(model, drawn=dataclasses.replace(model.drawn, fit=fit)), seed=0, options={})
    with h5py.File(tmp_path / "t.sketchtree") as file:
        assert file["posterior"].attrs["log_posterior"] == -1.0 and file["posterior/alternative_depth"].shape == (2, len(fit.depth))
        assert file["posterior/alternative_log_posterior"][()].tolist() == [-1.0, -2.0]


def test_an_hdf5_file_of_another_kind_is_named(tmp_path):
    write_hdf5(tmp_path / "t.h5", curved())
    with pytest.raises(SkeletonError, match="is no project of ours, or is damaged. Build it again."):
        read_choices(tmp_path / "t.h5")
    from sketchtree.errors import SketchError

    with pytest.raises(SketchError, match="a SketchTree project or exemplar database, which can't be read. Give the drawing it was made from."):
        read_sketch(tmp_path / "t.h5")


def test_a_damaged_project_is_named(tmp_path, model):
    from sketchtree.errors import SketchError

    write_project(tmp_path / "t.sketchtree", model, seed=0, options={})
    (tmp_path / "t.sketchtree").write_bytes((tmp_path / "t.sketchtree").read_bytes()[:2000])
    with pytest.raises(SketchError, match="can't be read"):
        read_sketch(tmp_path / "t.sketchtree")
    with pytest.raises(SkeletonError, match="is no HDF5 file, or is damaged"):
        read_skeleton(tmp_path / "t.sketchtree")


def test_another_extension_is_named(tmp_path, model):
    with pytest.raises(ExportError, match=r"This version writes \.sketchtree here"):
        write_project(tmp_path / "t.h5", model, seed=0, options={})
