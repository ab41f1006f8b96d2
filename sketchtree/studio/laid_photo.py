"""Which photo lies under the page, and before which processes? It is sent to each once."""

import asyncio

from sketchtree.editing.document import Document
from sketchtree.studio import wire
from sketchtree.studio.hand import Hand
from sketchtree.studio.making.photo_asked import Asked, is_photo


class LaidPhoto:
    """The photo of the newest drawing that had one."""

    def __init__(self) -> None:
        self.digest, self._picture = "", b""
        self._laid: dict[Hand, tuple[int, str]] = {}  # the process of each hand that has a photo, and which

    def lay(self, document: Document) -> Asked | None:
        """What a drawing asks; its photo is at hand. None: it has none."""
        if not is_photo(document.underlay):
            return None
        digest = wire.digest(document.underlay.picture)
        if digest != self.digest:
            self.digest, self._picture = digest, document.underlay.picture
        return Asked.of(document, digest)

    def show(self, hand: Hand, asked: Asked) -> bool:
        """The process has the photo; True: only from now on."""
        hand.ready()
        has = hand.begun, asked.picture
        if self._laid.get(hand) == has or asked.picture != self.digest:
            return False
        self._laid[hand] = has
        unheard(hand.ask("photo", self.digest, self._picture)[1])
        return True


def unheard(answer: asyncio.Future) -> None:
    """Whatever comes of it is not waited for: what is asked next fails where this does."""
    answer.add_done_callback(lambda done: done.cancelled() or done.exception())
