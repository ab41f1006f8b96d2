"""`sketchtree batch PATTERN --out DIR`: many drawings in, a tree and a report of each out."""

import dataclasses
import os
import time
from pathlib import Path

import click

from sketchtree.commands import options
from sketchtree.commands.progress import Progress
from sketchtree.errors import ExportError, OptionError
from sketchtree.export.files import MESHES, PROJECTS, SKELETONS

FORMATS = tuple(suffix[1:] for suffix in MESHES + SKELETONS + PROJECTS) + ("png",)
MOST_JOBS = 256


@click.command("batch")
@click.argument("patterns", nargs=-1, required=True, metavar="PATTERN...")
@click.option("--out", required=True, type=click.Path(path_type=Path), metavar="DIR", help="Folder to write to; made if there is none.")
@click.option("--format", "kind", type=click.Choice(FORMATS), default="glb", show_default=True, help="What to write of each tree.")
@click.option("--jobs", type=int, metavar="N", help="Processes (default 1); the trees are the same.")
@click.option("--scheduler", metavar="ADDRESS", help="Let the workers of a Dask scheduler do it; they must see the same disk.")
@click.option("--resume", is_flag=True, help="Keep trees made of the same drawings by the same options; make the others anew.")
@click.option("--skeleton", is_flag=True, help="Write each complete skeleton too (NAME.swc).")
@click.option("--preview", is_flag=True, help="Write a picture of each tree too (NAME.png).")
@options.reading
@options.tree(200_000, "each tree", beside=False)
@options.files
@options.common
def batch(
    patterns: tuple[str, ...], out: Path, jobs: int | None, scheduler: str | None, resume: bool, report: Path | None, quiet: bool, json_log: bool, **wanted
) -> int:
    """Turn every drawing that PATTERN matches into a tree: a file, a folder of drawings, or a pattern in quotes ('sketches/**/*.svg').

    DIR/NAME.glb is what `build` makes of it with the same options, DIR/NAME.report.json its report; DIR/batch.json and
    DIR/batch.csv have a line a drawing. One that can't be used does not stop the others; the exit status is then 1.
    """
    began = time.perf_counter()
    _check_who(jobs, scheduler)
    from sketchtree import batch_record
    from sketchtree.batch import check_free, check_manner, orders
    from sketchtree.commands.batch_crew import made

    manner = _manner(out, wanted)
    check_manner(manner)
    to_make, passed = orders(patterns, manner)
    _check_report(report, to_make)
    if not resume:
        check_free(to_make)
    _ready(out)
    rows, journal = {order.name: batch_record.row(order) for order in to_make}, batch_record.Journal(resume)
    progress = Files(tuple(order.name for order in to_make), quiet=quiet, json_log=json_log)
    try:
        with progress.running():
            if passed:
                progress.say(f"{passed} other file{'s' if passed > 1 else ''} passed over: no drawings by their names, or results in {out}.")
            for order, row in made(to_make, jobs or 1, scheduler, journal):
                rows[order.name] = row
                progress.tell(row)
    finally:
        told = batch_record.summary([*(rows | journal.made).values()], manner, patterns, time.perf_counter() - began)
        batch_record.write_summary(told, *([report] if report else []))
    progress.say(_conclusion(told), event="done", **told["count"])
    return 1 if told["count"][batch_record.FAILED] else 0


class Files(Progress):
    """A line a drawing; on a terminal a bar, and lines for failures only. Those are told in any case."""

    _done = 0

    def tell(self, row: dict) -> None:
        """One drawing is done."""
        self._done += 1
        failed, text = row["error"] is not None, _line(row)
        if failed and not self._json:
            click.echo(f"sketchtree: {text}", err=True) if self._bar is None else self.say(text)
        elif self._bar is None:
            self.say(text, event="file", **row)
        if self._bar is not None:
            self._bar.update(0, completed=self._done, description=f"{self._done} of {len(self._stages)}")


def _line(row: dict) -> str:
    if row["error"] is not None:
        return f"{row['sketch']}: {row['error']}"
    notes = len(row["warnings"])
    parts = [f"{row['sketch']} → {row['output']}: {row['status']}", f"{row['segments']} segments", f"{row['seconds']:.1f} s"]
    return ", ".join(parts + ([f"{notes} note{'s' if notes > 1 else ''}"] if notes else []))


def _conclusion(told: dict) -> str:
    count = {status: number for status, number in told["count"].items() if number}
    said = ", ".join(f"{number} {status}" for status, number in count.items())
    return f"{told['out']}: {len(told['files'])} drawing{'s' if len(told['files']) > 1 else ''}, {said}, {told['seconds']:.1f} s"


def _check_who(jobs: int | None, scheduler: str | None) -> None:
    if scheduler is not None and jobs is not None:
        raise OptionError("`--jobs` and `--scheduler` exclude each other.", remedy="Leave one out.")
    if jobs is not None and not 1 <= jobs <= MOST_JOBS:
        raise OptionError(f"`--jobs {jobs}` is no number of processes.", remedy=f"Give 1 to {MOST_JOBS}.")


def _manner(out: Path, wanted: dict):
    """What the user asked for, refused here if no tree could be made by it."""
    from sketchtree import batch_record
    from sketchtree import options as choices
    from sketchtree.batch import Manner
    from sketchtree.choose import bark_model, leaf_model
    from sketchtree.commands.writing import check_files, split_options
    from sketchtree.export.files import check_program
    from sketchtree.geometry.wood import check_wood
    from sketchtree.parameters import Habit
    from sketchtree.pipeline import read_obstacles
    from sketchtree.propagate.after.prune import Prune
    from sketchtree.templates.store.database import Database

    reading, tree, files = split_options(wanted, choices.ReadingOptions, choices.TreeOptions, choices.FileOptions)
    written = Path(f"{out / 'NAME'}.{wanted['kind']}")
    check_files(written, files, instead="Write `--format glb`.")
    check_program(written)
    db = wanted["db"]
    templates = None if db is None and reading.template == "none" else Database.open(db)
    if reading.template not in ("auto", "none"):
        templates.index(reading.template)
    leaf_model(tree.leaf, Habit(), templates), bark_model(tree.bark, Habit())
    Prune(tree.prune), read_obstacles(tree), check_wood(tree.wood, tree.solid)
    said = {name: wanted[name] for name in ("kind", "seed", "skeleton", "preview")}
    manner = Manner(str(out), os.getcwd(), reading=reading, tree=tree, files=files, db=None if db is None else str(db), **said)
    return dataclasses.replace(manner, made_by=batch_record.made_by(manner, templates and templates.path))


def _check_report(report: Path | None, to_make) -> None:
    """Refuse a `--report` that would overwrite a drawing or a tree, or can't be written."""
    if report is None:
        return
    from sketchtree.export.files import check_writable

    taken = {Path(path).resolve() for order in to_make for path in (order.sketch, *order.files)}
    if report.resolve() in taken:
        raise ExportError(f"`--report {report}` would overwrite a drawing or a result.", remedy="Give it another name.")
    check_writable(report)


def _ready(out: Path) -> None:
    """The folder is there and can be written to."""
    from sketchtree.batch import SUMMARY
    from sketchtree.export.files import check_writable

    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ExportError(f"The folder {out} can't be made ({(error.strerror or str(error)).lower()}).", remedy="Choose a place you may write to.") from error
    check_writable(out / SUMMARY)
