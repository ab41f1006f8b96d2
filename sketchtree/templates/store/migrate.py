"""What does a file of an older schema lack, and what stands there instead?

Schema 2 added `exemplar/species` and `exemplar/growth_habit`. In a file of schema 1 both are read from the heads of the recipes
it holds; empty where a recipe doesn't say. A file is brought up to date when it is next written (`templates build`,
`templates import --into`), never by reading it.
"""

import tomllib

import numpy as np

from sketchtree.templates.store.columns import COLUMNS

ADDED = {"exemplar/species": 2, "exemplar/growth_habit": 2}
"""Column → the schema that brought it."""

SOURCE = "exemplar/recipe"  # the column that they are filled from


def stored(schema: int) -> tuple[str, ...]:
    """The columns that a file of this schema has."""
    return tuple(name for name in COLUMNS if ADDED.get(name, 1) <= schema)


def filled(name: str, recipes: np.ndarray) -> np.ndarray:
    """Column `name` for exemplars with these recipes."""
    key = name.partition("/")[2]
    return np.array([_head(text).get(key, "").encode("utf-8") for text in recipes.tolist()] or np.zeros(0, "S1"))


def _head(recipe: bytes) -> dict[str, str]:
    try:
        table = tomllib.loads(recipe.decode("utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError):
        return {}
    return {key: value for key, value in table.items() if isinstance(value, str)}
