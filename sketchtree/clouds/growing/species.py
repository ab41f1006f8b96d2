"""How does a species grow? Five figures, each read from a recipe, a TOML file that people can edit.

Guo et al. 2018, Tables 1 and 2. A recipe has `name`, `title`, `source` and

    internode   l   metres, in a box of 10 m (`box`)       roll       φ   degrees from lateral to lateral
    branching   ψ   degrees between a lateral and its shoot     gamma      γ   of Eq. 5

The fifth, ρ, follows from l and the plant's height (`logistic`). Every key is checked: an unknown key, a wrong type or a value out of range is a `TemplateError` that names file and key.
"""

import tomllib
from dataclasses import dataclass, fields
from pathlib import Path

from sketchtree.errors import OptionError, TemplateError

_RANGE = {"internode": (0.005, 0.5), "roll": (0.0, 360.0), "branching": (0.0, 120.0), "gamma": (0.2, 1.0)}


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


def recipe_folder() -> Path:
    """Where the recipes lie."""
    return Path(__file__).parent / "recipes"


def names() -> tuple[str, ...]:
    """Every species that has a recipe."""
    return tuple(sorted(path.stem for path in recipe_folder().glob("*.toml")))


def species(name: str) -> Species:
    """The species of that name. Raises OptionError for one without a recipe."""
    if name not in names():
        raise OptionError(f"No species {name!r} is known for growth toward points.", remedy=f"Choose one of: {', '.join(names())}.")
    return read_species(recipe_folder() / f"{name}.toml")


def read_species(path: Path | str) -> Species:
    """The species in one TOML file."""
    path = Path(path)
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise TemplateError(f"Recipe {path.name}: it can't be read ({error}).", remedy="Give a readable TOML file.") from error
    known = [field.name for field in fields(Species)]
    for key in table:
        if key not in known:
            raise TemplateError(f"Recipe {path.name}: `{key}` is not known.", remedy=f"Leave it out; known are: {', '.join(known)}.")
    return Species(**{key: _value(table, key, path.name) for key in known})


def _value(table: dict, key: str, file: str):
    if key not in table:
        raise TemplateError(f"Recipe {file}: `{key}` is missing.", remedy="Add it.")
    value = table[key]
    if key not in _RANGE:
        if not isinstance(value, str):
            raise TemplateError(f"Recipe {file}: `{key}` is {value!r}.", remedy="Give a text.")
        return value
    low, high = _RANGE[key]
    if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
        raise TemplateError(f"Recipe {file}: `{key}` is {value!r}.", remedy=f"Give a number from {low:g} to {high:g}.")
    return float(value)
