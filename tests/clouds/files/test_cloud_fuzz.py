"""Whatever a file holds, reading it ends in sound points and a sound skeleton, or in a SketchTreeError: nothing else ever comes out.

Short and the same every time; `python -m benchmarks.fuzz --reader ply` looks longer.
"""

import numpy as np
import pytest

from benchmarks.cloud_mutants import CLOUDS, mutant
from benchmarks.fuzz import outcome_of_cloud


@pytest.mark.parametrize("kind", CLOUDS)
def test_mutants_of_clouds_end_in_a_tree_or_a_clear_error(kind, tmp_path):
    path, found = tmp_path / f"mutant.{kind}", []
    for k in range(8):
        path.write_bytes(mutant(kind, np.random.default_rng((7, k))))
        found.append(outcome_of_cloud(path))
    assert "read" in found and any(said.startswith("refused") for said in found)
