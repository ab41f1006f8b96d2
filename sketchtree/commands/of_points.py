"""What `cloud` and `views` do alike: what was asked of a tree that stands in points, and its files and report."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from sketchtree.cloud_report import cloud_report
from sketchtree.cloud_tree import CloudOptions, CloudTree, Follow, cloud_to_tree
from sketchtree.commands import cloud_growth, writing
from sketchtree.growth_tree import check_tree
from sketchtree.keys import root_key
from sketchtree.options import FileOptions, TreeOptions, options_as_dict
from sketchtree.templates.store.database import Database
from sketchtree.watch import Watch

_HOW = ("method", "species", "figures", "roots", "keep_pot", "in_leaf", "inside", "pixel")


@dataclass(frozen=True)
class Asked:
    """What was asked for, checked as far as it can be before any work."""

    how: CloudOptions
    tree: TreeOptions
    files: FileOptions
    template: str | None
    templates: Database
    seed: int
    output: Path
    skeleton: Path | None
    preview: Path | None
    distances: Path | None
    report: Path | None
    beside: cloud_growth.Beside

    def with_pixel(self, metres: float) -> "Asked":
        """The same of photos whose pixels are so much of the plant."""
        return replace(self, how=replace(self.how, pixel=metres))


def asked(wanted: dict, *, given: tuple[Path, ...], output: Path, report: Path | None, seed: int, db: Path | None, **how) -> Asked:
    """What the command line said. `given`: files that are read; `how`: options of the points that only one of the commands has. Raises OptionError and TemplateError for what there is not."""
    tree, files = writing.split_options(wanted, TreeOptions, FileOptions)
    writing.check_files(output, files)
    if wanted["distances"] is not None:
        writing.check_extension(wanted["distances"], (".ply",))
    points = CloudOptions(**{name: wanted[name] for name in _HOW}, **how)
    templates = Database.open(db)
    check_tree(tree, templates)
    if wanted["template"] is not None:
        templates.exemplar(wanted["template"])
    beside = cloud_growth.asked(wanted, points.method, output, (*given, *(path for path in (report, wanted["distances"], wanted.get("cloud_file")) if path is not None)))
    return Asked(points, tree, files, wanted["template"], templates, seed, output, wanted["skeleton"], wanted["preview"], wanted["distances"], report, beside)


def made(points, wanted: Asked, watch: Watch, follow: Follow | None = None) -> CloudTree:
    """The tree that stands in a file of points, or in points. `follow`: finds what they are too coarse for."""
    return cloud_to_tree(points, wanted.templates, key=root_key(wanted.seed), wanted=wanted.how, tree=wanted.tree, template=wanted.template, follow=follow, watch=watch)


def written(
    tree: CloudTree, wanted: Asked, command: str, watch: Watch, *, began: float, imported: float, given: tuple[Path, ...],
    options: dict | None = None, beside: Callable[[], None] = lambda: None, told: tuple[str, ...] = (), blocks: dict | None = None,
) -> dict:  # fmt: skip
    """Write every file that was asked for; the report. `given`: files that it was made of; `beside` writes what only one command has; `options`, `told`, `blocks`: what only its
    report says: choices, warnings, blocks."""
    run = writing.Run(command, wanted.seed, imported, began, watch, options_as_dict(wanted.how, wanted.tree, wanted.files) | {"template": wanted.template} | (options or {}))
    with watch("export"):
        beside()
        measured = _measured(tree, wanted.distances)
        unseen = writing.write_tree(tree.model, wanted.output, run, skeleton=wanted.skeleton, preview=wanted.preview, files=wanted.files, sketches=given)
    others, more = cloud_growth.written(tree, wanted.beside, run, wanted.files, given)
    record = cloud_report(tree, others, **writing.of_run(run), warnings=(*told, *unseen, *more)) | (blocks or {}) | measured
    writing.write_report(wanted.report, record)
    return record


def _measured(tree: CloudTree, path: Path | None) -> dict:
    """The report's block about distances, if they were asked for and written."""
    if path is None:
        return {}
    from sketchtree.fidelity.distance_file import write_distances

    found = write_distances(tree.prepared.cloud, tree.model.meshes, path)
    figures = {"mean": found.mean, "sd": found.sd, "share": found.share, "within": found.within(0.015)}
    return {"distances": {name: round(value, 6) for name, value in figures.items()}}
