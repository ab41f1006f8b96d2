"""How is the database made from its recipes? Grow, measure, write.

Every exemplar depends on its recipe's text and its seed alone, so the result does not depend on how many
processes or machines share the work. With `count`, recipes are used in turn; each further round grows a variant
(`name_2`, `name_3`, …) from a seed of its own. Exemplars are written as they come, in order (`writer`), and kept beside
the target until all are there (`journal`): memory doesn't grow with their number, and a build that was stopped goes on.
"""

from collections.abc import Callable
from contextlib import closing
from pathlib import Path

from sketchtree.errors import TemplateError
from sketchtree.templates.making.cluster import cluster
from sketchtree.templates.store.columns import TEXTS, texts
from sketchtree.templates.making.crew import in_turn, processes
from sketchtree.templates.store.database import Database
from sketchtree.templates.making.journal import Journal
from sketchtree.templates.making.order import Order, make
from sketchtree.templates.growing.recipe import Recipe, parse_recipe, read_recipe
from sketchtree.templates.store.writer import Writer
from sketchtree.version import __version__

__all__ = ["Order", "make", "orders", "recipe_folder", "regenerate"]

ROUND = 7919  # between the seeds of two rounds of variants


def recipe_folder() -> Path:
    """Where the recipes of this checkout lie."""
    return Path(__file__).resolve().parents[3] / "template_db"


def orders(folder: Path, *, only: tuple[str, ...] = (), count: int | None = None, seed: int = 0) -> list[Order]:
    """What to make from the recipes in `folder`, in the order of their names. `only` names recipes or, botanically, species;
    `seed` is added to the recipes' own."""
    files = sorted(Path(folder).glob("*.toml"))
    if not files:
        raise TemplateError(
            f"There are no recipes (*.toml) in {folder}.", remedy="Run it in a checkout, or name a folder with --recipes."
        )
    recipes = {recipe.name: (recipe, file.name) for file, recipe in ((f, read_recipe(f)) for f in files)}
    if len(recipes) < len(files):
        raise TemplateError(f"Two recipes in {folder} have the same `name`.", remedy="Give each a name of its own.")
    for name in only:
        if name not in recipes and not any(recipe.species == name for recipe, _ in recipes.values()):
            known = ", ".join(sorted(recipes))
            raise TemplateError(f"There is no recipe called {name!r}.", remedy=f"Use one of: {known}.")
    chosen = [recipes[name] for name in sorted(recipes) if not only or {name, recipes[name][0].species} & set(only)]
    wanted = len(chosen) if count is None else count
    return [_order(*chosen[i % len(chosen)], i // len(chosen), seed) for i in range(wanted)]


def _order(recipe: Recipe, file: str, turn: int, seed: int) -> Order:
    name = recipe.name + (f"_{turn + 1}" if turn else "")
    return Order(recipe.text, file, name, (recipe.seed + seed + ROUND * turn) % 2**32)


def regenerate(
    out: Path,
    wanted: list[Order],
    *,
    jobs: int = 1,
    scheduler: str | None = None,
    progress: Callable[[str], None] = lambda name: None,
    say: Callable[[str], None] = lambda text: None,
) -> Database:
    """Makes the exemplars and writes the file, on `jobs` processes or on a Dask cluster; `progress` hears each name when it
    is done, `say` what was found of an earlier run and what is kept of this one."""
    out, journal = Path(out), Journal(out)
    crew = cluster(scheduler) if scheduler is not None else processes(min(jobs, len(wanted)))
    if found := journal.count(wanted):
        say(f"taking up {found} of {len(wanted)} exemplars from an earlier run ({journal.folder})")
    try:
        with Writer(out, len(wanted), _widths(wanted)) as writer, crew as makers, closing(in_turn(wanted, makers, journal)) as made:
            for order, block in made:
                writer.add(block)
                progress(order.name)
    except BaseException:
        if kept := journal.count(wanted):
            say(f"{kept} finished exemplars are kept in {journal.folder}; the same command goes on from there")
        raise
    journal.drop()
    return Database(out)


def _widths(wanted: list[Order]) -> dict[str, int]:
    """The longest text of every text column, bytes."""
    heads, longest = {}, dict.fromkeys(TEXTS, 1)
    for order in wanted:
        if order.text not in heads:
            recipe = parse_recipe(order.text, file=order.file)
            heads[order.text] = texts(
                name="", title=recipe.title, species=recipe.species, growth_habit=recipe.growth_habit, recipe=recipe.text,
                source=recipe.source, habit=recipe.habit, version=__version__,
            )  # fmt: skip
        row = heads[order.text] | {"exemplar/name": order.name.encode()}
        longest = {column: max(longest[column], len(row[column])) for column in TEXTS}
    return longest
