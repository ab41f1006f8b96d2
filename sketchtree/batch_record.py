"""What was made of every drawing of a batch, and what of an earlier run need not be made again?

A report holds under `made_of` a hash of all that its tree follows from: the drawing, the options, the seed, the program, the
database, and the meshes that the options name. With `--resume` a tree is kept if its files are there and that hash is the one it would
get now. Reports are written last, so a tree that has one is whole.
"""

import csv
import hashlib
import io
import json
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from sketchtree.batch import SUMMARY, TABLE, Manner, TreeOrder, drawing_file
from sketchtree.export.files import write_whole
from sketchtree.options import TreeOptions, options_as_dict
from sketchtree.propagate.after.shears import HOLE, plane
from sketchtree.templates.making.fingerprint import fingerprint
from sketchtree.version import __version__

MADE, KEPT, FAILED, WAITING = "made", "kept", "failed", "not reached"
_COLUMNS = ("status", "sketch", "output", "seconds", "segments", "leaves", "warnings", "error")


def row(order: TreeOrder, status: str = WAITING, *, report: dict | None = None, seconds: float | None = None, error: str | None = None) -> dict:
    """What the summary says of one drawing; of its tree what its `report` says."""
    told = report or {"warnings": [], "segments": {"total": None}, "leaves": None, "seconds": {"total": seconds}}
    return {
        "status": status,
        "sketch": order.sketch,
        "output": None if report is None else str(order.tree.sure[0]),
        "report": None if report is None else str(order.report),
        "seconds": told["seconds"]["total"],
        "segments": told["segments"]["total"],
        "leaves": told["leaves"],
        "warnings": told["warnings"],
        "error": error,
    }


def summary(rows: Sequence[dict], manner: Manner, patterns: Sequence[str], seconds: float) -> dict:
    """One object for the whole batch."""
    count = Counter(one["status"] for one in rows)
    return {
        "schema": 1,
        "version": __version__,
        "command": "batch",
        "patterns": list(patterns),
        "out": manner.out,
        "format": manner.kind,
        "count": {status: count[status] for status in (MADE, KEPT, FAILED, WAITING)},
        "seconds": round(seconds, 3),
        "seed": manner.seed,
        "options": options_as_dict(manner.reading, manner.tree, manner.files),
        "files": list(rows),
    }


def write_summary(told: dict, *others: Path) -> None:
    """`batch.json` and `batch.csv` in the batch's folder, and the JSON once more into each of `others`."""
    whole = (json.dumps(told, indent=1, ensure_ascii=False) + "\n").encode("utf-8", "backslashreplace")
    for path in (Path(told["out"]) / SUMMARY, *others):
        write_whole(path, whole)
    table = io.StringIO()
    writer = csv.writer(table, lineterminator="\n")
    writer.writerow(_COLUMNS)
    writer.writerows([" | ".join(one[name]) if name == "warnings" else one[name] for name in _COLUMNS] for one in told["files"])
    write_whole(Path(told["out"]) / TABLE, table.getvalue().encode("utf-8", "backslashreplace"))


class Journal:
    """What need not be made, for `crew.in_turn`: trees of an earlier run, if it is to be resumed, and of this one."""

    def __init__(self, resume: bool):
        self._resume = resume
        self.made: dict[str, dict] = {}  # name → row, of all that this run has finished

    def has(self, order: TreeOrder) -> bool:
        """Whether the tree is there, made of the same."""
        return self.take(order) is not None

    def take(self, order: TreeOrder) -> dict | None:
        """Its row; None if it has to be made."""
        if order.name in self.made:
            return self.made[order.name]
        return self._earlier(order) if self._resume else None

    def keep(self, order: TreeOrder, made: dict) -> None:
        """The tree and its report are there already; of this run the row is enough."""
        self.made[order.name] = made

    def _earlier(self, order: TreeOrder) -> dict | None:
        if not all(order.at(path).is_file() for path in order.sure):
            return None
        try:
            report = json.loads(order.at(order.report).read_bytes())
            return row(order, KEPT, report=report) if report["made_of"] == made_of(order) else None
        except (OSError, ValueError, KeyError, TypeError, RecursionError):
            return None


def made_of(order: TreeOrder) -> str:
    """A hash of all that the tree follows from. Raises OSError where the drawing can't be read."""
    file, number = drawing_file(order.sketch)
    return _hash(order.manner.made_by, _of_file(order.at(file)), number)


def made_by(manner: Manner, database: Path | None) -> str:
    """The part of it that all trees of a batch share."""
    options = json.dumps(options_as_dict(manner.reading, manner.tree, manner.files), sort_keys=True)
    files = [Path(path) for path in (database, *mesh_files(manner.tree)) if path is not None]
    return _hash(options, str(manner.seed), fingerprint(), *(_of_file(path) for path in files))


def mesh_files(tree: TreeOptions) -> list[str]:
    """The files that the options name."""
    return [*tree.obstacle, *(shape.removeprefix(HOLE).strip() for shape in tree.prune if plane(shape) is None)]


def _of_file(path: Path) -> str:
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _hash(*said: str) -> str:
    return hashlib.sha256("\0".join(said).encode()).hexdigest()
