"""All commands under one program, and how every one of them ends.

Exit status: 0 done; 1 done with failures (`batch`); 2 the user's input (one paragraph on stderr); 130 Ctrl-C.
Anything else is a fault of ours and shows its traceback.
"""

import importlib
from collections.abc import Sequence

import click

from sketchtree.errors import SketchTreeError
from sketchtree.version import __version__

COMMANDS = {
    "build": "A sketch in, a complete textured 3D tree out.",
    "studio": "Draw in the browser: the tree follows the pen.",
    "photo": "One photo and a few strokes in, a complete textured 3D tree out.",
    "grow": "A picture with scribbles, a drawing, or any tree in, a tree that grows out.",
    "cloud": "A point cloud in, the tree that stands in it out.",
    "views": "Many photos of one plant in, the plant out.",
    "forest": "Several sketches in, a forest out: the trees compete for space and light.",
    "batch": "Many drawings in, a tree and a report of each out.",
    "infer": "Only the drawn branches, in 3D.",
    "inspect": "How a drawing is read, as a picture: strokes, junctions, root, crown, doubts.",
    "convert": "A tree from one kind of file to another.",
    "view": "Look at a tree: in a window, as a picture, or turning, as a film.",
    "doctor": "Does everything work here? What is installed, and what is missing for what.",
    "cite": "How to cite this program and the methods it uses.",
    "templates": "The exemplars a sketch is matched with.",
}
"""Command → its one line of help. Each lives in the module of its name, imported when it is used."""


class _Program(click.Group):
    def list_commands(self, context):
        return list(COMMANDS)

    def get_command(self, context, name):
        return getattr(importlib.import_module(f"sketchtree.commands.{name}"), name) if name in COMMANDS else None

    def format_commands(self, context, formatter):
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


@click.group(cls=_Program, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="sketchtree", message="%(prog)s %(version)s")
def program() -> None:
    """Freehand strokes in, a complete textured 3D tree out."""


def run(arguments: Sequence[str]) -> int:
    """Run one command; returns its exit status."""
    try:
        return program.main(list(arguments), prog_name="sketchtree", standalone_mode=False) or 0
    except SketchTreeError as error:
        click.echo(f"sketchtree: {error}", err=True)
        return 2
    except click.ClickException as error:
        error.show()
        return error.exit_code
    except (KeyboardInterrupt, click.Abort):
        click.echo("sketchtree: stopped; nothing was left half-written.", err=True)
        return 130
