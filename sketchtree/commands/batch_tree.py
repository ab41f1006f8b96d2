"""One drawing of a batch: what `sketchtree build` does, in whichever process or on whichever machine it is called.

What comes back is the drawing's row of the summary; a drawing that can't be used, or that we fail on, gives a row that says so.
"""

import dataclasses
import time
import traceback

from sketchtree import batch_record
from sketchtree.batch import TreeOrder
from sketchtree.errors import SketchTreeError
from sketchtree.options import TreeOptions, options_as_dict
from sketchtree.propagate.after.shears import HOLE, plane
from sketchtree.templates.making.order import Refusal, foreign


def make_tree(order: TreeOrder, program: str | None = None) -> dict | Refusal:
    """Build one tree and write its files. A worker that is another `program`, or doesn't see the folder, refuses."""
    if program is not None and (refusal := foreign(program) or _blind(order)) is not None:
        return refusal
    began = time.perf_counter()
    try:
        return batch_record.row(order, batch_record.MADE, report=_built(order))
    except SketchTreeError as error:
        return _failed(order, str(error), began)
    except Exception as error:  # one drawing that we fail on must not stop the others
        said = " ".join(str(error).split())
        told = f"SketchTree failed on it ({type(error).__name__}: {said}). Please report it, with the drawing and the traceback in {batch_record.SUMMARY}."
        return _failed(order, told, began) | {"traceback": traceback.format_exc()}


def _failed(order: TreeOrder, error: str, began: float) -> dict:
    return batch_record.row(order, batch_record.FAILED, seconds=round(time.perf_counter() - began, 4), error=error)


def _built(order: TreeOrder) -> dict:
    """The report of a tree that has been written."""
    began = time.perf_counter()
    from sketchtree import pipeline
    from sketchtree.commands import made_anew, writing
    from sketchtree.keys import root_key
    from sketchtree.templates.store.database import Database
    from sketchtree.watch import Watch

    manner, watch = order.manner, Watch()
    made_anew.refuse((order.at(order.sketch),), "batch")
    run = writing.Run("batch", manner.seed, time.perf_counter() - began, began, watch, options_as_dict(manner.reading, manner.tree, manner.files))
    templates = None if manner.db is None and manner.reading.template == "none" else Database.open(manner.db and order.at(manner.db))
    tree = _found_from_anywhere(manner.tree, order)
    model = pipeline.sketch_to_tree(order.at(order.sketch), templates, key=root_key(manner.seed), reading=manner.reading, tree=tree, watch=watch)
    at = {name: path and order.at(path) for name, path in (("skeleton", order.skeleton), ("preview", order.preview))}
    order.at(order.output).parent.mkdir(parents=True, exist_ok=True)
    with watch("export"):
        unseen = writing.write_tree(model, order.at(order.output), run, **at, files=manner.files, sketches=(order.at(order.sketch),))
    report = writing.record(run, model.drawn, model, extra_warnings=unseen) | {"made_of": batch_record.made_of(order)}
    writing.write_report(order.at(order.report), report)
    return report


def _found_from_anywhere(tree: TreeOptions, order: TreeOrder) -> TreeOptions:
    """The same options with the full paths of the meshes they name."""
    prune = [shape if plane(shape) is not None else _full(shape, order) for shape in tree.prune]
    return dataclasses.replace(tree, obstacle=tuple(str(order.at(path)) for path in tree.obstacle), prune=tuple(prune))


def _full(shape: str, order: TreeOrder) -> str:
    """FILE or outside:FILE with its full path."""
    hole = HOLE if shape.startswith(HOLE) else ""
    return f"{hole}{order.at(shape.removeprefix(HOLE).strip())}"


def _blind(order: TreeOrder) -> Refusal | None:
    folder = order.at(order.manner.out)
    if folder.is_dir():
        return None
    return Refusal(f"A worker does not see the folder {folder}.", "Put drawings and --out on a disk that all workers share, under the same path.")
