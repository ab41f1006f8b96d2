"""What does the studio's server ask of the program that makes trees?

The server itself imports neither jax nor any stage: whoever answers here may run in other processes (`studio.crew`). Everything is asked by revision: the newest
wins, and what comes of an older one is not told.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

from sketchtree.editing.document import Document
from sketchtree.editing.settled import Settled
from sketchtree.errors import SketchTreeError
from sketchtree.studio import messages

if TYPE_CHECKING:
    from sketchtree.studio.growth import Growing, Grown


class Fault(SketchTreeError):
    """A fault of ours."""

    @classmethod
    def here(cls) -> "Fault":
        """One whose details are in the terminal."""
        return cls("Something went wrong in the program.", remedy="Undo the last step; the terminal that runs the studio has the details.")


Tell = Callable[[str, float], None]
"""Is told the stage that runs, and how much of the work is done, 0-1."""


def untold(stage: str, done: float) -> None:
    """Nobody asks how far it is."""


@dataclass(frozen=True, eq=False)
class Outcome:
    """Something to tell: an event as it goes to the pages, and what the server is to keep of it."""

    revision: int
    event: bytes | messages.Event  # bytes: a binary frame, ready to be sent
    of_photo: bool = False  # a frame of the photo's tree
    settled: Settled | None = None  # where the depths came to, with a full `Tree`
    rough: Settled | None = None  # where they are for now, with a quick one


class Engine(Protocol):
    """Makes trees of documents. Methods are called on the server's event loop and return at once, or are awaited."""

    on_outcome: Callable[[Outcome], None]  # called on the event loop

    async def start(self) -> None:
        """Get ready; compile in the background."""

    async def stop(self) -> None:
        """End all processes."""

    def make(self, revision: int, document: Document) -> None:
        """Make the tree of this document: `Tree` quick, then `Tree` full, with `Working`, `Read`, `Matches` between, or a `Trouble`. Work on an older revision ends."""

    def refresh(self) -> None:
        """A page joined: the next `Tree` frames are to be complete. `frame` gives it the present one."""

    async def frame(self) -> bytes | None:
        """A `Tree` frame with everything in it, as last made; None: nothing yet."""

    def trace(self, revision: int, document: Document) -> None:
        """`Traced`, the limbs that show in the photo under the page, and later `Foliage`; nothing where there is no photo."""

    async def with_traced(self, document: Document) -> Document:
        """The drawing in which those limbs stand for the strokes that mark them. Raises SketchTreeError where there are none."""

    async def proposed(self, document: Document) -> tuple[Document, str]:
        """(the drawing in which strokes mark the main tree of the photo, what speaks against them). Raises SketchTreeError where no tree stands out."""

    def grow(self, revision: int, document: Document, *, at_once: bool = False) -> None:
        """`Growing`, and a `Tree` of phase "photo": the tree that the strokes mark in the photo under the page, once it is known what shows of it and nothing was changed for a
        moment; `at_once`: without that pause, and though it was stopped."""

    def stop_growing(self) -> None:
        """That tree is not wanted as it is now."""

    async def grown(self, document: Document, name: str, options: dict, tell: Tell = untold) -> dict[str, bytes]:
        """The files that the photo's tree becomes, by name: the one that grows towards its foliage, or that of its scribbles. `tell` hears how far it is; whoever does not want them any more
        cancels it. Raises SketchTreeError."""

    async def marks(self, document: Document) -> bytes:
        """The strokes that mark the photo, in its pixels, as SVG. Raises SketchTreeError where there is no photo."""

    def ghost(self, revision: int, document: Document, stroke: messages.Stroke | None, hold: messages.Hold | None) -> None:
        """A `Ghost` of the stroke in hand, or of a limb that is being dragged."""

    def glance(self, revision: int, document: Document | None) -> None:
        """A `Tree` of phase "glance" of a document that is not kept."""

    async def alternatives(self, revision: int, document: Document) -> tuple[messages.Alternatives, list[Settled]]:
        """Other readings, and where the depths are in each."""

    def cancel(self) -> None:
        """Stop what is going on. A hurried tree that is there already stays; the whole one comes with the next step."""

    async def find(self, document: Document, limb: int) -> Any:
        """An undrawn limb of the tree that is shown as an `edits.Adopted`, whatever is being made; raises SketchTreeError where there is none of that id."""

    async def read(self, data: bytes, name: str, cloud: messages.CloudReading = messages.CloudReading()) -> Document:
        """A document of a file: any drawing, a project, or a point cloud, read so, behind an empty page. Raises SketchTreeError; SeveralTrees where several stand in it and none was chosen."""

    async def export(self, document: Document, name: str, options: dict, tell: Tell = untold) -> dict[str, bytes]:
        """The files that the tree of the drawing becomes, by name, likewise."""

    async def aged(self, document: Document, growing: "Growing", tell: Tell = untold) -> bytes:
        """The growth of this tree, or of the photo's, as an animated GLB, likewise; nothing else waits for it."""

    async def moving(self, document: Document, name: str, tree: str, grown: "Grown", tell: Tell = untold) -> dict[str, bytes]:
        """The files, by name, of the growth of this tree, or of the photo's (`tree`: drawn or photo): animated ones, or a film; likewise."""

    async def project(self, document: Document) -> bytes:
        """The bytes of a project file."""

    async def texture(self, key: str, kind: str) -> bytes | None:
        """A PNG of a material; None: there is no such."""

    async def picture(self, what: str, name: str) -> bytes | None:
        """A PNG thumbnail: `what` is template, leaf, bark or example."""

    async def catalogue(self) -> messages.Welcome:
        """What there is to choose from; folder and files are the server's to fill in."""
