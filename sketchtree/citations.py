"""Whose methods are these, and which of them made this tree? How to cite them and the program."""

from collections.abc import Collection

from sketchtree.cited_works import WORKS, Work
from sketchtree.version import __version__

PROGRAM_KEY = "sketchtree"


def program_line() -> str:
    """This program, as one line of text."""
    return f"SketchTree developers: SketchTree, version {__version__}. Freehand strokes in, a complete textured 3D tree out."


def program_bibtex() -> str:
    """This program, for BibTeX."""
    fields = {"author": "{SketchTree developers}", "title": "{SketchTree}: freehand strokes in, a complete textured {3D} tree out", "version": __version__}
    body = ",\n".join(f"  {name} = {{{value}}}" for name, value in fields.items())
    return f"@software{{{PROGRAM_KEY},\n{body}\n}}"


def works_for(command: str | None, marks: Collection[str] = ()) -> tuple[Work, ...]:
    """The works behind a run of that command; all for None. `marks`: what else is known of it: the name of its method, the steps that it took."""
    if command is None:
        return WORKS
    return tuple(work for work in WORKS if (not work.of or command in work.of) and (not work.only or work.only in marks))


def marks_of(report: dict) -> frozenset[str]:
    """What a report tells of a run besides its command: the method, the steps from photos to points, and `placed` where cameras were found in the photos."""
    infer, options, views = ({} if not isinstance(report.get(name), dict) else report[name] for name in ("infer", "options", "views"))
    steps = views.get("seconds")
    method = infer.get("method") or options.get("method")
    found = {"placed"} if views and options.get("poses") is None else set()
    return frozenset({str(method)} | found | set(steps if isinstance(steps, dict) else ()))
