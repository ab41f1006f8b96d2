"""What nobody named is chosen by what the photo shows: nothing is guessed in silence, and what is named counts."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest

import leafy
from sketchtree import photo_choice
from sketchtree.options import ReadingOptions
from sketchtree.photo.foliage import Foliage
from sketchtree.photo.trace.traced import Traced
from sketchtree.photo_choice import PLAUSIBLE, Choice, choose_for_photo, choose_for_trunk
from sketchtree.templates.store.database import Database

TRACED = Traced(np.arange(len(leafy.TRUNK)) - 1, np.array(leafy.TRUNK, float), np.full(4, 5.0), np.zeros(4, int), np.zeros(4, int))
MASK = np.hypot(*(np.mgrid[: leafy.HIGH, : leafy.WIDE][::-1] - np.array([120.0, 105.0])[:, None, None])) < 85


def chosen(monkeypatch, scores: dict[str, float], *, limbs: int = 12, bare: bool = False, mask=MASK, narrow: bool = False, **reading) -> Choice:
    """The choice where matching scores exemplars so."""
    ranked = [SimpleNamespace(name=name, score=score) for name, score in sorted(scores.items(), key=lambda item: -item[1])]
    monkeypatch.setattr(photo_choice, "match", lambda graph, templates, count=None: ranked)
    monkeypatch.setattr(photo_choice, "blades_are_narrow", lambda photo, leafy: narrow)
    graph = SimpleNamespace(limb_id=np.arange(limbs), above_ground=lambda: None)
    foliage = Foliage(mask, mask, None, None, bare=bare)
    return choose_for_photo(leafy.leafy_photo(), leafy.leafy_marks(), foliage, TRACED, graph, Database.open(), ReadingOptions(**reading))


def test_what_is_sure_is_taken_with_its_height(monkeypatch):
    found = chosen(monkeypatch, {"english_oak": 5.0, "european_beech": 1.0})
    assert (found.reading.template, found.reading.height, found.leaf, found.told) == ("english_oak", None, None, ())


@pytest.mark.parametrize("scores, limbs", [({"olive": 1.0, "english_oak": 0.8}, 12), ({"english_oak": 9.0, "olive": 0.0}, 3)])
def test_what_is_not_sure_is_a_neutral_tree_of_a_plausible_height_and_told(monkeypatch, scores, limbs):
    found = chosen(monkeypatch, scores, limbs=limbs)
    assert (found.reading.template, found.reading.height) == ("small_leaved_lime", PLAUSIBLE)
    assert found.told == ("The photo doesn't show which broadleaf it is. It grows by the template small_leaved_lime, 10 m high; `--template` and `--height` say otherwise.",)


def test_a_bare_tree_shows_how_it_branches_but_not_how_high_it_is(monkeypatch):
    found = chosen(monkeypatch, {"norway_maple": 1.0, "european_beech": 0.9}, bare=True)
    assert (found.reading.template, found.reading.height, len(found.told)) == ("norway_maple", PLAUSIBLE, 1)


def test_needles_palms_and_oddities_are_no_guess_for_a_round_crown(monkeypatch):
    found = chosen(monkeypatch, {"bonsai_pine": 9.0, "dead_oak": 9.0, "date_palm": 9.0, "scots_pine": 9.0, "dragon_tree": 9.0, "english_oak": 4.0, "olive": 0.0})
    assert found.reading.template == "english_oak"


def test_a_cone_is_a_conifer(monkeypatch):
    monkeypatch.setattr(photo_choice.CrownShape, "of", classmethod(lambda cls, *_: cls(0.4, 0.5, 0.0, 1.0, 0.9)))
    assert chosen(monkeypatch, {"english_oak": 9.0, "deodar_cedar": 1.0}, limbs=3).reading.template == "norway_spruce"
    assert chosen(monkeypatch, {"english_oak": 9.0, "silver_fir": 6.0, "deodar_cedar": 1.0}).reading.template == "silver_fir"


def test_narrow_blades_are_a_willows_and_told(monkeypatch):
    found = chosen(monkeypatch, {"english_oak": 9.0, "olive": 0.0}, narrow=True)
    told = "The photo shows long, narrow leaves: it wears those of a willow; `--leaf` says otherwise."
    assert (found.leaf, found.warnings(None), found.warnings("oak")) == ("willow", (told,), ())


def test_what_is_named_counts(monkeypatch):
    assert chosen(monkeypatch, {"english_oak": 9.0}, template="olive", narrow=True) == Choice(ReadingOptions(template="olive"))
    assert chosen(monkeypatch, {"olive": 1.0}, limbs=3, height=3.5).reading.height == 3.5
    assert dataclasses.replace(ReadingOptions(), template="none") == chosen(monkeypatch, {}, template="none").reading


def test_a_tree_in_blossom_wears_flowers_those_of_its_species_where_that_is_sure(monkeypatch):
    monkeypatch.setattr(photo_choice, "is_in_blossom", lambda photo, leafy: True)
    found = chosen(monkeypatch, {"english_oak": 1.0, "olive": 0.9})
    assert found.leaf == "cherry_blossom" and found.warnings(None)[1] == "The photo shows a tree in blossom: instead of leaves it wears cherry_blossom; `--leaf` says otherwise."
    assert chosen(monkeypatch, {"apple": 9.0, "olive": 0.0}).leaf == "apple_blossom"
    assert chosen(monkeypatch, {"apple": 9.0, "olive": 0.0}, bare=True).leaf is None


def trunks(monkeypatch, scores: dict[str, float], *, limbs: int = 20, **reading) -> Choice:
    """The choice for a bare trunk where matching scores exemplars so."""
    ranked = [SimpleNamespace(name=name, score=score) for name, score in sorted(scores.items(), key=lambda item: -item[1])]
    monkeypatch.setattr(photo_choice, "match", lambda graph, templates, count=None: ranked)
    return choose_for_trunk(SimpleNamespace(limb_id=np.arange(limbs), above_ground=lambda: None), Database.open(), ReadingOptions(**reading))


def test_the_likeliest_of_a_bare_trunk_is_no_answer_and_that_is_told(monkeypatch):
    found = trunks(monkeypatch, {"european_ash": 1.0, "silver_birch": 0.5})
    assert (found.reading.template, found.reading.height) == ("small_leaved_lime", PLAUSIBLE)
    assert found.told == (
        "A bare trunk doesn't show which tree it is. Unless others are named it has the leaves and the bark of small_leaved_lime, and it is 10 m high: "
        "`--template NAME`, `--leaf MODEL` and `--height METRES` say otherwise.",
    )
    assert "it is" not in trunks(monkeypatch, {"european_ash": 1.0, "silver_birch": 0.5}, height=7.0).told[0].partition(". ")[2]


def test_a_bare_trunk_is_of_the_tree_that_its_limbs_make_sure_of_or_of_the_one_named(monkeypatch):
    assert trunks(monkeypatch, {"american_elm": 9.0, "olive": 1.0}).reading == ReadingOptions(template="american_elm")
    assert trunks(monkeypatch, {"american_elm": 9.0, "olive": 1.0}, limbs=5).reading.template == "small_leaved_lime"
    assert trunks(monkeypatch, {"american_elm": 9.0}, template="silver_birch") == Choice(ReadingOptions(template="silver_birch"))
