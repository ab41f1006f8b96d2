"""Which template, which leaf and which height does a photo's tree get, if nobody says so?

Footprint and branching (`templates.matching`) are told from what is drawn, and of a leafy tree in a photo little is: a trunk and the few limbs that show. So

- only ordinary trees are thought of, conifers where the silhouette is a conifer's (`photo.cone`), else broadleaves: a bonsai, a dead oak or a palm has to be named;
- the likeliest is taken where it is SURE among those, on at least LIMBS limbs; else a neutral one of its family (of a bare tree, which shows how it branches, the likeliest all the same),
  which is told, and PLAUSIBLE metres high: a height is never taken from a guess;
- leaves are a willow's, whatever the template, where the photo shows that they are long and narrow (`photo.blades`).
"""

import dataclasses
import json
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from sketchtree.foliage.species.conifers import CONIFERS
from sketchtree.foliage.species.monocots import MONOCOTS
from sketchtree.options import ReadingOptions
from sketchtree.photo.blades import blades_are_narrow
from sketchtree.photo.cone import CrownShape
from sketchtree.photo.foliage import Foliage
from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import Photo
from sketchtree.photo.trace.traced import Traced
from sketchtree.sketch.graph import SketchGraph
from sketchtree.templates.matching.match import Match, match
from sketchtree.templates.store.database import Database

SURE = 0.9  # probability among trees of its family: ten limbs of a poplar make a horse chestnut at .82, eleven of an oak make an oak at .96
LIMBS = 8  # fewer say too little: three of a hickory make an olive at .51, five of a spruce a cedar at .68
NEUTRAL = {"broadleaf": "small_leaved_lime", "conifer": "norway_spruce"}
NARROW_LEAF = "willow"
PLAUSIBLE = 10.0  # metres: half of a park's elm, three times an orchard's peach
_RARE = ("irregular", "palm")  # habits that a photo's tree isn't thought to have
_RANKED = 200  # of a large database, that are looked at


@dataclass(frozen=True)
class Choice:
    """What a tree grows by."""

    reading: ReadingOptions  # with the template, and the height if it was nobody's
    leaf: str | None = None  # None: the template's
    told: tuple[str, ...] = ()


def choose_for_photo(
    photo: Photo, marked: Marked, foliage: Foliage, traced: Traced, graph: SketchGraph, templates: Database | None, reading: ReadingOptions, *, scaled: bool = False
) -> Choice:
    """The template, unless one was named, with what the user should know. `scaled`: the tree's scale is known already."""
    if templates is None or reading.template != "auto":
        return Choice(reading)
    family = _family(foliage, marked, traced)
    found = _of_family(match(graph.above_ground(), templates, count=_RANKED), templates, family)
    says_enough = len(graph.limb_id) >= LIMBS
    is_sure = says_enough and _share_of_first(found) >= SURE
    name = found[0].name if is_sure or says_enough and foliage.bare and found else _neutral(found, templates, family)
    leaf = NARROW_LEAF if family == "broadleaf" and not foliage.bare and blades_are_narrow(photo, foliage.mask) else None
    if name is None:
        return Choice(reading, leaf)
    height = reading.height if is_sure or scaled else reading.height or PLAUSIBLE
    return Choice(dataclasses.replace(reading, template=name, height=height), leaf, tuple(_told(name, family, leaf, is_sure, height if reading.height is None else None)))


def _family(foliage: Foliage, marked: Marked, traced: Traced) -> str:
    """conifer or broadleaf: a tree without leaves is none of the former."""
    shape = None if foliage.bare else CrownShape.of(foliage.mask, marked, traced)
    return "conifer" if shape is not None and shape.is_cone else "broadleaf"


def _of_family(matches: Iterable[Match], templates: Database, family: str) -> list[Match]:
    """Those that a photo's tree may be, in their order."""
    habits = templates.column("exemplar/habit")  # read as one: to open exemplar after exemplar takes ten times as long

    def may_be(name: str) -> bool:
        row = templates.index(name)
        return templates.growth_habits[row] not in _RARE and _family_of(json.loads(habits[row])["leaf"]) == family

    return [one for one in matches if may_be(one.name)]


def _family_of(leaf: str) -> str:
    """Of a tree that wears the leaf."""
    return next((family for family, models in (("conifer", CONIFERS), ("monocot", MONOCOTS)) if leaf in {model.name for model in models}), "broadleaf")


def _share_of_first(found: list[Match]) -> float:
    """How probable the first is among them."""
    return float(1.0 / np.exp(np.array([one.score - found[0].score for one in found])).sum()) if found else 0.0


def _neutral(found: list[Match], templates: Database, family: str) -> str | None:
    """A template that is wrong for no tree of the family; where the database lacks it, the likeliest, or None."""
    return NEUTRAL[family] if NEUTRAL[family] in templates.names else next((one.name for one in found), None)


def _told(name: str, family: str, leaf: str | None, is_sure: bool, height: float | None):
    """What the user should know of the choice."""
    if not is_sure:
        size = "" if height is None else f", {height:g} m high"
        said = "`--template` and `--height` say" if height is not None else "`--template` says"
        yield f"The photo doesn't show which {family} it is. It grows by the template {name}{size}; {said} otherwise."
    if leaf is not None:
        yield f"The photo shows long, narrow leaves: it wears those of a {leaf}; `--leaf` says otherwise."
