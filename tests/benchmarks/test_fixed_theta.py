"""With Θ fixed, what the sketch left out has the template's angles."""

import pytest

from benchmarks.fixed_theta import AT_MOST, apart
from sketchtree.templates.store.database import Database


@pytest.mark.parametrize("name", ["english_oak", "apple", "norway_spruce"])
def test_grown_laterals_diverge_as_the_exemplar_s(name):
    found = apart(name, Database.open())
    assert found.laterals > 100
    assert found.fixed <= AT_MOST
