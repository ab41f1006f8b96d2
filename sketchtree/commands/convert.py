"""`sketchtree convert A B`: a tree from one kind of file to another, by their extensions."""

import time
from pathlib import Path

import click
from click.core import ParameterSource

from sketchtree.commands import options
from sketchtree.commands.progress import Progress


@click.command("convert")
@click.argument("source", metavar="A", type=click.Path(path_type=Path))
@click.argument("target", metavar="B", type=click.Path(path_type=Path))
@click.option("--leaf", metavar="MODEL|EXEMPLAR|none", help="From a skeleton to a mesh: leaves of that model (default: none; of a project, its own).")
@click.option("--season", type=click.Choice(options.SEASONS), help="The leaves' season (default: summer; of a project, its own).")
@click.option("--bark", metavar="NAME", help="From a skeleton to a mesh: its bark (default: oak; of a project, its own).")
@options.common
def convert(source: Path, target: Path, seed: int, quiet: bool, json_log: bool, report: Path | None, db: Path | None, **wanted) -> None:
    """Write the tree in file A as file B, each told by its extension.

    Meshes: .glb .gltf .usd .usdz .obj .ply .stl; skeletons: .swc .mtg .json .h5. A may also be a project, .sketchtree; B .3mf or .png.
    """
    began = time.perf_counter()
    from sketchtree.commands import writing
    from sketchtree.errors import ExportError
    from sketchtree.export.files import MESHES, SKELETONS

    if source.resolve() == target.resolve():
        raise ExportError(f"{target} is what is to be read, too.", remedy="Give the new file another name.")
    writing.check_outputs(source, target, report)
    imported = time.perf_counter() - began
    progress = Progress(("read", "mesh", "export"), quiet=quiet, json_log=json_log)
    from sketchtree.export.read import read_contents
    from sketchtree.commands import made_anew
    from sketchtree.watch import Watch

    watch = Watch(progress, progress.part)
    with progress.running():
        made = made_anew.is_made_anew(source)
        with watch("read"):
            contents, told, seed = _made_anew(source, seed, db, wanted) if made else (read_contents(source), (), seed)
        bare = contents.asset is None
        if target.suffix.lower() in SKELETONS:
            _refuse_dress(wanted, target, "a skeleton wears nothing")
            with watch("export"):
                warnings, said = told, _write_skeleton(source, target, contents)
            counts = None
        else:
            if not bare and not made:
                _refuse_dress(wanted, source, "its meshes are dressed already")
            with watch("mesh"):
                asset, worn, warnings = _dressed(source, contents, seed, db, wanted) if bare else (contents.asset, "", told)
            with watch("export"):
                warnings += _write_asset(target, asset) if target.suffix.lower() in MESHES else _write_picture(target, asset)
            counts = {kind: sum(part.triangle_count for part in asset.parts if part.name.startswith(kind)) for kind in ("wood", "leaf")}
            said = f"{sum(part.triangle_count for part in asset.parts)} triangles" + worn
        seconds = {"import": imported} | watch.seconds | {"total": time.perf_counter() - began}
        writing.write_report(report, _record(contents, counts, seed, seconds, warnings))
    for warning in warnings:
        progress.say(f"Note: {warning}", event="warning")
    progress.say(f"{target}: {said}, {seconds['total']:.1f} s", event="done")


def _made_anew(source: Path, seed: int, db: Path | None, wanted: dict):
    """(what a project that keeps no tree is made into, what a person should know of that, the seed in use)."""
    from sketchtree.commands import made_anew
    from sketchtree.export.read import Contents
    from sketchtree.options import TreeOptions
    from sketchtree.tree_output import Made, asset_of

    chosen = click.get_current_context().get_parameter_source("seed") is not ParameterSource.DEFAULT
    tree = TreeOptions(leaf=wanted["leaf"], bark=wanted["bark"], season=wanted["season"] or "summer")
    grown, seed = made_anew.grown(source, db, seed=seed, seed_chosen=chosen, season_chosen=wanted["season"] is not None, tree=tree)
    asset = asset_of(grown.model, Made(seed))
    return Contents(asset, asset.skeleton, {"units": "metres", "frame": "world", "seed": seed}), grown.warnings, seed


def _write_skeleton(source: Path, target: Path, contents) -> str:
    from sketchtree.errors import ExportError
    from sketchtree.export.write import write_skeleton
    from sketchtree.version import __version__

    if contents.skeleton is None:
        raise ExportError(f"{source} holds no skeleton.", remedy="Give a skeleton, a project, or a glTF or USD file that `sketchtree build` wrote.")
    write_skeleton(target, contents.skeleton, header=contents.header | {"version": __version__})
    return f"{contents.skeleton.segment_count} segments"


def _write_asset(target: Path, asset) -> tuple[str, ...]:
    from sketchtree.export.write import write_asset

    return write_asset(target, asset)


def _write_picture(target: Path, asset) -> tuple[str, ...]:
    from sketchtree.view import preview

    drawn, reason = preview([part.merged() for part in asset.parts], target)
    return () if drawn else (f"{target} was not drawn: {reason}",)


def _dressed(source: Path, contents, seed: int, db: Path | None, wanted: dict):
    """(the skeleton as meshes, what the summary says of its dress, warnings)."""
    from sketchtree.asset import Asset
    from sketchtree.choose import bark_model, leaf_model
    from sketchtree.dressing import Dress, leaves_worn, wood_worn
    from sketchtree.keys import root_key
    from sketchtree.parameters import Habit
    from sketchtree.tree_output import worn_in_words
    from sketchtree.version import __version__

    made_of = _project_dress(source)
    chosen = click.get_current_context().get_parameter_source("seed") is not ParameterSource.DEFAULT
    seed = seed if chosen else made_of.get("seed", seed)
    template, leaf = made_of.get("template"), wanted["leaf"] or made_of.get("leaf")
    templates = _templates(db) if template or leaf not in (None, "none") else None
    habit = templates.exemplar(template).habit if template and template in templates.names else Habit()
    season = wanted["season"] or made_of.get("season") or "summer"
    leaf = leaf_model(leaf, habit, templates) if leaf or template else None
    dress = Dress(bark_model(wanted["bark"] or made_of.get("bark"), habit), leaf, season, habit, made_of.get("wood"), made_of.get("solid", False))
    about = {"program": "SketchTree", "version": __version__, "seed": seed, "units": "metres", "up": "y"} | ({"template": template or None} if made_of else {}) | worn_in_words(dress)
    wood, leaves = wood_worn(contents.skeleton, dress, key=root_key(seed)), leaves_worn(contents.skeleton, dress, key=root_key(seed))
    asset = Asset.of((*wood.meshes, *leaves), skeleton=contents.skeleton, about=about)
    worn = f", wood {wood.made}, bark {dress.bark}, " + (f"leaves {leaf}" if leaf else "no leaves (`--leaf MODEL` adds them)")
    warnings = wood.warnings
    if (units := str(contents.header.get("units", "metres"))) not in ("metres", "m"):
        warnings += (f"{source} is in {units}; they were taken for metres.",)
    if not any(mesh.triangle_count for mesh in wood.meshes):
        warnings += (f"{source} has no branch of any length, so there is nothing to draw.",)
    elif leaf is not None and not leaves:
        warnings += (f"No leaf grew: no branch of {source} is thin enough to bear them, or the season is bare.",)
    return asset, worn, warnings


def _project_dress(source: Path) -> dict:
    """What a project was built with: seed, template, leaf, season, bark. Nothing of other files."""
    if source.suffix.lower() != ".sketchtree":
        return {}
    from sketchtree.export.skeletons.hdf5 import read_choices

    return read_choices(source)


def _templates(db: Path | None):
    from sketchtree.templates.store.database import Database

    return Database.open(db)


def _refuse_dress(wanted: dict, path: Path, why: str) -> None:
    from sketchtree.errors import OptionError

    given = next((name for name, value in wanted.items() if value is not None), None)
    if given is not None:
        raise OptionError(f"`--{given}` changes nothing in {path}: {why}.", remedy="Leave it out, or convert a skeleton to a mesh.")


def _record(contents, counts: dict | None, seed: int, seconds: dict, warnings: tuple[str, ...]) -> dict:
    from sketchtree.reading_report import SCHEMA
    from sketchtree.version import __version__

    tree = contents.skeleton
    return {
        "schema": SCHEMA,
        "version": __version__,
        "command": "convert",
        "segments": None if tree is None else tree.segment_count,
        "triangles": counts,
        "seconds": {name: round(value, 4) for name, value in seconds.items()},
        "warnings": list(warnings),
        "seed": seed,
    }
