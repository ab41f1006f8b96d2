"""Which leaves are there? The lookup of all leaf models; what each is stands in the rooms `species` and `drawings`."""

from functools import lru_cache

from sketchtree.errors import OptionError
from sketchtree.foliage.leaf_model import LeafModel
from sketchtree.foliage.painting import Painting
from sketchtree.foliage.species.blossoms import BLOSSOMS
from sketchtree.foliage.species.broadleaves import BROADLEAVES
from sketchtree.foliage.species.compound import COMPOUND
from sketchtree.foliage.species.conifers import CONIFERS
from sketchtree.foliage.species.monocots import MONOCOTS
from sketchtree.foliage.species.plain import PLAIN

_MODELS = {model.name: model for model in (*BROADLEAVES, *COMPOUND, *CONIFERS, *MONOCOTS, *BLOSSOMS)}
_UNLISTED = {model.name: model for model in PLAIN}


def leaf_names() -> tuple[str, ...]:
    """The names of all leaf models, blossoms last."""
    return tuple(_MODELS)


def plain_names() -> tuple[str, ...]:
    """The names of models that are no species', and not among `leaf_names`."""
    return tuple(_UNLISTED)


def leaf_model(name: str) -> LeafModel:
    """The model of that name, or an error that lists them."""
    if name in _UNLISTED:
        return _UNLISTED[name]
    if name not in _MODELS:
        raise OptionError(
            f"There is no leaf model called {name!r}.",
            remedy=f"Choose one of: {', '.join(_MODELS)}.",
        )
    return _MODELS[name]


@lru_cache(maxsize=None)
def leaf_painting(name: str) -> Painting:
    """The model's drawing, made once."""
    return leaf_model(name).draw()
