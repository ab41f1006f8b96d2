"""Which template, which leaf and which height does a photo's tree get, if nobody says so?

Footprint and branching (`templates.matching`) are told from what is drawn, and of a leafy tree in a photo little is: a trunk and the few limbs that show. So

- only ordinary trees are thought of, conifers where the silhouette is a conifer's (`photo.cone`), else broadleaves: a bonsai, a dead oak or a palm has to be named;
- the likeliest is taken where it is SURE among those, on at least LIMBS limbs; else a neutral one of its family (of a bare tree, which shows how it branches, the likeliest all the same),
  which is told, and PLAUSIBLE metres high: a height is never taken from a guess;
- a bare trunk that is taken from scribbles gets the neutral one of the broadleaves, unless another is SURE: `benchmarks.trunk_species` finds that the likeliest is never the right one, and that
  bark in shade, before the sky or in a grey photo has no colour that tells, a birch's neither;
- leaves are a willow's, whatever the template, where the photo shows that they are long and narrow (`photo.blades`), and flowers of a cherry, or of the sure template, where it shows a
  tree in blossom (`photo.flowering`).
"""

import dataclasses
import json
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool

from sketchtree.foliage.models import leaf_model
from sketchtree.foliage.species.conifers import CONIFERS
from sketchtree.foliage.species.monocots import MONOCOTS
from sketchtree.options import ReadingOptions
from sketchtree.photo.blades import blades_are_narrow
from sketchtree.photo.cone import CrownShape
from sketchtree.photo.flowering import is_in_blossom
from sketchtree.photo.foliage import Foliage
from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import Photo
from sketchtree.photo.trace.traced import Traced
from sketchtree.sketch.graph import SketchGraph
from sketchtree.templates.matching.match import Match, match
from sketchtree.templates.store.database import Database

SURE = 0.97  # probability among trees of its family: a poplar has made a horse chestnut at .82, a peach an olive at .94; a vase-shaped elm makes an elm at .997
LIMBS = 8  # fewer say too little: seven of a hickory make an olive at .81, four of an apple a weeping beech at .91
NEUTRAL = {"broadleaf": "small_leaved_lime", "conifer": "norway_spruce"}
NARROW_LEAF, FLOWER = "willow", "cherry_blossom"
PLAUSIBLE = 10.0  # metres: half of a park's elm, three times an orchard's peach
_RARE = ("irregular", "palm")  # habits that a photo's tree isn't thought to have
_RANKED = 200  # of a large database, that are looked at


@dataclass(frozen=True)
class Choice:
    """What a tree grows by."""

    reading: ReadingOptions  # with the template, and the height if it was nobody's
    leaf: str | None = None  # None: the template's
    told: tuple[str, ...] = ()
    told_leaf: tuple[str, ...] = ()

    def warnings(self, leaf: str | None) -> tuple[str, ...]:
        """What to tell where `leaf` was asked for (None: none was)."""
        return self.told + (self.told_leaf if leaf is None else ())


def choose_for_photo(
    photo: Photo, marked: Marked, foliage: Foliage, traced: Traced, graph: SketchGraph, templates: Database | None, reading: ReadingOptions, *,
    leafy: Bool[np.ndarray, "row column"] | None = None, scaled: bool = False,
) -> Choice:  # fmt: skip
    """The template, unless one was named, with what the user should know. `leafy`: the pixels that show a leaf; `scaled`: the tree's scale is known already."""
    if templates is None or reading.template != "auto":
        return Choice(reading)
    family = _family(foliage, marked, traced)
    found = _of_family(match(graph.above_ground(), templates, count=_RANKED), templates, family)
    says_enough = len(graph.limb_id) >= LIMBS
    is_sure = says_enough and _share_of_first(found) >= SURE
    name = found[0].name if is_sure or says_enough and foliage.bare and found else _neutral(found, templates, family)
    leaf = None if family == "conifer" or foliage.bare else _leaf(photo, foliage.mask if leafy is None else leafy, foliage.mask, name if is_sure else None, templates)
    about_leaf = () if leaf is None else (_told_leaf(leaf),)
    if name is None:
        return Choice(reading, leaf, (), about_leaf)
    height = reading.height if is_sure or scaled else reading.height or PLAUSIBLE
    about = () if is_sure else (_told(name, family, height if reading.height is None else None),)
    return Choice(dataclasses.replace(reading, template=name, height=height), leaf, about, about_leaf)


def choose_for_trunk(graph: SketchGraph, templates: Database | None, reading: ReadingOptions) -> Choice:
    """The same for a bare trunk that was taken from a picture: a neutral broadleaf, unless its limbs make sure of another."""
    if templates is None or reading.template != "auto":
        return Choice(reading)
    found = broadleaves(graph, templates)
    if len(graph.limb_id) >= LIMBS and _share_of_first(found) >= SURE:
        return Choice(dataclasses.replace(reading, template=found[0].name))
    name = _neutral(found, templates, "broadleaf")
    if name is None:
        return Choice(reading)
    height = reading.height or PLAUSIBLE
    return Choice(dataclasses.replace(reading, template=name, height=height), told=(_told_trunk(name, height if reading.height is None else None),))


def broadleaves(graph: SketchGraph, templates: Database) -> list[Match]:
    """The ordinary broadleaved trees that the limbs may be of, the likeliest first."""
    return _of_family(match(graph.above_ground(), templates, count=_RANKED), templates, "broadleaf")


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


def _leaf(photo: Photo, leafy, mask, sure: str | None, templates: Database) -> str | None:
    """The model that the photo shows instead of the template's."""
    if is_in_blossom(photo, leafy):
        return (leaf_model(templates.exemplar(sure).habit.leaf).blossom if sure else None) or FLOWER
    return NARROW_LEAF if blades_are_narrow(photo, mask) else None


def _told(name: str, family: str, height: float | None) -> str:
    """What the user should know of a template that is not sure."""
    size = "" if height is None else f", {height:g} m high"
    said = "`--template` says" if height is None else "`--template` and `--height` say"
    return f"The photo doesn't show which {family} it is. It grows by the template {name}{size}; {said} otherwise."


def _told_trunk(name: str, height: float | None) -> str:
    """What the user should know of a template that a bare trunk doesn't tell."""
    size, more = ("", "") if height is None else (f", and it is {height:g} m high", " and `--height METRES`")
    return f"A bare trunk doesn't show which tree it is. Unless others are named it has the leaves and the bark of {name}{size}: `--template NAME`, `--leaf MODEL`{more} say otherwise."


def _told_leaf(leaf: str) -> str:
    """What the user should know of leaves that are not the template's."""
    if leaf_model(leaf).flower:
        return f"The photo shows a tree in blossom: instead of leaves it wears {leaf}; `--leaf` says otherwise."
    return f"The photo shows long, narrow leaves: it wears those of a {leaf}; `--leaf` says otherwise."
