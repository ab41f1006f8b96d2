"""What does a species look like? Reading one exemplar's recipe, a TOML file people can edit.

A recipe has a head (`name`, `title`, `species`, `growth_habit`, `source`, `seed`), a `[crown]`, one `[[limbs]]` table a level
(level 0 the trunk; the last table serves all deeper levels up to `levels`), and a `[habit]` that fills `parameters.Habit`. Lengths
are metres, angles degrees, and every key is checked: an unknown key, a wrong type or a value out of
range is a `TemplateError` that names file and key. The keys, their units and ranges are the fields
below; `template_db/README.md` lists them.
"""

import dataclasses
import json
import tomllib
from dataclasses import dataclass
from pathlib import Path

from sketchtree.errors import TemplateError
from sketchtree.parameters import Habit
from sketchtree.templates.growing.profile import Profile
from sketchtree.templates.growing.tables import Crown, Limbs

NAME_LENGTH = 48  # characters, at most


GROWTH_HABITS = ("decurrent", "fastigiate", "weeping", "excurrent", "umbrella", "palm", "shrub", "irregular")


@dataclass(frozen=True)
class Recipe:
    """One exemplar's recipe, checked."""

    name: str
    title: str
    species: str  # botanical name; several exemplars (young, old) may share it; "" unknown
    growth_habit: str  # one of GROWTH_HABITS; "" not said
    source: str  # where the figures come from; "estimated" where nobody measured
    seed: int
    crown: Crown
    limbs: tuple[Limbs, ...]
    habit: Habit
    text: str  # the file as it stands

    def level(self, level: int) -> Limbs:
        """The table of a level; the last serves all deeper ones."""
        return self.limbs[min(level, len(self.limbs) - 1)]


def read_recipe(path: Path | str) -> Recipe:
    """The recipe in one TOML file."""
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise TemplateError(f"Recipe {path}: it can't be read ({error}).", remedy="Give a readable TOML file.") from error
    return parse_recipe(text, file=path.name)


def parse_recipe(text: str, *, file: str) -> Recipe:
    """The recipe in `text`; `file` names it in errors."""
    try:
        table = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise TemplateError(f"Recipe {file}: it is not valid TOML ({error}).", remedy="Correct that line.") from error
    known = {"name", "title", "species", "growth_habit", "source", "seed", "crown", "limbs", "habit"}
    _refuse_unknown(table, known, file, "")
    limbs = _require(table, "limbs", list, file, "")
    if not limbs or not all(isinstance(level, dict) for level in limbs):
        _fail(file, "limbs", "it needs at least one [[limbs]] table.", "Describe the trunk in the first.")
    name = _require(table, "name", str, file, "")
    if not (name.isidentifier() and name == name.lower() and len(name) <= NAME_LENGTH):
        _fail(file, "name", f"{name!r} is no plain name.", f"Use small letters, digits and _ (at most {NAME_LENGTH}).")
    seed = _require(table, "seed", int, file, "")
    if not 0 <= seed < 2**32:
        _fail(file, "seed", f"{seed} is out of range.", "Give an integer from 0 to 2³² − 1.")
    growth_habit = _require(table, "growth_habit", str, file, "") if "growth_habit" in table else ""
    if "growth_habit" in table and growth_habit not in GROWTH_HABITS:
        _fail(file, "growth_habit", f"{growth_habit!r} is not known.", f"Give one of: {', '.join(GROWTH_HABITS)}.")
    levels = tuple(_record(Limbs, level, file, f"limbs[{i}]") for i, level in enumerate(limbs))
    if min(levels[0].ratio.values) <= 0:
        _fail(file, "limbs[0].ratio", "the trunk has no length.", "Give it a ratio above 0.")
    return Recipe(
        name=name,
        title=_require(table, "title", str, file, ""),
        species=_require(table, "species", str, file, "") if "species" in table else "",
        growth_habit=growth_habit,
        source=_require(table, "source", str, file, ""),
        seed=seed,
        crown=_record(Crown, _require(table, "crown", dict, file, ""), file, "crown"),
        limbs=levels,
        habit=_habit(_require(table, "habit", dict, file, ""), file),
        text=text,
    )


def _record(kind: type, table: dict, file: str, where: str):
    fields = {f.name: f for f in dataclasses.fields(kind)}
    _refuse_unknown(table, set(fields), file, where)
    values = {}
    for name, key in fields.items():
        if name in table:
            values[name] = _value(table[name], key, file, f"{where}.{name}")
        elif key.default is dataclasses.MISSING:
            meaning, unit = key.metadata["meaning"], key.metadata["unit"]
            _fail(file, f"{where}.{name}", "it is missing.", f"Add it: {meaning} ({unit}).")
    return kind(**values)


def _value(value, key: dataclasses.Field, file: str, where: str):
    unit, meaning = key.metadata["unit"], key.metadata["meaning"]
    if unit == "bool":
        if not isinstance(value, bool):
            _fail(file, where, f"{value!r} is not true or false.", f"It says: {meaning}.")
        return value
    if _is_number(value) and key.name != "forks":
        _in_range(value, key, file, where)
        return Profile.constant(value) if _is_profile(key) else float(value)
    pairs = isinstance(value, list) and value and all(isinstance(p, list) and len(p) == 2 for p in value)
    if not (_is_profile(key) and pairs and all(_is_number(x) for p in value for x in p)):
        _fail(file, where, f"{value!r} is not {_wanted(key)}.", f"It is: {meaning} ({unit}).")
    place = [p[0] for p in value]
    if not all(0 <= at <= 1 for at in place) or any(b <= a for a, b in zip(place, place[1:], strict=False)):
        _fail(file, where, f"its places {place} do not rise from 0 to 1.", "Give places in rising order, from 0 to 1.")
    for _, x in value:
        _in_range(x, key, file, where)
    return Profile(tuple((float(a), float(b)) for a, b in value))


def _wanted(key: dataclasses.Field) -> str:
    if key.name == "forks":
        return "[[place, value], ...]"
    return "a number or [[place, value], ...]" if _is_profile(key) else "a number"


def _is_profile(key: dataclasses.Field) -> bool:
    return key.type in (Profile, Profile | None) or "Profile" in str(key.type)


def _is_number(value) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and value == value


def _in_range(value, key, file, where) -> None:
    low, high, unit = (key.metadata[k] for k in ("low", "high", "unit"))
    if not low <= value <= high:
        _fail(file, where, f"{value} is out of range.", f"Give {low:g} to {high:g} ({unit}): {key.metadata['meaning']}.")
    if unit == "count" and value != int(value):
        _fail(file, where, f"{value} is no whole number.", f"It is: {key.metadata['meaning']}.")


ARRANGEMENTS = ("alternate", "opposite", "whorled", "spiral")
LEAF_ARRANGEMENTS = ("opposite", "decussate", "alternate", "whorled", "spiral", "fascicled", "frond")
_HABIT_RANGE = {
    "height": (0.3, 120), "trunk_ratio": (0.001, 0.2), "pipe_exponent": (1, 4), "twig_radius": (1e-4, 0.1),
    "max_order": (0, 12), "whorl": (1, 60), "phyllotaxis": (0, 360), "lateral_spacing": (0.01, 20),
    "lateral_ratio": (0, 4), "lateral_angle": (0, 180), "twig_length": (0.01, 20), "gravitropism": (-720, 720),
    "apical_control": (0, 1), "leaf_size": (0.001, 10), "leaf_spacing": (0.001, 10),
}  # fmt: skip


def _habit(table: dict, file: str) -> Habit:
    fields = {f.name: f for f in dataclasses.fields(Habit)}
    _refuse_unknown(table, set(fields), file, "habit")
    for name, value in table.items():
        where, wanted = f"habit.{name}", type(getattr(Habit(), name))
        if wanted is float and _is_number(value):
            value = float(value)
        if not isinstance(value, wanted) or isinstance(value, bool):
            _fail(file, where, f"{value!r} is not a {wanted.__name__}.", "Correct its type.")
        if name in _HABIT_RANGE and not _HABIT_RANGE[name][0] <= value <= _HABIT_RANGE[name][1]:
            _fail(file, where, f"{value} is out of range.", "Give {:g} to {:g}.".format(*_HABIT_RANGE[name]))
        choices = {"arrangement": ARRANGEMENTS, "leaf_arrangement": LEAF_ARRANGEMENTS}.get(name)
        if choices and value not in choices:
            _fail(file, where, f"{value!r} is not known.", f"Give one of: {', '.join(choices)}.")
    try:
        json.dumps(table)
    except (TypeError, ValueError):
        _fail(file, "habit.extra", "it holds a value that the database can't keep.", "Use numbers, text, lists and tables.")
    return Habit(**{k: float(v) if isinstance(getattr(Habit(), k), float) else v for k, v in table.items()})


def _require(table: dict, key: str, kind: type, file: str, where: str):
    name = f"{where}.{key}" if where else key
    if key not in table:
        _fail(file, name, "it is missing.", "Add it; template_db/README.md lists the keys.")
    if not isinstance(table[key], kind) or isinstance(table[key], bool):
        _fail(file, name, f"{table[key]!r} is not a {kind.__name__}.", "Correct its type.")
    return table[key]


def _refuse_unknown(table: dict, known: set[str], file: str, where: str) -> None:
    for key in table:
        if key not in known:
            name = f"{where}.{key}" if where else key
            _fail(file, name, "it is not a key of recipes.", f"Use one of: {', '.join(sorted(known))}.")


def _fail(file: str, key: str, message: str, remedy: str) -> None:
    raise TemplateError(f"Recipe {file}, `{key}`: {message}", remedy=remedy)
