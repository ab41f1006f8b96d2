"""Which trees does a growth toward points write beside its own? A series of its cycles, and a tree of each value of a figure."""

from dataclasses import dataclass, replace
from pathlib import Path

from sketchtree.clouds.growing.figures import Change, changes
from sketchtree.commands import writing
from sketchtree.commands.series import check_series, series_files, write_series
from sketchtree.errors import OptionError

MOST = 64
"""Variations."""


@dataclass(frozen=True)
class Beside:
    """What was asked for."""

    changes: tuple[Change, ...]
    series: Path | None
    frames: int | None
    output: Path
    skeleton: Path | None
    preview: Path | None

    def paths(self, change: Change) -> dict[str, Path | None]:
        """The files of one variation: those of the tree, with the figure in their names."""
        named = {"output": self.output, "skeleton": self.skeleton, "preview": self.preview}
        return {name: None if path is None else path.with_name(f"{path.stem}_{change.name}_{change.text}{path.suffix}") for name, path in named.items()}


def asked(wanted: dict, method: str, output: Path, given: tuple[Path, ...]) -> Beside:
    """What the command line said, checked as far as it can be before any work. `given`: files that are read, or written by the rest of the command. Raises OptionError and ExportError."""
    found = Beside(tuple(change for said in wanted["vary"] for change in changes(said)), wanted["series"], wanted["frames"], output, wanted["skeleton"], wanted["preview"])
    _check(found, wanted, method)
    others = [path for path in (output, wanted["skeleton"], wanted["preview"]) if path is not None]
    for change in found.changes:
        paths = found.paths(change)
        writing.check_outputs((*given, *others), paths["output"], None, paths["skeleton"], paths["preview"], source="what it is made of, or another tree")
    if found.series is not None:
        check_series(found.series, [output.stem], found.frames)
    return found


def _check(found: Beside, wanted: dict, method: str) -> None:
    if found.frames is not None and found.series is None:
        raise OptionError("`--frames` counts the trees of a series, and none is asked for.", remedy="Add `--series FOLDER`, or leave it out.")
    if method != "grown":
        for option, given in (("--vary", wanted["vary"][0] if wanted["vary"] else None), ("--series", found.series)):
            if given is not None:
                raise OptionError(f"`{option} {given}` is about how a tree grows, and one that is {method} is where its points are.", remedy="Add `--method grown`, or leave it out.")
    if len(found.changes) > MOST:
        raise OptionError(f"{len(found.changes)} variations are asked for.", remedy=f"Ask for {MOST} at most.")
    twice = next((change for k, change in enumerate(found.changes) if change in found.changes[:k]), None)
    if twice is not None:
        raise OptionError(f"`--vary` says {twice.name}={twice.text} twice.", remedy="Say it once.")


def written(tree, beside: Beside, run, files, given: tuple[Path, ...]) -> tuple[dict, tuple[str, ...]]:
    """(what the report says of them, warnings): each variation is grown, written and forgotten; the series is whole or not at all."""
    told, found = (), []
    for change in beside.changes:
        row, more = _variation(tree, change, beside.paths(change), run, files, given)
        found.append(row)
        told += more
    return {"series": [] if beside.series is None else _series(tree, beside, run, files), "variations": found}, told


def _variation(tree, change: Change, paths: dict, run, files, given) -> tuple[dict, tuple[str, ...]]:
    from sketchtree.cloud_growing import variation

    other = variation(tree, change, run.watch).tree
    run = replace(run, options=run.options | {"figures": (*tree.wanted.figures, f"{change.name}={change.text}")})
    with run.watch("export"):
        told = writing.write_tree(other.model, paths["output"], run, skeleton=paths["skeleton"], preview=paths["preview"], files=files, sketches=given)
    of_species = {name: getattr(other.species, name) for name in ("internode", "roll", "branching", "gamma")}
    return {"file": paths["output"].name, "figure": change.name, "value": change.text, "species": of_species} | _size(other.model), told


def _series(tree, beside: Beside, run, files) -> list[dict]:
    from sketchtree.asset import Asset
    from sketchtree.cloud_growing import after, cycles
    from sketchtree.export.write import asset_files
    from sketchtree.levels.make import as_fine_as
    from sketchtree.tree_output import about_of

    paths, rows = series_files(beside.series, beside.output.stem, beside.frames), []
    at = cycles(tree, len(paths))

    def frame(path: Path, number: int) -> bytes:
        model = after(tree, int(at[number]))
        meshes = as_fine_as(model, files)
        rows.append({"file": path.name, "cycle": int(at[number])} | _size(model))
        return asset_files(path, Asset.of(meshes, skeleton=model.skeleton, about=about_of(model, run.made)))[path]

    with run.watch("export"):
        write_series(paths, frame, run.watch.on_part)
    return rows


def _size(model) -> dict:
    skeleton = model.skeleton
    return {"segments": skeleton.segment_count, "height": skeleton.height, "length": float(skeleton.length.sum()), "leaves": len(model.leaves)}
