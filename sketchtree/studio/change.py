"""What is different between two documents? Small where little is, so that undo, the journal and the pages each keep or send only that."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any

from sketchtree.editing.document import Document
from sketchtree.sketch.strokes import Stroke

_OTHERS = tuple(one.name for one in fields(Document) if one.name != "strokes")


@dataclass(frozen=True, eq=False)
class Change:
    """Strokes by id; one in `put` whose id is there already takes its place, others come last."""

    put: Mapping[str, Stroke] = field(default_factory=dict)
    gone: tuple[str, ...] = ()
    order: tuple[str, ...] | None = None  # of all ids, where `put` and `gone` alone don't give it
    others: Mapping[str, Any] = field(default_factory=dict)  # fields of the document that are others now

    def __bool__(self) -> bool:
        return bool(self.put or self.gone or self.order is not None or self.others)


def change(old: Document, new: Document) -> Change:
    """What makes `new` of `old`. Strokes, edits and depths are told apart by identity: an operation leaves alone what it doesn't touch."""
    others = {name: getattr(new, name) for name in _OTHERS if _differs(getattr(old, name), getattr(new, name))}
    if new.strokes is old.strokes:
        return Change(others=others)
    put = {name: stroke for name, stroke in new.strokes.items() if old.strokes.get(name) is not stroke}
    gone = tuple(name for name in old.strokes if name not in new.strokes)
    order = tuple(new.strokes)
    return Change(put, gone, None if order == tuple(_mixed(old.strokes, put, gone)) else order, others)


def apply(document: Document, what: Change) -> Document:
    """The document after the change."""
    strokes = document.strokes
    if what.put or what.gone or what.order is not None:
        strokes = _mixed(strokes, what.put, what.gone)
        strokes = strokes if what.order is None else {name: strokes[name] for name in what.order}
    return document.replace(strokes=strokes, **what.others)


def inverse(what: Change, old: Document) -> Change:
    """What leads back to `old` from where the change led."""
    put = {name: old.strokes[name] for name in (*what.put, *what.gone) if name in old.strokes}
    gone = tuple(name for name in what.put if name not in old.strokes)
    order = tuple(old.strokes) if what.gone or what.order is not None else None
    return Change(put, gone, order, {name: getattr(old, name) for name in what.others})


def _differs(old: Any, new: Any) -> bool:
    return old is not new and old != new


def _mixed(strokes: Mapping[str, Stroke], put: Mapping[str, Stroke], gone: tuple[str, ...]) -> dict[str, Stroke]:
    mixed = dict(strokes)
    for name in gone:
        mixed.pop(name, None)
    mixed.update(put)
    return mixed
