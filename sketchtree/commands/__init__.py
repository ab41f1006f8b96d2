"""The command line, one command a file. `main` is the program `sketchtree`."""

import sys


def main() -> None:
    """Run the command line and leave with its exit status."""
    from sketchtree.commands.app import run

    sys.exit(run(sys.argv[1:]))
