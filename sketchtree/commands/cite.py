"""`sketchtree cite`: how to cite this program and the methods that made a tree."""

import json
from pathlib import Path

import click


@click.command("cite")
@click.argument("report", required=False, type=click.Path(path_type=Path), metavar="[REPORT.json]")
@click.option("--bibtex", is_flag=True, help="Entries for BibTeX.")
def cite(report: Path | None, bibtex: bool) -> None:
    """How to cite this program and the methods it uses; with a REPORT of a run, those that it used."""
    from sketchtree import citations

    run = None if report is None else _run(report)
    works = citations.works_for(None) if run is None else citations.works_for(str(run.get("command", "build")), citations.marks_of(run))
    if bibtex:
        click.echo("\n\n".join([citations.program_bibtex(), *(work.bibtex for work in works)]))
        return
    click.echo(citations.program_line())
    for work in works:
        click.echo(f"\n{work.line}\n  for {work.serves}")


def _run(report: Path) -> dict:
    """A report as it stands in its file."""
    from sketchtree.errors import OptionError

    try:
        content = json.loads(report.read_text("utf-8"))
    except OSError as error:
        raise OptionError(f"{report} can't be read: {(error.strerror or 'it failed').lower()}.", remedy="Check the path.") from error
    except ValueError as error:
        raise OptionError(f"{report} is no report.", remedy="Give the file that `--report` wrote.") from error
    if not isinstance(content, dict) or "schema" not in content:
        raise OptionError(f"{report} is no report.", remedy="Give the file that `--report` wrote.")
    return content
