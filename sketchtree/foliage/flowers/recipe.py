"""Of what is a species' blossom made? Figures, each read from a recipe, a TOML file that people can edit.

    form    umbel    flowers on stalks from one place, open ones outside, buds among them (apple, cherry, hawthorn)
            plate    the same on stalks that end at one height (elder)
            panicle  flowers round an upright axis (chestnut, lilac)
            catkin   bracts and anthers round an axis that hangs (hazel, birch, alder, willow)
            cluster  flowers on short stalks out of old wood (redbud)
    flower  five: petals alike round a heart with stamens; pea: a standard, two wings and a keel

Lengths are shares of the whole blossom's (`LeafModel.size`). Every key is checked: one that is unknown, a wrong type or a value out of range is a `TemplateError` that names file and key.
"""

from dataclasses import dataclass, fields
from functools import lru_cache
from pathlib import Path

from sketchtree.errors import TemplateError
from sketchtree.toml_file import read_table

FORMS, FLOWERS = ("umbel", "plate", "panicle", "catkin", "cluster"), ("five", "pea")
RANGES = {
    "petals": (3, 8),
    "flowers": (1, 200),
    "buds": (0, 40),
    "radius": (0.01, 1.0),
    "width": (0.1, 1.2),
    "notch": (0.0, 0.4),
    "cup": (-30.0, 90.0),
    "heart": (0.0, 0.5),
    "throat": (0.0, 1.0),
    "stamens": (0, 40),
    "stamen": (0.0, 1.0),
    "stalk": (0.0, 1.0),
    "spread": (0.0, 120.0),
    "wide": (0.01, 1.0),
}


@dataclass(frozen=True)
class Recipe:
    """One recipe, checked."""

    form: str
    flower: str = "five"
    petals: int = 5
    flowers: int = 5  # open
    buds: int = 0  # closed
    radius: float = 0.2  # of a flower
    width: float = 0.42  # half of a petal, petal lengths
    notch: float = 0.0  # how far a petal's tip is cut in, petal lengths
    cup: float = 20.0  # degrees that petals rise from the plane of the flower
    heart: float = 0.14  # radius of its middle, petal lengths
    throat: float = 0.0  # how far the heart's colour runs up the petals, petal lengths
    stamens: int = 12
    stamen: float = 0.35  # length, petal lengths
    stalk: float = 0.5  # of every flower
    spread: float = 70.0  # degrees that the outer stalks lean
    wide: float = 0.2  # half width of a panicle or a catkin


def recipe_folder() -> Path:
    """Where the recipes lie."""
    return Path(__file__).parent / "recipes"


def names() -> tuple[str, ...]:
    """Every blossom that has a recipe."""
    return tuple(sorted(path.stem for path in recipe_folder().glob("*.toml")))


@lru_cache(maxsize=None)
def recipe(name: str) -> Recipe:
    """The recipe of a blossom, by the name of its leaf model."""
    return read_recipe(recipe_folder() / f"{name}.toml")


def read_recipe(path: Path | str) -> Recipe:
    """The recipe in one TOML file. Raises TemplateError."""
    path = Path(path)
    table = read_table(path, "Flower")
    known = [field.name for field in fields(Recipe)]
    for key, value in table.items():
        if key not in known:
            raise TemplateError(f"Flower {path.name}: `{key}` is not known.", remedy=f"Leave it out; known are: {', '.join(known)}.")
        _check(key, value, path.name)
    if "form" not in table:
        raise TemplateError(f"Flower {path.name}: `form` is missing.", remedy=f"Give one of: {', '.join(FORMS)}.")
    return Recipe(**table)


def _check(key: str, value, file: str) -> None:
    choices = {"form": FORMS, "flower": FLOWERS}.get(key)
    if choices is not None:
        if value not in choices:
            raise TemplateError(f"Flower {file}: `{key}` is {value!r}.", remedy=f"Give one of: {', '.join(choices)}.")
        return
    low, high = RANGES[key]
    kinds = int if isinstance(low, int) else int | float
    if isinstance(value, bool) or not isinstance(value, kinds) or not low <= value <= high:
        raise TemplateError(f"Flower {file}: `{key}` is {value!r}.", remedy=f"Give a {'whole ' if kinds is int else ''}number from {low:g} to {high:g}.")
