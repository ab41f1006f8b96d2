"""Can the page say the name of every stroke? A file may call its strokes anything; on the wire an id is short and printable."""

import re

from sketchtree.editing.document import Document

_LONGEST = 64
_PRINTABLE = re.compile(r"[^\x00-\x1f\x7f\ud800-\udfff]+")


def fitting(document: Document) -> Document:
    """The document, in which strokes whose ids don't fit are called otherwise. Limbs that edits speak of are called after their strokes, and keep their names."""
    if document.edits or all(is_id(name) for name in document.strokes):
        return document
    from dataclasses import replace

    strokes, number = {}, 0
    for name, stroke in document.strokes.items():
        while not is_id(name) or name in strokes:
            number += 1
            name = f"stroke-{number}"
            if name in document.strokes:
                name = ""
        strokes[name] = stroke if name == stroke.id else replace(stroke, id=name)
    return document.replace(strokes=strokes)


def is_id(name: str) -> bool:
    """Does it fit `messages.Id`?"""
    return 0 < len(name) <= _LONGEST and _PRINTABLE.fullmatch(name) is not None
