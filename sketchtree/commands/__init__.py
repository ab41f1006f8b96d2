"""The command line, one command a file. `main` is the program `sketchtree`."""

import sys


def main() -> None:
    """Run the command line and leave with its exit status."""
    try:
        from sketchtree.commands.stopping import listen

        listen()
        from sketchtree.commands.app import run
    except KeyboardInterrupt:
        sys.exit(130)
    sys.exit(run(sys.argv[1:]))
