"""A page's line to a studio in another process."""

from urllib.parse import parse_qs, urlsplit

from websockets.sync.client import connect

from sketchtree.studio import messages
from sketchtree.studio.outbox import encode


def line(address: str):
    """A page's line to the studio of that address, opened with what the page knows."""
    place, token = urlsplit(address).netloc, parse_qs(urlsplit(address).query)["token"][0]
    cookie = f"sketchtree-{place.rpartition(':')[2]}={token}"
    return connect(f"ws://{place}/ws", origin=f"http://{place}", additional_headers={"Cookie": cookie}, proxy=None, max_size=None)


def say(page, *requests) -> None:
    for request in (messages.Hello(version=messages.VERSION), *requests):
        page.send(encode(request))
