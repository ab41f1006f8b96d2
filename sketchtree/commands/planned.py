"""Commands and options that a later part brings: each says so in one paragraph instead of failing oddly."""

import click

from sketchtree.errors import OptionError

COMMANDS = {
    "views": "Many photos",
}
"""Command → the section of docs/roadmap.md that describes it."""


def not_yet(what: str, section: str, instead: str = "") -> OptionError:
    """The error for a documented option or command that this version does not have."""
    return OptionError(
        f"`{what}` is described in docs/roadmap.md, “{section}”, and is not in this version.",
        remedy=instead or "Leave it out, or use a version that lists it as done.",
    )


def planned_command(name: str) -> click.Command:
    """A command that takes any arguments and says where it is described."""

    @click.command(name, hidden=True, add_help_option=False, context_settings=_TAKES_ANYTHING)
    def command() -> None:
        raise not_yet(f"sketchtree {name}", COMMANDS[name])

    return command


_TAKES_ANYTHING = {"allow_extra_args": True, "ignore_unknown_options": True}
