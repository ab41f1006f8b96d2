"""Skeletons and projects as HDF5.

A project (`.sketchtree`) is all that a tree was made of, so that it can be made again and edited:

    format, schema, version, seed, template     attributes of the root
    sketch                            the drawing, as sketch JSON: no stroke, width or pressure is lost
    edits                             JSON: what was done by hand, operations by limb id (`editing.kept`)
    settled                           JSON: what the depths of drawn limbs have come to, likewise
    underlay                          a picture that was traced over, as it came; attributes x, y, width, height, opacity (sketch units, y up), photo
    cloud                             points of a scan behind the drawing, as `editing.laid_cloud` has them; attributes coloured, x, y, unit (sketch units, y up), trunk (metres), remarks (JSON)
    options                           JSON: as used
    skeleton/                         every column of the complete tree
    posterior/                        what is known of the drawn segments' depths: depth and depth_sd (sketch units), log_posterior,
                                      method; alternative_depth [reading segment] and alternative_log_posterior, where asked for
"""

import io
import json
import os
from collections.abc import Mapping

import numpy as np

from sketchtree.editing import kept
from sketchtree.errors import SkeletonError
from sketchtree.export.files import check_extension, write_whole
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_hdf5 import PROJECT, SCHEMA, put, put_columns, write_skeleton_hdf5
from sketchtree.sketch.files.sketch_json import sketch_json
from sketchtree.sketch.formats import check_writable as check_drawing
from sketchtree.version import __version__


def write_hdf5(path: str | os.PathLike, tree: TreeSkeleton, *, header: Mapping[str, object] | None = None) -> None:
    """Write every column without loss as `.h5`, all or nothing. Each entry of `header` (units, frame, seed, …) becomes an attribute.

    Raises `ExportError` where it can't be written."""
    check_extension(path, (".h5",))
    whole = io.BytesIO()
    write_skeleton_hdf5(whole, tree, header=header)
    write_whole(path, whole.getvalue())


def write_project(path: str | os.PathLike, model, *, seed: int, options: dict, underlay=None) -> None:
    """Write a `TreeModel` with the drawing it was made of, and the points behind it, as `.sketchtree`, all or nothing. `options` are JSON, `underlay` an `editing.document.Underlay`.

    Raises `SketchError` for a drawing that a file could not give back, `ExportError` where it can't be written."""
    import h5py

    check_extension(path, (".sketchtree",))
    check_drawing(model.drawn.sketch)
    whole = io.BytesIO()
    with h5py.File(whole, "w", libver=("v110", "v110")) as file:
        file.attrs["format"], file.attrs["schema"], file.attrs["version"], file.attrs["seed"] = PROJECT, SCHEMA, __version__, seed
        file.attrs["template"] = model.drawn.exemplar.name if model.drawn.exemplar else ""
        _put_drawing(file, model.drawn.sketch, model.drawn.edits, model.drawn.settled, options, underlay, model.drawn.cloud)
        put_columns(file.create_group("skeleton"), model.skeleton)
        _put_posterior(file.create_group("posterior"), model.drawn.fit)
    write_whole(path, whole.getvalue())


def write_undrawn(path: str | os.PathLike, document, *, options: dict) -> None:
    """Write an `editing.document.Document` whose tree is taken from scribbles on its picture, or from the points behind it, as `.sketchtree`, all or nothing. It holds no skeleton: whoever wants
    the tree makes it (`scribbled_tree`, `laid_tree`).

    Raises `SketchError` for a drawing that a file could not give back, `ExportError` where it can't be written."""
    import h5py

    check_extension(path, (".sketchtree",))
    check_drawing(document.sketch)
    whole = io.BytesIO()
    with h5py.File(whole, "w", libver=("v110", "v110")) as file:
        file.attrs["format"], file.attrs["schema"], file.attrs["version"], file.attrs["seed"] = PROJECT, SCHEMA, __version__, document.seed
        file.attrs["template"] = ""
        _put_drawing(file, document.sketch, document.edits, document.settled, options, document.underlay, document.cloud)
    write_whole(path, whole.getvalue())


def _put_drawing(file, sketch, edits, settled, options: dict, underlay, cloud) -> None:
    _put_text(file, "sketch", sketch_json(sketch))
    file["sketch"].attrs["name"] = sketch.name
    _put_text(file, "edits", json.dumps(kept.edits_as_json(edits)))
    _put_text(file, "settled", json.dumps(kept.settled_as_json(settled)))
    if underlay is not None:
        put(file, "underlay", np.frombuffer(underlay.picture, np.uint8), "byte")
        for name in ("x", "y", "width", "height", "opacity"):
            file["underlay"].attrs[name] = float(getattr(underlay, name))
        file["underlay"].attrs["photo"] = bool(underlay.photo)
    if cloud is not None:
        put(file, "cloud", np.frombuffer(cloud.points, np.uint8), "byte")
        said = file["cloud"].attrs
        said["coloured"], said["remarks"] = cloud.coloured, json.dumps(cloud.remarks)
        said["x"], said["y"], said["unit"], said["trunk"] = *cloud.place, cloud.trunk
    _put_text(file, "options", json.dumps(options, sort_keys=True))


def _put_text(file, name: str, text: str) -> None:
    put(file, name, np.frombuffer(text.encode(), np.uint8), "UTF-8")


def _put_posterior(group, fit) -> None:
    put(group, "depth", fit.depth, "sketch unit")
    put(group, "depth_sd", fit.depth_sd, "sketch unit")
    group.attrs["method"] = fit.method
    if fit.log_posterior is not None:
        group.attrs["log_posterior"] = fit.log_posterior
    if fit.alternatives:
        put(group, "alternative_depth", np.stack([reading.depth for reading in fit.alternatives]), "sketch unit")
        put(group, "alternative_log_posterior", np.array([reading.log_posterior for reading in fit.alternatives], float), "nat")


def read_choices(path: str | os.PathLike) -> dict:
    """What a project was built with: `seed`, `template`, and `leaf`, `season`, `bark`, `wood`, `solid` where they were chosen. Raises `SkeletonError`."""
    import h5py

    try:
        with h5py.File(path, "r") as file:
            said = json.loads(file["options"][()].tobytes())
            chosen = {name: said[name] for name in ("leaf", "season", "bark", "wood", "solid") if said.get(name) is not None}
            return {"seed": int(file.attrs["seed"]), "template": str(file.attrs["template"])} | chosen
    except (OSError, RuntimeError, ValueError, TypeError, KeyError, AttributeError) as error:
        raise SkeletonError(f"{path} is no project of ours, or is damaged.", remedy="Build it again.") from error
