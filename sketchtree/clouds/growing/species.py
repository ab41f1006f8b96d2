"""How does a species grow? Five figures, each read from a recipe, a TOML file that people can edit.

Guo et al. 2018, Tables 1 and 2. A recipe has `name`, `title`, `source` and

    internode   l   metres, in a box of 10 m (`box`)       roll       φ   degrees from lateral to lateral
    branching   ψ   degrees between a lateral and its shoot     gamma      γ   of Eq. 5

The fifth, ρ, follows from l and the plant's height (`logistic`). A table `[growing]` says what else is not as the paper has it, by the names of `wanted.Growing`: theta, alpha, beta, tropism
("up", "down" or three numbers), influence ("logistic" or internodes) and so on. Every key is checked: an unknown key, a wrong type or a value out of range is a `TemplateError` that names
file and key.
"""

from dataclasses import dataclass, fields
from pathlib import Path

from sketchtree.clouds.growing.wanted import INFLUENCE, RANGES, Growing
from sketchtree.errors import OptionError, TemplateError
from sketchtree.toml_file import read_table

FIGURES = {"internode": (0.005, 0.5), "roll": (0.0, 360.0), "branching": (0.0, 120.0), "gamma": (0.2, 1.0)}
"""Within which each of a species' figures may lie."""

TROPISM = {"down": (0.0, -1.0, 0.0), "up": (0.0, 1.0, 0.0)}
"""V_tropism by word; down is what the paper prints."""

_SWITCHES = ("weighted", "steered", "decided", "settles", "sheds", "dominant", "direct", "holds", "persists")


@dataclass(frozen=True)
class Species:
    """One recipe, checked."""

    name: str
    title: str
    source: str  # where the figures come from
    internode: float  # l, metres in a box of 10 m
    roll: float  # φ, degrees
    branching: float  # ψ, degrees
    gamma: float  # γ
    growing: Growing = Growing()  # noqa: RUF009 (frozen); what else is its own


def recipe_folder() -> Path:
    """Where the recipes lie."""
    return Path(__file__).parent / "recipes"


def names() -> tuple[str, ...]:
    """Every species that has a recipe."""
    return tuple(sorted(path.stem for path in recipe_folder().glob("*.toml")))


def species(name: str) -> Species:
    """The species of that name, or in that TOML file. Raises OptionError for a name without a recipe, TemplateError for a file at fault."""
    if Path(name).suffix.lower() == ".toml":
        return read_species(name)
    if name not in names():
        raise OptionError(f"No species {name!r} is known for growth toward points.", remedy=f"Choose one of: {', '.join(names())}; or give a recipe of your own, a .toml file.")
    return read_species(recipe_folder() / f"{name}.toml")


def read_species(path: Path | str) -> Species:
    """The species in one TOML file."""
    path = Path(path)
    table = read_table(path, "Recipe")
    known = [field.name for field in fields(Species)]
    _check_known(table, known, "", path.name)
    return Species(**{key: _value(table, key, path.name) for key in known[:-1]}, growing=_growing(table.get("growing", {}), path.name))


def _check_known(table: dict, known, prefix: str, file: str) -> None:
    for key in table:
        if key not in known:
            raise TemplateError(f"Recipe {file}: `{prefix}{key}` is not known.", remedy=f"Leave it out; known are: {', '.join(known)}.")


def _value(table: dict, key: str, file: str):
    if key not in table:
        raise TemplateError(f"Recipe {file}: `{key}` is missing.", remedy="Add it.")
    if key in FIGURES:
        return _number(table[key], key, FIGURES[key], file)
    if not isinstance(table[key], str):
        raise TemplateError(f"Recipe {file}: `{key}` is {table[key]!r}.", remedy="Give a text.")
    return table[key]


def _number(value, key: str, between: tuple[float, float], file: str, or_else: str = "") -> float:
    low, high = between
    if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
        raise TemplateError(f"Recipe {file}: `{key}` is {value!r}.", remedy=f"Give a number from {low:g} to {high:g}{or_else}.")
    return float(value)


def _growing(table, file: str) -> Growing:
    """The table `[growing]`."""
    if not isinstance(table, dict):
        raise TemplateError(f"Recipe {file}: `growing` is {table!r}.", remedy="Make it a table: `[growing]`.")
    _check_known(table, (*RANGES, "tropism", "influence", *_SWITCHES), "growing.", file)
    try:
        return Growing(**{key: _choice(value, key, file) for key, value in table.items()})
    except OptionError as error:
        raise TemplateError(f"Recipe {file}: {error.message}", remedy=error.remedy) from error


def _choice(value, key: str, file: str):
    """One value of `[growing]`."""
    named = f"growing.{key}"
    if key in RANGES:
        return _number(value, named, RANGES[key], file)
    if key == "influence":
        return None if value == "logistic" else _number(value, named, INFLUENCE, file, ', internodes, or "logistic"')
    if key == "tropism":
        return _tropism(value, named, file)
    if not isinstance(value, bool):
        raise TemplateError(f"Recipe {file}: `{named}` is {value!r}.", remedy="Give true or false.")
    return value


def _tropism(value, named: str, file: str) -> tuple[float, float, float]:
    if isinstance(value, str) and value in TROPISM:
        return TROPISM[value]
    if isinstance(value, list) and len(value) == 3 and all(isinstance(one, int | float) and not isinstance(one, bool) and -1.0 <= one <= 1.0 for one in value):
        return tuple(float(one) for one in value)
    raise TemplateError(f"Recipe {file}: `{named}` is {value!r}.", remedy='Give "up", "down" or three numbers from -1 to 1: x, y, z.')
