"""`sketchtree templates`: make, list, show and try the exemplars a sketch is matched with."""

import json
from pathlib import Path

import click

from sketchtree.commands.options import common, drawing
from sketchtree.commands.planned import not_yet
from sketchtree.commands.progress import Progress
from sketchtree.errors import OptionError

_SECTION = "The template database"
SCORES = ("calibrated", "chen")


@click.group(help="The exemplars a sketch is matched with.")
def templates() -> None:
    """Make, list, show and try exemplars."""


@templates.command("list")
@click.option("--json", "as_json", is_flag=True, help="One JSON array instead of lines.")
@common
def list_command(as_json: bool, db: Path | None, report: Path | None, **_) -> None:
    """One line an exemplar and nothing else."""
    from sketchtree.templates.database import Database

    database = Database.open(db)
    rows = [{"name": name, "title": title} for name, title in zip(database.names, database.titles, strict=True)]
    if as_json:
        click.echo(json.dumps(rows, ensure_ascii=False, indent=2))
    else:
        for row in rows:
            click.echo(f"{row['name']:<20} {row['title']}")
    _write_report(report, {"exemplars": rows})


@templates.command("show")
@click.argument("name")
@click.option("-o", "--out", type=click.Path(path_type=Path), help="Write a picture (.png).")
@common
def show_command(name: str, out: Path | None, db: Path | None, report: Path | None, quiet: bool, **_) -> None:
    """What the database knows of one exemplar."""
    from sketchtree.templates.database import Database
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
    from sketchtree.templates.database import Database
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
    from sketchtree.templates.database import Database
    from sketchtree.templates.match import match
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
@click.option("--only", multiple=True, metavar="SPECIES", help="Only this recipe; may be repeated.")
@click.option("--count", type=click.IntRange(1, 100_000), help="So many exemplars: recipes in turn, each round from new seeds.")
@click.option("--jobs", type=click.IntRange(1, 256), default=1, show_default=True, help="Processes; the result is the same.")
@click.option("--scheduler", metavar="ADDRESS", help="A cluster (a later version).")
@common
def build_command(
    out: Path | None, recipes: Path | None, only: tuple[str, ...], count: int | None, jobs: int, scheduler: str | None,
    seed: int, quiet: bool, json_log: bool, db: Path | None, report: Path | None,
) -> None:  # fmt: skip
    """Make the database from its recipes. `--seed` is added to every recipe's own."""
    if scheduler is not None:
        raise not_yet("templates build --scheduler", _SECTION, "Use --jobs for the processors of this machine.")
    from sketchtree.templates.regenerate import orders, recipe_folder, regenerate

    folder = recipes or recipe_folder()
    wanted = orders(folder, only=only, count=count, seed=seed)
    target = out or db or folder / "exemplars.h5"
    if out is None and db is None and (only or count) and target.exists():
        raise OptionError(
            f"`--only` and `--count` would replace the whole database {target} by other exemplars.",
            remedy="Name the file to write with --out.",
        )
    progress = Progress(tuple(order.name for order in wanted), quiet=quiet, json_log=json_log)
    with progress.running():
        database = regenerate(target, wanted, jobs=jobs, progress=progress)
        progress.say(f"wrote {target}: {len(database)} exemplars, {target.stat().st_size / 1e6:.2f} MB", event="written")
    _write_report(report, {"exemplars": list(database.names), "out": str(target)})


@templates.command("import", context_settings={"allow_extra_args": True, "ignore_unknown_options": True}, add_help_option=False)
def import_command() -> None:
    """Digitised trees as exemplars (a later version)."""
    raise not_yet("templates import", _SECTION, "Describe the tree in a recipe, and run `sketchtree templates build`.")


def _write_report(path: Path | None, content: dict) -> None:
    if path is None:
        return
    try:
        path.write_text(json.dumps({"schema": 1, **content}, ensure_ascii=False, indent=2) + "\n", encoding="utf-8")
    except OSError as error:
        raise OptionError(
            f"--report {path}: it can't be written ({error.strerror}).", remedy="Choose a folder that exists and is writable."
        ) from error
