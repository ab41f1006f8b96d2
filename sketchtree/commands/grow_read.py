"""What does `sketchtree grow` read? A picture with what marks its tree, a drawing, or a tree that is there already: each becomes what a tree begins as."""

import dataclasses
from pathlib import Path

import click
from click.core import ParameterSource

from sketchtree.commands.own_looks import with_own_looks
from sketchtree.errors import ExportError, SketchError
from sketchtree.export.files import PROJECTS


def read(kind: str, source: Path, wanted: dict, templates, *, seed: int, seed_chosen: bool, reading, tree, trunk, watch):
    """(what the tree begins as, the seed in use). Raises SketchError, SkeletonError, ExportError, OptionError."""
    from sketchtree.growth_tree import of_drawing
    from sketchtree.keys import root_key

    if kind == "picture":
        return _of_picture(source, wanted, templates, key=root_key(seed), reading=reading, tree=tree, trunk=trunk, watch=watch), seed
    if kind in ("scribbled", "traced"):
        from sketchtree.commands import scribbled, traced

        return {"scribbled": scribbled, "traced": traced}[kind].begun(source, templates, seed=seed, seed_chosen=seed_chosen, season_chosen=_season_chosen(), reading=reading, tree=tree, watch=watch)
    if kind == "drawing":
        return of_drawing(source, templates, key=root_key(seed), reading=reading, tree=tree, watch=watch), seed
    with watch("read"):
        return _of_skeleton(source, wanted, templates, seed=seed, seed_chosen=seed_chosen, reading=reading, tree=tree)


def _of_picture(source: Path, wanted: dict, templates, *, key, reading, tree, trunk, watch):
    from sketchtree.growth_tree import find_trunk, of_picture
    from sketchtree.matting.known_matte import read_matte
    from sketchtree.matting.scribbles import read_scribbles
    from sketchtree.photo.read_photo import read_photo
    from sketchtree.trunk.edits import VertexEdits, read_edits

    with watch("read"):
        photo = read_photo(source, max_mb=reading.max_mb, max_megapixels=reading.max_megapixels)
        scribbles = None if wanted["scribbles"] is None else read_scribbles(wanted["scribbles"], photo, max_mb=reading.max_mb)
        known = None if wanted["use_matte"] is None else read_matte(wanted["use_matte"], photo)
        if scribbles is None and known is None and photo.alpha is None:
            raise SketchError(
                f"{source.name} is a picture, and nothing says what of it is tree.",
                remedy="Give `--scribbles FILE` with lines on the tree and beside it, or `--use-matte A.png`. If it is a drawing: `sketchtree build` it, and give that tree to `grow`.",
            )
        edits = VertexEdits() if wanted["vertices"] is None else read_edits(wanted["vertices"])
    found = find_trunk(photo, scribbles, templates, key=key, wanted=trunk, reading=reading, edits=edits, painted=wanted["edit_matte"], known=known, watch=watch)
    return of_picture(found, tree, templates, key=key)


def _of_skeleton(source: Path, wanted: dict, templates, *, seed: int, seed_chosen: bool, reading, tree):
    """A tree that is there already, dressed as its file tells where the user does not."""
    from sketchtree.growth_tree import of_skeleton
    from sketchtree.keys import root_key

    skeleton, told, units, parts = _skeleton(source)
    seed = seed if seed_chosen else int(told.get("seed", seed))
    template = reading.template if reading.template not in ("auto", "none") else told.get("template") if reading.template == "auto" else None
    if template and (templates is None or template not in templates.names):
        from sketchtree.errors import TemplateError

        raise TemplateError(f"There is no template called “{template}”.", remedy=f"Choose auto, none or one of: {', '.join(templates.names if templates else ())}.")
    begun = of_skeleton(skeleton, with_own_looks(tree, told, season_chosen=_season_chosen()), templates, key=root_key(seed), template=template or None, height=reading.height)
    return dataclasses.replace(begun, leafing=_as_seen(told, parts, skeleton, reading.height), warnings=(*units, *begun.warnings)), seed


def _as_seen(told: dict, parts: tuple, skeleton, height: float | None):
    """What puts leaves where those of the file are, if they stand there because they were seen."""
    from sketchtree.tree_output import SEEN

    if told.get("leaves") != SEEN:
        return None
    from sketchtree.clouds.leafy.worn_before import worn_before

    return worn_before(parts, skeleton, height)


def _season_chosen() -> bool:
    return click.get_current_context().get_parameter_source("season") is not ParameterSource.DEFAULT


def _skeleton(source: Path):
    """(the skeleton of a file, what it tells of the tree's looks, what a person should know, its meshes). Raises SkeletonError, ExportError."""
    from sketchtree.export.read import read_contents
    from sketchtree.skeleton_files import read_skeleton

    suffix = source.suffix.lower()
    if suffix in (".npz", ".csv", ".txt"):
        return read_skeleton(source), {}, (), ()
    contents = read_contents(source)
    if contents.skeleton is None:
        raise ExportError(f"{source} holds no skeleton, and only a skeleton grows.", remedy="Give a file that `sketchtree` wrote, or a skeleton.")
    units = str(contents.header.get("units", "metres"))
    said = () if units in ("metres", "m") else (f"{source.name} is in {units}; they were taken for metres (`--height` scales it).",)
    if suffix in PROJECTS:
        from sketchtree.export.skeletons.hdf5 import read_choices

        return contents.skeleton, read_choices(source), said, ()
    return (contents.skeleton, {}, said, ()) if contents.asset is None else (contents.skeleton, _looks(contents.asset), said, contents.asset.parts)


def _looks(asset) -> dict:
    """What a mesh file of ours tells: seed, template and what it wears; of an older one, leaf and bark by the names of its materials."""
    told = {name: asset.about[name] for name in ("seed", "template", "leaf", "bark", "season", "leaves") if asset.about.get(name) is not None}
    return _by_materials(asset) | told


def _by_materials(asset) -> dict:
    from sketchtree.foliage.models import leaf_names
    from sketchtree.geometry.bark import bark_names

    names = [part.mesh.material.name if hasattr(part, "mesh") else part.material.name for part in asset.parts]
    leaves = [name.removeprefix("leaf_") for name in names if name.startswith("leaf_")]
    leaf = next((model for model in sorted(leaf_names(), key=len, reverse=True) for name in leaves if name.startswith(model)), None)
    bark = next((model for model in sorted(bark_names(), key=len, reverse=True) for name in names if name.startswith(f"wood_{model}")), None)
    return {"leaf": leaf or "none"} | ({} if bark is None else {"bark": bark})
