"""Errors that name the thing at fault and the way out.

Every message says what was given and what was expected; `remedy` says what to do. Where a stroke,
a file or a row is at fault it is also an attribute, so that an interface can light it up.
"""


class SketchTreeError(Exception):
    """Something the user gave can't be used. `str(error)` is one paragraph: cause, then remedy."""

    def __init__(self, message: str, *, remedy: str):
        self.message = message
        self.remedy = remedy
        super().__init__(f"{message} {remedy}")


class SketchError(SketchTreeError):
    """A sketch, or one stroke of it, can't be read. `stroke` is the stroke's id (None: the whole file)."""

    def __init__(self, message: str, *, remedy: str, stroke: str | int | None = None):
        self.stroke = stroke
        super().__init__(message if stroke is None else f"Stroke {stroke}: {message}", remedy=remedy)


class SeveralTrees(SketchError):
    """Several trees stand in a cloud, and none was chosen. `trees` has each in words, the largest first."""

    def __init__(self, message: str, *, remedy: str, trees: tuple[str, ...]):
        self.trees = trees
        super().__init__(message, remedy=remedy)


class ViewsError(SketchTreeError):
    """Photos of one plant from many sides, or where they were taken from, can't be used. `photo` is the name of the photo at fault (None: all)."""

    def __init__(self, message: str, *, remedy: str, photo: str | None = None):
        self.photo = photo
        super().__init__(message if photo is None else f"Photo {photo}: {message}", remedy=remedy)


class SkeletonError(SketchTreeError):
    """The columns of a skeleton break one of its requirements. `row` is the first row at fault."""

    def __init__(self, message: str, *, remedy: str, row: int | None = None):
        self.row = row
        super().__init__(message if row is None else f"Row {row}: {message}", remedy=remedy)


class TemplateError(SketchTreeError):
    """A recipe or the template database can't be used, or has no exemplar of that name."""


class InferenceError(SketchTreeError):
    """The depths could not be inferred."""


class OptionError(SketchTreeError):
    """An option has a value outside its range, or names something that does not exist."""


class ExportError(SketchTreeError):
    """A result can't be written as asked."""
