"""`sketchtree templates`: make, list, show and try the exemplars a sketch is matched with."""

import json
import os
from pathlib import Path

import click

from sketchtree.commands.options import common, drawing
from sketchtree.commands.progress import Progress
from sketchtree.errors import OptionError

SCORES = ("calibrated", "chen")
SCANS = (".ply", ".las", ".laz", ".xyz", ".pts", ".asc", ".npy")
"""Files that are point clouds and nothing else."""

GROWTH_HABITS = ("decurrent", "fastigiate", "weeping", "excurrent", "umbrella", "palm", "shrub", "irregular")


@click.group(help="The exemplars a sketch is matched with.")
def templates() -> None:
    """Make, list, show and try exemplars."""


@templates.command("list")
@click.option("--json", "as_json", is_flag=True, help="One JSON array instead of lines.")
@common
def list_command(as_json: bool, db: Path | None, report: Path | None, **_) -> None:
    """One line an exemplar and nothing else."""
    from sketchtree.templates.store.database import Database

    database = Database.open(db)
    columns = (database.names, database.titles, database.species, database.growth_habits)
    rows = [dict(zip(("name", "title", "species", "growth_habit"), row, strict=True)) for row in zip(*columns, strict=True)]
    if as_json:
        click.echo(json.dumps(rows, ensure_ascii=False, indent=2))
    else:
        for row in rows:
            title = row["title"].removesuffix(f" ({row['species']})")
            click.echo(f"{row['name']:<22} {row['growth_habit'] or '-':<11} {row['species'] or '-':<30} {title}".rstrip())
    _write_report(report, {"exemplars": rows})


@templates.command("show")
@click.argument("name")
@click.option("-o", "--out", type=click.Path(path_type=Path), help="Write a picture (.png).")
@common
def show_command(name: str, out: Path | None, db: Path | None, report: Path | None, quiet: bool, **_) -> None:
    """What the database knows of one exemplar."""
    from sketchtree.templates.store.database import Database
    from sketchtree.templates.pictures import portrait, save_picture
    from sketchtree.templates.summary import summary

    exemplar = Database.open(db).exemplar(name)
    if out is not None:
        save_picture(portrait(exemplar), out)
    facts = summary(exemplar)
    if not quiet:
        width = max(map(len, facts))
        for key, value in facts.items():
            click.echo(f"{key:<{width}}  {value}")
    _write_report(report, {"exemplar": facts})


@templates.command("sheet")
@click.option("-o", "--out", type=click.Path(path_type=Path), required=True, help="The picture to write (.png).")
@common
def sheet_command(out: Path, db: Path | None, report: Path | None, **_) -> None:
    """All exemplars on one picture."""
    from sketchtree.templates.store.database import Database
    from sketchtree.templates.pictures import contact_sheet, save_picture

    database = Database.open(db)
    save_picture(contact_sheet(database), out)
    _write_report(report, {"exemplars": list(database.names), "out": str(out)})


@templates.command("match")
@click.argument("sketch", type=click.Path(path_type=Path))
@click.option("--json", "as_json", is_flag=True, help="One JSON array instead of lines.")
@click.option("--score", type=click.Choice(SCORES), default="calibrated", show_default=True, help="Ours, or exactly the paper's.")
@drawing
@common
def match_command(sketch: Path, as_json: bool, score: str, db: Path | None, report: Path | None, **wanted) -> None:
    """Which exemplars a sketch is like, best first."""
    from sketchtree.commands.writing import split_options
    from sketchtree.drawing import read_drawing
    from sketchtree.options import DrawingOptions
    from sketchtree.templates.store.database import Database
    from sketchtree.templates.matching.match import match
    from sketchtree.watch import Watch

    (options,) = split_options(wanted, DrawingOptions)
    _, graph = read_drawing(sketch, options, Watch())
    ranked = match(graph.above_ground(), Database.open(db), score=score)
    keys = ("name", "view_deg", "score", "crown", "branching")
    rows = [{key: getattr(row, key) for key in keys} for row in ranked]
    if as_json:
        click.echo(json.dumps(rows, indent=2))
    else:
        for row in ranked:
            click.echo(f"{row.name:<20} {row.score:10.3f}   seen from {row.view_deg:3.0f}°")
    _write_report(report, {"template": rows})


@templates.command("build")
@click.option("--out", type=click.Path(path_type=Path), help="The file to write (default: exemplars.h5 beside the recipes).")
@click.option("--recipes", type=click.Path(path_type=Path), help="Folder of recipes (default: template_db of the checkout).")
@click.option("--only", multiple=True, metavar="SPECIES", help="Only this recipe, or all of this species; may be repeated.")
@click.option("--count", type=click.IntRange(1, 100_000), help="So many exemplars: recipes in turn, each round from new seeds.")
@click.option("--jobs", type=click.IntRange(1, 256), help="Processes (default: all cores); the result is the same.")
@click.option("--scheduler", metavar="ADDRESS", help="Let the workers of a Dask scheduler do it, such as tcp://10.0.0.1:8786.")
@common
def build_command(
    out: Path | None, recipes: Path | None, only: tuple[str, ...], count: int | None, jobs: int | None, scheduler: str | None,
    seed: int, quiet: bool, json_log: bool, db: Path | None, report: Path | None,
) -> None:  # fmt: skip
    """Make the database from its recipes. `--seed` is added to every recipe's own.

    A build that was stopped goes on where it was when the same command is run again.
    """
    from sketchtree.templates.making.regenerate import orders, recipe_folder, regenerate

    if scheduler is not None and jobs is not None:
        raise OptionError("`--jobs` and `--scheduler` exclude each other.", remedy="Leave one out.")
    folder = recipes or recipe_folder()
    wanted = orders(folder, only=only, count=count, seed=seed)
    target = out or db or folder / "exemplars.h5"
    if out is None and db is None and (only or count) and target.exists():
        raise OptionError(
            f"`--only` and `--count` would replace the whole database {target} by other exemplars.",
            remedy="Name the file to write with --out.",
        )
    progress = Exemplars(tuple(order.name for order in wanted), quiet=quiet, json_log=json_log)
    with progress.running():
        database = regenerate(target, wanted, jobs=jobs or cores(), scheduler=scheduler, progress=progress, say=progress.say)
        progress.say(f"wrote {target}: {len(database)} exemplars, {target.stat().st_size / 1e6:.2f} MB", event="written")
    _write_report(report, {"exemplars": list(database.names), "out": str(target)})


class Exemplars(Progress):
    """Tells how many exemplars are done: each by name, or of very many every tenth."""

    NAMED = 200  # exemplars, above which they are counted only

    def __init__(self, names: tuple[str, ...], **how):
        self._many, self._done = len(names) if len(names) > self.NAMED else 0, 0
        super().__init__((f"{len(names)} exemplars",) if self._many else names, **how)
        if self._many:
            super().__call__(f"{len(names)} exemplars")

    def __call__(self, name: str) -> None:
        self._done += 1
        if self._many:
            self.part(self._done / self._many)
        else:
            super().__call__(name)


def cores() -> int:
    """How many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@templates.command("import")
@click.argument("files", nargs=-1, required=True, metavar="FILE...", type=click.Path(path_type=Path))
@click.option("--into", type=click.Path(path_type=Path), required=True, help="The database to add to; begun where there is none.")
@click.option("--name", help="Name of the exemplar (default: the file's). One file only.")
@click.option("--title", help="Name for people (default: the name). One file only.")
@click.option("--unit", type=click.Choice(["m", "cm", "mm"]), default="m", show_default=True, help="What the file's lengths are in.")
@click.option("--up", type=click.Choice(["y", "z"]), help="Which axis points up (default: z in MTG and cylinder tables, as it lies in clouds, else y).")
@click.option("--tree", "which", type=click.IntRange(1), metavar="K", help="Which tree of a point cloud of several, 1 the largest.")
@click.option("--species", default="", help="Botanical name.")
@click.option("--growth-habit", type=click.Choice(GROWTH_HABITS), help="What it looks like before any species.")
@click.option("--source", default="", help="Who measured it, where; kept with it.")
@click.option("--leaf", help="Leaf model.")
@click.option("--bark", help="Bark model.")
@click.option("--like", metavar="NAME", help="Exemplar of --db whose leaves, bark and unmeasured habit it borrows.")
@click.option("--replace", is_flag=True, help="Put it in the place of an exemplar of the same name.")
@common
def import_command(
    files: tuple[Path, ...], into: Path, name: str | None, title: str | None, like: str | None, leaf: str | None, bark: str | None,
    growth_habit: str | None, which: int | None, replace: bool, quiet: bool, json_log: bool, db: Path | None, report: Path | None, seed: int, **said,
) -> None:  # fmt: skip
    """Add real trees as exemplars: digitised (.mtg, .swc, .csv or .txt of cylinders, .npz, .json, .h5), or scanned (.ply, .las, .laz, .xyz)."""
    from sketchtree.templates.importing.add import add, blocks_of, check_free
    from sketchtree.templates.importing.read import Described, check_name, imported, name_of

    if len(files) > 1 and (name is not None or title is not None):
        raise OptionError("`--name` and `--title` are for one file.", remedy="Import the files one by one, or let their names be the exemplars'.")
    if name is not None:
        check_name(name)
    habit = None if like is None else _habit_of(like, db)
    _check_models(leaf, bark)
    check_free(into, [name or name_of(file) for file in files if not _is_database(file)], replace=replace)
    described = Described(name=name, title=title, growth_habit=growth_habit or "", leaf=leaf, bark=bark, like=habit, **said)
    progress = Exemplars(tuple(map(str, files)), quiet=quiet, json_log=json_log)
    with progress.running():
        blocks = []
        for file in files:
            blocks += blocks_of(file) if _is_database(file) else [imported(file, described, _traced(file, described, which, seed))]
            progress(str(file))
        database = add(into, blocks, replace=replace)
        progress.say(f"wrote {into}: {len(database)} exemplars, {len(blocks)} of them new, {into.stat().st_size / 1e6:.2f} MB", event="written")
    _write_report(report, {"exemplars": list(database.names), "imported": [b["exemplar/name"][0].decode() for b in blocks], "out": str(into)})


def _traced(file: Path, described, which: int | None, seed: int):
    """The tree that stands in a point cloud; None of a file that holds a skeleton."""
    if file.suffix.lower() not in SCANS:
        return None
    from sketchtree.cloud_tree import CloudOptions, CloudSource
    from sketchtree.keys import root_key
    from sketchtree.templates.importing.frame import METRES

    return CloudSource(CloudOptions(up=described.up or "auto", tree=which, unit=METRES[described.unit], inside=False))(file, key=root_key(seed))


def _is_database(file: Path) -> bool:
    import h5py

    from sketchtree.templates.store.writer import FORMAT

    try:
        with h5py.File(file, "r") as opened:
            return opened.attrs.get("format") == FORMAT
    except (OSError, RuntimeError):
        return False


def _habit_of(name: str, db: Path | None):
    from sketchtree.templates.store.database import Database

    return Database.open(db).exemplar(name).habit


def _check_models(leaf: str | None, bark: str | None) -> None:
    from sketchtree.choose import bark_model, leaf_model
    from sketchtree.parameters import Habit

    leaf_model(leaf, Habit(), None)
    bark_model(bark, Habit())


def _write_report(path: Path | None, content: dict) -> None:
    if path is None:
        return
    try:
        path.write_text(json.dumps({"schema": 1, **content}, ensure_ascii=False, indent=2) + "\n", encoding="utf-8")
    except OSError as error:
        raise OptionError(
            f"--report {path}: it can't be written ({error.strerror}).", remedy="Choose a folder that exists and is writable."
        ) from error
