"""Which template a drawing gets while it is drawn."""

from types import SimpleNamespace

import pytest

from sketchtree.choose import _best
from sketchtree.editing.document import BEGINNING, Document
from sketchtree.templates.store.database import Database


def _ranked(**scores: float) -> list:
    return [SimpleNamespace(name=name, score=score) for name, score in sorted(scores.items(), key=lambda item: -item[1])]


def test_without_one_in_use_the_best_is_taken():
    assert _best(_ranked(oak=1.0, ash=0.0), None, 3) == "oak"
    assert _best(_ranked(oak=1.0, ash=0.0), "of another database", 3) == "oak"


@pytest.mark.parametrize(("limbs", "behind", "stays"), [(1, 50.0, True), (2, 4.9, True), (4, 5.1, False), (5, 3.9, True), (7, 4.1, False), (8, 0.9, True), (30, 1.1, False)])
def test_the_one_in_use_stays_the_longer_the_less_is_drawn(limbs, behind, stays):
    assert (_best(_ranked(oak=10.0, ash=10.0 - behind), "ash", limbs) == "ash") is stays


def test_an_empty_page_begins_with_a_template_that_there_is():
    assert Document.blank(name="new").settled.template == BEGINNING and BEGINNING in Database.open().names
    assert not Document.blank().settled
