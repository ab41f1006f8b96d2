"""What is not installed is named, with the way to have it."""

import importlib
import sys

import numpy as np
import pytest
from PIL import Image

from sketchtree.errors import ViewsError
from sketchtree.multiview import compiled, sfm
from sketchtree.multiview.moves import fused

INSTALL = "Install it: pip install 'sketchtree[multiview]'."


def test_numba(monkeypatch):
    monkeypatch.setitem(sys.modules, "numba", None)
    with pytest.raises(ViewsError) as error:
        importlib.reload(compiled)
    assert str(error.value) == f"Depth from photos needs the package `numba`. {INSTALL}"


def test_pycolmap(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "pycolmap", None)
    for k in range(5):
        Image.new("RGB", (8, 8)).save(tmp_path / f"{k}.png")
    with pytest.raises(ViewsError) as error:
        sfm.structure_from_motion(tmp_path)
    assert str(error.value) == f"Finding where photos were taken from needs the package `pycolmap`. {INSTALL}"


def test_ortools(monkeypatch):
    monkeypatch.setitem(sys.modules, "ortools.graph.python.max_flow", None)
    with pytest.raises(ViewsError) as error:
        fused(np.array([[0.0, 1.0], [1.0, 0.0]]), np.array([[0, 1]]), np.zeros((1, 2, 2)))
    assert str(error.value) == f"Refining depth maps needs the package `ortools`. {INSTALL}"
