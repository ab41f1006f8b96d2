"""Options that every command, or every command that reads a sketch, has."""

from pathlib import Path

import click

METHODS = ("elevation", "chen", "chen-fixed", "okabe", "random-sign", "flat")
SEASONS = ("spring", "summer", "autumn", "bare")

_COMMON = (
    click.option("--seed", type=click.IntRange(0, 2**31 - 1), default=0, show_default=True, help="Same seed, same bytes."),
    click.option("--quiet", is_flag=True, help="Say nothing but errors."),
    click.option("--json-log", is_flag=True, help="Progress as one JSON object a line, on stderr."),
    click.option("--report", type=click.Path(path_type=Path), help="Write what was done, as JSON."),
    click.option("--db", type=click.Path(path_type=Path), help="Template database (default: the shipped one)."),
)
_DRAWING = (
    click.option("--crown", type=click.Choice(["auto", "off"]), default="auto", show_default=True, help="Use a drawn crown outline, or leave it out."),
    click.option("--max-strokes", type=click.IntRange(1), default=20_000, show_default=True, help="Refuse a sketch with more strokes."),
    click.option("--max-mb", type=click.FloatRange(0, min_open=True), default=100.0, show_default=True, help="Refuse a larger file (MB)."),
    click.option("--max-megapixels", type=click.FloatRange(0, min_open=True), default=200.0, show_default=True, help="Refuse a larger picture."),
)  # fmt: skip
_READING = (
    click.option("--template", default="auto", show_default=True, metavar="auto|none|NAME", help="Exemplar that supplies the prior."),
    click.option("--theta", type=click.Choice(["fit", "fixed"]), default="fit", show_default=True, help="Learn Θ from the sketch, or hold the template's."),
    click.option("--method", type=click.Choice(METHODS), default="elevation", show_default=True, help="How depths are inferred."),
    click.option("--height", type=float, metavar="METRES", help="Height of the tree (default: the template's)."),
    click.option("--planar", is_flag=True, help="An espalier or a fan: hold the depths small."),
    *_DRAWING,
)  # fmt: skip


def common(command):
    """--seed --quiet --json-log --report --db (INTERFACES: every command has them)."""
    return _apply(_COMMON, command)


def drawing(command):
    """Options of every command that reads a drawing."""
    return _apply(_DRAWING, command)


def reading(command):
    """Options of every command that turns a sketch into branches."""
    return _apply(_READING, command)


def _apply(options, command):
    for option in reversed(options):
        command = option(command)
    return command
