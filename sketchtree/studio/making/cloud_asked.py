"""Which tree is to be traced in the points behind the drawing? Named by the server, so nothing here imports more than it does."""

from collections.abc import Hashable
from dataclasses import dataclass

from sketchtree.editing.document import Document
from sketchtree.editing.laid_cloud import LaidCloud
from sketchtree.options import ReadingOptions, TreeOptions


@dataclass(frozen=True, eq=False)
class CloudWish:
    """All that it hangs on."""

    cloud: LaidCloud
    reading: ReadingOptions
    tree: TreeOptions
    seed: int

    @property
    def key(self) -> Hashable:
        """The same where the same tree comes of it, at the same place."""
        return self.cloud.digest, self.cloud.place, self.reading, self.tree, self.seed

    @classmethod
    def of(cls, document: Document) -> "CloudWish | None":
        """The tree of a drawing; None where it is that of strokes, or of a photo."""
        if document.cloud is None or not document.points.traced:
            return None
        return cls(document.cloud, ReadingOptions(template=document.reading.template, height=document.reading.height), document.tree, document.seed)
