"""How is the database made from its recipes? Grow, measure, write.

Every exemplar depends on its recipe's text and its seed alone, so the result does not depend on how many
processes share the work. With `count`, recipes are used in turn; each further round grows a variant
(`name_2`, `name_3`, …) from a seed of its own.
"""

import signal
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

from sketchtree.errors import TemplateError
from sketchtree.templates.columns import to_columns
from sketchtree.templates.database import Database, write_database
from sketchtree.templates.exemplar import Exemplar, Views, measure
from sketchtree.templates.procedural import grow
from sketchtree.templates.recipe import Recipe, parse_recipe, read_recipe
from sketchtree.version import __version__

ROUND = 7919  # between the seeds of two rounds of variants


@dataclass(frozen=True)
class Order:
    """One exemplar to be made."""

    text: str  # of the recipe
    file: str  # its name, for errors
    name: str  # of the exemplar
    seed: int


def recipe_folder() -> Path:
    """Where the recipes of this checkout lie."""
    return Path(__file__).resolve().parents[2] / "template_db"


def orders(folder: Path, *, only: tuple[str, ...] = (), count: int | None = None, seed: int = 0) -> list[Order]:
    """What to make from the recipes in `folder`, in the order of their names. `seed` is added to the recipes' own."""
    files = sorted(Path(folder).glob("*.toml"))
    if not files:
        raise TemplateError(
            f"There are no recipes (*.toml) in {folder}.", remedy="Run it in a checkout, or name a folder with --recipes."
        )
    recipes = {recipe.name: (recipe, file.name) for file, recipe in ((f, read_recipe(f)) for f in files)}
    if len(recipes) < len(files):
        raise TemplateError(f"Two recipes in {folder} have the same `name`.", remedy="Give each a name of its own.")
    for name in only:
        if name not in recipes:
            known = ", ".join(sorted(recipes))
            raise TemplateError(f"There is no recipe called {name!r}.", remedy=f"Use one of: {known}.")
    chosen = [recipes[name] for name in sorted(recipes) if not only or name in only]
    wanted = len(chosen) if count is None else count
    return [_order(*chosen[i % len(chosen)], i // len(chosen), seed) for i in range(wanted)]


def _order(recipe: Recipe, file: str, turn: int, seed: int) -> Order:
    name = recipe.name + (f"_{turn + 1}" if turn else "")
    return Order(recipe.text, file, name, (recipe.seed + seed + ROUND * turn) % 2**32)


def make(order: Order) -> tuple[Exemplar, Views]:
    """One exemplar, grown and measured."""
    recipe = parse_recipe(order.text, file=order.file)
    return measure(
        grow(recipe, order.seed), name=order.name, title=recipe.title, habit=recipe.habit,
        recipe=recipe.text, source=recipe.source, seed=order.seed, version=__version__,
    )  # fmt: skip


def regenerate(
    out: Path, wanted: list[Order], *, jobs: int = 1, progress: Callable[[str], None] = lambda name: None
) -> Database:
    """Makes the exemplars and writes the file; `progress` hears each name when it is done."""
    made = []
    for exemplar, views in _in_turn(wanted, jobs):
        made.append((exemplar, views))
        progress(exemplar.name)
    write_database(out, to_columns(*zip(*made, strict=True)))
    return Database(out)


def _in_turn(wanted: list[Order], jobs: int) -> Iterator[tuple[Exemplar, Views]]:
    if jobs <= 1 or len(wanted) <= 1:
        yield from map(make, wanted)
        return
    # Ctrl-C is the parent's to handle; a worker that heard it too would print a traceback.
    quiet = {"initializer": signal.signal, "initargs": (signal.SIGINT, signal.SIG_IGN)}
    with ProcessPoolExecutor(min(jobs, len(wanted)), mp_context=get_context("spawn"), **quiet) as pool:
        yield from pool.map(make, wanted)
