"""What does a name say about a stroke? `crown`, `obstacle`, `branches` in ids, classes and layer names."""

import re

from sketchtree.sketch.strokes import StrokeKind

_WORD = re.compile(r"(?<![a-z])(crown|obstacle|branch|trunk)(?:e?s)?(?![a-z])")
_KIND = {
    "crown": StrokeKind.CROWN,
    "obstacle": StrokeKind.OBSTACLE,
    "branch": StrokeKind.BRANCH,
    "trunk": StrokeKind.BRANCH,
}


def kind_named(*names: str | None) -> StrokeKind | None:
    """The kind that these names of one element (or layer) give; None if they say nothing."""
    for name in names:
        match = _WORD.search(name.lower()) if name else None
        if match:
            return _KIND[match[1]]
    return None
