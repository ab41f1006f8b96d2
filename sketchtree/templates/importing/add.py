"""How are exemplars added to a database? It is written anew, whole, with what it had and what is new.

So a stopped or failed import leaves the file as it was, readers see the old or the new one, and a file of an older schema is brought up to date.
"""

from collections.abc import Iterator, Sequence
from pathlib import Path

from sketchtree.errors import TemplateError
from sketchtree.templates.store.columns import TEXTS
from sketchtree.templates.store.database import Database
from sketchtree.templates.making.order import Block
from sketchtree.templates.store.writer import Writer


def add(into: Path, new: Sequence[Block], *, replace: bool = False) -> Database:
    """Appends exemplars to the database `into`, which is begun where there is none. With `replace`, one whose name is taken
    stands where the old one stood. Raises `TemplateError` where a name is taken, or twice among the new."""
    into = Path(into)
    by_name = {_name(block): block for block in new}
    old = check_free(into, list(map(_name, new)), replace=replace)
    taken = [name for name in by_name if old is not None and name in old.names]
    if old is not None:
        old.verify()
    widths = {name: max([block[name].dtype.itemsize for block in new] + ([old.width(name)] if old else [])) for name in TEXTS}
    count = len(new) - len(taken) + (len(old) if old else 0)
    with Writer(into, count, widths) as writer:
        for block in _merged(old, by_name):
            writer.add(block)
    return Database(into)


def check_free(into: Path, names: Sequence[str], *, replace: bool = False) -> Database | None:
    """The database at `into`, if there is one, to which exemplars of these names can be added. Raises `TemplateError` where they can't."""
    if len(set(names)) < len(names):
        twice = next(name for i, name in enumerate(names) if name in names[:i])
        raise TemplateError(f"Two of the trees would be called {twice!r}.", remedy="Import one at a time with a --name of its own.")
    old = Database(into) if Path(into).exists() else None
    for name in names:
        if old is not None and name in old.names and not replace:
            raise TemplateError(
                f"{into} already has an exemplar called {name!r}.", remedy="Give another with --name, or put it in its place with --replace."
            )
    return old


def blocks_of(database: Path) -> list[Block]:
    """All exemplars of another database, to be added."""
    other = Database(database)
    other.verify()
    return list(other.blocks())


def _merged(old: Database | None, new: dict[str, Block]) -> Iterator[Block]:
    seen = set()
    for block in old.blocks() if old is not None else ():
        seen.add(_name(block))
        yield new.get(_name(block), block)
    yield from (block for name, block in new.items() if name not in seen)


def _name(block: Block) -> str:
    return bytes(block["exemplar/name"][0]).decode("utf-8")
