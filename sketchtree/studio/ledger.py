"""What must the journal be told, so that playing it gives the same drawing with the same steps?

A journal begins with the drawing as it is when the first step after a save is done, so it may know fewer steps than the history: where undo leads to before
its beginning, it is told the difference as a step of its own.
"""

from sketchtree.editing.document import Document
from sketchtree.studio import journal_lines as lines
from sketchtree.studio import wire
from sketchtree.studio.change import Change
from sketchtree.studio.history import History


class Ledger:
    """Follows a history, and gives the lines to write."""

    def __init__(self, history: History, *, begun: bool = False):
        self.begun = begun  # the journal has its first line
        self._back, self._on = history.states() if begun else ([], [])  # states that undo and redo lead to when it is played

    def forget(self) -> None:
        """All is in a file: the journal begins anew."""
        self.begun, self._back, self._on = False, [], []

    def begin(self, document: Document, saved: bool, signature: tuple[int, int] | None) -> tuple[lines.Line, ...]:
        """Before a step: the first lines, if it has none."""
        if self.begun:
            return ()
        self.begun = True
        first = lines.Begin(version=lines.VERSION, document=lines.different(Document(), document), saved=saved, signature=signature)
        return (*_pictures(document), first)

    def step(self, before: Document, what: Change, document: Document, label: str, state: int, *, merges: bool) -> tuple[lines.Line, ...]:
        """A step from `before`, whose number is `state`."""
        if not merges:
            self._back.append(state)
        self._on.clear()
        return (*_pictures(document), lines.Step(label=label, different=lines.told(before, what, document), merges=merges))

    def walk(self, before: Document, what: Change, document: Document, old: int, new: int, *, on: bool) -> tuple[lines.Line, ...]:
        """Undo or redo, from the state `old` to `new`."""
        ways, others = (self._on, self._back) if on else (self._back, self._on)
        if ways and ways[-1] == new:
            ways.pop()
            others.append(old)
            return (lines.On() if on else lines.Back(),)
        return self.step(before, what, document, "redo" if on else "undo", old, merges=False)

    def keep(self, before: Document, document: Document) -> tuple[lines.Line, ...]:
        """The depths have settled."""
        return (lines.Keep(different=lines.different(before, document)),) if self.begun else ()


def _pictures(document: Document) -> tuple[lines.Line, ...]:
    """What a line can only name: the bytes of a picture, and of points."""
    found = []
    if document.underlay is not None:
        found.append(lines.Picture(digest=wire.digest(document.underlay.picture), data=document.underlay.picture))
    if document.cloud is not None:
        found.append(lines.Picture(digest=document.cloud.digest, data=document.cloud.points))
    return tuple(found)
