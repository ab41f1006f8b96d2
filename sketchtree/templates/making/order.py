"""What is to be made, and how is one of it made?"""

from dataclasses import dataclass

import numpy as np

from sketchtree.errors import SketchTreeError
from sketchtree.templates.store.columns import to_columns
from sketchtree.templates.exemplar import Exemplar, Views, measure
from sketchtree.templates.making.fingerprint import fingerprint
from sketchtree.templates.growing.procedural import grow
from sketchtree.templates.growing.recipe import parse_recipe
from sketchtree.version import __version__


@dataclass(frozen=True)
class Order:
    """One exemplar to be made."""

    text: str  # of the recipe
    file: str  # its name, for errors
    name: str  # of the exemplar
    seed: int


@dataclass(frozen=True)
class Refusal:
    """An error of the user's input as it travels from a worker: cause and remedy."""

    message: str
    remedy: str


def foreign(program: str) -> Refusal | None:
    """What a worker answers to a client that is another `program` (its `fingerprint`); None if they are the same."""
    if program == fingerprint():
        return None
    return Refusal(
        f"A worker runs another SketchTree ({__version__}, or with other sources) than this one.",
        "Install the same version on the workers, and restart them.",
    )


Block = dict[str, np.ndarray]
"""The columns of one exemplar."""


def make(order: Order) -> tuple[Exemplar, Views]:
    """One exemplar, grown and measured."""
    recipe = parse_recipe(order.text, file=order.file)
    return measure(
        grow(recipe, order.seed), name=order.name, title=recipe.title, habit=recipe.habit, recipe=recipe.text,
        source=recipe.source, seed=order.seed, version=__version__, species=recipe.species, growth_habit=recipe.growth_habit,
    )  # fmt: skip


def make_block(order: Order, program: str | None = None) -> Block | Refusal:
    """One exemplar as it is stored, about 40 kB: what a worker sends back. Refuses where the worker is another `program`."""
    if program is not None and (refusal := foreign(program)) is not None:
        return refusal
    try:
        exemplar, views = make(order)
    except SketchTreeError as error:
        return Refusal(error.message, error.remedy)
    return to_columns([exemplar], [views])
