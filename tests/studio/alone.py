"""The studio in a process of its own, with an engine that makes nothing: `python alone.py FILE` prints its address."""

import asyncio
import sys
from pathlib import Path

from fake_engine import FakeEngine

from sketchtree.studio.serving import Start, serve

if __name__ == "__main__":
    file = Path(sys.argv[1])
    page = file.parent / "built"
    page.mkdir(exist_ok=True)
    asyncio.run(serve(FakeEngine(), Start(file, file.parent), page, lambda url: print(url, flush=True)))
