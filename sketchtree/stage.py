"""The two doors: what makes a skeleton, and what changes one.

Built-in sources and stages come through the same doors as anybody's plug-in (entry points
`sketchtree.sources` and `sketchtree.stages`). Options are typed fields of the object; randomness is
an explicit key without a default.
"""

from importlib.metadata import entry_points
from typing import Any, Protocol, runtime_checkable

from jaxtyping import Array, Key

from sketchtree.skeleton import TreeSkeleton


@runtime_checkable
class SkeletonSource(Protocol):
    """Makes a skeleton from an input: a sketch, a photo, a point cloud, a file."""

    def __call__(self, input: Any, *, key: Key[Array, ""]) -> TreeSkeleton: ...


@runtime_checkable
class SkeletonStage(Protocol):
    """Takes a skeleton and returns another. Rows of kind DRAWN and OBSERVED keep their projection
    on the page (x, y), unless bending them is the stage's declared purpose."""

    def __call__(self, tree: TreeSkeleton, *, key: Key[Array, ""]) -> TreeSkeleton: ...


def sources() -> dict[str, type]:
    """Every installed source by name, built-in ones and plug-ins alike."""
    return {entry.name: entry.load() for entry in entry_points(group="sketchtree.sources")}


def stages() -> dict[str, type]:
    """Every installed stage by name, built-in ones and plug-ins alike."""
    return {entry.name: entry.load() for entry in entry_points(group="sketchtree.stages")}
